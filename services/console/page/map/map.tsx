import { useMemo, useRef, useState, type MouseEvent } from 'react';
import type { Place, Robot, Route } from '../api';
import { doubts, kUnsure_m } from '../doubts';
import { asTaught, beside, boxOf, nearest, onPlan, pathOf, pointAt, roundLength, type Point } from './plan';
import { ClassPaths, Robots } from './marks';
import { RoutePicker } from '../routes/route-picker';
import { along, classes, useOnScreen, useShape, type Measure, type Shape } from './shape';
import { Badge, how, stands } from '../robot/state';

const kMostListed = 20;
const kPad = 34;  // px about a plan
export const kNear_px = 24;  // what is clicked so near is meant

export function MapLegend({ measure }: { measure: Measure }) {
  return (
    <p className="legend">
      {[...classes[measure], 'not known'].map((words, kind) => (
        <span key={kind}>
          <svg width="34" height="18" aria-hidden="true"><path className={`course ${measure} kind-${kind}`} d="M2 9H32" /></svg>
          {words}
        </span>
      ))}
      <span><svg width="34" height="18" aria-hidden="true"><path className="doubt" d="M2 9H32" /></svg>followers may be unsure</span>
      <span><svg width="34" height="18" aria-hidden="true"><path className="doubted" d="M2 9H32" /></svg>they were (± {kUnsure_m} m and more) while this page was open</span>
    </p>
  );
}

function Plan({ shape, robots, measure, pin, onPlace }: {
  shape: Shape;
  robots: Robot[];
  measure: Measure;
  pin: number | null;  // along it
  onPlace: (along_m: number) => void;
}) {
  const ref = useRef<HTMLDivElement>(null);
  const { width } = useOnScreen(ref);
  const { draw, undo, height, perMetre, bar_m } = useMemo(() => {
    const box = boxOf(shape, asTaught);
    const wide_m = Math.max(box.right - box.left, 0.5);
    const high_m = Math.max(box.high - box.low, 0.5);
    const most = Math.min(520, Math.max(260, width));
    const perMetre = Math.min((width - 2 * kPad) / wide_m, (most - 2 * kPad) / high_m);
    const height = Math.max(150, high_m * perMetre + 2 * kPad + 16);
    const left = (width - wide_m * perMetre) / 2;
    return {
      height,
      perMetre,
      bar_m: roundLength(width / 3 / perMetre),
      undo: (x: number, y: number) => ({ x: box.left + (x - left) / perMetre, y: box.high - (y - kPad) / perMetre }),
      draw: ({ x, y }: Point) => ({
        x: left + (x - box.left) * perMetre,
        y: kPad + (box.high - y) * perMetre,
      }),
    };
  }, [shape, width]);
  // What does not move is drawn once.
  const course = useMemo(() => (
    <>
      {shape.weak_places.map((place, i) => (
        <path key={i} className="doubt" d={pathOf(shape, place.begin, place.end, draw)} />
      ))}
      <ClassPaths shape={shape} measure={measure} draw={draw} />
    </>
  ), [shape, measure, draw]);
  const marks = onPlan(robots, shape, draw);
  const start = draw({ x: shape.points.x_m[0], y: shape.points.y_m[0] });
  const last = shape.points.x_m.length - 1;
  const end = draw({ x: shape.points.x_m[last], y: shape.points.y_m[last] });
  const click = (event: MouseEvent<SVGSVGElement>) => {
    const frame = event.currentTarget.getBoundingClientRect();
    const { along, off } = nearest(shape, undo(event.clientX - frame.left, event.clientY - frame.top));
    if (off * perMetre < kNear_px) onPlace(along);
  };
  const pinned = pin === null ? null : draw(pointAt(shape, pin));
  const text = robots.map((robot) => `${robot.name} ${robot.state} at ${how(robot, along(robot, shape), 'm')}`);
  return (
    <div ref={ref} className="plan">
      <svg role="img" width="100%" height={height} onClick={click}
        aria-label={`The route's shape by its scout's wheels. ${text.slice(0, 20).join('; ') || 'No robot is on it.'}`}>
        {course}
        {doubts(shape.route, shape.teaching, shape.length).map((each, i) => (
          <path key={i} className="doubted" d={pathOf(shape, each.begin, each.end, draw)} />
        ))}
        {robots.map((robot) => {
          const at = along(robot, shape);
          const sigma = robot.left_sigma_m ?? 0;
          if (at === null || sigma <= 0) return null;
          const on = pointAt(shape, at);
          const one = draw(beside(on, (robot.left_m ?? 0) - sigma));
          const other = draw(beside(on, (robot.left_m ?? 0) + sigma));
          return <path key={robot.name} className="unsure-way" d={`M${one.x} ${one.y}L${other.x} ${other.y}`} />;
        })}
        <circle className="begin" cx={start.x} cy={start.y} r="6" />
        <rect className="finish" x={end.x - 5} y={end.y - 5} width="10" height="10" />
        <Robots marks={marks} />
        {pinned && <path className="pin" d={`M${pinned.x} ${pinned.y}l-7-13a7.5 7.5 0 1 1 14 0z`} />}
        <path className="bar" d={`M${kPad} ${height - 14}v5h${bar_m * perMetre}v-5`} />
        <text className="scale" x={kPad + bar_m * perMetre + 6} y={height - 8}>{bar_m} m</text>
      </svg>
    </div>
  );
}

export function ShapeView({ robots, live, settled, pin, onPlace }: {
  robots: Robot[];
  live: Route[];
  settled: boolean;
  pin: Place | null;
  onPlace: (place: Place) => void;
}) {
  const [chosen, setChosen] = useState<Route | null>(null);
  const [measure, setMeasure] = useState<Measure>('features');
  const route = chosen ?? live[0] ?? null;
  const on = robots.filter((robot) => route && robot.route_id === route.route);
  const { shape, fetched, error } = useShape(route?.route ?? '', on[0]?.teaching ?? '', !!route);
  // Where robots on another revision are would be measured along another way.
  const upon = on.filter((robot) => shape && robot.teaching === shape.teaching);
  return (
    <>
      <div className="map-fields">
        <RoutePicker label="Route" live={live} chosen={route} onChoose={setChosen} />
        <label>Colours
          <select value={measure} onChange={(event) => setMeasure(event.target.value as Measure)}>
            <option value="features">features to steer by</option>
            <option value="roughness">roughness of the ground</option>
          </select>
        </label>
      </div>
      {!route && <p className="note">{settled ? 'No robot is on a route: choose one.' : 'Searching for robots …'}</p>}
      {route && error && <p className="note">The shape of {route.name} is not there: {error}.</p>}
      {route && !shape && !error && <p className="note">Fetching the shape of {route.name}: {Math.round(100 * fetched)} %</p>}
      {route && shape?.unit === 's' && <p className="note">{route.name} was taught without odometry: it has no shape.</p>}
      {shape?.unit === 'm' && (
        <>
          <Plan shape={shape} robots={upon} measure={measure} pin={pin?.route === route?.name ? pin!.along_m : null}
            onPlace={(along_m) => onPlace({ route: route!.name, along_m })} />
          <p className="note by-wheels">
            <strong>Odometry trace (may drift):</strong> wheels slip, and the path bends a little more or less than this.
            {shape.closing && ` Its end looks as its beginning and came out ${shape.closing.gap_m.toFixed(1)} m off; that is spread along the loop for drawing only.`}
          </p>
          <MapLegend measure={measure} />
          <ul className="on-map">
            {[...upon].sort((one, other) => Number(stands(other)) - Number(stands(one))).slice(0, kMostListed).map((robot) => (
              <li key={robot.name}>
                <a href={`#fleet/${robot.name}`}>{robot.name}</a> <Badge state={robot.state} />{' '}
                {how(robot, along(robot, shape), 'm')}
                {stands(robot) && robot.detail ? `: ${robot.detail}` : ''}
              </li>
            ))}
            {upon.length > kMostListed && <li>and {upon.length - kMostListed} more</li>}
          </ul>
        </>
      )}
    </>
  );
}
