import { useEffect, useState, type RefObject } from 'react';
import type { Robot } from '../api';

// openapi.yaml's RouteShape. Along a route in metres, or, taught without odometry, in seconds.
export type Shape = {
  route: string;
  teaching: string;
  unit: 'm' | 's';
  length: number;
  segments: number;
  segments_a_cell: number;
  cells: {
    begin: number[];
    features: number[];
    roughness: (string | null)[];
    slope_rad: (number | null)[];
  };
  terrain: { shares: Record<string, number> | null; up_rad: number | null; down_rad: number | null };
  points: { along: number[]; x_m: number[]; y_m: number[] };
  closing: { gap_m: number; turn_rad: number } | null;
  weak_places: { begin: number; end: number; why: string; features: number }[];
};

export type Drawn = { shape: Shape | null; fetched: number; error: string };

// A page that is open for days has seen many routes.
const kMostKept = 48;
const kAgain_ms = 10000;
const nothing: Drawn = { shape: null, fetched: 0, error: '' };
const kept = new Map<string, Drawn>();
const looking = new Map<string, Set<() => void>>();
const asked: string[] = [];
let busy = false;

function keep(key: string, drawn: Drawn) {
  kept.delete(key);
  kept.set(key, drawn);
  for (const oldest of kept.keys()) {
    if (kept.size <= kMostKept) break;
    if (!looking.has(oldest)) kept.delete(oldest);
  }
  looking.get(key)?.forEach((tell) => tell());
}

async function fetchOne(key: string) {
  const [route, teaching] = key.split(' ');
  const query = teaching ? `?teaching=${teaching}` : '';
  try {
    while (looking.has(key)) {
      const reply = await fetch(`/api/routes/${route}/shape${query}`);
      const json = await reply.json();
      if (reply.status === 200) return keep(key, { shape: json, fetched: 1, error: '' });
      if (reply.status !== 202) return keep(key, { ...nothing, error: json.error ?? 'it failed' });
      keep(key, { ...nothing, fetched: json.fetched });
    }
  } catch {
    keep(key, { ...nothing, error: 'the console does not answer' });
  }
}

// One after the other: robots need the link more than pictures do.
async function work() {
  if (busy) return;
  busy = true;
  for (let key = asked.shift(); key !== undefined; key = asked.shift()) await fetchOne(key);
  busy = false;
}

// Of a route's teaching ('' for the active one); asked for only while `wanted`.
export function useShape(route: string, teaching: string, wanted = true): Drawn {
  const key = `${route} ${teaching}`;
  const [, setTold] = useState(0);
  const there = !!kept.get(key)?.shape;
  useEffect(() => {
    if (!route || !wanted) return;
    const tell = () => setTold((times) => times + 1);
    const others = looking.get(key) ?? new Set();
    looking.set(key, others.add(tell));
    const ask = () => {
      if (kept.get(key)?.shape || asked.includes(key)) return;
      asked.push(key);
      work();
    };
    ask();
    const again = there ? undefined : window.setInterval(ask, kAgain_ms);
    return () => {
      window.clearInterval(again);
      others.delete(tell);
      if (others.size === 0) looking.delete(key);
    };
  }, [key, wanted, there]);
  return kept.get(key) ?? nothing;
}

// Whether it has ever been on the screen, and how wide it is there.
export function useOnScreen(ref: RefObject<Element>): { seen: boolean; width: number } {
  const [seen, setSeen] = useState(false);
  const [width, setWidth] = useState(320);
  useEffect(() => {
    const element = ref.current;
    if (!element) return;
    const eye = new IntersectionObserver((entries) => {
      if (entries.some((entry) => entry.isIntersecting)) setSeen(true);
    });
    const rule = new ResizeObserver((entries) => {
      const wide = Math.round(entries[entries.length - 1].contentRect.width);
      if (wide > 0) setWidth(wide);
    });
    eye.observe(element);
    rule.observe(element);
    return () => {
      eye.disconnect();
      rule.disconnect();
    };
  }, []);
  return { seen, width };
}

// What a stretch is coloured by. Each class has a width or a pattern of its own besides.
export type Measure = 'features' | 'roughness';
export const classes: Record<Measure, string[]> = {
  features: ['under 5 a metre', '5 to 15', '15 to 30', '30 and more'],
  roughness: ['smooth', 'uneven', 'rough', 'very-rough'],
};
export const kUnknown = -1;

export function classOf(shape: Shape, cell: number, measure: Measure): number {
  if (measure === 'roughness') return classes.roughness.indexOf(shape.cells.roughness[cell] ?? '');
  const length = cellEnd(shape, cell) - shape.cells.begin[cell];
  if (length <= 0) return kUnknown;
  const perUnit = shape.cells.features[cell] / length;
  return perUnit < 5 ? 0 : perUnit < 15 ? 1 : perUnit < 30 ? 2 : 3;
}

export function cellEnd(shape: Shape, cell: number): number {
  return cell + 1 < shape.cells.begin.length ? shape.cells.begin[cell + 1] : shape.length;
}

// Stretches of one class, in the route's order.
export function stretches(shape: Shape, measure: Measure): { begin: number; end: number; kind: number }[] {
  const found: { begin: number; end: number; kind: number }[] = [];
  shape.cells.begin.forEach((begin, cell) => {
    const kind = classOf(shape, cell, measure);
    const last = found[found.length - 1];
    if (last && last.kind === kind) last.end = cellEnd(shape, cell);
    else found.push({ begin, end: cellEnd(shape, cell), kind });
  });
  return found;
}

// How far along a robot is, in the shape's unit.
export function along(robot: Robot, shape: Shape | null): number | null {
  if (shape?.unit === 's') return robot.progress * shape.length;
  if (robot.along_m !== null) return robot.along_m;
  return shape ? robot.progress * shape.length : null;
}
