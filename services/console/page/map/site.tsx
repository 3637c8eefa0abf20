import { useEffect, useMemo, useRef, useState, type KeyboardEvent, type MouseEvent, type PointerEvent } from 'react';
import { change, get, type Answer, type Place, type Robot, type Route } from '../api';
import { useMay } from '../me';
import { ClassPaths, Robots } from './marks';
import { boxOf, metresFrom, nearest, onPlan, placed, pointAt, roundLength, unplaced, type Box, type Origin, type Placement, type Point, type Site } from './plan';
import { RoutePicker } from '../routes/route-picker';
import { kNear_px } from './map';
import { useOnScreen, useShape, type Shape } from './shape';

const kPad_m = 2;
const kMostRoutes = 40;
const kSite_m = '10000';  // what lies further off is of another site
const kArrow_px = 56;  // from a route's beginning to the handle that turns it

// By what its scout said of it when it was taught; its heading nobody knows yet.
function byItsPlace(route: Route, origin: Origin | null): Placement | null {
  if (!route.place) return null;
  if ('site_x_m' in route.place) {
    return { x_m: route.place.site_x_m, y_m: route.place.site_y_m, heading_rad: 0, scale: 1 };
  }
  if (!origin) return null;
  const { x, y } = metresFrom(origin, route.place.longitude, route.place.latitude);
  return { x_m: x, y_m: y, heading_rad: 0, scale: 1 };
}

function usePlanSize(site: Site | null, onMissing: () => void): { width: number; height: number } | null {
  const [size, setSize] = useState<{ width: number; height: number } | null>(null);
  const perPixel = site?.plan?.metres_per_pixel ?? 0;
  useEffect(() => {
    if (perPixel <= 0) return;
    const picture = new Image();
    picture.onload = () => setSize({ width: picture.naturalWidth * perPixel, height: picture.naturalHeight * perPixel });
    picture.onerror = onMissing;
    picture.src = '/api/site/plan';
    return () => { picture.onload = picture.onerror = null; };
  }, [perPixel]);
  return size;
}

function PlacedRoute({ route, placement, robots, toScreen, chosen, pin, onBox, onShape }: {
  route: Route;
  placement: Placement;
  robots: Robot[];
  toScreen: (at: Point) => Point;
  chosen: boolean;
  pin: number | null;
  onBox: (route: string, box: Box) => void;
  onShape: (route: string, shape: Shape) => void;
}) {
  const { shape } = useShape(route.route, '');
  useEffect(() => {
    if (shape) onShape(route.route, shape);
  }, [shape]);
  const draw = (at: Point) => toScreen(placed(at, placement));
  const drawn = !!shape && shape.points.x_m.length > 1;
  useEffect(() => {
    if (shape && drawn) onBox(route.route, boxOf(shape, placement));
  }, [shape, placement]);
  const course = useMemo(() => shape && drawn && <ClassPaths shape={shape} measure="features" draw={draw} />, [shape, placement, toScreen]);
  const start = draw({ x: 0, y: 0 });
  const pinned = pin !== null && shape && drawn ? draw(pointAt(shape, pin)) : null;
  const on = robots.filter((robot) => shape && robot.teaching === shape.teaching);
  return (
    <g className={chosen ? 'placed chosen' : 'placed'}>
      {course}
      <circle className="begin" cx={start.x} cy={start.y} r="5" />
      <text x={start.x + 9} y={start.y + 16}>{route.name}</text>
      {shape && drawn && <Robots marks={onPlan(on, shape, draw)} />}
      {pinned && <path className="pin" d={`M${pinned.x} ${pinned.y}l-7-13a7.5 7.5 0 1 1 14 0z`} />}
    </g>
  );
}

// What a press of a key does to a placement; a tenth of it without the shift key.
function moved(from: Placement, event: KeyboardEvent): Placement | null {
  const step = event.shiftKey ? 1 : 0.1;
  const turn = (event.shiftKey ? 10 : 1) * Math.PI / 180;
  switch (event.key) {
    case 'ArrowLeft': return { ...from, x_m: from.x_m - step };
    case 'ArrowRight': return { ...from, x_m: from.x_m + step };
    case 'ArrowUp': return { ...from, y_m: from.y_m + step };
    case 'ArrowDown': return { ...from, y_m: from.y_m - step };
    case 'q': case 'Q': return { ...from, heading_rad: from.heading_rad + turn };
    case 'e': case 'E': return { ...from, heading_rad: from.heading_rad - turn };
    default: return null;
  }
}

function rounded(placement: Placement): Placement {
  const full = 2 * Math.PI;
  return {
    x_m: Math.round(placement.x_m * 100) / 100,
    y_m: Math.round(placement.y_m * 100) / 100,
    heading_rad: Math.round((placement.heading_rad - full * Math.round(placement.heading_rad / full)) * 1e4) / 1e4,
    scale: Math.round(placement.scale * 1000) / 1000,
  };
}

function Numbers({ placement, onChange }: { placement: Placement; onChange: (to: Placement) => void }) {
  const field = (label: string, value: number, step: number, set: (value: number) => Placement) => (
    <label>{label}
      <input type="number" step={step} value={value}
        onChange={(event) => event.target.value !== '' && onChange(set(Number(event.target.value)))} />
    </label>
  );
  const degrees = Math.round(placement.heading_rad * 1800 / Math.PI) / 10;
  return (
    <div className="numbers">
      {field('Right, m', placement.x_m, 0.1, (x_m) => ({ ...placement, x_m }))}
      {field('Up, m', placement.y_m, 0.1, (y_m) => ({ ...placement, y_m }))}
      {field('Heading, °', degrees, 1, (value) => ({ ...placement, heading_rad: value * Math.PI / 180 }))}
      {field('Scale', placement.scale, 0.01, (scale) => ({ ...placement, scale: Math.min(10, Math.max(0.1, scale)) }))}
    </div>
  );
}

// The handles of the chosen route: its beginning is dragged, the tip of the arrow turns it.
function Handles({ placement, toScreen, toSite, onChange }: {
  placement: Placement;
  toScreen: (at: Point) => Point;
  toSite: (event: PointerEvent) => Point;
  onChange: (to: Placement) => void;
}) {
  const start = toScreen({ x: placement.x_m, y: placement.y_m });
  const tip = {
    x: start.x + kArrow_px * Math.cos(placement.heading_rad),
    y: start.y - kArrow_px * Math.sin(placement.heading_rad),
  };
  const drag = (move: (at: Point) => Placement) => ({
    onPointerDown: (event: PointerEvent) => event.currentTarget.setPointerCapture(event.pointerId),
    onPointerMove: (event: PointerEvent) => {
      if (event.currentTarget.hasPointerCapture(event.pointerId)) onChange(move(toSite(event)));
    },
  });
  return (
    <g className="handles" tabIndex={0} role="group"
      aria-label="Place of the chosen route: arrow keys move it by 0.1 m, Q and E turn it by a degree, with the shift key by ten times as much"
      onKeyDown={(event) => {
        const to = moved(placement, event);
        if (!to) return;
        event.preventDefault();
        onChange(to);
      }}>
      <path d={`M${start.x} ${start.y}L${tip.x} ${tip.y}`} />
      <circle cx={start.x} cy={start.y} r="16" {...drag(({ x, y }) => ({ ...placement, x_m: x, y_m: y }))} />
      <circle cx={tip.x} cy={tip.y} r="13" {...drag(({ x, y }) => ({
        ...placement,
        heading_rad: Math.atan2(y - placement.y_m, x - placement.x_m),
      }))} />
    </g>
  );
}

export function SiteView({ robots, live, pin, onPlace }: {
  robots: Robot[];
  live: Route[];
  pin: Place | null;
  onPlace: (place: Place) => void;
}) {
  const shapes = useRef(new Map<string, Shape>());
  const onShape = (route: string, shape: Shape) => void shapes.current.set(route, shape);
  const ref = useRef<HTMLDivElement>(null);
  const svg = useRef<SVGSVGElement>(null);
  const { width: shown } = useOnScreen(ref);
  const [site, setSite] = useState<Site | null>(null);
  const [others, setOthers] = useState<Route[]>([]);
  const [chosen, setChosen] = useState<Route | null>(null);
  const [draft, setDraft] = useState<Placement | null>(null);
  const [zoom, setZoom] = useState(1);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [boxes, setBoxes] = useState<Record<string, Box>>({});
  const plan = usePlanSize(site, () => setAnswer({ ok: false, text: 'The floor plan does not load.' }));
  const mayPlace = useMay('operate') && site?.kept;

  useEffect(() => {
    let over = false;
    (async () => {
      const there = await get<Site>('/api/site', {});
      if (over) return;
      if (typeof there === 'string') return setAnswer({ ok: false, text: there });
      setSite(there);
      const found: Route[] = [];
      const add = async (query: Record<string, string>) => {
        const page = await get<{ routes: Route[] }>('/api/routes', query);
        if (typeof page !== 'string') found.push(...page.routes);
        else if (!over) setAnswer({ ok: false, text: `Some routes are not shown: ${page}` });
      };
      const near = { within_m: kSite_m, state: 'active', limit: String(kMostRoutes) };
      await add({ ...near, near_site: '0,0' });
      if (there.origin) await add({ ...near, near_gps: `${there.origin.latitude_deg},${there.origin.longitude_deg}` });
      for (const id of Object.keys(there.placements).slice(0, kMostRoutes)) {
        if (over) return;
        if (!found.some((route) => route.route === id)) await add({ name: id, state: 'active' });
      }
      if (over) return;
      setOthers(found);
    })();
    return () => { over = true; };
  }, []);

  const known = new Map([...others, ...live, ...(chosen ? [chosen] : [])].map((route) => [route.route, route]));
  const first = [...known.values()].find((route) => route.place && 'longitude' in route.place)?.place;
  const origin = site?.origin ?? (site && !site.plan && first && 'longitude' in first
    ? { longitude_deg: first.longitude, latitude_deg: first.latitude } : null);
  const placements = useMemo(() => {
    const all = new Map<string, Placement>();
    for (const route of known.values()) {
      const placement = site?.placements[route.route] ?? byItsPlace(route, origin);
      if (placement && all.size < kMostRoutes) all.set(route.route, placement);
    }
    return all;
  }, [site, [...known.keys()].join(' '), origin?.latitude_deg, origin?.longitude_deg]);

  // The plan, or all that is placed.
  const all = [...placements.keys()].map((id) => boxes[id]).filter((box) => box);
  const box = plan ? { left: 0, right: plan.width, low: 0, high: plan.height } : {
    left: Math.min(0, ...all.map((each) => each.left)) - kPad_m,
    right: Math.max(10, ...all.map((each) => each.right)) + kPad_m,
    low: Math.min(0, ...all.map((each) => each.low)) - kPad_m,
    high: Math.max(6, ...all.map((each) => each.high)) + kPad_m,
  };
  const width = shown * zoom;
  const perMetre = Math.min(width / (box.right - box.left), 560 * zoom / (box.high - box.low));
  const height = (box.high - box.low) * perMetre;
  const left = (width - (box.right - box.left) * perMetre) / 2;
  const toScreen = useMemo(
    () => ({ x, y }: Point) => ({ x: left + (x - box.left) * perMetre, y: (box.high - y) * perMetre }),
    [left, box.left, box.high, perMetre],
  );
  const toSite = (event: MouseEvent): Point => {
    const frame = svg.current!.getBoundingClientRect();
    return {
      x: box.left + (event.clientX - frame.left - left) / perMetre,
      y: box.high - (event.clientY - frame.top) / perMetre,
    };
  };
  const choose = (route: Route) => {
    setChosen(route);
    setAnswer(null);
    setDraft(null);
  };
  const middle = { x_m: (box.left + box.right) / 2, y_m: (box.low + box.high) / 2, heading_rad: 0, scale: 1 };
  const at = chosen ? draft ?? placements.get(chosen.route) ?? null : null;
  const edit = (to: Placement) => setDraft(rounded(to));
  const keep = async (to: Placement | null) => {
    if (!chosen) return;
    const path = `/api/site/placements/${chosen.route}`;
    const reply = await change<Site>(to ? 'PUT' : 'DELETE', path, to);
    if (typeof reply === 'string') return setAnswer({ ok: false, text: reply });
    if (!others.some((each) => each.route === chosen.route)) setOthers([...others, chosen]);
    setSite(reply);
    setDraft(null);
    setAnswer({ ok: true, text: to ? `${chosen.name} is placed.` : `${chosen.name} is taken off.` });
  };
  const onBox = (route: string, grown: Box) => {
    const same = boxes[route];
    if (same && same.left === grown.left && same.right === grown.right && same.low === grown.low && same.high === grown.high) return;
    setBoxes((before) => ({ ...before, [route]: grown }));
  };
  // The route that passes nearest to where one clicks.
  const click = (event: MouseEvent) => {
    const at = toSite(event);
    let best = { route: '', along_m: 0, off_px: kNear_px };
    for (const [id, placement] of placements) {
      const shape = shapes.current.get(id);
      if (!shape || shape.unit !== 'm') continue;
      const { along, off } = nearest(shape, unplaced(at, placement));
      const off_px = off * placement.scale * perMetre;
      if (off_px < best.off_px) best = { route: known.get(id)!.name, along_m: along, off_px };
    }
    if (best.route && !(chosen && mayPlace)) onPlace({ route: best.route, along_m: best.along_m });
  };
  const pinOn = (route: Route) => (pin?.route === route.name ? pin.along_m : null);
  const bar_m = roundLength(shown / 3 / perMetre);
  const corner = toScreen({ x: box.left, y: box.high });
  return (
    <>
      <div className="map-fields">
        <RoutePicker label="Place a route" live={[...known.values()]} chosen={chosen} onChoose={choose} />
        <span className="zoom">
          <button onClick={() => setZoom(Math.max(1, zoom / 1.5))} disabled={zoom <= 1} aria-label="Smaller">−</button>
          <button onClick={() => setZoom(Math.min(8, zoom * 1.5))} aria-label="Larger">+</button>
        </span>
      </div>
      {site && !site.kept && (
        <p className="note">Nothing is kept of where routes lie: start the console with <code>--site FOLDER</code>, in which a floor plan may be.</p>
      )}
      <div className={plan ? 'plan site upon' : 'plan site'} ref={ref} tabIndex={zoom > 1 ? 0 : -1}>
        <svg ref={svg} width={width} height={height} role="group" onClick={click} aria-label="The site, with the routes that are placed upon it">
          {plan && <image href="/api/site/plan" x={corner.x} y={corner.y} width={plan.width * perMetre} height={plan.height * perMetre} />}
          {[...placements].map(([id, placement]) => (
            <PlacedRoute key={id} route={known.get(id)!} robots={robots.filter((robot) => robot.route_id === id)}
              placement={chosen?.route === id && draft ? draft : placement} toScreen={toScreen} chosen={chosen?.route === id}
              pin={pinOn(known.get(id)!)} onBox={onBox} onShape={onShape} />
          ))}
          {chosen && draft && !placements.has(chosen.route) && (
            <PlacedRoute route={chosen} robots={robots.filter((robot) => robot.route_id === chosen.route)}
              placement={draft} toScreen={toScreen} chosen pin={null} onBox={onBox} onShape={onShape} />
          )}
          {chosen && at && mayPlace && <Handles placement={at} toScreen={toScreen} toSite={toSite} onChange={edit} />}
        </svg>
      </div>
      <p className="note">
        <svg width={bar_m * perMetre + 4} height="12" aria-hidden="true"><path className="bar" d={`M2 2v6h${bar_m * perMetre}v-6`} /></svg>{' '}
        {bar_m} m. Routes lie where somebody has put them, or where their scouts said that they begin; between them, it is as good as that.
      </p>
      {chosen && mayPlace && (
        <section className="placing" aria-label={`Place of ${chosen.name}`}>
          {!at && <button onClick={() => edit(middle)}>Place {chosen.name}</button>}
          {at && (
            <>
              <p className="note">Drag its beginning, and the tip of its arrow to turn it; or use the keys, or numbers.</p>
              <Numbers placement={at} onChange={edit} />
              <div className="orders">
                <button disabled={!draft} onClick={() => keep(draft)}>Save</button>
                <button disabled={!draft} onClick={() => setDraft(null)}>Undo</button>
                {site.placements[chosen.route] && <button onClick={() => keep(null)}>Remove</button>}
              </div>
            </>
          )}
        </section>
      )}
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>
        {answer && (answer.ok ? '' : '⚠ ') + answer.text}
      </p>
    </>
  );
}
