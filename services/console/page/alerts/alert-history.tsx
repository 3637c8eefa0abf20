import { useEffect, useState } from 'react';
import { get, type Alert, type Answer } from '../api';
import { age, when } from '../fleet';
import { Acknowledge, Subject } from './alerts';

const kEvery_ms = 5000;

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
