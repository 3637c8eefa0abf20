import { useContext, useState } from 'react';
import { acknowledge, type Alert, type Answer } from '../api';
import { age, when } from '../fleet';
import { Lost } from '../lost';
import { useMay } from '../me';

// Above everything so many, the newest that nobody has acknowledged first.
const kMostAbove = 3;

const urgency = (alert: Alert) => (alert.acknowledged_by !== null ? 2 : alert.severity === 'alarm' ? 0 : 1);
export const byUrgency = (one: Alert, other: Alert) => urgency(one) - urgency(other) || other.since_unix_ms - one.since_unix_ms;

export const unacknowledged = (alerts: Alert[]) => alerts.filter((alert) => alert.acknowledged_by === null).length;

export function Subject({ alert }: { alert: Alert }) {
  return alert.robot ? <a href={`#fleet/${alert.robot}`}>{alert.robot}</a> : <strong>{alert.server}</strong>;
}

export function Acknowledge({ alert, onAnswer }: { alert: Alert; onAnswer: (answer: Answer) => void }) {
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
