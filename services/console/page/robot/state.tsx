// These tell what a robot does: by a shape, a word and a line of text.
import { useContext } from 'react';
import type { Robot, RobotState } from '../api';
import { Lost } from '../lost';

export const capital = (state: RobotState) => state[0].toUpperCase() + state.slice(1);

// A shape each, so that colour is not needed to tell them apart.
export const shapes: Record<RobotState, string> = {
  offline: 'M3 3 13 13M13 3 3 13', stopped: 'M5.5 2h5L14 5.5v5L10.5 14h-5L2 10.5v-5z',
  paused: 'M4 3h3v10H4zM9 3h3v10H9z', starting: 'M8 3v5l3 3', available: 'M3 8h10',
  waiting: 'M4 2h8L8 8l4 6H4l4-6z', teaching: 'M3 13 4 9l7-7 3 3-7 7z', driving: 'M4 2l9 6-9 6z',
  arrived: 'M2 8l4 4 8-8', 'shut down': 'M4 4h8v8H4z', fault: 'M8 2l7 12H1z',
  failed: 'M8 2v8M8 12v2',
};

const filled = ['stopped', 'paused', 'driving', 'fault'];

export function Glyph({ state }: { state: RobotState }) {
  const lost = useContext(Lost);
  return (
    <span className={lost ? 'glyph-dot old' : `glyph-dot ${state.replace(' ', '-')}`} aria-hidden="true">
      <svg viewBox="0 0 16 16" className={filled.includes(state) ? 'filled' : ''}><path d={shapes[state]} /></svg>
    </span>
  );
}

// Where the page has lost its console, a robot's state is what it was last.
export function Badge({ state }: { state: RobotState }) {
  const lost = useContext(Lost);
  return (
    <span className={lost ? 'badge old' : `badge ${state.replace(' ', '-')}`}>
      <svg viewBox="0 0 16 16" aria-hidden="true" className={filled.includes(state) ? 'filled' : ''}><path d={shapes[state]} /></svg>
      {lost ? `Last: ${capital(state)}` : capital(state)}
    </span>
  );
}

// As far as is known: one that is offline may have been sent on by itself.
const standing: RobotState[] = ['stopped', 'paused', 'available', 'arrived', 'failed', 'fault', 'shut down'];
export const mayMove = (robot: Robot) =>
  !standing.includes(robot.state) || robot.speed_mps !== 0 || robot.unanswered_stop_unix_ms !== null;

// Those that would take a mission now.
export const isFree = (robot: Robot) =>
  robot.role === 'follower' && robot.heard && !robot.mission && !['driving', 'teaching', 'shut down'].includes(robot.state);

// Robots that stand are seen first: they are listed first, and drawn last.
export const stands = (robot: Robot) => robot.state !== 'driving' && robot.state !== 'teaching';

export function how(robot: Robot, at: number | null, unit: string): string {
  const of = robot.length_m && unit === 'm' ? ` of ${robot.length_m.toFixed(1)}` : '';
  const where = at === null ? `${Math.round(100 * robot.progress)} %` : `${at.toFixed(1)}${of} ${unit}`;
  const sure = robot.left_sigma_m ? `, ${Math.abs(robot.left_m ?? 0).toFixed(2)} ± ${robot.left_sigma_m.toFixed(2)} m ${(robot.left_m ?? 0) < 0 ? 'right' : 'left'} of its path` : '';
  return `${where}${robot.speed_mps !== 0 ? `, ${robot.speed_mps.toFixed(2)} m/s` : ''}${sure}`;
}
