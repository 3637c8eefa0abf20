import { useEffect, useState } from 'react';
import { get, type RoutePage } from '../api';
import { SpeedChoice } from '../robot/send';

export type Draft = {
  route: string; from: string; to: string;  // of a stretch
  name: string; place: string;
  first: string; second: string;  // of a joint, or a way
};
export const noDraft: Draft = { route: '', from: '', to: '', name: '', place: '', first: '', second: '' };

type Edits = { draft: Draft; onDraft: (draft: Draft) => void; onEdit: (words: string) => void };

// Routes that are drawn, and others that begin as what is typed.
function useRouteNames(drawn: string[], typed: string): string[] {
  const [found, setFound] = useState<string[]>([]);
  const prefix = typed.split('@')[0].trim();
  useEffect(() => {
    let over = false;
    const timer = window.setTimeout(async () => {
      const page = await get<RoutePage>('/api/routes', { prefix, state: 'active', sort: 'name', limit: '20' });
      if (!over && typeof page !== 'string') setFound(page.routes.map((each) => each.name));
    }, 300);
    return () => {
      over = true;
      window.clearTimeout(timer);
    };
  }, [prefix]);
  return [...new Set([...found, ...drawn])].slice(0, 100);
}

export function Field({ label, value, list, onChange }: {
  label: string; value: string; list?: string; onChange: (value: string) => void;
}) {
  return (
    <label>{label}
      <input type="text" value={value} list={list} maxLength={128} autoComplete="off" autoCapitalize="none" spellCheck={false}
        onChange={(event) => onChange(event.target.value)} />
    </label>
  );
}

function Metres({ label, value, onChange }: { label: string; value: string; onChange: (value: string) => void }) {
  return (
    <label>{label}
      <input type="number" min={0} step="any" value={value} onChange={(event) => onChange(event.target.value)} />
    </label>
  );
}

export function ChangeStretch({ draft, onDraft, onEdit, routes }: Edits & { routes: string[] }) {
  const [speed, setSpeed] = useState('0.5');
  const names = useRouteNames(routes, draft.route);
  const range = draft.from || draft.to ? ` ${draft.from}..${draft.to}` : '';
  const stretch = `${draft.route.trim()}${range}`;
  const lacks = !draft.route.trim();
  return (
    <>
      <p className="note">Click where it begins and where it ends, or say it; without metres it is the whole route.</p>
      <div className="net-fields">
        <Field label="Route" list="net-routes" value={draft.route} onChange={(route) => onDraft({ ...draft, route })} />
        <datalist id="net-routes">{names.map((name) => <option key={name} value={name} />)}</datalist>
        <Metres label="From, m" value={draft.from} onChange={(from) => onDraft({ ...draft, from })} />
        <Metres label="To, m" value={draft.to} onChange={(to) => onDraft({ ...draft, to })} />
        <button disabled={lacks} onClick={() => onEdit(`close ${stretch}`)}>Close</button>
        <button disabled={lacks} onClick={() => onEdit(`open ${stretch}`)}>Open</button>
        <label>Speed
          <SpeedChoice speed={speed} onChange={setSpeed} />
        </label>
        <button disabled={lacks} onClick={() => onEdit(`limit ${stretch} speed ${speed}`)}>Limit</button>
      </div>
    </>
  );
}

export function NamePlace({ draft, onDraft, onEdit, routes }: Edits & { routes: string[] }) {
  const names = useRouteNames(routes, draft.place);
  const [home, setHome] = useState(false);
  const [dock, setDock] = useState(false);
  const [name, place] = [draft.name.trim(), draft.place.trim()];
  const kinds = (home ? ' home' : '') + (dock ? ' dock' : '');
  return (
    <div className="net-fields">
      <Field label="Place (click there, or ROUTE@METRES)" list="net-starts" value={draft.place} onChange={(value) => onDraft({ ...draft, place: value })} />
      <datalist id="net-starts">{names.map((each) => <option key={each} value={`${each}@`} />)}</datalist>
      <Field label="Is called" value={draft.name} onChange={(value) => onDraft({ ...draft, name: value })} />
      <label className="net-check" title="Robots that are sent home go to the nearest"><input type="checkbox" checked={home} onChange={(event) => setHome(event.target.checked)} />a home</label>
      <label className="net-check" title="Robots charge there, one at a time"><input type="checkbox" checked={dock} onChange={(event) => setDock(event.target.checked)} />a dock</label>
      <button disabled={!name || !place} onClick={() => onEdit(`name ${name} ${place}${kinds}`)}>Name it</button>
      <button disabled={!name} onClick={() => onEdit(`forget ${name}`)}>Forget the name</button>
    </div>
  );
}

export function JoinPlaces({ draft, onDraft, onEdit, routes }: Edits & { routes: string[] }) {
  const [both, setBoth] = useState(false);
  const names = useRouteNames(routes, draft.second || draft.first);
  const [first, second] = [draft.first.trim(), draft.second.trim()];
  return (
    <>
      <p className="note">
        Two places that are one and the same, where both routes look the same way: robots may change over from the first
        to the second. A route that ends where it begins is a ring: join its end to its beginning.
      </p>
      <div className="net-fields">
        <Field label="From (click there, or ROUTE@METRES)" list="net-starts" value={draft.first} onChange={(value) => onDraft({ ...draft, first: value })} />
        <Field label="To" list="net-starts" value={draft.second} onChange={(value) => onDraft({ ...draft, second: value })} />
        <datalist id="net-starts">{names.map((each) => <option key={each} value={`${each}@`} />)}</datalist>
        <label className="net-check"><input type="checkbox" checked={both} onChange={(event) => setBoth(event.target.checked)} />and back</label>
        <button disabled={!first || !second} onClick={() => onEdit(`join ${first} ${second}${both ? ' both' : ''}`)}>Join</button>
        <button disabled={!first || !second} onClick={() => onEdit(`part ${first} ${second}`)}>Remove</button>
      </div>
    </>
  );
}
