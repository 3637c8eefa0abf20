import { memo, useMemo, useState, type KeyboardEvent } from 'react';
import type { Fleet, Mission } from '../api';
import { compareNames, when } from '../fleet';
import { keep, kept } from '../kept';
import { addressOf, isOver } from '../missions';
import { shapes } from '../robot/state';
import { keyOf, midnight, useDay, type Day } from './day';

const kMin_ms = 60000;
const kHour_ms = 60 * kMin_ms;
const kSteps_min = [1, 2, 5, 10, 15, 30, 60, 120, 180];
const kMostTicks = 9;
const kAhead = 0.03;  // of its span lies beyond now
const kFinest = 2000;  // of its span: less than a pixel
const kLeast = 0.018;     // of its span is a bar long at least, to be seen and pressed
const kBesideNow = 0.06;  // of the width: two times would lie over each other
const kKept = 'trailcast-timeline';
const ranges = { day: 'Today', hour: 'Last hour' };
type Range = keyof typeof ranges;

type Kind = 'waiting' | 'driving' | 'paused' | 'arrived' | 'failed' | 'cancelled';
const kinds: Record<string, Kind> = {
  sent: 'waiting', accepted: 'waiting', fetching: 'waiting', 'under way': 'driving', paused: 'paused', arrived: 'arrived',
  failed: 'failed', refused: 'failed', expired: 'failed', cancelled: 'cancelled',
};
const signs: Record<Kind, string> = {
  waiting: shapes.waiting, driving: shapes.driving, paused: shapes.paused, arrived: shapes.arrived, failed: shapes.failed, cancelled: shapes.offline,
};
const neverDrove = (mission: Mission) => mission.state === 'refused' || mission.state === 'expired';

const wasDone = (mission: Mission) => mission.state === 'arrived' || mission.state === 'failed';

// A mission was sent at `sent_ms` and began at `does_ms` or later. It ended at `end_ms`, or is known to go on until
// `known_ms`.
type Bar = { mission: Mission; kind: Kind; sent_ms: number; does_ms: number; known_ms: number; end_ms: number | null; lane: number };
type Row = { robot: string; bars: Bar[]; lanes: number };

// This has when each robot was heard last, and Infinity for one that is heard now.
type Heard = Record<string, number>;

function heardOf(fleet: Fleet | null, lost_ms: number | null): Heard {
  const now_ms = lost_ms ?? Infinity;
  return Object.fromEntries((fleet?.robots ?? []).map(({ name, heard, last_heard_unix_ms }) => [name, heard ? now_ms : last_heard_unix_ms ?? 0]));
}

// This returns until when the page knows that an open mission was in its state.
function knownUntil(mission: Mission, heard_ms: number | undefined, live: boolean, lost_ms: number | null): number {
  if (heard_ms === undefined || !live) return mission.changed_unix_ms;
  // Servers keep the queue of a robot that is not heard.
  return mission.state === 'sent' ? lost_ms ?? Infinity : heard_ms;
}

// A bar is drawn `least_ms` long at least, and lies over no other.
function rowsOf(day: Day, heard: Heard, lost_ms: number | null, least_ms: number): Row[] {
  const byRobot = new Map<string, Mission[]>();
  for (const mission of day.missions) byRobot.set(mission.robot, [...(byRobot.get(mission.robot) ?? []), mission]);
  const rows = [...byRobot].map(([name, missions]) => {
    missions.sort((one, other) => one.sent_unix_ms - other.sent_unix_ms);
    const free_ms: number[] = [];
    const bars = missions.map((mission) => {
      const kind = kinds[mission.state] ?? 'waiting';
      const sent_ms = mission.sent_unix_ms;
      const end_ms = isOver(mission) ? Math.max(sent_ms, mission.changed_unix_ms) : null;
      const last_ms = end_ms ?? Infinity;
      // A robot does one after the other: it began after what was sent before and was done.
      const before_ms = missions.filter((each) => each !== mission && wasDone(each) && each.sent_unix_ms <= sent_ms && each.changed_unix_ms < last_ms)
        .reduce((latest, each) => Math.max(latest, each.changed_unix_ms), sent_ms);
      const does_ms = kind === 'waiting' ? Infinity
        : neverDrove(mission) ? last_ms
        : Math.min(last_ms, Math.max(sent_ms, day.begun_ms.get(keyOf(mission)) ?? before_ms));
      const known_ms = end_ms ?? knownUntil(mission, heard[name], day.live.has(keyOf(mission)), lost_ms);
      const found = free_ms.findIndex((until) => until <= sent_ms);
      const lane = found < 0 ? free_ms.length : found;
      free_ms[lane] = Math.max(last_ms, sent_ms + least_ms);
      return { mission, kind, sent_ms, does_ms, known_ms: Math.max(sent_ms, known_ms), end_ms, lane };
    });
    return { robot: name, bars, lanes: free_ms.length };
  });
  return rows.sort((one, other) => compareNames(one.robot, other.robot));
}

type Span = { from_ms: number; to_ms: number; step_ms: number };

// It moves on by steps, so that bars are not drawn anew each second.
function spanOf(range: Range, missions: Mission[], now_ms: number): Span {
  const day_ms = midnight(now_ms);
  const first_ms = missions.reduce((first, each) => Math.min(first, each.sent_unix_ms), now_ms);
  const wanted_ms = range === 'hour' ? now_ms - kHour_ms : Math.min(Math.max(day_ms, first_ms), now_ms - 5 * kMin_ms);
  const min = kSteps_min.find((each) => (now_ms - wanted_ms) / (each * kMin_ms) <= kMostTicks) ?? kSteps_min[kSteps_min.length - 1];
  const step_ms = min * kMin_ms;
  const grain_ms = step_ms / 10;
  const from_ms = Math.max(range === 'day' ? day_ms : 0, day_ms + Math.floor((wanted_ms - day_ms) / grain_ms) * grain_ms - grain_ms);
  const to_ms = day_ms + Math.ceil((now_ms + kAhead * (now_ms - from_ms) - day_ms) / grain_ms) * grain_ms;
  return { from_ms, to_ms, step_ms };
}

const clock = (unix_ms: number) => when(unix_ms).slice(11, 16);
const share = (span: Span, unix_ms: number) => Math.min(1, Math.max(0, (unix_ms - span.from_ms) / (span.to_ms - span.from_ms)));
const percent = (part: number) => `${(100 * part).toFixed(3)}%`;

function textOf({ mission, end_ms, known_ms }: Bar): string {
  const ends = end_ms !== null ? ` at ${clock(end_ms)}` : known_ms !== Infinity ? `, as last known at ${clock(known_ms)}` : '';
  return `${mission.robot}: ${mission.orders || '(orders not told)'} – ${mission.state}${ends}; sent at ${clock(mission.sent_unix_ms)}${mission.sent_by ? ` by ${mission.sent_by}` : ''}${mission.detail ? `. ${mission.detail}` : ''}`;
}

function BarLink({ bar, span, now_ms, last }: { bar: Bar; span: Span; now_ms: number; last: boolean }) {
  const begin = share(span, bar.sent_ms);
  const end = Math.max(begin, share(span, bar.end_ms ?? now_ms));
  const within = (unix_ms: number) => (end > begin ? Math.min(1, Math.max(0, (share(span, unix_ms) - begin) / (end - begin))) : 0);
  const does = bar.does_ms === Infinity ? 1 : within(bar.does_ms);
  const known = bar.known_ms === Infinity ? 1 : within(bar.known_ms);
  return (
    <a className={`bar ${bar.kind}`} href={addressOf(bar.mission)} title={textOf(bar)} aria-label={textOf(bar)} tabIndex={last ? 0 : -1}
      style={{ left: percent(begin), width: percent(end - begin), top: `${1.25 * bar.lane}rem` }}>
      <span className="waits" style={{ width: percent(Math.min(does, known)) }} />
      {known < 1 && <span className="unknown" style={{ left: percent(known), width: percent(1 - known) }} />}
      <span className="does" style={{ left: `min(${percent(does < 1 ? does : bar.end_ms === null ? 0 : 1)}, 100% - 1rem)`, width: percent(does < 1 ? Math.max(0, known - does) : 0) }}>
        <svg viewBox="0 0 16 16" aria-hidden="true"><path d={signs[bar.kind]} /></svg>
        <span>{bar.mission.orders}</span>
      </span>
    </a>
  );
}

const DayRow = memo(function DayRow({ row, span, now_ms }: { row: Row; span: Span; now_ms: number }) {
  const shown = row.bars.filter((bar) => (bar.end_ms ?? Infinity) >= span.from_ms);
  return (
    <li>
      <a href={`#fleet/${row.robot}`}>{row.robot}</a>
      <div className="lanes" style={{ height: `${1.25 * row.lanes + 0.25}rem` }}>
        {shown.map((bar, i) => <BarLink key={keyOf(bar.mission)} bar={bar} span={span} now_ms={now_ms} last={i === shown.length - 1} />)}
      </div>
    </li>
  );
});

// The arrow keys go from mission to mission of a robot.
function step(event: KeyboardEvent<HTMLElement>) {
  const by = event.key === 'ArrowRight' ? 1 : event.key === 'ArrowLeft' ? -1 : 0;
  const lanes = (event.target as HTMLElement).closest('.lanes');
  if (by === 0 || !lanes) return;
  const bars = [...lanes.querySelectorAll<HTMLElement>('.bar')];
  event.preventDefault();
  bars[bars.indexOf(event.target as HTMLElement) + by]?.focus();
}

const legend: [Kind, string][] = [
  ['waiting', 'Waiting'], ['driving', 'Under way'], ['paused', 'Paused'], ['arrived', 'Arrived'], ['failed', 'Failed'], ['cancelled', 'Cancelled'],
];

// It shows what became of today's missions, with a row for each robot and a bar for each mission.
export function Timeline({ fleet, lost_ms, now_ms }: { fleet: Fleet | null; lost_ms: number | null; now_ms: number }) {
  const day = useDay(fleet, lost_ms !== null, now_ms);
  const [range, setRange] = useState(() => kept<Range>(kKept, ranges, 'day'));
  const { from_ms, to_ms, step_ms } = spanOf(range, day.missions, now_ms);
  const span = useMemo(() => ({ from_ms, to_ms, step_ms }), [from_ms, to_ms, step_ms]);
  // What is not to be seen of a second is not drawn.
  const fine_ms = (to_ms - from_ms) / kFinest;
  const shown_ms = Math.floor(now_ms / fine_ms) * fine_ms;
  const heard = JSON.stringify(heardOf(fleet, lost_ms), (_, value) => (value === Infinity ? 'now' : value));
  const rows = useMemo(() => rowsOf(day, heardOf(fleet, lost_ms), lost_ms, (to_ms - from_ms) * kLeast), [day, heard, lost_ms, from_ms, to_ms])
    .filter(({ bars }) => bars.some((bar) => (bar.end_ms ?? Infinity) >= from_ms));
  const ticks: number[] = [];
  const day_ms = midnight(now_ms);
  for (let at_ms = day_ms + Math.ceil((span.from_ms - day_ms) / span.step_ms) * span.step_ms; at_ms < span.to_ms; at_ms += span.step_ms) {
    if (Math.abs(share(span, at_ms) - share(span, shown_ms)) > kBesideNow) ticks.push(at_ms);
  }
  return (
    <section className="pane timeline" aria-label="Missions of today">
      <header>
        <h2>Missions</h2>
        <ul className="key" aria-label="Legend">
          {legend.map(([kind, text]) => (
            <li key={kind} className={kind}><svg viewBox="0 0 16 16" aria-hidden="true"><path d={signs[kind]} /></svg>{text}</li>
          ))}
        </ul>
        <div className="layers" role="radiogroup" aria-label="Time">
          {(Object.keys(ranges) as Range[]).map((each) => (
            <label key={each}>
              <input type="radio" name="range" checked={range === each} onChange={() => { keep(kKept, each); setRange(each); }} />
              {ranges[each]}
            </label>
          ))}
        </div>
        <a href="#history">All missions</a>
      </header>
      {day.why && <p className="answer bad" role="status">⚠ {day.why} {day.told ? 'What is drawn may lack some.' : 'Only what was heard since this page was opened is drawn.'}</p>}
      {day.left_out && <p className="note">The last missions of today; <a href="#history">all of them</a>.</p>}
      {rows.length === 0
        ? <p className="note">{!day.told && !day.why ? 'Loading missions …' : range === 'hour' ? 'No missions in the last hour.' : 'No missions today.'}</p>
        : (
          <div className="chart-of-day" onKeyDown={step}>
            <div className="hours" aria-hidden="true"><div>
              {ticks.map((at_ms) => <span key={at_ms} style={{ left: percent(share(span, at_ms)) }}>{clock(at_ms)}</span>)}
              <span className="now" style={{ left: percent(share(span, shown_ms)) }}>{clock(now_ms)}</span>
            </div></div>
            <div className="days">
              <ul>
                {rows.map((row) => <DayRow key={row.robot} row={row} span={span} now_ms={row.bars.some(({ end_ms }) => end_ms === null) ? shown_ms : 0} />)}
              </ul>
              <div className="now-line" aria-hidden="true"><div style={{ left: percent(share(span, shown_ms)) }} /></div>
            </div>
          </div>
        )}
    </section>
  );
}
