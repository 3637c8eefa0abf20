import { useEffect, useId, useState } from 'react';
import { get, type RoutePage } from '../api';
import { PhotoFields } from '../photos/fields';
import { bodyOf, noPhotos, type PhotosBody } from '../photos/asked';

// What moves a robot takes a whole slide, or as many presses of an arrow key: a tap on the far end
// does not do.
const kWholeWay = 100;
const kFurthestAtOnce = 45;

export function Slide({ label, onDone }: { label: string; onDone: () => void }) {
  const [at, setAt] = useState(0);
  const [from, setFrom] = useState(0);
  const move = (to: number) => {
    if (to - from > kFurthestAtOnce) return setAt(0);
    setFrom(to);
    setAt(to);
    if (to < kWholeWay) return;
    setFrom(0);
    setAt(0);
    onDone();
  };
  const letGo = () => {
    setFrom(0);
    setAt(0);
  };
  return (
    <label className="slide">
      <span>{label}</span>
      <input
        type="range" min={0} max={kWholeWay} step={10} value={at} aria-label={`${label}: slide, or press the right arrow key ten times`}
        onChange={(event) => move(Number(event.target.value))}
        onPointerUp={letGo} onPointerCancel={letGo} onBlur={letGo}
      />
    </label>
  );
}

// Times the taught speed.
export function SpeedChoice({ id, speed, onChange }: { id?: string; speed: string; onChange: (speed: string) => void }) {
  return (
    <select id={id} value={speed} onChange={(event) => onChange(event.target.value)}>
      <option value="1">as taught</option>
      <option value="0.75">three quarters</option>
      <option value="0.5">half</option>
      <option value="0.25">a quarter</option>
    </select>
  );
}

export function Send({ who, onGo }: { who: string; onGo: (orders: string, photos: PhotosBody) => void }) {
  const [prefix, setPrefix] = useState('');
  const [found, setFound] = useState<{ of: string; page: RoutePage | string } | null>(null);
  const [chosen, setChosen] = useState('');
  const [laps, setLaps] = useState(1);
  const [speed, setSpeed] = useState('1');
  const [photos, setPhotos] = useState(noPhotos);
  const id = useId();
  useEffect(() => {
    let still = true;
    const timer = window.setTimeout(async () => {
      const page = await get<RoutePage>('/api/routes', { prefix, state: 'active', sort: 'name', limit: '50' });
      if (still) setFound({ of: prefix, page });
    }, prefix ? 250 : 0);
    return () => {
      still = false;
      window.clearTimeout(timer);
    };
  }, [prefix]);
  if (found === null) return <p className="note">Loading routes …</p>;
  const { of, page } = found;
  const why = of !== prefix ? 'Loading …' : typeof page === 'string' ? `⚠ ${page}` : '';
  const routes = typeof page === 'string' ? [] : page.routes;
  const total = typeof page === 'string' ? 0 : page.total;
  const route = routes.find((each) => each.route === chosen) ?? routes[0];
  if (!route && !prefix) return <p className="note">{why || 'No route is known: teach one.'}</p>;
  const sameName = route && routes.filter((each) => each.name === route.name).length > 1;
  const name = route && (sameName ? route.route : route.name);
  const orders = `follow ${name}` + (laps > 1 ? ` laps ${laps}` : '') + (speed !== '1' ? ` speed ${speed}` : '');
  return (
    <div className="send">
      {(prefix || total > routes.length) && (
        <label className="search">Name begins with
          <input type="search" value={prefix} autoComplete="off" onChange={(event) => setPrefix(event.target.value)} />
          <span className="note">{total > routes.length ? `${routes.length} of ${total} routes are listed` : ''}</span>
        </label>
      )}
      {!route && <p className="note">{why || 'No route’s name begins so.'}</p>}
      {route && (
        <>
          <div className="fields">
            <label htmlFor={`${id}r`}>Route
              <select id={`${id}r`} value={route.route} onChange={(event) => setChosen(event.target.value)}>
                {routes.map((each) => (
                  <option key={each.route} value={each.route}>
                    {each.name}{each.length_m > 0 ? `, ${each.length_m.toFixed(1)} m` : ''}
                  </option>
                ))}
              </select>
            </label>
            <label htmlFor={`${id}l`}>Laps
              <input id={`${id}l`} type="number" min={1} max={100} value={laps}
                onChange={(event) => setLaps(Math.min(100, Math.max(1, Number(event.target.value) || 1)))} />
            </label>
            <label htmlFor={`${id}s`}>Speed
              <SpeedChoice id={`${id}s`} speed={speed} onChange={setSpeed} />
            </label>
          </div>
          <div className="fields">
            <PhotoFields asked={photos} onChange={setPhotos} />
          </div>
          {laps > 1 && <p className="note">Several laps need a route whose end is its beginning.</p>}
          <Slide label={`Slide to send ${who} along ${route.name}`} onDone={() => onGo(orders, bodyOf(photos))} />
        </>
      )}
    </div>
  );
}
