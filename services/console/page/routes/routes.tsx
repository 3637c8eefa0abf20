import { memo, useEffect, useRef, useState, type ChangeEvent, type FormEvent } from 'react';
import { get, type FoundRoute, type RoutePage } from '../api';
import { ChangesSince, sinceOf } from './changes';
import { Finder } from './finder';
import { age, when } from '../fleet';
import { Revisions } from './revisions';

type Search = Record<string, string>;

const kTyped_ms = 250;
// Of what is listed page after page the last ones are shown.
const kMostRows = 500;

function Filters({ onSearch }: { onSearch: (search: Search) => void }) {
  const soon = useRef<number>();
  useEffect(() => () => window.clearTimeout(soon.current), []);
  // What cannot be half a word is searched for as it is typed.
  const changes = ({ target: { form } }: ChangeEvent<HTMLInputElement | HTMLSelectElement>) => {
    window.clearTimeout(soon.current);
    soon.current = window.setTimeout(() => form?.requestSubmit(), kTyped_ms);
  };
  const submit = (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    window.clearTimeout(soon.current);
    const search: Search = {};
    for (const [name, value] of new FormData(event.currentTarget)) search[name] = String(value).trim();
    const { place, frame, ...rest } = search;
    onSearch(place ? { ...rest, [frame]: place.replace(/\s/g, '') } : { ...rest, within_m: '' });
  };
  return (
    <form className="filters" role="search" onSubmit={submit}>
      <label>Name begins with<input name="prefix" type="search" autoComplete="off" onChange={changes} /></label>
      <label>Tag<input name="tag" autoComplete="off" /></label>
      <label>State
        <select name="state" defaultValue="" onChange={changes}>
          <option value="">any</option>
          <option>active</option><option>staged</option><option>retired</option><option>teaching</option>
        </select>
      </label>
      <label>Sort
        <select name="sort" defaultValue="newest" onChange={changes}>
          <option>newest</option><option>oldest</option><option>name</option><option>longest</option><option>shortest</option>
        </select>
      </label>
      <button type="submit">Search</button>
      <details>
        <summary>More</summary>
        <div className="more">
          <label>Taught by<input name="scout" autoComplete="off" /></label>
          <label>Camera begins with<input name="camera" autoComplete="off" /></label>
          <label>Begins near
            <select name="frame" defaultValue="near_gps">
              <option value="near_gps">latitude,longitude</option>
              <option value="near_site">x,y on the site, m</option>
            </select>
          </label>
          <label>Place<input name="place" placeholder="48.137,11.575" autoComplete="off" /></label>
          <label>Within, m<input name="within_m" type="number" min={1} defaultValue={50} /></label>
        </div>
      </details>
    </form>
  );
}

const Line = memo(function Line({ route, now_ms }: { route: FoundRoute; now_ms: number }) {
  return (
    <tr className={route.state.replace(/ /g, '-')}>
      <td data-label="Route"><a href={`#routes/${route.route}`}>{route.name}</a></td>
      <td data-label="Revision">{route.revision || '–'}</td>
      <td data-label="State"><strong>{route.state}</strong></td>
      <td data-label="Length">{route.length_m > 0 ? `${route.length_m.toFixed(1)} m` : '–'}</td>
      <td data-label="Taught" title={when(route.taught_unix_ms)}>
        {age(now_ms - route.taught_unix_ms)} ago by {route.scout}
      </td>
      <td data-label="Tags">{route.tags.join(', ')}</td>
      <td data-label="Description">{route.description}</td>
    </tr>
  );
});

function Listing({ now_ms }: { now_ms: number }) {
  const [search, setSearch] = useState<Search>({});
  const [{ routes, listed }, setRoutes] = useState<{ routes: FoundRoute[]; listed: number }>({ routes: [], listed: 0 });
  const [page, setPage] = useState<RoutePage | string | null>(null);
  const [cursor, setCursor] = useState('');
  useEffect(() => {
    let still = true;
    get<RoutePage>('/api/routes', { ...search, cursor }).then((reply) => {
      if (!still) return;
      setPage(reply);
      const found = typeof reply === 'string' ? [] : reply.routes;
      setRoutes((had) => (cursor
        ? { routes: [...had.routes, ...found].slice(-kMostRows), listed: had.listed + found.length }
        : { routes: found, listed: found.length }));
    });
    return () => { still = false; };
  }, [search, cursor]);
  const start = (wanted: Search) => {
    setPage(null);
    setCursor('');
    setSearch(wanted);
  };
  const told = typeof page === 'string' ? `⚠ ${page}`
    : page === null ? 'Loading …'
    : page.total === 0 ? 'No routes match.'
    : `${listed > routes.length ? `${listed - routes.length + 1} to ` : ''}${listed} of ${page.total}`;
  return (
    <>
      <Filters onSearch={start} />
      <p role="status" className={typeof page === 'string' ? 'answer bad' : 'note'}>{told}</p>
      {routes.length > 0 && (
        <table>
          <thead>
            <tr><th>Route</th><th>Revision</th><th>State</th><th>Length</th><th>Taught</th><th>Tags</th><th>Description</th></tr>
          </thead>
          <tbody>{routes.map((each) => <Line key={each.route + each.teaching} route={each} now_ms={now_ms} />)}</tbody>
        </table>
      )}
      {page !== null && typeof page !== 'string' && page.next && (
        <button onClick={() => setCursor(page.next)}>More</button>
      )}
    </>
  );
}

// What happens to robots meanwhile is nothing to it: drawn anew as often as `now_ms` is another.
export const Routes = memo(function Routes({ open, now_ms }: { open: string; now_ms: number }) {
  const since = sinceOf(open);
  if (open && since === null) return <section aria-label="Routes" className="routes"><Revisions key={open} route={open} /></section>;
  return (
    <section aria-label="Routes" className="routes">
      <h2>Routes</h2>
      <nav className="kinds" aria-label="Of what">
        <a href="#routes" aria-current={since === null ? 'page' : undefined}>All routes</a>
        <a href="#routes/since=7d" aria-current={since !== null ? 'page' : undefined}>Activity log</a>
      </nav>
      {since === null ? <><Finder /><Listing now_ms={now_ms} /></> : <ChangesSince key={since} since={since} />}
    </section>
  );
});
