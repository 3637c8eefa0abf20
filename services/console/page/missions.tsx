import type { Mission } from './api';
import { age, when } from './fleet';

export const isOver = ({ state }: Mission) => ['arrived', 'failed', 'cancelled', 'refused', 'expired'].includes(state);

// This is the address that opens a mission. No name of a robot has a colon.
export const addressOf = ({ robot, mission }: Mission) => `#history/mission-${robot}:${mission}`;

export function Missions({ missions, now_ms }: { missions: Mission[] | null; now_ms: number }) {
  if (missions === null) return <p className="note">Loading missions …</p>;
  if (missions.length === 0) return <p className="note">No robot was sent anywhere yet.</p>;
  return (
    <table>
      <thead>
        <tr><th>Sent</th><th>Robot</th><th>Orders</th><th>State</th><th>Why</th><th>Operator</th></tr>
      </thead>
      <tbody>
        {missions.map((each) => (
          <tr key={`${each.robot} ${each.mission}`} className={each.state.replace(' ', '-')}>
            <td data-label="Sent" title={when(each.sent_unix_ms)}>
              {age(now_ms - each.sent_unix_ms)} ago
            </td>
            <td data-label="Robot">{each.robot}</td>
            <td data-label="Orders">{each.orders || '(not told)'}</td>
            <td data-label="State"><strong>{each.state}</strong></td>
            <td data-label="Why">{each.detail}</td>
            <td data-label="Operator">{each.sent_by}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
