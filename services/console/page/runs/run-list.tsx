import { useEffect, useState, type DragEvent, type FormEvent } from 'react';
import { get } from '../api';
import { Copy } from '../copy';
import { age, when } from '../fleet';
import { openLog, type RunsPage, type Summary } from './runs';

type Search = { robot: string; route: string; mission: string };

const ended = (run: Summary) => run.state || (run.under_way ? 'under way' : 'breaks off');
const began = (run: Summary) => run.began_unix_ms ?? run.written_unix_ms - 1000 * run.lasted_s;
// Of a route that is still being taught a share would be of another length at each moment.
const far = (run: Summary) =>
  (run.driven_m === null ? `${Math.round(100 * run.progress)} %` : `${run.driven_m.toFixed(run.driven_m < 1 ? 2 : 1)} m`);

function useRuns(search: Search, skip: number) {
  const [runs, setRuns] = useState<Summary[]>([]);
  const [last, setLast] = useState<RunsPage | string | null>(null);
  const [times, setTimes] = useState(0);
  useEffect(() => {
    let still = true;
    let again: number | undefined;
    get<RunsPage>('/api/runs', { ...search, skip: skip ? String(skip) : '' }).then((page) => {
      if (!still) return;
      setLast(page);
      if (typeof page === 'string') return;
      setRuns((had) => (skip ? [...had.slice(0, skip), ...page.runs] : page.runs));
      if (page.unread > 0) again = window.setTimeout(() => setTimes(times + 1), 1000);
    });
    return () => {
      still = false;
      window.clearTimeout(again);
    };
  }, [search, skip, times]);
  return { runs, last };
}

// A log of one's own is opened as those are that lie there.
function Drop() {
  const [over, setOver] = useState(false);
  const [told, setTold] = useState('');
  const take = async (files: FileList | null) => {
    const file = files?.[0];
    if (!file) return;
    setTold(`Takes ${file.name} …`);
    const opened = await openLog(file);
    if (typeof opened === 'string') return setTold(`⚠ ${opened}`);
    window.location.hash = `#history/run-${opened.run}`;
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    void take(event.dataTransfer.files);
  };
  return (
    <div
      className={over ? 'finder over' : 'finder'} onDrop={drop}
      onDragOver={(event) => { event.preventDefault(); setOver(true); }} onDragLeave={() => setOver(false)}
    >
      <p>Drop a run’s log here to open it, as <code>trailcast-agent replay --log</code> and <code>serve --logs</code> write it.</p>
      <div className="orders">
        <label className="button">
          Open log …
          <input type="file" accept=".mcap" className="hidden" onChange={(event) => { void take(event.target.files); event.target.value = ''; }} />
        </label>
      </div>
      {told && <p role="status" className={told.startsWith('⚠') ? 'answer bad' : 'note'}>{told}</p>}
    </div>
  );
}

export function RunList({ now_ms }: { now_ms: number }) {
  const [search, setSearch] = useState<Search>({ robot: '', route: '', mission: '' });
  const [skip, setSkip] = useState(0);
  const { runs, last } = useRuns(search, skip);
  const submit = (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    const given = new FormData(event.currentTarget);
    const word = (name: string) => String(given.get(name) ?? '').trim();
    setSkip(0);
    setSearch({ robot: word('robot'), route: word('route'), mission: word('mission') });
  };
  const next = last !== null && typeof last !== 'string' ? last.next : 0;
  const unread = last !== null && typeof last !== 'string' ? last.unread : 0;
  return (
    <>
      <form className="filters" role="search" onSubmit={submit}>
        <label>Robot<input name="robot" autoComplete="off" /></label>
        <label>Route<input name="route" autoComplete="off" /></label>
        <label>Mission<input name="mission" autoComplete="off" /></label>
        <button type="submit">Search</button>
      </form>
      {last === null && <p role="status" className="note">Loading …</p>}
      {typeof last === 'string' && <p role="status" className="answer bad">⚠ {last}</p>}
      {unread > 0 && <p role="status" className="note">{unread} more files are still looked at …</p>}
      {last !== null && typeof last !== 'string' && runs.length === 0 && unread === 0 && <p role="status" className="note">There is none.</p>}
      {runs.length > 0 && (
        <table className="runs">
          <thead><tr><th>Began</th><th>Robot</th><th>Route</th><th>Ended</th><th>Duration</th><th>Distance</th><th>Why</th><th>Mission</th></tr></thead>
          <tbody>
            {runs.map((run) => (
              <tr key={run.run} className={run.state === 'ARRIVED' || run.under_way ? '' : 'failed'}>
                <td data-label="Began" title={when(began(run))}>{age(now_ms - began(run))} ago</td>
                <td data-label="Robot">{run.robot}</td>
                <td data-label="Route"><a href={`#history/run-${run.run}`}>{run.route || run.file}</a></td>
                <td data-label="Ended"><strong>{ended(run)}</strong></td>
                <td data-label="Duration">{age(1000 * run.lasted_s)}</td>
                <td data-label="Distance">{far(run)}</td>
                <td data-label="Why">{run.reason}</td>
                <td data-label="Mission">{run.mission && <Copy id={run.mission} what="mission" />}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {next > 0 && <button onClick={() => setSkip(next)}>Older ones</button>}
      <Drop />
    </>
  );
}

// On a mission's life.
export function RunsOf({ mission }: { mission: string }) {
  const [runs, setRuns] = useState<Summary[]>([]);
  useEffect(() => {
    let still = true;
    get<RunsPage>('/api/runs', { mission }).then((page) => {
      if (still && typeof page !== 'string') setRuns(page.runs);
    });
    return () => { still = false; };
  }, [mission]);
  if (runs.length === 0) return null;
  return (
    <p>
      Its runs:{' '}
      {runs.map((run) => (
        <a key={run.run} href={`#history/run-${run.run}`}>{run.route}, {far(run)}, {ended(run)}</a>
      ))}
    </p>
  );
}
