import { useContext, useEffect, useMemo, useRef, useState, type HTMLAttributes } from 'react';
import type { Alert, Fleet, Robot } from '../api';
import { byUrgency } from '../alerts/alerts';
import { age } from '../fleet';
import { Lost } from '../lost';
import { ShapeView } from '../map/map';
import { SiteView } from '../map/site';
import { Lines } from '../robot/strip';
import { Glyph, capital } from '../robot/state';
import { byName, placeText, rank } from './rows';
import { NetworkLive, useBest } from './site-live';
import { counts } from './wall-now';

const kMostAlerts = 3;
const nothing = () => undefined;
// Nobody presses anything here but Stop all.
const inert = { inert: '' } as HTMLAttributes<HTMLElement>;

// The screen stays on where the browser allows it: over https, or on the console's own machine.
function useScreenOn() {
  useEffect(() => {
    const wake = (navigator as { wakeLock?: { request(kind: 'screen'): Promise<{ release(): Promise<void> }> } }).wakeLock;
    if (!wake) return;
    let over = false;
    let lock: { release(): Promise<void> } | null = null;
    const hold = async () => {
      if (document.hidden) return;
      try {
        const held = await wake.request('screen');
        if (over) void held.release();
        else lock = held;
      } catch {
        // The battery is low, or it is forbidden: the screen goes off as the system has it.
      }
    };
    void hold();
    document.addEventListener('visibilitychange', hold);
    return () => {
      over = true;
      document.removeEventListener('visibilitychange', hold);
      void lock?.release();
    };
  }, []);
}

// The tag tells which page the console has. A page that is left open for weeks is loaded anew once the console has another.
async function pageTag(): Promise<string | null> {
  try {
    return (await fetch('/page.js', { method: 'HEAD', cache: 'no-store' })).headers.get('ETag');
  } catch {
    return null;
  }
}

function useNewestPage(lost: boolean) {
  const mine = useRef<string | null>(null);
  useEffect(() => {
    if (lost) return;
    void pageTag().then((tag) => {
      if (tag === null) return;
      if (mine.current !== null && mine.current !== tag) window.location.reload();
      mine.current = tag;
    });
  }, [lost]);
}

function Site({ fleet, settled }: { fleet: Fleet | null; settled: boolean }) {
  const best = useBest(true);
  const map = { robots: fleet?.robots ?? [], live: fleet?.routes ?? [], pin: null, onPlace: nothing };
  return (
    <div className={`wall-site ${best ?? ''}`} {...inert}>
      {best === 'lines' && <Lines robots={map.robots} chosen="" settled={settled} pin={null} onPlace={nothing} />}
      {best === 'network' && <NetworkLive {...map} way={null} />}
      {best === 'shape' && <ShapeView {...map} settled={settled} />}
      {best === 'site' && <SiteView {...map} />}
    </div>
  );
}

function Alerts({ alerts, now_ms }: { alerts: Alert[]; now_ms: number }) {
  if (alerts.length === 0) return null;
  const shown = [...alerts].sort(byUrgency).slice(0, kMostAlerts);
  return (
    <ul className="wall-alerts" aria-label="Alerts">
      {shown.map((alert) => (
        <li key={alert.alert} className={alert.acknowledged_by !== null ? 'quiet' : alert.severity}>
          <strong>{alert.robot ?? alert.server}</strong> <span>{alert.reason}{!alert.known && ', as last known'}</span>{' '}
          <small>{alert.place && `${alert.place} · `}{age(now_ms - alert.since_unix_ms)}{alert.acknowledged_by !== null && ` · ${alert.acknowledged_by} sees to it`}</small>
        </li>
      ))}
      {alerts.length > shown.length && <li className="quiet">and {alerts.length - shown.length} more alerts</li>}
    </ul>
  );
}

// Rows have these heights, in the size of the list's letters. Where not all have room, there are two columns of low ones.
const kRow_em = 2.5;
const kDense_em = 1.6;

// It counts how many rows of either height have room.
function useRoom(): [React.RefObject<HTMLUListElement>, { rows: number; dense: number }] {
  const list = useRef<HTMLUListElement>(null);
  const [room, setRoom] = useState({ rows: 8, dense: 20 });
  useEffect(() => {
    const rule = new ResizeObserver(() => {
      const height_em = list.current!.clientHeight / parseFloat(getComputedStyle(list.current!).fontSize);
      const fit = (row_em: number) => Math.max(1, Math.floor(height_em / row_em + 0.05));
      setRoom({ rows: fit(kRow_em), dense: 2 * fit(kDense_em) });
    });
    rule.observe(list.current!);
    return () => rule.disconnect();
  }, []);
  return [list, room];
}

function Rows({ robots, settled, now_ms }: { robots: Robot[]; settled: boolean; now_ms: number }) {
  const lost = useContext(Lost);
  const [list, room] = useRoom();
  const sorted = useMemo(() => [...robots].sort((one, other) => rank(one) - rank(other) || byName(one, other)), [robots]);
  const dense = sorted.length > room.rows;
  const shown = sorted.slice(0, !dense || sorted.length <= room.dense ? sorted.length : room.dense - 2);
  const rest = sorted.slice(shown.length);
  return (
    <ul className={dense ? 'wall-rows dense' : 'wall-rows'} aria-label="Robots" ref={list}>
      {robots.length === 0 && <li>{settled ? 'No robot is heard.' : 'Searching for robots …'}</li>}
      {shown.map((robot) => (
        <li key={robot.name} className={`robot-row ${robot.state.replace(' ', '-')}${robot.needs_person ? ' attention' : ''}`}>
          <Glyph state={robot.state} />
          <strong>{robot.name}</strong>
          <span className="state">{lost && 'Last: '}{capital(robot.state)}</span>
          {!dense && <small>{robot.last_heard_unix_ms !== null ? `last seen ${age(now_ms - robot.last_heard_unix_ms)} ago` : placeText(robot) || robot.detail}</small>}
        </li>
      ))}
      {rest.length > 0 && <li className="rest"><small>and {rest.length} more: {counts(rest)}</small></li>}
    </ul>
  );
}

// This page is for a screen on a wall, which is read from three metres and left open.
export function Wall({ fleet, settled, now_ms }: { fleet: Fleet | null; settled: boolean; now_ms: number }) {
  useScreenOn();
  useNewestPage(useContext(Lost));
  return (
    <>
      <Alerts alerts={fleet?.alerts ?? []} now_ms={now_ms} />
      <Site fleet={fleet} settled={settled} />
      <Rows robots={fleet?.robots ?? []} settled={settled} now_ms={now_ms} />
    </>
  );
}
