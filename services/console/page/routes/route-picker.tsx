import { useEffect, useState } from 'react';
import { get, type Route } from '../api';

// Choose among the routes that robots are on, and those that a search finds.
export function RoutePicker({ label, live, chosen, onChoose }: {
  label: string;
  live: Route[];
  chosen: Route | null;
  onChoose: (route: Route) => void;
}) {
  const [found, setFound] = useState<Route[]>([]);
  const [why, setWhy] = useState('');
  const [prefix, setPrefix] = useState('');
  useEffect(() => {
    let over = false;
    const timer = window.setTimeout(async () => {
      const page = await get<{ routes: Route[] }>('/api/routes', { prefix, state: 'active', sort: 'name', limit: '30' });
      if (over) return;
      setWhy(typeof page === 'string' ? page : '');
      if (typeof page !== 'string') setFound(page.routes);
    }, prefix ? 300 : 0);
    return () => {
      over = true;
      window.clearTimeout(timer);
    };
  }, [prefix]);
  const listed = new Map([...(chosen ? [chosen] : []), ...live, ...found].map((route) => [route.route, route]));
  return (
    <>
      <label>{label}
        <select value={chosen?.route ?? ''} onChange={(event) => {
          const route = listed.get(event.target.value);
          if (route) onChoose(route);
        }}>
          {!chosen && <option value="">choose …</option>}
          {[...listed.values()].map((each) => (
            <option key={each.route} value={each.route}>{each.name}{each.length_m > 0 ? `, ${each.length_m.toFixed(1)} m` : ''}</option>
          ))}
        </select>
      </label>
      <label>Find others by the beginning of a name
        <input type="search" value={prefix} maxLength={64} autoComplete="off" onChange={(event) => setPrefix(event.target.value.trim())} />
      </label>
      {why && <p className="answer bad" role="status">⚠ Other routes are not listed: {why}</p>}
    </>
  );
}
