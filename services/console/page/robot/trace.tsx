import type { Robot } from '../api';

const kOver_ms = 600000;
const kEvery_ms = 2000;
const kMost = 256;  // robots
type Point = { at_ms: number; sigma_m: number | null; battery: number | null };
const traces = new Map<string, Point[]>();

// What this page has seen of each robot in the last ten minutes.
export function trace(robots: Robot[]) {
  const now = Date.now();
  for (const robot of robots) {
    if (!robot.heard) continue;
    const points = traces.get(robot.name) ?? [];
    if (points.length > 0 && now - points[points.length - 1].at_ms < kEvery_ms) continue;
    points.push({ at_ms: now, sigma_m: robot.left_sigma_m, battery: robot.battery_percent });
    while (points[0].at_ms < now - kOver_ms) points.shift();
    traces.delete(robot.name);
    traces.set(robot.name, points);
    if (traces.size > kMost) traces.delete(traces.keys().next().value!);
  }
}

const kWide = 200;
const kHigh = 36;

function Chart({ label, value, most, points }: { label: string; value: string; most: number; points: { at_ms: number; value: number | null }[] }) {
  const now = Date.now();
  let d = '';
  let last_ms = 0;
  for (const { at_ms, value } of points) {
    if (value === null) continue;
    const x = kWide * (1 - (now - at_ms) / kOver_ms);
    const y = kHigh - 1 - (kHigh - 2) * Math.min(1, value / most);
    d += `${d === '' || at_ms - last_ms > 4 * kEvery_ms ? 'M' : 'L'}${x.toFixed(1)} ${y.toFixed(1)}`;
    last_ms = at_ms;
  }
  return (
    <figure className="chart">
      <figcaption>{label} <strong>{value}</strong></figcaption>
      <svg viewBox={`0 0 ${kWide} ${kHigh}`} preserveAspectRatio="none" role="img" aria-label={`${label} in the last ten minutes: now ${value}`}>
        <path className="base" d={`M0 ${kHigh - 0.5}H${kWide}`} />
        <path className="curve" d={d} />
      </svg>
    </figure>
  );
}

// Its doubt and its battery.
export function Charts({ robot }: { robot: Robot }) {
  const points = traces.get(robot.name) ?? [];
  const sigmas = points.map(({ at_ms, sigma_m }) => ({ at_ms, value: sigma_m }));
  const batteries = points.map(({ at_ms, battery }) => ({ at_ms, value: battery }));
  const most_m = Math.max(0.2, ...sigmas.map(({ value }) => value ?? 0));
  const knowsSigma = sigmas.some(({ value }) => value !== null);
  const knowsBattery = batteries.some(({ value }) => value !== null);
  if (!knowsSigma && !knowsBattery) return null;
  return (
    <div className="charts">
      {knowsSigma && <Chart label="Doubt" value={robot.left_sigma_m === null ? '–' : `± ${robot.left_sigma_m.toFixed(2)} m`} most={most_m} points={sigmas} />}
      {knowsBattery && <Chart label="Battery" value={robot.battery_percent === null ? '–' : `${robot.battery_percent} %`} most={100} points={batteries} />}
      <p className="note">Ten minutes, as far as this page was open.</p>
    </div>
  );
}
