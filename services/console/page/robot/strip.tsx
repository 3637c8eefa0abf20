import { memo, useRef, type MouseEvent } from 'react';
import type { Place, Robot } from '../api';
import { doubts, kUnsure_m } from '../doubts';
import { along, classes, stretches, useOnScreen, useShape, type Shape } from '../map/shape';
import { Badge, how, shapes, stands } from './state';

const kSide = 12;      // px left free at both ends, for a robot that stands there
const kMiddle = 50;    // y of the line
const kRow = 15;       // of names above it
const kRows = 2;
const kLetter = 8;     // about as wide as one of a name
const kLeastTick = 5;  // between hand-overs that can be told apart
const kHalf = [2, 4, 6, 8];  // of a class's height
const kPerMetre = 22;  // px, that a robot may be beside its path

const metres = (value: number, unit: string) => `${value.toFixed(value < 100 ? 1 : 0)} ${unit}`;

const scaleOf = (length: number, width: number) => (at: number) =>
  kSide + (width - 2 * kSide) * at / (length || 1);

// The line: thicker and bluer where there is more to steer by.
const Cells = memo(function Cells({ shape, width }: { shape: Shape; width: number }) {
  const x = scaleOf(shape.length, width);
  const paths = classes.features.map(() => '');
  for (const { begin, end, kind } of stretches(shape, 'features')) {
    if (kind < 0) continue;
    const half = kHalf[kind];
    paths[kind] += `M${x(begin).toFixed(1)} ${kMiddle - half}H${x(end).toFixed(1)}v${2 * half}H${x(begin).toFixed(1)}z`;
  }
  let ticks = '';
  const { begin } = shape.cells;
  const legible = shape.segments_a_cell === 1 && (x(shape.length) - x(0)) / begin.length >= kLeastTick;
  if (legible) for (const at of begin.slice(1)) ticks += `M${x(at).toFixed(1)} ${kMiddle - 10}v20`;
  const weak = shape.weak_places.map((place) =>
    `M${x(place.begin).toFixed(1)} ${kMiddle + 12}H${Math.max(x(place.end), x(place.begin) + 2).toFixed(1)}`);
  return (
    <>
      {paths.map((d, kind) => d && <path key={kind} className={`cells kind-${kind}`} d={d} />)}
      {ticks && <path className="hand-overs" d={ticks} />}
      {weak.length > 0 && <path className="weak" d={weak.join('')} />}
    </>
  );
});

type Mark = { robot: Robot; x: number; row: number };

// Names that would lie over others are left out: the list below has them.
function place(robots: Robot[], x: (robot: Robot) => number, width: number): Mark[] {
  const marks = robots.map((robot) => ({ robot, x: x(robot), row: -1 }));
  marks.sort((one, other) => Number(stands(one.robot)) - Number(stands(other.robot)));
  const taken: { left: number; right: number }[][] = Array.from({ length: kRows }, () => []);
  for (const mark of [...marks].reverse()) {
    const wide = mark.robot.name.length * kLetter;
    const left = Math.min(Math.max(0, mark.x - wide / 2), Math.max(0, width - wide));
    const right = left + wide + 4;
    mark.row = taken.findIndex((row) => row.every((other) => other.right < left || other.left > right));
    if (mark.row >= 0) taken[mark.row].push({ left, right });
  }
  return marks;
}

function Marker({ mark, width }: { mark: Mark; width: number }) {
  const { robot, row } = mark;
  const half = 9 + kPerMetre * Math.min(1, robot.left_sigma_m ?? 0);
  const wide = robot.name.length * kLetter;
  const name = Math.min(Math.max(wide / 2, mark.x), width - wide / 2);
  const colour = `on-line ${robot.state.replace(' ', '-')}${robot.heard ? '' : ' unheard'}`;
  return (
    <g className={colour} data-robot={robot.name}>
      {robot.left_sigma_m && (
        <rect className="unsure" x={mark.x - 11} width={22} y={kMiddle - half} height={2 * half} rx={4} />
      )}
      {row >= 0 && <path className="lead" d={`M${mark.x} ${kMiddle - 9}V${kMiddle - 14 - kRow * row}`} />}
      <g transform={`translate(${mark.x - 8} ${kMiddle - 8})`}>
        <circle cx="8" cy="8" r="9" />
        <path className="glyph" d={shapes[robot.state]} transform="translate(3.2 3.2) scale(0.6)" />
      </g>
      {row >= 0 && <text x={name} y={kMiddle - 16 - kRow * row} textAnchor="middle">{robot.name}</text>}
    </g>
  );
}

// A route as a metro line, with the robots upon it. Drawn anew only when one of them has changed.
const Line = memo(function Line({ robots, pin = null, onPlace }: {
  robots: Robot[];
  pin?: number | null;  // along it
  onPlace?: (along_m: number) => void;
}) {
  const ref = useRef<HTMLDivElement>(null);
  const { seen, width } = useOnScreen(ref);
  const on = robots.find((robot) => robot.route_id) ?? robots[0];
  const { shape, fetched, error } = useShape(on.route_id, on.teaching, seen);
  // 0: not yet. Of who teaches it, so far.
  const known = shape?.length ||
    Math.max(...robots.map((robot) => robot.length_m ?? (robot.teaches ? robot.along_m : null) ?? 0));
  const length = known || 1;
  const unit = shape?.unit ?? 'm';
  const x = scaleOf(length, width);
  const at = (robot: Robot) => (known ? along(robot, shape) : null) ?? robot.progress * length;
  const marks = place(robots, (robot) => x(Math.min(length, Math.max(0, at(robot)))), width);
  const unsure = doubts(on.route_id, on.teaching, length).map(({ begin, end }) =>
    `M${x(begin).toFixed(1)} ${kMiddle + 16}H${x(end).toFixed(1)}`);
  const click = (event: MouseEvent<SVGSVGElement>) => {
    if (!onPlace || unit !== 'm' || !shape) return;
    const at_px = event.clientX - event.currentTarget.getBoundingClientRect().left;
    onPlace(Math.min(length, Math.max(0, (at_px - kSide) / (width - 2 * kSide) * length)));
  };
  const text = robots.slice(0, 20)
    .map((robot) => `${robot.name} ${robot.state} at ${how(robot, along(robot, shape), unit)}`).join('; ');
  return (
    <div className="line" ref={ref}>
      <svg role="img" aria-label={`Route ${on.route}: ${text}`} width="100%" height={kMiddle + 30}
        className={onPlace && shape ? 'clickable' : ''} onClick={click}>
        <path className="way" d={`M${x(0)} ${kMiddle}H${x(length)}`} />
        {shape && <Cells shape={shape} width={width} />}
        {unsure.length > 0 && <path className="doubted" d={unsure.join('')} />}
        <path className="ends" d={`M${x(0)} ${kMiddle - 11}v22M${x(length)} ${kMiddle - 11}v22`} />
        <text className="scale" x={x(0)} y={kMiddle + 27}>0</text>
        <text className="scale" x={x(length)} y={kMiddle + 27} textAnchor="end">
          {known ? metres(length, unit) : 'its end'}
        </text>
        {pin !== null && <path className="pin" d={`M${x(pin)} ${kMiddle}l-7-13a7.5 7.5 0 1 1 14 0z`} />}
        {marks.map((mark) => <Marker key={mark.robot.name} mark={mark} width={width} />)}
      </svg>
      {!shape && on.route_id && (fetched > 0 || error) && (
        <p className="note">{error ? `Its segments are not shown: ${error}.` : `Fetching its segments: ${Math.round(100 * fetched)} %`}</p>
      )}
    </div>
  );
}, (one, other) => one.pin === other.pin && one.robots.length === other.robots.length && one.robots.every((robot, i) => robot === other.robots[i]));

// On a robot's card.
export function Strip({ robot }: { robot: Robot }) {
  return (
    <div className="strip">
      <Line robots={[robot]} />
      <span>{robot.route}: {how(robot, robot.along_m, 'm')}</span>
    </div>
  );
}

function Legend() {
  return (
    <details className="legend-box">
      <summary>Legend</summary>
      <p className="legend">
      Features to steer by:{' '}
      {classes.features.map((words, kind) => (
        <span key={kind}>
          <svg width="22" height="18" aria-hidden="true"><rect className={`cells kind-${kind}`} width="22" y={9 - kHalf[kind]} height={2 * kHalf[kind]} /></svg>
          {words}
        </span>
      ))}
      <span><svg width="22" height="18" aria-hidden="true"><path className="weak" d="M0 9H22" /></svg>weak: followers may be unsure</span>
      <span><svg width="22" height="18" aria-hidden="true"><path className="doubted" d="M0 9H22" /></svg>position uncertain this session (± {kUnsure_m} m and more)</span>
      <span><svg width="22" height="18" aria-hidden="true"><rect className="unsure" x="4" width="14" y="1" height="16" rx="4" /></svg>the taller, the less sure a robot is</span>
      </p>
    </details>
  );
}

// The routes that robots are on, and who stands there and why.
export function Lines({ robots, chosen, settled, pin, onPlace }: {
  robots: Robot[];
  chosen: string;
  settled: boolean;
  pin: Place | null;
  onPlace: (place: Place) => void;
}) {
  const routes = new Map<string, Robot[]>();
  for (const robot of robots) {
    // One that has not found itself on its route yet may be anywhere, or there may be no such route.
    if (!robot.route || !(robot.route_id || robot.teaches)) continue;
    const key = robot.route_id ? `${robot.route_id} ${robot.teaching}` : robot.route;
    const others = routes.get(key);
    if (others) others.push(robot);
    else routes.set(key, [robot]);
  }
  if (routes.size === 0) return <p className="note">{settled ? 'No robot is on a route.' : 'Searching for robots …'}</p>;
  return (
    <section className="lines" aria-label="Active routes">
      {[...routes].map(([key, on]) => (
        <figure key={key}>
          <figcaption>{on[0].route}</figcaption>
          <Line robots={on} pin={pin?.route === on[0].route ? pin.along_m : null} onPlace={(along_m) => onPlace({ route: on[0].route, along_m })} />
          <ul>
            {on.filter(stands).map((robot) => (
              <li key={robot.name} className={robot.name === chosen ? 'chosen' : ''}>
                <a href={`#fleet/${robot.name}`}>{robot.name}</a> <Badge state={robot.state} />{' '}
                {how(robot, robot.along_m, 'm')}
              </li>
            ))}
          </ul>
        </figure>
      ))}
      <Legend />
    </section>
  );
}
