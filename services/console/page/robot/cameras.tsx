import type { Robot } from '../api';
import { Snapshot } from './snapshot';
import { Badge, mayMove } from './state';
import { useMay } from '../me';
import { StopButton } from '../stop';

// Consoles look through so many at once.
const kMost = 8;

// What all robots see that are heard, those first that need a person or move.
export function Cameras({ robots, settled, onStop }: { robots: Robot[]; settled: boolean; onStop: (robot: string) => void }) {
  const stops = useMay('operate');
  const rank = (robot: Robot) => (robot.needs_person ? 0 : mayMove(robot) ? 1 : 2);
  const seen = robots.filter((robot) => robot.heard && robot.state !== 'shut down' && robot.role === 'follower')
    .sort((one, other) => rank(one) - rank(other) || (one.name < other.name ? -1 : 1));
  return (
    <section className="cameras" aria-label="Cameras">
      {seen.length === 0 && <p className="note">{settled ? 'No robot is heard.' : 'Searching for robots …'}</p>}
      {seen.length > kMost && <p className="note">{kMost} of {seen.length} cameras: those that need attention and those that move come first.</p>}
      <ul>
        {seen.slice(0, kMost).map((robot) => (
          <li key={robot.name}>
            <header>
              <a href={`#robot/${robot.name}`}>{robot.name}</a> <Badge state={robot.state} />
              {stops && <StopButton robot={robot.name} moves={mayMove(robot)} small onClick={() => onStop(robot.name)} />}
            </header>
            <Snapshot robot={robot} brief />
          </li>
        ))}
      </ul>
    </section>
  );
}
