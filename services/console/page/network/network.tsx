import { useCallback, useEffect, useMemo, useState } from 'react';
import { editNetwork, type Answer, type NetworkPart, type Place, type Robot, type Route, type Way } from '../api';
import { useMay } from '../me';
import { Charging } from './charging';
import { ChangeStretch, JoinPlaces, NamePlace, noDraft, type Draft } from './network-changes';
import { layOut, metres, standsHow, textOf, withRobots } from './network-layout';
import { NetworkMap, type Overlay } from './network-map';
import { SendThere, type Shown } from './network-send';
import { NetworkTable } from './network-table';
import { FindWay } from './network-way';
import { useNetwork, type Query } from './use-network';

const kTyped_ms = 300;
const kLimits = ['60', '200', '500'];
const kMostStrays = 20;

function Search({ query, onQuery }: { query: Query; onQuery: (query: Query) => void }) {
  const [typed, setTyped] = useState(query.search);
  useEffect(() => {
    if (typed.trim() === query.search) return;
    const timer = window.setTimeout(() => onQuery({ ...query, search: typed.trim(), around: '' }), kTyped_ms);
    return () => window.clearTimeout(timer);
  }, [typed]);
  return (
    <form className="filters" role="search" onSubmit={(event) => event.preventDefault()}>
      <label>Routes and places with
        <input type="search" value={typed} maxLength={64} autoComplete="off" onChange={(event) => setTyped(event.target.value)} />
      </label>
      <label>At most
        <select value={query.limit} onChange={(event) => onQuery({ ...query, limit: event.target.value })}>
          {kLimits.map((limit) => <option key={limit}>{limit}</option>)}
        </select>
      </label>
      {query.around && <button type="button" onClick={() => onQuery({ ...query, around: '' })}>Not around {query.around} alone</button>}
    </form>
  );
}

const many = (count: number, what: string) => `${count} ${what}${count === 1 ? '' : 's'}`;

function counted(part: NetworkPart, query: Query): string {
  const shown = part.network.routes.length;
  const whole = part.whole ? '' : ' The server has more than this console takes.';
  const left = part.left_out > 0 ? ` ${part.left_out} junctions, restrictions or names are left out.` : '';
  if (part.routes === 0) return `No routes are joined, none has a closed part or a named place.${whole}`;
  if (shown === part.routes) return `${many(shown, 'route')}, ${many(part.joints, 'junction')}.${left}${whole}`;
  const of = query.around ? `${part.matched} that ${query.around} leads to or is reached from`
    : query.search ? `${part.matched} with “${query.search}”` : `${part.routes}`;
  return `${shown} of ${of} are shown; the network has ${many(part.routes, 'route')} and ${many(part.joints, 'junction')}.${left}${whole}`;
}

const modes = { send: 'Send a robot', way: 'Find a path', stretch: 'Close, open, limit', name: 'Name a place', join: 'Join' };
type Mode = keyof typeof modes;

// What a click on a route fills in.
function clicked(mode: Mode, draft: Draft, place: Place): Draft {
  const words = textOf(place);
  if (mode === 'name') return { ...draft, place: words };
  if (mode === 'join' || mode === 'way') return draft.first && !draft.second ? { ...draft, second: words } : { ...draft, first: words, second: '' };
  const at = metres(place.along_m);
  if (draft.route !== place.route || !draft.from || draft.to) return { ...draft, route: place.route, from: at, to: '' };
  return Number(at) < Number(draft.from) ? { ...draft, from: at, to: draft.from } : { ...draft, to: at };
}

const done = (now: string[], words: string) => {
  if (now.length === 0) return 'Done: nothing is closed or limited there now.';
  return `${/^(part|forget|refuse) /.test(words) ? 'No more' : 'Now'}: ${now.join('; ')}`;
};

export function NetworkPage({ robots, live }: { robots: Robot[]; live: Route[] }) {
  const [query, setQuery] = useState<Query>({ search: '', around: '', limit: kLimits[0] });
  const { part, why, again } = useNetwork(query);
  const [chosen, setChosen] = useState('');
  const [wanted, setMode] = useState<Mode>('send');
  const [draft, setDraft] = useState<Draft>(noDraft);
  const [to, setTo] = useState('');
  const [shown, setShown] = useState<Shown | null>(null);
  const [way, setWay] = useState<Way | null>(null);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const mayOperate = useMay('operate');
  const mode = mayOperate ? wanted : 'way';
  const still = useMemo(() => part && layOut(part, live), [part, live]);
  const layout = useMemo(() => still && withRobots(still, robots, live), [still, robots, live]);

  const onPlace = (place: Place) => {
    setChosen(place.route);
    setAnswer(null);
    if (mode === 'send') setTo(textOf(place));
    else setDraft(clicked(mode, draft, place));
  };
  const edit = useCallback(async (words: string) => {
    setAnswer({ ok: true, text: 'Sending …' });
    const { ok, now, why } = await editNetwork(words);
    setAnswer({ ok, text: ok ? done(now, words) : why });
    if (ok) setDraft(noDraft);
    again();
  }, [again]);
  const around = useCallback((route: string) => {
    setChosen(route);
    setQuery(({ limit }) => ({ search: '', around: route, limit }));
  }, []);
  const drawn = mode === 'send' ? shown?.way : mode === 'way' ? way : null;
  const placeOf = (words: string) => {
    const named = part?.network.names.find((each) => each.name === words.trim())?.place;
    return named ? textOf(named) : words.trim();
  };
  const overlay: Overlay = {
    way: drawn?.way.stretches ?? [],
    stretch: mode === 'stretch' && draft.route && draft.to
      ? { route: draft.route, from_m: Number(draft.from) || 0, to_m: Number(draft.to) } : null,
    pins: mode === 'send' ? [placeOf(to)]
      : mode === 'name' ? [draft.place.trim()]
      : mode === 'join' || mode === 'way' ? [placeOf(draft.first), placeOf(draft.second)]
      : draft.from && !draft.to ? [`${draft.route}@${draft.from}`] : [],
  };
  const names = part?.network.names.map((each) => each.name) ?? [];
  const rows = layout?.rows ?? [];
  const routes = rows.map((row) => row.name);
  const edits = { draft, onDraft: setDraft, onEdit: edit, routes };
  return (
    <section className="network" aria-label="Network">
      <Search key={query.around} query={query} onQuery={setQuery} />
      <p role="status" className={why ? 'answer bad' : 'note'}>
        {why ? `⚠ ${why}${part ? ' What is drawn is from before.' : ''}` : part ? counted(part, query) : 'Loading the network …'}
      </p>
      {layout && rows.length > 0 && (
        <NetworkMap layout={layout} still={still!.rows} chosen={chosen} onChoose={setChosen} onPlace={onPlace} overlay={overlay} />
      )}
      {layout && layout.strays.length > 0 && (
        <p className="note">
          On routes that are not shown, or on another revision than is followed:{' '}
          {layout.strays.slice(0, kMostStrays).map((robot, i) => (
            <span key={robot.name}>
              {i > 0 && ', '}<a href={`#fleet/${robot.name}`}>{robot.name}</a> {standsHow(robot)} of {robot.route}
            </span>
          ))}
          {layout.strays.length > kMostStrays && ` and ${layout.strays.length - kMostStrays} more`}
        </p>
      )}
      <section className="net-change" aria-label={mayOperate ? 'Change the network' : modes.way}>
        {mayOperate && (
          <div className="layers" role="radiogroup" aria-label="What a click on a route is for">
            {(Object.keys(modes) as Mode[]).map((each) => (
              <label key={each}>
                <input type="radio" name="net-mode" checked={mode === each} onChange={() => { setMode(each); setAnswer(null); }} />
                {modes[each]}
              </label>
            ))}
          </div>
        )}
        {mode === 'send' && (
          <SendThere robots={robots} to={to} onTo={setTo} names={names} shown={shown} onShown={setShown} onAnswer={setAnswer} />
        )}
        {mode === 'way' && (
          <FindWay draft={draft} onDraft={setDraft} names={names} way={way} onWay={setWay} onAnswer={setAnswer} />
        )}
        {mode === 'stretch' && <ChangeStretch {...edits} />}
        {mode === 'name' && <NamePlace {...edits} />}
        {mode === 'join' && <JoinPlaces {...edits} />}
        <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>
          {answer && (answer.ok ? '' : '⚠ ') + answer.text}
        </p>
      </section>
      {part && <Charging network={part.network} onEdit={mayOperate ? edit : null} />}
      {rows.length > 0 && (
        <NetworkTable rows={rows} chosen={chosen} onChoose={setChosen} onAround={around} onEdit={mayOperate ? edit : null} />
      )}
    </section>
  );
}
