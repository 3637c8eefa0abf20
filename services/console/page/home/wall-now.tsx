import { useContext } from 'react';
import type { Robot, RobotState } from '../api';
import { when } from '../fleet';
import { Lost } from '../lost';

export function counts(robots: Robot[]): string {
  const found = new Map<RobotState, number>();
  for (const { state } of robots) found.set(state, (found.get(state) ?? 0) + 1);
  return [...found].sort(([, one], [, other]) => other - one).map(([state, count]) => `${count} ${state}`).join(', ');
}

// It stands in the head of the page.
export function WallNow({ robots, now_ms }: { robots: Robot[]; now_ms: number }) {
  const lost = useContext(Lost);
  return (
    <p className="wall-now">
      <time>{when(now_ms).slice(11, 16)}</time>
      <span>{lost && robots.length > 0 && 'Last: '}{counts(robots)}</span>
    </p>
  );
}
