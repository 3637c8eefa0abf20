import { Fragment, useEffect, useState, type FormEvent } from 'react';
import { get, type Changes } from '../api';
import { when } from '../fleet';

// As `trailcast routes --since` has them.
const moments = { today: 'Today', yesterday: 'Yesterday', monday: 'Monday', '7d': '7 days', '30d': '30 days' };
const kStep = 100;
const kMost = 5000;
const kLately = '30d';
const kLatelyShown = 10;

const many = (count: number) => `${count} change${count === 1 ? '' : 's'}`;
const at = when;
const addressOf = (since: string) => `#routes/since=${encodeURIComponent(since)}`;

// Since when what is open on the page of routes tells what was changed; null: it is something else.
export function sinceOf(open: string): string | null {
  if (!open.startsWith('since=')) return null;
  try {
    return decodeURIComponent(open.slice('since='.length)) || kLately;
  } catch {
    return kLately;
  }
}

// `again`: whatever may have changed what is told.
function useChanges(parameters: { since: string; route: string[]; limit: string }, again: unknown): Changes | string | null {
  const [changes, setChanges] = useState<Changes | string | null>(null);
  useEffect(() => {
    let still = true;
    get<Changes>('/api/changes', parameters).then((reply) => still && setChanges(reply));
    return () => { still = false; };
  }, [parameters.since, parameters.route.join(' '), parameters.limit, again]);
  return changes;
}

function beforeThat({ since_unix_ms, history }: Changes): string {
  return history.kept_since_unix_ms > since_unix_ms
    ? ` The server keeps it since ${at(history.kept_since_unix_ms)}: what was changed before is not known.` : '';
}

function Since({ since }: { since: string }) {
  const submit = (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    const wanted = String(new FormData(event.currentTarget).get('since')).trim();
    if (wanted) window.location.hash = addressOf(wanted);
  };
  return (
    <>
      <nav className="kinds" aria-label="Since when">
        {Object.entries(moments).map(([word, label]) => (
          <a key={word} href={addressOf(word)} aria-current={word === since ? 'page' : undefined}>{label}</a>
        ))}
      </nav>
      <form className="filters" onSubmit={submit}>
        <label>Since another time
          <input key={since} name="since" defaultValue={since in moments ? '' : since} placeholder="09:15, 2026-11-23, 12h, 2d" maxLength={64} autoComplete="off" autoCapitalize="none" />
        </label>
        <button type="submit">Show</button>
      </form>
    </>
  );
}

// What was changed of routes and of how they are joined, by whom, the newest first.
export function ChangesSince({ since }: { since: string }) {
  const [limit, setLimit] = useState(kStep);
  const changes = useChanges({ since, route: [], limit: String(limit) }, null);
  const isError = typeof changes === 'string';
  const list = changes && !isError ? changes.history.changes : [];
  const total = changes && !isError ? changes.history.total : 0;
  const told = changes === null ? 'Loading …'
    : isError ? `⚠ ${changes}`
    : `${total === 0 ? 'Nothing was changed' : list.length < total ? `The last ${list.length} of ${total} changes` : many(total)} since ${at(changes.since_unix_ms)}.${beforeThat(changes)}`;
  return (
    <>
      <Since since={since} />
      <p role="status" className={isError ? 'answer bad' : 'note'}>{told}</p>
      {list.length > 0 && (
        <table>
          <thead><tr><th>When</th><th>Operator</th><th>Route</th><th>Change</th></tr></thead>
          <tbody>
            {list.map((each, i) => (
              <tr key={total - i}>
                <td data-label="When">{at(each.at_unix_ms)}</td>
                <td data-label="Operator">{each.by ?? 'not known'}</td>
                <td data-label="Route">
                  {each.routes.map((route, k) => <Fragment key={route}>{k > 0 && ', '}<a href={`#routes/${route}`}>{route}</a></Fragment>)}
                </td>
                <td data-label="Change">{each.what}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {list.length < total && limit < kMost && <button onClick={() => setLimit(limit + kStep)}>Older ones</button>}
    </>
  );
}

// The same of one route, by its id and name, and of late.
export function ChangedLately({ route, again }: { route: string[]; again: unknown }) {
  const changes = useChanges({ since: kLately, route, limit: String(kLatelyShown) }, again);
  if (changes === null) return <p className="note">Loading the activity log …</p>;
  if (typeof changes === 'string') return <p className="note" role="status">Activity log: {changes}</p>;
  const { changes: list, total } = changes.history;
  return (
    <section className="life" aria-label="Activity log">
      <h3>Changed in the last 30 days</h3>
      {list.length > 0 && (
        <ul className="plain">
          {list.map((each, i) => (
            <li key={total - i}><time>{at(each.at_unix_ms)}</time> {each.by ?? 'not known by whom'}: {each.what}</li>
          ))}
        </ul>
      )}
      <p className="note">
        {total === 0 ? 'Nothing.' : list.length < total ? `The last ${list.length} of ${total}.` : ''}{beforeThat(changes)}{' '}
        <a href={addressOf(kLately)}>Of all routes</a>
      </p>
    </section>
  );
}
