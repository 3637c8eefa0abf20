import { memo, useCallback, useContext, useRef, useState, type KeyboardEvent, type MouseEvent } from 'react';
import type { Mission, Robot } from '../api';
import { age, compareNames } from '../fleet';
import { Lost } from '../lost';
import { useMay } from '../me';
import { Glyph, capital, mayMove } from '../robot/state';
import { StopButton } from '../stop';
import { GroupSend } from './group';
import { Several } from './several';

const kLow_percent = 20;

// Of the states that are asked for most; one alone counts.
const kinds: Record<string, { label: string; has: (robot: Robot) => boolean }> = {
  all: { label: 'All', has: () => true },
  attention: { label: 'Needs attention', has: (robot) => robot.needs_person },
  moving: { label: 'Moving', has: (robot) => robot.state === 'driving' || robot.state === 'teaching' },
  available: { label: 'Available', has: (robot) => robot.state === 'available' || robot.state === 'arrived' },
  offline: { label: 'Offline', has: (robot) => !robot.heard },
};

export const byName = (one: Robot, other: Robot) => compareNames(one.name, other.name);
export const rank = (robot: Robot) =>
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

function groupsOf(robots: Robot[]): [string, number][] {
  const counts = new Map<string, number>();
  for (const { group } of robots) counts.set(group, (counts.get(group) ?? 0) + 1);
  const groups = [...counts].filter(([, count]) => count > 1);
  return groups.length > 0 && counts.size > 1 ? groups.sort(([one], [other]) => one.localeCompare(other)) : [];
}

// A robot is toggled alone, or selected with all rows up to the one that was toggled before.
type Select = (robot: string, range: boolean) => void;

const Row = memo(function Row({ robot, chosen, selected, stops, seen, onSelect, onStop }: {
  robot: Robot;
  chosen: boolean;
  selected: boolean;
  stops: boolean;
  seen: string;
  onSelect: Select;
  onStop: (robot: string) => void;
}) {
  const lost = useContext(Lost);
  const place = placeText(robot);
  const doing = robot.mission?.orders ?? '';
  const second = [place, doing].filter((text) => text !== '').join(' – ');
  const battery = robot.battery_percent;
  const selects = stops && robot.role === 'follower';
  const click = (event: MouseEvent) => {
    if (!selects || !(event.ctrlKey || event.metaKey || event.shiftKey)) return;
    event.preventDefault();
    onSelect(robot.name, event.shiftKey);
  };
  const press = (event: KeyboardEvent) => {
    if (!selects || event.key !== ' ') return;
    event.preventDefault();
    onSelect(robot.name, event.shiftKey);
  };
  return (
    <li id={`robot-${robot.name}`} className={`robot-row ${robot.state.replace(' ', '-')}${chosen ? ' chosen' : ''}${selected ? ' selected' : ''}${robot.heard ? '' : ' unheard'}`}>
      {selects && (
        <label className="tick" title="Select; also Ctrl or Shift and a click, or the space bar">
          <input type="checkbox" tabIndex={-1} aria-label={`Select ${robot.name}`} checked={selected}
            onChange={(event) => onSelect(robot.name, (event.nativeEvent as unknown as { shiftKey?: boolean }).shiftKey === true)} />
        </label>
      )}
      <a href={`#fleet/${robot.name}`} aria-current={chosen ? 'true' : undefined} onClick={click} onKeyDown={press}>
        <Glyph state={robot.state} />
        <span className="first"><strong>{robot.name}</strong> <span className="state">{lost ? 'Last: ' : ''}{capital(robot.state)}{seen}</span></span>
        <span className="second">{second || robot.detail || '–'}</span>
        <span className={battery !== null && battery < kLow_percent ? 'battery low' : 'battery'}>
          {battery !== null && <>{battery < kLow_percent && '⚠ '}{battery} %<span className="hidden"> battery</span></>}
        </span>
      </a>
      {selects && <StopButton robot={robot.name} moves={mayMove(robot)} small onClick={() => onStop(robot.name)} />}
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

export function RobotRows({ robots, missions, settled, chosen, now_ms, onStop }: {
  robots: Robot[];
  missions: Mission[];
  settled: boolean;
  chosen: string;
  now_ms: number;
  onStop: (robot: string) => void;
}) {
  const [kind, setKind] = useState('all');
  const [order, setOrder] = useState('name');
  const [words, setWords] = useState('');
  const [wanted, setGroup] = useState('');
  const [names, setNames] = useState<ReadonlySet<string>>(new Set());
  const stops = useMay('operate');
  const groups = groupsOf(robots);
  const group = groups.some(([name]) => name === wanted) ? wanted : '';
  const found = robots.filter((robot) => {
    const text = `${robot.name} ${robot.state} ${robot.route} ${robot.mission?.orders ?? ''}`.toLowerCase();
    return kinds[kind].has(robot) && (group === '' || robot.group === group) && words.toLowerCase().split(/\s+/).every((word) => text.includes(word));
  }).sort(orders[order].compare);
  const selectable = found.filter((robot) => robot.role === 'follower').map(({ name }) => name);
  const selected = stops ? robots.filter((robot) => names.has(robot.name)) : [];
  const shown = selectable.filter((name) => names.has(name)).length;
  const rows = useRef({ listed: selectable, last: '' });
  rows.current.listed = selectable;
  const select = useCallback<Select>((robot, range) => {
    const { listed, last } = rows.current;
    const ends = [listed.indexOf(last), listed.indexOf(robot)].sort((one, other) => one - other);
    const between = range && ends[0] >= 0 ? listed.slice(ends[0], ends[1] + 1) : [];
    rows.current.last = robot;
    setNames((had) => {
      if (between.length > 0) return new Set([...had, ...between]);
      const now = new Set(had);
      if (!now.delete(robot)) now.add(robot);
      return now;
    });
  }, []);
  const selectAll = () => setNames((had) => (shown === selectable.length
    ? new Set([...had].filter((name) => !selectable.includes(name))) : new Set([...had, ...selectable])));
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
        {groups.length > 0 && (
          <label><span className="hidden">Group</span>
            <select value={group} onChange={(event) => setGroup(event.target.value)}>
              <option value="">All groups</option>
              {groups.map(([name, count]) => <option key={name} value={name}>{name} ({count})</option>)}
            </select>
          </label>
        )}
        {stops && selectable.length > 1 && (
          <label className="all-shown">
            <input type="checkbox" checked={shown === selectable.length} onChange={selectAll}
              ref={(box) => { if (box) box.indeterminate = shown > 0 && shown < selectable.length; }} />
            Select all<span className="hidden"> shown</span>
          </label>
        )}
      </div>
      {!settled && robots.length === 0 && <p className="note">Searching for robots …</p>}
      {settled && robots.length === 0 && (
        <p className="note">
          No robot is heard. One that is on duty (<code>trailcast-agent serve</code>) shows up here by itself.
        </p>
      )}
      {robots.length > 0 && found.length === 0 && <p className="note">No robot is so.</p>}
      <ul className={selected.length > 0 ? 'selecting' : ''} onKeyDown={step}>
        {found.map((robot) => (
          <Row key={robot.name} robot={robot} chosen={robot.name === chosen} selected={names.has(robot.name)} stops={stops} onSelect={select} onStop={onStop}
            seen={robot.last_heard_unix_ms === null ? '' : `, seen ${age(now_ms - robot.last_heard_unix_ms)} ago`} />
        ))}
      </ul>
      {stops && group !== '' && selected.length === 0 && <GroupSend key={group} group={group} missions={missions} />}
      {selected.length > 0 && <Several robots={selected} hidden={selected.length - shown} onClear={() => setNames(new Set())} />}
    </section>
  );
}
