import { useRef, useState, useEffect, type PointerEvent } from 'react';
import type { Mark, Run } from './runs';

const kHeight = 132;
const kMarks = 14;     // y of what has happened,
const kSureTop = 28;   // of how sure it was,
const kSure = 34;
const kBesideTop = 70; // and of where it was beside its path
const kBeside = 46;
const kSide = 10;
const kOverlap = 0.4; // no gap is seen between cells

// From the bar's height as from its colour: lost, nothing to go by, unsure, sure, and not yet.
export const sureness = [
  { words: 'lost', share: 0.25 },
  { words: 'nothing to go by', share: 0.5 },
  { words: 'unsure', share: 0.75 },
  { words: 'sure', share: 1 },
  { words: 'waits', share: 0.1 },
];

const glyphs: Record<string, string> = {
  lost: 'M-5 -5 5 5M5 -5-5 5',
  stands: 'M-4 -5h3v10h-3zM1 -5h3v10h-3z',
  recovered: 'M-5 0 -1 4 5 -4',
  'looked-again': 'M-4 0a4 4 0 1 1 8 0a4 4 0 1 1 -8 0',
  carried: 'M-6 0h12M2 -4 6 0 2 4',
};
const otherGlyph = 'M0 -5 5 4h-10z';

export const markWords: Record<string, string> = {
  lost: 'lost', stands: 'stands', recovered: 'found itself again', 'looked-again': 'looked again', carried: 'carried off',
  dropped: 'frames left out',
};

function useWidth() {
  const ref = useRef<HTMLDivElement>(null);
  const [width, setWidth] = useState(320);
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => setWidth(Math.max(120, entry.contentRect.width)));
    observer.observe(ref.current!);
    return () => observer.disconnect();
  }, []);
  return { ref, width };
}

function Glyph({ mark, x }: { mark: Mark; x: number }) {
  return (
    <g className={`mark ${mark.what}`} transform={`translate(${x.toFixed(1)} ${kMarks})`}>
      <title>{mark.text}</title>
      <path d={glyphs[mark.what] ?? otherGlyph} />
    </g>
  );
}

// The run from its beginning to its end: how sure the robot was, what happened, and where it was
// beside its path by its own estimate.
export function RunStrip({ run, at, onRow }: { run: Run; at: number; onRow: (row: number) => void }) {
  const { ref, width } = useWidth();
  const strip = run.strip!;
  const { cells, length } = strip;
  const x = (value: number) => kSide + ((width - 2 * kSide) * value) / (length || 1);
  const ends = cells.at.map((_, i) => (i + 1 < cells.at.length ? cells.at[i + 1] : length));
  const bars = sureness.map(() => '');
  cells.sure.forEach((sure, i) => {
    const high = kSure * sureness[sure].share;
    const wide = Math.max(1, x(ends[i]) - x(cells.at[i]) + kOverlap);
    bars[sure] += `M${x(cells.at[i]).toFixed(1)} ${(kSureTop + kSure - high).toFixed(1)}h${wide.toFixed(1)}v${high}h${(-wide).toFixed(1)}z`;
  });
  const most = Math.max(0.1, ...cells.left_m.map((left, i) => Math.abs(left ?? 0) + (cells.left_sigma_m[i] ?? 0)));
  const y = (left: number) => kBesideTop + kBeside / 2 - (kBeside / 2) * Math.max(-1, Math.min(1, left / most));
  let path = '';
  let band = '';
  cells.left_m.forEach((left, i) => {
    if (left === null) return;
    const sigma = cells.left_sigma_m[i] ?? 0;
    path += `${path && cells.left_m[i - 1] !== null ? 'L' : 'M'}${x(cells.at[i]).toFixed(1)} ${y(left).toFixed(1)}`;
    const wide = Math.max(1, x(ends[i]) - x(cells.at[i]));
    band += `M${x(cells.at[i]).toFixed(1)} ${y(left + sigma).toFixed(1)}h${wide.toFixed(1)}V${y(left - sigma).toFixed(1)}h${(-wide).toFixed(1)}z`;
  });
  const handOvers = strip.marks.filter((mark) => mark.what === 'hand-over');
  const ticks = handOvers.map((mark) => `M${x(mark.at).toFixed(1)} ${kSureTop + kSure}v8`).join('');
  const pick = (event: PointerEvent<SVGSVGElement>) => {
    if (event.type === 'pointermove' && event.buttons === 0) return;
    const left = event.currentTarget.getBoundingClientRect().left;
    const wanted = ((event.clientX - left - kSide) / (width - 2 * kSide)) * length;
    let cell = cells.at.findIndex((begin) => begin > wanted) - 1;
    if (cell < -1) cell = cells.at.length - 1;
    if (cell < 0) cell = 0;
    const next = cell + 1 < cells.row.length ? cells.row[cell + 1] : run.rows;
    const share = (wanted - cells.at[cell]) / Math.max(1e-9, ends[cell] - cells.at[cell]);
    onRow(Math.min(next - 1, Math.max(cells.row[cell], Math.floor(cells.row[cell] + share * (next - cells.row[cell])))));
  };
  return (
    <div className="run-strip" ref={ref}>
      <svg
        width="100%" height={kHeight} role="img" onPointerDown={pick} onPointerMove={pick}
        aria-label={`The run, ${length.toFixed(1)} ${strip.unit}: ${strip.marks.length - handOvers.length} things marked`}
      >
        {bars.map((d, sure) => d && <path key={sure} className={`sure sure-${sure}`} d={d} />)}
        {ticks && <path className="hand-overs" d={ticks} />}
        {band && <path className="band" d={band} />}
        <path className="zero" d={`M${kSide} ${y(0)}H${width - kSide}`} />
        {path && <path className="left" d={path} />}
        {path && <text className="scale" x={kSide} y={kBesideTop + 4}>{most.toFixed(2)} m left</text>}
        {path && <text className="scale" x={kSide} y={kBesideTop + kBeside + 2}>{most.toFixed(2)} m right</text>}
        {strip.marks.filter((mark) => mark.what !== 'hand-over').map((mark, i) => <Glyph key={i} mark={mark} x={x(mark.at)} />)}
        <text className="scale" x={kSide} y={kHeight - 2}>0</text>
        <text className="scale" x={width - kSide} y={kHeight - 2} textAnchor="end">{length.toFixed(1)} {strip.unit}</text>
        <path className="now" d={`M${x(at).toFixed(1)} 4V${kHeight - 14}`} />
      </svg>
    </div>
  );
}

export function StripLegend({ run }: { run: Run }) {
  const marked = [...new Set(run.strip!.marks.map((mark) => mark.what))].filter((what) => what !== 'hand-over');
  return (
    <p className="legend">
      {[3, 2, 1, 0].map((sure) => (
        <span key={sure}>
          <svg width="14" height="16" aria-hidden="true">
            <rect className={`sure sure-${sure}`} width="14" y={16 - 16 * sureness[sure].share} height={16 * sureness[sure].share} />
          </svg>
          {sureness[sure].words}
        </span>
      ))}
      {marked.map((what) => (
        <span key={what}>
          <svg width="16" height="16" viewBox="-8 -8 16 16" aria-hidden="true" className="mark-sample">
            <g className={`mark ${what}`}><path d={glyphs[what] ?? otherGlyph} /></g>
          </svg>
          {markWords[what] ?? what}
        </span>
      ))}
      <span>line: beside its path by its own estimate, and ± σ; ticks: hand-overs</span>
    </p>
  );
}
