// Geometry of what is drawn from above.
import { along, cellEnd, classOf, type Measure, type Shape } from './shape';
import type { Robot } from '../api';
import { stands } from '../robot/state';

export type Point = { x: number; y: number };
// Metres to the right and up from the site's lower left corner; the heading of a route's beginning,
// counter-clockwise.
export type Placement = { x_m: number; y_m: number; heading_rad: number; scale: number };
export type Origin = { longitude_deg: number; latitude_deg: number };
export type Site = {
  kept: boolean;
  plan: { metres_per_pixel: number } | null;
  origin: Origin | null;
  placements: Record<string, Placement>;
};

export const asTaught: Placement = { x_m: 0, y_m: 0, heading_rad: 0, scale: 1 };
const kEarth_m = 6371000;

export function metresFrom(origin: Origin, longitude_deg: number, latitude_deg: number): Point {
  const rad = Math.PI / 180;
  return {
    x: kEarth_m * rad * (longitude_deg - origin.longitude_deg) * Math.cos(rad * origin.latitude_deg),
    y: kEarth_m * rad * (latitude_deg - origin.latitude_deg),
  };
}

export function placed(at: Point, placement: Placement): Point {
  const cos = placement.scale * Math.cos(placement.heading_rad);
  const sin = placement.scale * Math.sin(placement.heading_rad);
  return { x: placement.x_m + cos * at.x - sin * at.y, y: placement.y_m + sin * at.x + cos * at.y };
}

// Where on the shape one is after so much of it, and which way it goes there.
export function pointAt(shape: Shape, at: number): Point & { heading: number } {
  const { along: grid, x_m, y_m } = shape.points;
  const last = grid.length - 1;
  if (last < 1) return { x: x_m[0] ?? 0, y: y_m[0] ?? 0, heading: 0 };
  let low = 0;
  let high = last;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (grid[middle] <= at) low = middle;
    else high = middle;
  }
  const share = Math.min(1, Math.max(0, (at - grid[low]) / (grid[high] - grid[low] || 1)));
  return {
    x: x_m[low] + share * (x_m[high] - x_m[low]),
    y: y_m[low] + share * (y_m[high] - y_m[low]),
    heading: Math.atan2(y_m[high] - y_m[low], x_m[high] - x_m[low]),
  };
}

export function beside(at: Point & { heading: number }, left_m: number): Point {
  return { x: at.x - left_m * Math.sin(at.heading), y: at.y + left_m * Math.cos(at.heading) };
}

// How far along the shape is nearest to a point, and how far off that is.
export function nearest(shape: Shape, at: Point): { along: number; off: number } {
  const { along: grid, x_m, y_m } = shape.points;
  let best = { along: 0, off: Infinity };
  for (let i = 0; i + 1 < grid.length; ++i) {
    const [dx, dy] = [x_m[i + 1] - x_m[i], y_m[i + 1] - y_m[i]];
    const share = Math.min(1, Math.max(0, ((at.x - x_m[i]) * dx + (at.y - y_m[i]) * dy) / (dx * dx + dy * dy || 1)));
    const off = Math.hypot(x_m[i] + share * dx - at.x, y_m[i] + share * dy - at.y);
    if (off < best.off) best = { along: grid[i] + share * (grid[i + 1] - grid[i]), off };
  }
  return best;
}

// Metres on the site as a route's own.
export function unplaced(at: Point, placement: Placement): Point {
  const cos = Math.cos(placement.heading_rad) / placement.scale;
  const sin = Math.sin(placement.heading_rad) / placement.scale;
  const [x, y] = [at.x - placement.x_m, at.y - placement.y_m];
  return { x: cos * x + sin * y, y: cos * y - sin * x };
}

// Of a stretch, as a path: its own ends, and what lies between.
export function pathOf(shape: Shape, begin: number, end: number, draw: (at: Point) => Point): string {
  const text = (at: Point) => {
    const { x, y } = draw(at);
    return `${x.toFixed(1)} ${y.toFixed(1)}`;
  };
  let d = `M${text(pointAt(shape, begin))}`;
  shape.points.along.forEach((at, i) => {
    if (at > begin && at < end) d += `L${text({ x: shape.points.x_m[i], y: shape.points.y_m[i] })}`;
  });
  return `${d}L${text(pointAt(shape, end))}`;
}

// One path a class, the last for what is not known.
export function classPaths(shape: Shape, measure: Measure, draw: (at: Point) => Point): string[] {
  const paths = ['', '', '', '', ''];
  const { begin } = shape.cells;
  let from = 0;
  let next = 0;  // of the shape's points
  const { along: grid, x_m, y_m } = shape.points;
  const text = (at: Point) => {
    const { x, y } = draw(at);
    return `${x.toFixed(1)} ${y.toFixed(1)}`;
  };
  while (from < begin.length) {
    const kind = classOf(shape, from, measure);
    let to = from;
    while (to + 1 < begin.length && classOf(shape, to + 1, measure) === kind) ++to;
    const end = cellEnd(shape, to);
    let d = `M${text(pointAt(shape, begin[from]))}`;
    while (next < grid.length && grid[next] <= begin[from]) ++next;
    for (; next < grid.length && grid[next] < end; ++next) d += `L${text({ x: x_m[next], y: y_m[next] })}`;
    paths[kind < 0 ? 4 : kind] += `${d}L${text(pointAt(shape, end))}`;
    from = to + 1;
  }
  return paths;
}

export type Box = { left: number; right: number; low: number; high: number };
export const emptyBox: Box = { left: Infinity, right: -Infinity, low: Infinity, high: -Infinity };

export function boxOf(shape: Shape, placement: Placement, box: Box = emptyBox): Box {
  const grown = { ...box };
  shape.points.x_m.forEach((x, i) => {
    const at = placed({ x, y: shape.points.y_m[i] }, placement);
    grown.left = Math.min(grown.left, at.x);
    grown.right = Math.max(grown.right, at.x);
    grown.low = Math.min(grown.low, at.y);
    grown.high = Math.max(grown.high, at.y);
  });
  return grown;
}

// A length that a scale bar has: 1, 2 or 5 of something, at most this.
export function roundLength(most_m: number): number {
  const ten = 10 ** Math.floor(Math.log10(most_m));
  return [5, 2, 1].map((digit) => digit * ten).find((length) => length <= most_m) ?? ten;
}

// `name`: where its middle is drawn; null: where many stand there is no room for it.
export type OnPlan = { robot: Robot; x: number; y: number; heading: number; name: Point | null };

const kLetter_px = 8.3;
const kFew = 15;  // robots, whose names may be farther off
const kName_px = 15;  // high
const kMark_px = 12;  // half of one
// From a robot's middle, in the order of preference: above and below, to their sides, and farther off.
const kSpots: ((wide: number) => Point)[] = [-16, 26, -32, 42].flatMap((y) => [
  () => ({ x: 0, y }), (wide: number) => ({ x: wide / 2 + 10, y }), (wide: number) => ({ x: -wide / 2 - 10, y }),
]).concat([-16, 26].flatMap((y) => [(wide: number) => ({ x: wide + 14, y }), (wide: number) => ({ x: -wide - 14, y })]));

// Finds for each name a place where it lies over no other and over no robot, the last first.
// `free`: there may be a name.
export function placeNames(marks: OnPlan[], free: (at: Point, wide: number) => boolean = () => true) {
  const taken: { x: number; y: number; wide: number }[] = [];
  for (const mark of [...marks].reverse()) {
    const wide = kLetter_px * mark.robot.name.length;
    const spots = marks.length > kFew ? kSpots.slice(0, 6) : kSpots;
    const spot = spots.map((from) => ({ x: mark.x + from(wide).x, y: mark.y + from(wide).y })).find((at) =>
      free(at, wide)
      && taken.every((other) => Math.abs(other.x - at.x) > (other.wide + wide) / 2 + 3 || Math.abs(other.y - at.y) > kName_px)
      && marks.every((other) => Math.abs(other.x - at.x) > wide / 2 + kMark_px || Math.abs(other.y - (at.y - 4)) > kMark_px + 4));
    mark.name = spot ?? null;
    if (spot) taken.push({ ...spot, wide });
  }
}

// Robots in pixels, those that stand above the others.
export function onPlan(robots: Robot[], shape: Shape, draw: (at: Point) => Point): OnPlan[] {
  const marks: OnPlan[] = robots.map((robot) => {
    const on = pointAt(shape, along(robot, shape) ?? 0);
    const at = beside(on, robot.left_m ?? 0);
    const { x, y } = draw(at);
    const front = draw({ x: at.x + Math.cos(on.heading), y: at.y + Math.sin(on.heading) });
    return { robot, x, y, heading: Math.atan2(front.y - y, front.x - x), name: null };
  });
  marks.sort((one, other) => Number(stands(one.robot)) - Number(stands(other.robot)));
  placeNames(marks);
  return marks;
}
