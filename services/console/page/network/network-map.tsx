import { memo, useId, useRef, useState, type MouseEvent } from 'react';
import type { Place } from '../api';
import { Robots } from '../map/marks';
import { lostText, metres, placeOf, rowOf, spotOf, textOf, told, type Layout, type Link, type Row } from './network-layout';
import { placeNames, roundLength, type OnPlan } from '../map/plan';
import { useOnScreen } from '../map/shape';
import { stands } from '../robot/state';

const kRows_px = 400;    // that few rows share
const kRow_px = 52;
const kMostRow_px = 112;
const kLine = 0.55;      // of a row's height
const kSide_px = 18;
const kBow_px = 15;
const kArrow_px = 7;
const kLetter_px = 7.5;
const kMostZoom = 32;

// Where things are, in pixels.
export type Frame = { rowHeight: number; perMetre: number; width: number };
const xOf = (frame: Frame, row: Row, along_m: number) => kSide_px + (row.start_m + along_m) * frame.perMetre;
const yOf = (frame: Frame, row: number) => (row + kLine) * frame.rowHeight;

function head(toX: number, toY: number, x: number, y: number): string {
  const length = Math.hypot(x, y) || 1;
  const [ux, uy] = [x / length * kArrow_px, y / length * kArrow_px];
  const point = (px: number, py: number) => `${px.toFixed(1)} ${py.toFixed(1)}`;
  return `M${point(toX, toY)}L${point(toX - ux - 0.5 * uy, toY - uy + 0.5 * ux)}L${point(toX - ux + 0.5 * uy, toY - uy - 0.5 * ux)}z`;
}

function LinkPath({ link, rows, frame, chosen }: { link: Link; rows: Row[]; frame: Frame; chosen: string }) {
  const { joint, from, to } = link;
  const [x1, y1] = [xOf(frame, rows[from.row], from.along_m), yOf(frame, from.row)];
  const [x2, y2] = [xOf(frame, rows[to.row], to.along_m), yOf(frame, to.row)];
  const ring = from.row === to.row;
  const d = ring ? `M${x1} ${y1}v${kBow_px}H${x2}V${y2}` : `M${x1} ${y1}L${x2} ${y2}`;
  const heads = (ring ? head(x2, y2 + 3, 0, -1) : head(x2, y2, x2 - x1, y2 - y1))
    + (!joint.both ? '' : ring ? head(x1, y1 + 3, 0, -1) : head(x1, y1, x1 - x2, y1 - y2));
  const its = rows[from.row].name === chosen || rows[to.row].name === chosen;
  const of = chosen ? (its ? ' its' : ' others') : '';
  const kind = link.confidence !== null ? ' proposed' : link.used ? '' : ' unused';
  const why = link.confidence !== null ? `, proposed: ${Math.round(100 * link.confidence)} % sure`
    : link.used ? '' : ', not used: robots follow another revision';
  return (
    <g className={`joint${kind}${of}`}>
      <title>{`${textOf(joint.from)} ${joint.both ? 'and back' : 'to'} ${textOf(joint.to)}${why}`}</title>
      <path d={d} />
      <path className="head" d={heads} />
      {!joint.both && <circle cx={x1} cy={y1} r="3.5" />}
      {link.confidence !== null && <text x={(x1 + x2) / 2} y={(ring ? y1 + kBow_px : (y1 + y2) / 2) + 4} textAnchor="middle">?</text>}
    </g>
  );
}

// Names that would lie over others are left out: the table has them.
function Names({ row, i, frame }: { row: Row; i: number; frame: Frame }) {
  const y = yOf(frame, i);
  let free = -Infinity;
  return (
    <>
      {[...row.names].sort((one, other) => one.along_m - other.along_m).map((named) => {
        const x = xOf(frame, row, named.along_m);
        const wide = named.name.length * kLetter_px;
        const left = Math.max(0, Math.min(x - wide / 2, frame.width - wide));
        const shown = left > free;
        if (shown) free = left + wide + 4;
        return (
          <g key={named.name} className={named.used ? 'named' : 'named unused'}>
            <title>{`${named.name}: ${textOf(named.place)}`}</title>
            <circle cx={x} cy={y} r="6" />
            {shown && <text x={left} y={y + 21}>{named.name}</text>}
          </g>
        );
      })}
    </>
  );
}

// What does not move is drawn once.
const Lines = memo(function Lines({ rows, links, frame, chosen, hatch }: {
  rows: Row[]; links: Link[]; frame: Frame; chosen: string; hatch: string;
}) {
  return (
    <>
      {links.map((link, i) => <LinkPath key={i} link={link} rows={rows} frame={frame} chosen={chosen} />)}
      {rows.map((row, i) => {
        const y = yOf(frame, i);
        const begin = xOf(frame, row, 0);
        const end = xOf(frame, row, row.length_m);
        return (
          <g key={row.name} className={row.name === chosen ? 'row chosen' : 'row'}>
            <path className="track" d={`M${begin} ${y}H${end}`} />
            <path className="track-end" d={head(end + 5, y, 1, 0)} />
            <circle className="track-begin" cx={begin} cy={y} r="4.5" />
            {row.limits.map(({ from_m, to_m, stretch }, each) => (
              <path key={each} className="limited" d={`M${xOf(frame, row, from_m)} ${y}H${xOf(frame, row, to_m)}`}>
                <title>{`${row.name} ${metres(from_m)} to ${metres(to_m)} m: ${stretch.speed} times the taught speed, a metre counts as ${stretch.cost}`}</title>
              </path>
            ))}
            {row.backed.map(({ from_m, to_m }, each) => (
              <g key={`b${each}`} className="backed">
                <title>{`robots may drive backwards on ${row.name} from ${metres(to_m)} to ${metres(from_m)} m`}</title>
                <path d={`M${xOf(frame, row, from_m)} ${y + 13}H${xOf(frame, row, to_m)}`} />
                <path className="head" d={head(xOf(frame, row, from_m), y + 13, -1, 0)} />
              </g>
            ))}
            {row.narrow.map(({ from_m, to_m, takenBy }, each) => (
              <path key={`n${each}`} className="narrow" d={`M${xOf(frame, row, from_m)} ${y - 7}H${xOf(frame, row, to_m)}M${xOf(frame, row, from_m)} ${y + 7}H${xOf(frame, row, to_m)}`}>
                <title>{`${row.name} is narrow from ${metres(from_m)} to ${metres(to_m)} m${takenBy.length > 0 ? `, taken by ${takenBy.join(' and ')}` : ''}`}</title>
              </path>
            ))}
            {row.lost.map(({ from_m, to_m, stretch }, each) => (
              <path key={`x${each}`} className="lost-at" d={`M${xOf(frame, row, from_m)} ${y}H${xOf(frame, row, to_m)}`}>
                <title>{`robots lost their path on ${row.name} ${metres(from_m)} to ${metres(to_m)} m ${lostText(stretch)}`}</title>
              </path>
            ))}
            {row.closed.map(({ from_m, to_m }, each) => {
              const [left, right] = [xOf(frame, row, from_m), xOf(frame, row, to_m)];
              const middle = (left + right) / 2;
              return (
                <g key={each} className="closed">
                  <title>{`${row.name} is closed from ${metres(from_m)} to ${metres(to_m)} m`}</title>
                  <rect x={left} y={y - 7} width={Math.max(3, right - left)} height="14" fill={`url(#${hatch})`} />
                  <path d={`M${middle - 6} ${y - 6}l12 12m0-12l-12 12`} />
                </g>
              );
            })}
          </g>
        );
      })}
      {rows.map((row, i) => <Names key={row.name} row={row} i={i} frame={frame} />)}
    </>
  );
});

const RowNames = memo(function RowNames({ rows, rowHeight, chosen, onChoose }: {
  rows: Row[]; rowHeight: number; chosen: string; onChoose: (route: string) => void;
}) {
  return (
    <ol className="net-names" aria-label="Routes, from above">
      {rows.map((row) => (
        <li key={row.name} style={{ height: rowHeight }}>
          <button className="opens" aria-pressed={row.name === chosen} title={row.name}
            onClick={() => onChoose(row.name === chosen ? '' : row.name)}>
            {row.name}
          </button>
          <span>{row.length_m.toFixed(1)} m{row.joined ? '' : ', not joined'}</span>
        </li>
      ))}
    </ol>
  );
});

// Robots in pixels, those that stand above the others.
function marksOf(row: Row, i: number, frame: Frame): OnPlan[] {
  const marks: OnPlan[] = row.robots.map((robot) => ({
    robot, x: xOf(frame, row, Math.min(row.length_m, Math.max(0, robot.along_m ?? 0))), y: yOf(frame, i), heading: 0, name: null,
  }));
  marks.sort((one, other) => Number(stands(one.robot)) - Number(stands(other.robot)));
  // In its own row.
  placeNames(marks, (at, wide) => at.y > i * frame.rowHeight + 10 && at.y < (i + 1) * frame.rowHeight - 2
    && at.x > wide / 2 && at.x < frame.width - wide / 2);
  return marks;
}

export type Overlay = {
  way: { route: string; from_m: number; to_m: number }[];
  stretch: { route: string; from_m: number; to_m: number } | null;
  pins: string[];  // places, in words
};

function Over({ overlay, rows, frame }: { overlay: Overlay; rows: Row[]; frame: Frame }) {
  const band = ({ route, from_m, to_m }: { route: string; from_m: number; to_m: number }) => {
    const i = rowOf(rows, route);
    if (i < 0) return '';
    const row = rows[i];
    const within = (along_m: number) => xOf(frame, row, Math.min(row.length_m, Math.max(0, along_m)));
    return `M${within(from_m)} ${yOf(frame, i)}H${within(to_m)}`;
  };
  const pins = overlay.pins.map(placeOf).map((place) => place && spotOf(rows, place)).filter((spot) => spot !== null);
  return (
    <>
      <path className="on-way" d={overlay.way.map(band).join('')} />
      {overlay.stretch && <path className="on-stretch" d={band(overlay.stretch)} />}
      {pins.map((spot, i) => (
        <path key={i} className="pin" d={`M${xOf(frame, rows[spot!.row], spot!.along_m)} ${yOf(frame, spot!.row)}l-7-13a7.5 7.5 0 1 1 14 0z`} />
      ))}
    </>
  );
}

// `still`: the same rows without robots.
export function NetworkMap({ layout, still, chosen, onChoose, onPlace, overlay }: {
  layout: Layout;
  still: Row[];
  chosen: string;
  onChoose: (route: string) => void;
  onPlace: (place: Place) => void;
  overlay: Overlay;
}) {
  const ref = useRef<HTMLDivElement>(null);
  const [zoom, setZoom] = useState(1);
  const shown = useOnScreen(ref).width;
  const hatch = useId().replace(/:/g, '');
  const { rows, links, end_m } = layout;
  const width = Math.max(120, shown) * zoom;
  const rowHeight = Math.round(Math.min(kMostRow_px, Math.max(kRow_px, kRows_px / rows.length)));
  const perMetre = (width - 2 * kSide_px) / end_m;
  // The same object for as long as nothing of it changes.
  const last = useRef<Frame>({ rowHeight, perMetre, width });
  if (last.current.rowHeight !== rowHeight || last.current.perMetre !== perMetre || last.current.width !== width) {
    last.current = { rowHeight, perMetre, width };
  }
  const frame = last.current;
  const click = (event: MouseEvent<SVGSVGElement>) => {
    const box = event.currentTarget.getBoundingClientRect();
    const i = Math.min(rows.length - 1, Math.max(0, Math.floor((event.clientY - box.top) / rowHeight)));
    const row = rows[i];
    const along_m = (event.clientX - box.left - kSide_px) / perMetre - row.start_m;
    // What a pixel is worth is as exact as it gets.
    const digits = perMetre >= 100 ? 100 : perMetre >= 10 ? 10 : 1;
    const rounded = Math.round(Math.min(row.length_m, Math.max(0, along_m)) * digits) / digits;
    onPlace({ route: row.name, along_m: Math.min(rounded, Math.floor(row.length_m * 100) / 100) });
  };
  const bar_m = roundLength(shown / 4 / perMetre);
  return (
    <>
      <div className="net">
        <RowNames rows={still} rowHeight={rowHeight} chosen={chosen} onChoose={onChoose} />
        <div className="net-lines" ref={ref} tabIndex={zoom > 1 ? 0 : -1}>
          <svg role="img" width={width} height={rows.length * rowHeight} aria-label={told(layout)}
            onClick={click}>
            <defs>
              <pattern id={hatch} width="7" height="7" patternUnits="userSpaceOnUse" patternTransform="rotate(45)">
                <rect className="hatch-ground" width="7" height="7" /><rect className="hatch" width="3.5" height="7" />
              </pattern>
            </defs>
            <Lines rows={still} links={links} frame={frame} chosen={chosen} hatch={hatch} />
            <Over overlay={overlay} rows={rows} frame={frame} />
            {rows.map((row, i) => row.robots.length > 0 && <Robots key={row.name} marks={marksOf(row, i, frame)} />)}
          </svg>
        </div>
      </div>
      <p className="note net-scale">
        <svg width={bar_m * perMetre + 4} height="12" aria-hidden="true"><path className="bar" d={`M2 2v6h${bar_m * perMetre}v-6`} /></svg>{' '}
        {bar_m} m{' '}
        <span className="zoom">
          <button onClick={() => setZoom(Math.max(1, zoom / 2))} disabled={zoom <= 1} aria-label="Smaller">−</button>
          <button onClick={() => setZoom(Math.min(kMostZoom, zoom * 2))} disabled={zoom >= kMostZoom} aria-label="Larger">+</button>
        </span>
      </p>
      <NetworkLegend />
    </>
  );
}

function NetworkLegend() {
  const sample = (inside: JSX.Element) => <svg width="34" height="18" aria-hidden="true">{inside}</svg>;
  return (
    <details className="legend-box">
      <summary>Legend</summary>
      <p className="legend net-legend">
      <span>{sample(<><path className="track" d="M4 9H28" /><path className="track-end" d={head(33, 9, 1, 0)} /><circle className="track-begin" cx="5" cy="9" r="4" /></>)}a route, as it was taught</span>
      <span>{sample(<g className="joint"><path d="M6 2L24 16" /><path className="head" d={head(24, 16, 18, 14)} /></g>)}junction: robots may change over</span>
      <span>{sample(<g className="joint proposed"><path d="M4 9H30" /><text x="17" y="13" textAnchor="middle">?</text></g>)}proposed by a server</span>
      <span>{sample(<g className="joint unused"><path d="M6 2L24 16" /></g>)}not used: of another revision</span>
      <span>{sample(<path className="narrow" d="M3 3H31M3 15H31" />)}narrow</span>
      <span>{sample(<g className="closed"><rect className="sample" x="3" y="3" width="28" height="12" /><path d="M11 3l12 12m0-12l-12 12" /></g>)}closed</span>
      <span>{sample(<g className="backed"><path d="M3 9H31" /><path className="head" d={head(5, 9, -1, 0)} /></g>)}two-way (reverse)</span>
      <span>{sample(<path className="limited" d="M3 9H31" />)}slower, or counts as longer</span>
      <span>{sample(<path className="lost-at" d="M3 9H31" />)}robots lost their path there</span>
      <span>{sample(<g className="named"><circle cx="17" cy="9" r="6" /></g>)}a named place</span>
      <span>{sample(<g className="on-line free unheard"><circle cx="17" cy="9" r="7" /></g>)}where a robot stood last</span>
      </p>
    </details>
  );
}
