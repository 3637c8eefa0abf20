import { useEffect, useState } from 'react';
import type { Change, Fleet, Robot } from './api';
import { askWhoIAm } from './me';

// The console speaks every five seconds at least.
const kLost_ms = 12000;
// Who is not heard so long after the first word of a console, which may just have started, is not there.
const kSettles_ms = 4000;
// A page that nobody sees is told nothing after so long.
const kUnseen_ms = 60000;
const kVisits_ms = 600000;

export type View = {
  fleet: Fleet | null;
  settled: boolean;  // what it does not tell of is not there
  lost: boolean;   // this page hears nothing of the console
  now_ms: number;  // by the console's clock
  heard_ms: number;
};

// Robots that have not changed stay the same objects.
function changed(fleet: Fleet | null, { gone, robots, ...rest }: Change): Fleet | null {
  if (!fleet) return null;
  const byName = new Map(fleet.robots.map((robot) => [robot.name, robot]));
  for (const name of gone) byName.delete(name);
  for (const robot of robots) byName.set(robot.name, { ...byName.get(robot.name), ...robot } as Robot);
  const sorted = [...byName.values()].sort((one, other) => (one.name < other.name ? -1 : 1));
  return { ...fleet, ...rest, robots: sorted };
}

export function useFleet(): View {
  const [fleet, setFleet] = useState<Fleet | null>(null);
  const [offset_ms, setOffset] = useState(0);
  const [heard_ms, setHeard] = useState(Date.now());
  const [told_ms, setTold] = useState(0);
  const [open, setOpen] = useState(true);
  const [now_ms, setNow] = useState(Date.now());

  useEffect(() => {
    let source: EventSource | null = null;
    let again: number | undefined;
    let leave: number | undefined;
    const heard = (console_ms: number) => {
      setOpen(true);
      setHeard(Date.now());
      setOffset(console_ms - Date.now());
    };
    const connect = () => {
      source = new EventSource('/api/events');
      source.addEventListener('state', (event) => {
        const state = JSON.parse((event as MessageEvent).data) as Fleet;
        setFleet(state);
        setTold(Date.now());
        heard(state.now_unix_ms);
      });
      source.addEventListener('change', (event) => {
        const change = JSON.parse((event as MessageEvent).data) as Change;
        setFleet((fleet) => changed(fleet, change));
        heard(change.now_unix_ms);
      });
      source.addEventListener('alive', (event) => {
        heard(JSON.parse((event as MessageEvent).data).now_unix_ms);
      });
      source.onerror = () => {
        setOpen(false);
        askWhoIAm();  // the console may have logged us out
        // After a refusal, as of too many pages, a browser does not try again by itself.
        if (source?.readyState === EventSource.CLOSED) again = window.setTimeout(connect, 2000);
      };
    };
    const disconnect = () => {
      source?.close();
      source = null;
      window.clearTimeout(again);
      window.clearTimeout(leave);
    };
    const look = () => {
      window.clearTimeout(leave);
      if (document.hidden) {
        leave = window.setTimeout(disconnect, kUnseen_ms);
      } else if (!source) {
        setHeard(Date.now());
        connect();
      }
    };
    look();
    document.addEventListener('visibilitychange', look);
    // Browsers keep pages that one has left, to come back to, and what they hear with them.
    window.addEventListener('pagehide', disconnect);
    window.addEventListener('pageshow', look);
    const clock = window.setInterval(() => setNow(Date.now()), 1000);
    // One that is not seen for hours stays logged in.
    const visits = window.setInterval(() => { if (!source) askWhoIAm(); }, kVisits_ms);
    return () => {
      disconnect();
      document.removeEventListener('visibilitychange', look);
      window.removeEventListener('pagehide', disconnect);
      window.removeEventListener('pageshow', look);
      window.clearInterval(clock);
      window.clearInterval(visits);
    };
  }, []);

  const lost = !open || now_ms - heard_ms > kLost_ms;
  const settled = fleet !== null && now_ms - told_ms > kSettles_ms;
  return { fleet, settled, lost, now_ms: now_ms + offset_ms, heard_ms: heard_ms + offset_ms };
}

// As robots and commands write it, by this browser's time zone: "2026-11-29 21:38:03".
export function when(unix_ms: number): string {
  const at = new Date(unix_ms);
  const two = (value: number) => String(value).padStart(2, '0');
  return `${at.getFullYear()}-${two(at.getMonth() + 1)}-${two(at.getDate())} ${two(at.getHours())}:${two(at.getMinutes())}:${two(at.getSeconds())}`;
}

// This compares names by their numbers: robot-2 comes before robot-10. A collator that is made for each pair is slow.
export const compareNames = new Intl.Collator(undefined, { numeric: true }).compare;

export function age(ms: number): string {
  const s = Math.max(0, Math.round(ms / 1000));
  if (s < 100) return `${s} s`;
  if (s < 6000) return `${Math.round(s / 60)} min`;
  if (s < 172800) return `${Math.round(s / 3600)} h`;
  return `${Math.round(s / 86400)} d`;
}
