import { useEffect } from 'react';
import { Missions } from '../missions';
import { RobotCard } from './robot';
import type { Fleet } from '../api';

// A robot by itself, with an address of its own.
export function RobotPage({ fleet, name, settled, lost_ms, now_ms }: {
  fleet: Fleet | null;
  name: string;
  settled: boolean;
  lost_ms: number | null;
  now_ms: number;
}) {
  const robot = fleet?.robots.find((each) => each.name === name);
  const missions = fleet?.missions?.filter((each) => each.robot === name) ?? null;
  useEffect(() => window.scrollTo(0, 0), [name]);
  return (
    <section className="robot-page" aria-label={name}>
      <p><a href={`#fleet/${name}`}>All robots</a></p>
      {!robot && <p className="note">{settled ? `${name} is not heard, and was not since the console started.` : 'Searching for robots …'}</p>}
      {robot && <RobotCard robot={robot} alone lost_ms={lost_ms} now_ms={now_ms} />}
      <section aria-label="Missions">
        <h2>Its last missions</h2>
        <Missions missions={missions} now_ms={now_ms} />
        <p><a href="#history/runs">Runs</a> · <a href="#history">All missions</a></p>
      </section>
    </section>
  );
}
