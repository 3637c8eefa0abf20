import { memo, useContext, useState, type KeyboardEvent } from 'react';
import type { Robot } from '../api';
import { age } from '../fleet';
import { Lost } from '../lost';
import { useMay } from '../me';
import { Glyph, capital, mayMove } from '../robot/state';
import { StopButton } from '../stop';

const kLow_percent = 20;

// Of the states that are asked for most; one alone counts.
const kinds: Record<string, { label: string; has: (robot: Robot) => boolean }> = {
  all: { label: 'All', has: () => true },
  attention: { label: 'Needs attention', has: (robot) => robot.needs_person },
  moving: { label: 'Moving', has: (robot) => robot.state === 'driving' || robot.state === 'teaching' },
  available: { label: 'Available', has: (robot) => robot.state === 'available' || robot.state === 'arrived' },
  offline: { label: 'Offline', has: (robot) => !robot.heard },
};

const byName = (one: Robot, other: Robot) => one.name.localeCompare(other.name, undefined, { numeric: true });
const rank = (robot: Robot) =>
  (robot.needs_person ? 0 : robot.state === 'driving' || robot.state === 'teaching' ? 1 : robot.heard ? 2 : 3);
const orders: Record<string, { label: string; compare: (one: Robot, other: Robot) => number }> = {
  name: { label: 'Name', compare: byName },
  state: { label: 'State', compare: (one, other) => rank(one) - rank(other) || byName(one, other) },
  place: {
    label: 'Place',
    compare: (one, other) => one.route.localeCompare(other.route) || (one.along_m ?? -1) - (other.along_m ?? -1) || byName(one, other),
  },
  battery: { label: 'Battery', compare: (one, other) => (one.battery_percent ?? 101) - (other.battery_percent ?? 101) || byName(one, other) },
};

export function placeText(robot: Robot): string {
  if (robot.teaches) return `teaches ${robot.route}`;
  if (robot.route && robot.along_m !== null) return `${robot.route} · ${robot.along_m.toFixed(1)}${robot.length_m ? ` of ${robot.length_m.toFixed(1)}` : ''} m`;
  if (robot.stood) return `last on ${robot.stood.route} · ${robot.stood.along_m.toFixed(1)} m`;
  return robot.route;
}

const Row = memo(function Row({ robot, chosen, stops, seen, onStop }: {
  robot: Robot;
  chosen: boolean;
  stops: boolean;
  seen: string;
  onStop: (robot: string) => void;
}) {
  const lost = useContext(Lost);
  const place = placeText(robot);
  const doing = robot.mission?.orders ?? '';
  const second = [place, doing].filter((text) => text !== '').join(' – ');
  const battery = robot.battery_percent;
  return (
    <li id={`robot-${robot.name}`} className={`robot-row ${robot.state.replace(' ', '-')}${chosen ? ' chosen' : ''}${robot.heard ? '' : ' unheard'}`}>
      <a href={`#fleet/${robot.name}`} aria-current={chosen ? 'true' : undefined}>
        <Glyph state={robot.state} />
        <span className="first"><strong>{robot.name}</strong> <span className="state">{lost ? 'Last: ' : ''}{capital(robot.state)}{seen}</span></span>
        <span className="second">{second || robot.detail || '–'}</span>
        <span className={battery !== null && battery < kLow_percent ? 'battery low' : 'battery'}>
          {battery !== null && <>{battery < kLow_percent && '⚠ '}{battery} %<span className="hidden"> battery</span></>}
        </span>
      </a>
      {stops && robot.role === 'follower' && <StopButton robot={robot.name} moves={mayMove(robot)} small onClick={() => onStop(robot.name)} />}
    </li>
  );
});

// The arrow keys go from row to row.
function step(event: KeyboardEvent<HTMLElement>) {
  if (event.key !== 'ArrowDown' && event.key !== 'ArrowUp') return;
  const rows = [...event.currentTarget.querySelectorAll<HTMLElement>('.robot-row > a')];
  const to = rows[rows.indexOf(document.activeElement as HTMLElement) + (event.key === 'ArrowDown' ? 1 : -1)];
  if (!to) return;
  event.preventDefault();
  to.focus();
}

export function RobotRows({ robots, settled, chosen, now_ms, onStop }: {
  robots: Robot[];
  settled: boolean;
  chosen: string;
  now_ms: number;
  onStop: (robot: string) => void;
}) {
  const [kind, setKind] = useState('all');
  const [order, setOrder] = useState('name');
  const [words, setWords] = useState('');
  const stops = useMay('operate');
  const found = robots.filter((robot) => {
    const text = `${robot.name} ${robot.state} ${robot.route} ${robot.mission?.orders ?? ''}`.toLowerCase();
    return kinds[kind].has(robot) && words.toLowerCase().split(/\s+/).every((word) => text.includes(word));
  }).sort(orders[order].compare);
  return (
    <section className="pane robots" aria-label="Robots">
      <header>
        <h2>Robots</h2>
        <input type="search" aria-label="Filter robots by name, state, route or mission" placeholder="Filter" value={words}
          onChange={(event) => setWords(event.target.value)} />
        <label><span className="hidden">Sort by</span>
          <select value={order} onChange={(event) => setOrder(event.target.value)}>
            {Object.entries(orders).map(([name, { label }]) => <option key={name} value={name}>By {label.toLowerCase()}</option>)}
          </select>
        </label>
      </header>
      <div className="chips" role="group" aria-label="Show">
        {Object.entries(kinds).map(([name, { label, has }]) => {
          const count = robots.filter(has).length;
          if (name !== 'all' && name !== kind && count === 0) return null;
          return <button key={name} aria-pressed={kind === name} onClick={() => setKind(name)}>{label} <span>{count}</span></button>;
        })}
      </div>
      {!settled && robots.length === 0 && <p className="note">Searching for robots …</p>}
      {settled && robots.length === 0 && (
        <p className="note">
          No robot is heard. One that is on duty (<code>trailcast-agent serve</code>) shows up here by itself. Then choose it, and
          <strong> Teach …</strong> its first route; <strong>Send …</strong> sends any robot along it.
        </p>
      )}
      {robots.length > 0 && found.length === 0 && <p className="note">No robot is so.</p>}
      <ul onKeyDown={step}>
        {found.map((robot) => (
          <Row key={robot.name} robot={robot} chosen={robot.name === chosen} stops={stops} onStop={onStop}
            seen={robot.last_heard_unix_ms === null ? '' : `, seen ${age(now_ms - robot.last_heard_unix_ms)} ago`} />
        ))}
      </ul>
    </section>
  );
}
