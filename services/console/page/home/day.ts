import { useEffect, useRef, useState } from 'react';
import { get, type Fleet, type Mission, type MissionPage } from '../api';
import { isOver } from '../missions';

const kMostPages = 10;
const kPage = '100';  // servers tell no more at a time
const kAgain_ms = 10000;
const kMostAtOnce = 5;

export const keyOf = ({ robot, mission }: Mission) => `${robot}:${mission}`;

// The clocks of servers and consoles differ, and a mission that is over stays so.
function isNewer(one: Mission, other: Mission): boolean {
  if (isOver(one) !== isOver(other)) return isOver(one);
  return one.changed_unix_ms > other.changed_unix_ms || (one.changed_unix_ms === other.changed_unix_ms && one.state !== other.state);
}

const isOfGroup = ({ robot }: Mission) => robot.startsWith('@');

export type Day = {
  missions: Mission[];
  begun_ms: Map<string, number>;  // of those that this page has seen begin
  live: Set<string>;              // what robots are on, or have in their queues
  told: boolean;                  // servers have told of it
  left_out: boolean;              // there are more than were asked for
  why: string;                    // servers do not tell
};

export function midnight(now_ms: number): number {
  const day = new Date(now_ms);
  day.setHours(0, 0, 0, 0);
  return day.getTime();
}

async function askForDay(from_ms: number): Promise<{ missions: Mission[]; left_out: boolean; why: string }> {
  const missions: Mission[] = [];
  let before = '';
  for (let page = 0; page < kMostPages; ++page) {
    const reply = await get<MissionPage>('/api/missions', { from_unix_ms: String(from_ms), limit: kPage, before });
    if (typeof reply === 'string') return { missions, left_out: false, why: reply };
    missions.push(...reply.missions);
    if (reply.next === 0) return { missions, left_out: false, why: '' };
    before = String(reply.next);
  }
  return { missions, left_out: true, why: '' };
}

// These are the missions that were sent since midnight. Servers are asked for them once, and after each time without a
// connection. The live state tells the rest.
export function useDay(fleet: Fleet | null, lost: boolean, now_ms: number): Day {
  const from_ms = midnight(now_ms);
  const known = useRef(new Map<string, Mission>());
  const begun = useRef(new Map<string, number>());
  const [day, setDay] = useState<Day>({ missions: [], begun_ms: begun.current, live: new Set(), told: false, left_out: false, why: '' });
  const [visits, setVisits] = useState(0);
  const asked_ms = useRef(0);

  const take = (missions: Mission[]) => {
    let news = false;
    for (const mission of missions) {
      // A group's mission belongs to the robot that it is given to from then on, under the same id.
      const others = [...known.current.values()].filter((each) => each.mission === mission.mission && isOfGroup(each) !== isOfGroup(mission));
      if (isOfGroup(mission) && others.length > 0) continue;
      for (const other of others) known.current.delete(keyOf(other));
      const key = keyOf(mission);
      const had = known.current.get(key);
      if (had && !isNewer(mission, had)) continue;
      const waited = had && ['sent', 'accepted', 'fetching'].includes(had.state);
      if (waited && mission.state === 'under way') begun.current.set(key, mission.changed_unix_ms);
      known.current.set(key, mission);
      news = true;
    }
    return news;
  };
  const list = () => [...known.current.values()].filter((each) => each.sent_unix_ms >= from_ms || !isOver(each));

  useEffect(() => {
    const seen = () => { if (!document.hidden) setVisits((count) => count + 1); };
    document.addEventListener('visibilitychange', seen);
    return () => document.removeEventListener('visibilitychange', seen);
  }, []);
  useEffect(() => {
    if (lost) return;
    let still = true;
    for (const [key, mission] of known.current) {
      if (mission.sent_unix_ms >= from_ms || !isOver(mission)) continue;
      known.current.delete(key);
      begun.current.delete(key);
    }
    void askForDay(from_ms).then(({ missions, left_out, why }) => {
      if (!still) return;
      take(missions);
      setDay((had) => ({ ...had, missions: list(), told: why === '' || had.told, left_out, why }));
    });
    return () => { still = false; };
  }, [from_ms, lost, visits]);

  useEffect(() => {
    if (!fleet) return;
    const doing = fleet.robots.flatMap(({ mission, queue }) => (mission ? [mission, ...queue] : queue));
    const news = take([...(fleet.missions ?? []), ...doing]);
    const live = new Set(doing.map(keyOf));
    const same = live.size === day.live.size && [...live].every((key) => day.live.has(key));
    if (news || !same) setDay((had) => ({ ...had, missions: news ? list() : had.missions, live }));
  }, [fleet]);

  // Servers say what became of those that no robot is on, and that are not among the last ones.
  useEffect(() => {
    if (lost || now_ms < asked_ms.current + kAgain_ms) return;
    const open = day.missions.filter((each) => !isOver(each) && !day.live.has(keyOf(each))).slice(0, kMostAtOnce);
    if (open.length === 0) return;
    asked_ms.current = now_ms;
    for (const { robot, mission } of open) {
      void get<MissionPage>('/api/missions', { robot, mission }).then((reply) => {
        if (typeof reply !== 'string' && take(reply.missions)) setDay((had) => ({ ...had, missions: list() }));
      });
    }
  }, [day, lost, now_ms]);
  return day;
}
