import { useCallback, useEffect, useRef, useState, type ReactNode } from 'react';
import { editRoute, get, type Answer, type FoundRoute, type RoutePage, type RouteAction } from '../api';
import { ChangedLately } from './changes';
import { age, when } from '../fleet';
import { Ground } from '../map/ground';
import { useMay } from '../me';
import { Passing } from '../network/passing';
import { Slide } from '../robot/send';
import { Labels } from './labels';
import { Download } from './transfers';

type Asked = { action: Asking; revision: number; what: string };

const has = (text: ReactNode) => text || '–';

function placeOf({ place }: FoundRoute): string {
  if (!place) return '';
  return 'latitude' in place ? `${place.latitude}, ${place.longitude}` : `${place.site_x_m}, ${place.site_y_m} m on the site`;
}

// What a revision is, a line each.
const lines: [string, (route: FoundRoute) => ReactNode][] = [
  ['State', (route) => <strong>{route.state}</strong>],
  ['Taught', (route) => <span title={when(route.taught_unix_ms)}>{age(Date.now() - route.taught_unix_ms)} ago</span>],
  ['Taught by', (route) => route.scout],
  ['Camera', (route) => has(route.camera)],
  ['Length', (route) => (route.length_m > 0 ? `${route.length_m.toFixed(1)} m` : '–')],
  ['Segments', (route) => (
    <>{route.segments}{route.segments_lost > 0 && <strong className="lost"> ⚠ {route.segments_lost} lost at the server</strong>}</>
  )],
  ['Size', (route) => `${(route.bytes / 1000).toFixed(0)} kB`],
  ['Tags', (route) => has(route.tags.join(', '))],
  ['Begins at', (route) => has(placeOf(route))],
  ['Description', (route) => has(route.description)],
  ['Stored on', (route) => has(route.held_by.join(', '))],
];

function Confirm({ asked, name, onDone, onLeave }: {
  asked: Asked;
  name: string;
  onDone: () => void;
  onLeave: () => void;
}) {
  const here = useRef<HTMLDivElement>(null);
  // The button that asks for it may be far below.
  useEffect(() => {
    here.current?.scrollIntoView({ block: 'center' });
  }, []);
  return (
    <div className="send" ref={here}>
      <p>{asked.what}</p>
      <Slide label={`Slide to ${words[asked.action].toLowerCase()} ${name}${asked.revision ? ` revision ${asked.revision}` : ''}`} onDone={onDone} />
      <button onClick={onLeave}>Cancel</button>
    </div>
  );
}

type Asking = Extract<RouteAction, 'activate' | 'rollback' | 'retire' | 'delete'>;
const words: Record<Asking, string> = {
  activate: 'Activate', rollback: 'Roll back', retire: 'Retire', delete: 'Delete',
};

// A complete revision before the active one, to go back to.
const hasBefore = (revisions: FoundRoute[]) => {
  const active = revisions.find((each) => each.state === 'active');
  return active !== undefined && revisions.some((each) => each.revision < active.revision && ['staged', 'retired'].includes(each.state));
};

const willFollow = (route: FoundRoute) => (route.state === 'cut off'
  ? 'Its teaching was discarded or cut off, so it ends somewhere on the way. Robots will follow it all the same from now on.'
  : 'Robots will follow this revision from now on.');

export function Revisions({ route }: { route: string }) {
  const [page, setPage] = useState<RoutePage | string | null>(null);
  const [asked, setAsked] = useState<Asked | null>(null);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [ground, setGround] = useState(false);
  const [labels, setLabels] = useState(false);
  const mayAdminister = useMay('administer');
  const look = useCallback(async () => {
    setPage(await get<RoutePage>('/api/routes', { name: route, sort: 'newest', limit: '200' }));
  }, [route]);
  useEffect(() => void look(), [look]);
  const back = <p><a href="#routes">All routes</a></p>;
  if (page === null) return <>{back}<p className="note">Loading …</p></>;
  if (typeof page === 'string') return <>{back}<p className="answer bad" role="status">⚠ {page}</p></>;
  const revisions = page.routes;
  if (revisions.length === 0) return <>{back}<p className="note">No server has this route.</p></>;
  const name = revisions[0].name;
  const carryOut = async ({ action, revision }: Asked) => {
    setAsked(null);
    setAnswer({ ok: true, text: `Sending ${words[action]} …` });
    setAnswer(await editRoute(route, action, { revision }));
    await look();
  };
  return (
    <>
      {back}
      <header className="routehead">
        <h2>{name}</h2>
        {mayAdminister && <button aria-expanded={labels} onClick={() => setLabels(!labels)}>Rename, tag, describe …</button>}
        {mayAdminister && hasBefore(revisions) && (
          <button onClick={() => setAsked({ action: 'rollback', revision: 0, what: 'Robots will follow the revision before the active one.' })}>
            Roll back …
          </button>
        )}
      </header>
      {labels && mayAdminister && (
        <Labels key={`${name} ${revisions[0].tags.join()} ${revisions[0].description}`} of={revisions[0]} onAnswer={async (said) => {
          setAnswer(said);
          await look();
        }} />
      )}
      {asked && <Confirm key={asked.action + asked.revision} asked={asked} name={name} onDone={() => carryOut(asked)} onLeave={() => setAsked(null)} />}
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>{answer && (answer.ok ? '' : '⚠ ') + answer.text}</p>
      <div className="wide" tabIndex={0} role="region" aria-label={`Revisions of ${name}`}>
        <table className="sides">
          <thead>
            <tr>
              <th scope="col">Revision</th>
              {revisions.map((each) => <th key={each.teaching} scope="col">{each.revision || 'not numbered yet'}</th>)}
            </tr>
          </thead>
          <tbody>
            {lines.map(([label, show]) => (
              <tr key={label}>
                <th scope="row">{label}</th>
                {revisions.map((each) => <td key={each.teaching} className={each.state === 'active' ? 'active' : ''}>{show(each)}</td>)}
              </tr>
            ))}
            <tr>
              <th scope="row">
                Ground{' '}
                {!ground && <button onClick={() => setGround(true)}>Show</button>}
              </th>
              {revisions.map((each) => (
                <td key={each.teaching} className={each.state === 'active' ? 'active' : ''}>{ground && <Ground route={each} />}</td>
              ))}
            </tr>
            <tr>
              <th scope="row">Actions</th>
              {revisions.map((each) => (
                <td key={each.teaching}>
                  <div className="orders">
                    {mayAdminister && each.state !== 'active' && each.state !== 'teaching' && (
                      <button onClick={() => setAsked({ action: 'activate', revision: each.revision, what: willFollow(each) })}>
                        Activate …
                      </button>
                    )}
                    {mayAdminister && each.state !== 'retired' && each.state !== 'teaching' && (
                      <button onClick={() => setAsked({ action: 'retire', revision: each.revision, what: 'It is kept, and offered to no robot.' })}>
                        Retire …
                      </button>
                    )}
                    {mayAdminister && each.state !== 'active' && each.state !== 'teaching' && each.revision > 0 && (
                      <button onClick={() => setAsked({ action: 'delete', revision: each.revision, what: 'It is deleted for good, and no robot follows it any more.' })}>
                        Delete …
                      </button>
                    )}
                    {each.state !== 'teaching' && <Download route={each} />}
                  </div>
                </td>
              ))}
            </tr>
          </tbody>
        </table>
      </div>
      <Passing name={name} id={revisions[0].route} again={page} />
      <ChangedLately route={[name, revisions[0].route]} again={page} />
    </>
  );
}
