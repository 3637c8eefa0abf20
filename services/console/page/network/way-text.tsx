import type { Way } from '../api';
import { metres } from './network-layout';

// How long it is, and what one drives along.
export function WayText({ to, way }: { to: string; way: Way }) {
  return (
    <p role="status">
      <strong>{metres(way.way.length_m)} m</strong> to {to}:{' '}
      {way.way.stretches.map(({ route, from_m, to_m, speed }) =>
        `${route} ${metres(from_m)} to ${metres(to_m)} m${speed !== 1 ? ` at ${speed} times the taught speed` : ''}`).join(', then ')}
    </p>
  );
}
