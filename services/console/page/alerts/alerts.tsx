import { useContext, useEffect, useState } from 'react';
import { acknowledge, get, type Alert, type Answer } from '../api';
import { age, when } from '../fleet';
import { Lost } from '../lost';
import { useMay } from '../me';

// Above everything so many, the newest that nobody has acknowledged first.
const kMostAbove = 3;
const kEvery_ms = 5000;

const urgency = (alert: Alert) => (alert.acknowledged_by !== null ? 2 : alert.severity === 'alarm' ? 0 : 1);
export const byUrgency = (one: Alert, other: Alert) => urgency(one) - urgency(other) || other.since_unix_ms - one.since_unix_ms;

export const unacknowledged = (alerts: Alert[]) => alerts.filter((alert) => alert.acknowledged_by === null).length;

function Subject({ alert }: { alert: Alert }) {
  return alert.robot ? <a href={`#fleet/${alert.robot}`}>{alert.robot}</a> : <strong>{alert.server}</strong>;
}

function Acknowledge({ alert, onAnswer }: { alert: Alert; onAnswer: (answer: Answer) => void }) {
  const mayOperate = useMay('operate');
  if (!mayOperate || alert.acknowledged_by !== null || alert.ended_unix_ms !== null) return null;
  return (
    <button onClick={async () => {
      const said = await acknowledge(alert.alert);
      if (!said.ok) onAnswer(said);
    }}>
      Acknowledge<span className="hidden"> {alert.robot ?? alert.server}: {alert.reason}</span>
    </button>
  );
}

// `told`: whom another line already names, as it does not answer a stop.
export function AlertBar({ alerts: open, told, now_ms }: { alerts: Alert[]; told: string[]; now_ms: number }) {
  const lost = useContext(Lost);
  const alerts = open.filter((alert) => alert.kind !== 'not-stopped' || !told.includes(alert.robot!));
  const [all, setAll] = useState(false);
  const [answer, setAnswer] = useState<Answer | null>(null);
  if (alerts.length === 0) return null;
  const sorted = [...alerts].sort(byUrgency);
  const shown = all ? sorted : sorted.filter((alert) => alert.acknowledged_by === null).slice(0, window.matchMedia('(max-width: 40rem)').matches ? 1 : kMostAbove);
  const hidden = alerts.length - shown.length;
  return (
    <section className="alerts" aria-label="Alerts">
      <ul>
        {shown.map((alert) => (
          <li key={alert.alert} className={alert.acknowledged_by !== null ? 'quiet' : alert.severity}>
            <span className="sign" aria-hidden="true">{alert.severity === 'alarm' ? '⚠' : '▲'}</span>
            <span className="what">
              <Subject alert={alert} /> {alert.reason}
              <span className="note">{lost ? 'As last known. ' : alert.known ? '' : 'As last known: not heard since the console started. '}{alert.action}</span>
            </span>
            <span className="where">
              {alert.place && <>{alert.place} · </>}<time title={when(alert.since_unix_ms)}>{age(now_ms - alert.since_unix_ms)}</time>
              {alert.acknowledged_by !== null && <> · acknowledged by {alert.acknowledged_by}</>}
            </span>
            <Acknowledge alert={alert} onAnswer={setAnswer} />
          </li>
        ))}
      </ul>
      {answer && <p className="answer bad" role="status">⚠ {answer.text}</p>}
      <p className="more-alerts">
        {(hidden > 0 || all) && (
          <button className="plain" aria-expanded={all} onClick={() => setAll(!all)}>
            {all ? 'Fewer' : shown.length === 0 ? `${hidden} acknowledged alert${hidden === 1 ? '' : 's'}` : `${hidden} more`}
          </button>
        )}
        <a href="#history/alerts">All alerts</a>
      </p>
    </section>
  );
}

type AlertPage = { alerts: Alert[]; kept: boolean };

// Those that are open and those that have ended, the newest first.
export function AlertHistory({ now_ms }: { now_ms: number }) {
  const [page, setPage] = useState<AlertPage | string | null>(null);
  const [robot, setRobot] = useState('');
  const [kind, setKind] = useState('');
  const [answer, setAnswer] = useState<Answer | null>(null);
  useEffect(() => {
    let over = false;
    const look = async () => {
      const reply = await get<AlertPage>('/api/alerts', {});
      if (!over) setPage(reply);
    };
    void look();
    const timer = window.setInterval(() => !document.hidden && void look(), kEvery_ms);
    return () => {
      over = true;
      window.clearInterval(timer);
    };
  }, [answer]);
  if (page === null) return <p className="note" role="status">Loading …</p>;
  if (typeof page === 'string') return <p className="answer bad" role="status">⚠ {page}</p>;
  const kinds = [...new Set(page.alerts.map((alert) => alert.kind))].sort();
  const found = page.alerts.filter((alert) =>
    (alert.robot ?? alert.server ?? '').includes(robot.trim()) && (kind === '' || (kind === 'open' ? alert.ended_unix_ms === null : alert.kind === kind)));
  return (
    <>
      <form className="filters" role="search" onSubmit={(event) => event.preventDefault()}>
        <label>Robot<input value={robot} autoComplete="off" onChange={(event) => setRobot(event.target.value)} /></label>
        <label>Kind
          <select value={kind} onChange={(event) => setKind(event.target.value)}>
            <option value="">any</option>
            <option value="open">open</option>
            {kinds.map((each) => <option key={each}>{each}</option>)}
          </select>
        </label>
      </form>
      {!page.kept && <p className="note">These are kept until the console ends; started with <code>--alerts FILE</code> it keeps them.</p>}
      {answer && <p className="answer bad" role="status">⚠ {answer.text}</p>}
      {found.length === 0 && <p className="note" role="status">There is none.</p>}
      {found.length > 0 && (
        <table>
          <thead><tr><th>Since</th><th>Robot</th><th>Reason</th><th>Place</th><th>What to do</th><th>Acknowledged</th><th>Ended</th></tr></thead>
          <tbody>
            {found.map((alert) => (
              <tr key={alert.alert} className={alert.ended_unix_ms === null ? alert.severity : ''}>
                <td data-label="Since" title={when(alert.since_unix_ms)}>{age(now_ms - alert.since_unix_ms)} ago</td>
                <td data-label="Robot"><Subject alert={alert} /></td>
                <td data-label="Reason">{alert.reason}</td>
                <td data-label="Place">{alert.place}</td>
                <td data-label="What to do">{alert.action}</td>
                <td data-label="Acknowledged">
                  {alert.acknowledged_by !== null && `${alert.acknowledged_by}, ${age(now_ms - alert.acknowledged_unix_ms!)} ago`}
                  <Acknowledge alert={alert} onAnswer={setAnswer} />
                </td>
                <td data-label="Ended">{alert.ended_unix_ms === null ? <strong>open</strong> : `after ${age(alert.ended_unix_ms - alert.since_unix_ms)}`}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
    </>
  );
}
