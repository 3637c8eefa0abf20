import { useEffect, useRef, useSyncExternalStore } from 'react';
import type { Fleet, Robot } from '../api';
import { Missions } from '../missions';
import { RobotCard } from '../robot/robot';
import { Guide } from './guide';
import { RobotRows } from './rows';
import { SiteLive } from './site-live';
import { Timeline } from './timeline';

// Who is looked at where nobody was chosen: the same one for as long as it is there.
export function useChosen(robots: Robot[], open: string): Robot | null {
  const last = useRef('');
  const first = () => robots.find((robot) => robot.needs_person) ?? robots.find((robot) => robot.state === 'driving') ?? robots[0];
  const chosen = robots.find((robot) => robot.name === open) ?? robots.find((robot) => robot.name === last.current) ?? first() ?? null;
  last.current = chosen?.name ?? '';
  return chosen;
}

// On a desk panes lie side by side, and the day has room.
const desk = window.matchMedia('(min-width: 64.01rem)');
function useDesk(): boolean {
  return useSyncExternalStore((changed) => {
    desk.addEventListener('change', changed);
    return () => desk.removeEventListener('change', changed);
  }, () => desk.matches);
}

// All robots, the site with them upon it, and one of them.
export function Home({ fleet, open, chosen, settled, lost_ms, now_ms, onStop }: {
  fleet: Fleet | null;
  open: string;
  chosen: Robot | null;
  settled: boolean;
  lost_ms: number | null;
  now_ms: number;
  onStop: (robot: string) => void;
}) {
  const robots = fleet?.robots ?? [];
  const wide = useDesk();
  const pane = useRef<HTMLElement>(null);
  // In one column whoever chooses a robot wants to see it; beside the others it is in view.
  const isThere = chosen !== null && chosen.name === open;
  useEffect(() => {
    if (isThere && !desk.matches) pane.current?.scrollIntoView({ block: 'start' });
  }, [open, isThere]);
  return (
    <>
    <Guide fleet={fleet} settled={settled} />
    <div className="home">
      <RobotRows robots={robots} missions={fleet?.missions ?? []} settled={settled} chosen={chosen?.name ?? ''} now_ms={now_ms} onStop={onStop} />
      <section className="pane one" aria-label="Chosen robot" ref={pane}>
        {chosen
          ? <RobotCard key={chosen.name} robot={chosen} lost_ms={lost_ms} now_ms={chosen.heard && lost_ms === null ? 0 : now_ms} />
          : <p className="note">What a robot sees and does is shown here, once one is heard.</p>}
      </section>
      <div className="middle">
        <SiteLive robots={robots} live={fleet?.routes ?? []} settled={settled} chosen={chosen} />
        {!wide && (
          <section className="pane missions" aria-label="Missions">
            <header><h2>Missions</h2></header>
            <Missions missions={fleet?.missions ?? null} now_ms={now_ms} />
          </section>
        )}
      </div>
      {wide && <Timeline fleet={fleet} lost_ms={lost_ms} now_ms={now_ms} />}
    </div>
    </>
  );
}
