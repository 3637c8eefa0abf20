import { useRef } from 'react';
import type { FoundRoute } from '../api';
import { classes, useOnScreen, useShape, type Shape } from './shape';

const degrees = (rad: number) => `${(rad * 180 / Math.PI).toFixed(1)}°`;
const percent = (share: number) => (share > 0 && share < 0.01 ? 'under 1 %' : `${Math.round(100 * share)} %`);

function Felt({ terrain: { shares, up_rad, down_rad } }: { terrain: Shape['terrain'] }) {
  const rough = classes.roughness.filter((name) => shares?.[name]);
  const known = rough.reduce((sum, name) => sum + shares![name], 0);
  return (
    <>
      {rough.length === 0 ? 'roughness not known' : (
        <ul className="ground">
          {rough.map((name) => <li key={name}>{name} {percent(shares![name])}</li>)}
          {known < 0.995 && <li>not known {percent(1 - known)}</li>}
        </ul>
      )}
      <div>{up_rad === null || down_rad === null ? 'slope not known' : `up to ${degrees(up_rad)} up, ${degrees(down_rad)} down`}</div>
    </>
  );
}

// The ground under one revision, which is asked of its segments: only where somebody looks.
export function Ground({ route }: { route: FoundRoute }) {
  const place = useRef<HTMLDivElement>(null);
  const { seen } = useOnScreen(place);
  const taught = route.state !== 'teaching';
  const { shape, fetched, error } = useShape(route.route, route.teaching, seen && taught);
  return (
    <div ref={place}>
      {!taught ? '–'
        : shape ? <Felt terrain={shape.terrain} />
        : error ? `⚠ ${error}`
        : `Loading … ${Math.round(100 * fetched)} %`}
    </div>
  );
}
