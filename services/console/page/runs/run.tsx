import { Copy } from '../copy';
import { useEffect, useMemo, useRef, useState } from 'react';
import { FramePicture } from './frame';
import { RunStrip, StripLegend } from './run-strip';
import { useFrame, useRun, useSeen, type Axis, type Run } from './runs';
import { when } from '../fleet';

const kLeap = 10;

const started = (run: Run) => (run.began_unix_ms === null ? '' : when(run.began_unix_ms));

// Arrow keys go from frame to frame, with shift ten at once, also where nothing has the focus.
function useKeys(step: (by: number) => void, to: (row: number) => void, rows: number) {
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => {
      const on = event.target as HTMLElement;
      const types = on.matches('textarea, select, input:not([type=range])');
      if (types || event.altKey || event.ctrlKey || event.metaKey) return;
      const by = event.shiftKey ? kLeap : 1;
      if (event.key === 'ArrowRight') step(by);
      else if (event.key === 'ArrowLeft') step(-by);
      else if (event.key === 'Home') to(0);
      else if (event.key === 'End') to(rows - 1);
      else return;
      event.preventDefault();
    };
    window.addEventListener('keydown', pressed);
    return () => window.removeEventListener('keydown', pressed);
  }, [step, to, rows]);
}

// At the pace at which it was driven.
function usePlay(t_s: number, step: () => void, isAtEnd: boolean): [boolean, (plays: boolean) => void] {
  const [plays, setPlays] = useState(false);
  const last = useRef(t_s);
  useEffect(() => {
    const pause_ms = Math.min(1000, Math.max(30, 1000 * (t_s - last.current)));
    last.current = t_s;
    if (!plays) return undefined;
    if (isAtEnd) {
      setPlays(false);
      return undefined;
    }
    const timer = window.setTimeout(step, pause_ms);
    return () => window.clearTimeout(timer);
  }, [plays, t_s, step, isAtEnd]);
  return [plays, setPlays];
}

function Story({ run, row, onRow }: { run: Run; row: number; onRow: (row: number) => void }) {
  const { story } = run;
  return (
    <section className="story" aria-label="What explain says of the run">
      <h3>What happened</h3>
      {story.happened.length === 0 && <p className="note">Nothing to tell: it was sure of the path all the way.</p>}
      <ol>
        {story.happened.map((each, i) => (
          <li key={i} aria-current={row >= each.first && row <= each.last ? 'true' : undefined}>
            <button className="opens" onClick={() => onRow(each.first)}><span className="where">{each.where}</span> {each.text}</button>
          </li>
        ))}
      </ol>
      {story.lesser > 0 && <p className="note">and {story.lesser} lesser things</p>}
      <details>
        <summary>Statistics</summary>
        <pre>{story.figures.join('\n')}</pre>
      </details>
    </section>
  );
}

function Frames({ run, axis, onAxis }: { run: Run; axis: Axis; onAxis: (axis: Axis) => void }) {
  const [row, setRow] = useState(0);
  const to = useMemo(() => (wanted: number) => setRow(Math.max(0, Math.min(run.rows - 1, wanted))), [run.rows]);
  const step = useMemo(() => (by: number) => setRow((had) => Math.max(0, Math.min(run.rows - 1, had + by))), [run.rows]);
  const next = useMemo(() => () => step(1), [step]);
  useKeys(step, to, run.rows);
  const frame = useFrame(run.run, row, run.rows);
  const seen = useSeen(run.run, row, run.pictures);
  const [plays, setPlays] = usePlay(frame?.t_s ?? 0, next, row >= run.rows - 1);
  const strip = run.strip!;
  const at = frame ? (strip.unit === 'm' ? frame.driven_m ?? 0 : frame.t_s) : 0;
  const marked = [...strip.marks.filter((mark) => mark.what !== 'hand-over').map((mark) => mark.row), ...run.story.happened.map((each) => each.first)];
  const before = Math.max(...marked.filter((each) => each < row), -1);
  const after = Math.min(...marked.filter((each) => each > row), run.rows);
  return (
    <>
      <RunStrip run={run} at={at} onRow={to} />
      <div className="stepper">
        <input
          type="range" min={0} max={run.rows - 1} value={row} aria-label="Frame" className="frames"
          aria-valuetext={`${row + 1} of ${run.rows}`} onChange={(event) => to(Number(event.target.value))}
        />
        <div className="orders">
          <button disabled={before < 0} onClick={() => to(before)}>What was before</button>
          <button aria-label="Ten frames back" onClick={() => step(-kLeap)}>« 10</button>
          <button aria-label="One frame back" onClick={() => step(-1)}>‹</button>
          <button aria-pressed={plays} onClick={() => setPlays(!plays)}>{plays ? 'Halt' : 'Play'}</button>
          <button aria-label="One frame on" onClick={() => step(1)}>›</button>
          <button aria-label="Ten frames on" onClick={() => step(kLeap)}>10 »</button>
          <button disabled={after >= run.rows} onClick={() => to(after)}>Next event</button>
          <label className="axis">Along
            <select value={axis} onChange={(event) => onAxis(event.target.value as Axis)}>
              <option value="metres">metres</option>
              <option value="seconds">time</option>
            </select>
          </label>
        </div>
        <p className="note">Arrow keys go frame by frame, with Shift ten at once.</p>
      </div>
      <StripLegend run={run} />
      <div className="beside">
        <section className="now" aria-label="This frame">
          <h3>Frame {row + 1} of {run.rows}{frame && `, ${frame.t_s.toFixed(2)} s`}</h3>
          {frame && <FramePicture run={run.run} frame={frame} seen={seen?.seen ?? null} row={seen?.row ?? -1} />}
          {frame && (
            <dl className="says" data-row={frame.row}>
              {frame.says.map(([about, text], i) => <div key={i}><dt>{about}</dt><dd>{text}</dd></div>)}
            </dl>
          )}
        </section>
        <Story run={run} row={row} onRow={to} />
      </div>
    </>
  );
}

// A run opened again from its log.
export function RunPage({ id }: { id: string }) {
  const [axis, setAxis] = useState<Axis>('metres');
  const run = useRun(id, axis);
  return (
    <section aria-label="Run" className="run">
      <p><a href="#history/runs">All runs</a></p>
      {run === null && <p role="status" className="note">Reads the log …</p>}
      {typeof run === 'string' && <p role="status" className="answer bad">⚠ {run}</p>}
      {run !== null && typeof run !== 'string' && (
        <>
          <h2>{run.robot || 'A robot'} along {run.route || 'a route'}{run.revision && ` revision ${run.revision}`}</h2>
          <p><strong>{run.story.outcome}</strong></p>
          <p className="note">
            {run.story.how_far}.{started(run) && ` Began ${started(run)}.`}
            {run.mission && <> <Copy id={run.mission} what="mission" /></>}
          </p>
          <p className="note">{run.story.who}</p>
          {run.story.missing.length > 0 && <p className="lacks">⚠ {run.story.missing.join(' ')}</p>}
          {run.strip
            ? <Frames run={run} axis={axis} onAxis={setAxis} />
            : <p className="note">The log has no frames: there is nothing to go through.</p>}
        </>
      )}
    </section>
  );
}
