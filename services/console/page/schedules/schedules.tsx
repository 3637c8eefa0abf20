import { useCallback, useEffect, useState } from 'react';
import { change, get } from '../api';
import { useMay } from '../me';
import { Calendar } from './calendar';
import { ScheduleForm } from './form';
import type { Schedule } from './schedule';

const kAgain_ms = 5000;

type Order = 'pause' | 'resume' | 'remove';

// Returns why it was not changed, or nothing.
async function tell(name: string, order: Order): Promise<string> {
  const reply = order === 'remove'
    ? await change<object>('DELETE', `/api/schedules/${name}`, null)
    : await change<object>('POST', `/api/schedules/${name}/${order}`, {});
  return typeof reply === 'string' ? reply : '';
}

function Outcome({ schedule: { last, outcome, sent } }: { schedule: Schedule }) {
  if (last === null) return <>Not yet due</>;
  if (outcome !== null) return <>{last.text}: nobody was sent: {outcome}</>;
  return (
    <>
      {last.text}
      <ul className="plain">
        {sent.map(({ robot, mission, outcome: became }) => (
          <li key={robot}>
            {mission === null ? robot : <a href={`#history/mission-${robot}:${mission}`}>{robot}</a>}: {became}
          </li>
        ))}
      </ul>
    </>
  );
}

function Row({ schedule, mayOperate, onChange, onEdit }: {
  schedule: Schedule; mayOperate: boolean; onChange: (order: Order) => void; onEdit: () => void;
}) {
  const [asks, setAsks] = useState(false);
  const { name, paused_by, next } = schedule;
  const order: Order = paused_by === null ? 'pause' : 'resume';
  return (
    <tr>
      <td data-label="Schedule"><strong>{name}</strong></td>
      <td data-label="When">{schedule.when.replace(' zone ', ', ')}</td>
      <td data-label="Robots">{schedule.robots.join(', ')}</td>
      <td data-label="Orders">{schedule.orders}</td>
      <td data-label="Next">{paused_by !== null ? `Paused by ${paused_by}` : next === null ? 'Never again' : next.text}</td>
      <td data-label="Last"><div><Outcome schedule={schedule} /></div></td>
      {mayOperate && (
        <td data-label="Change">
          {asks ? (
            <div>
              <button onClick={() => onChange('remove')}>Remove {name}</button>{' '}
              <button onClick={() => setAsks(false)}>Keep it</button>
            </div>
          ) : (
            <div>
              <button onClick={onEdit} aria-label={`Edit ${name} …`}>Edit …</button>{' '}
              <button onClick={() => onChange(order)} aria-label={`${order === 'pause' ? 'Pause' : 'Resume'} ${name}`}>
                {order === 'pause' ? 'Pause' : 'Resume'}
              </button>{' '}
              <button onClick={() => setAsks(true)} aria-label={`Remove ${name} …`}>Remove …</button>
            </div>
          )}
        </td>
      )}
    </tr>
  );
}

// Missions that are sent at times.
export function Schedules({ robots }: { robots: string[] }) {
  const [schedules, setSchedules] = useState<Schedule[] | string | null>(null);
  const [why, setWhy] = useState('');
  const [edits, setEdits] = useState<Schedule | 'new' | null>(null);
  const [changes, setChanges] = useState(0);
  const mayOperate = useMay('operate');
  const look = useCallback(async () => {
    const reply = await get<{ schedules: Schedule[] }>('/api/schedules', {});
    setSchedules(typeof reply === 'string' ? reply : reply.schedules);
  }, []);
  useEffect(() => {
    void look();
    const timer = window.setInterval(look, kAgain_ms);
    return () => window.clearInterval(timer);
  }, [look]);
  const onChange = async (name: string, order: Order) => {
    setWhy(await tell(name, order));
    await look();
    setChanges((count) => count + 1);
  };
  const onDone = async () => {
    setEdits(null);
    await look();
    setChanges((count) => count + 1);
  };
  const all = Array.isArray(schedules) ? schedules : [];
  return (
    <section className="schedules" aria-label="Schedules">
      <h2>Schedules</h2>
      <p role="status" className="note">{why !== '' && `⚠ ${why}`}</p>
      {schedules === null && <p className="note">Loading schedules …</p>}
      {typeof schedules === 'string' && <p className="note" role="alert">⚠ Schedules: {schedules}</p>}
      {Array.isArray(schedules) && schedules.length === 0 && <p className="note">No robot is sent at set times.</p>}
      {mayOperate && edits === null && <p><button onClick={() => setEdits('new')}>New schedule …</button></p>}
      {mayOperate && edits !== null && (
        <ScheduleForm key={edits === 'new' ? '' : edits.name} schedule={edits === 'new' ? null : edits} robots={robots}
          onDone={() => void onDone()} onLeave={() => setEdits(null)} />
      )}
      {all.length > 0 && (
        <table>
          <thead>
            <tr>
              <th>Schedule</th><th>When</th><th>Robots</th><th>Orders</th><th>Next</th><th>Last</th>{mayOperate && <th>Change</th>}
            </tr>
          </thead>
          <tbody>
            {all.map((each) => (
              <Row key={each.name} schedule={each} mayOperate={mayOperate} onEdit={() => setEdits(each)}
                onChange={(order) => void onChange(each.name, order)} />
            ))}
          </tbody>
        </table>
      )}
      {all.length > 0 && <Calendar changes={changes} />}
    </section>
  );
}
