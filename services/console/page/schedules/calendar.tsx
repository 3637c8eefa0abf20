import { useEffect, useState } from 'react';
import { get } from '../api';
import type { Firing } from './schedule';

const kWeek = ['Mon', 'Tue', 'Wed', 'Thu', 'Fri', 'Sat', 'Sun'];
const kMostADay = 4;
const kDay_ms = 86_400_000;

// "2026-11-30" of a moment as "Mon 2026-11-30 08:30 CET".
const dayOf = ({ text }: Firing) => text.slice(4, 14);
const timeOf = ({ text }: Firing) => text.slice(15);

// The days of whole weeks, from this one's Monday until the last day with something due.
function weeksOf(firings: Firing[], now_ms: number): string[][] {
  const today = new Date(now_ms);
  const first = Date.UTC(today.getFullYear(), today.getMonth(), today.getDate() - (today.getDay() + 6) % 7);
  const last = firings.map(dayOf).reduce((one, other) => (one > other ? one : other), '');
  const weeks: string[][] = [];
  for (let monday = first; weeks.length === 0 || new Date(monday).toISOString().slice(0, 10) <= last; monday += 7 * kDay_ms) {
    weeks.push(kWeek.map((_, i) => new Date(monday + i * kDay_ms).toISOString().slice(0, 10)));
  }
  return weeks;
}

// When robots are sent next, each at its schedule's own time. `changes` counts what may have changed that.
export function Calendar({ changes }: { changes: number }) {
  const [found, setFound] = useState<{ days: number; firings: Firing[] } | string | null>(null);
  useEffect(() => {
    let over = false;
    const look = async () => {
      const reply = await get<{ days: number; firings: Firing[] }>('/api/schedules/calendar', {});
      if (!over) setFound(reply);
    };
    void look();
    const timer = window.setInterval(look, 60_000);
    return () => {
      over = true;
      window.clearInterval(timer);
    };
  }, [changes]);
  if (found === null) return null;
  if (typeof found === 'string') return <p className="note" role="alert">⚠ Calendar: {found}</p>;
  const { days, firings } = found;
  if (firings.length === 0) return <p className="note">Nothing is due in the next {days} days.</p>;
  const of = new Map<string, Firing[]>();
  for (const firing of firings) of.set(dayOf(firing), [...of.get(dayOf(firing)) ?? [], firing]);
  return (
    <table className="calendar">
      <caption>Due in the next {days} days</caption>
      <thead><tr>{kWeek.map((day) => <th key={day} scope="col">{day}</th>)}</tr></thead>
      <tbody>
        {weeksOf(firings, Date.now()).map((week) => (
          <tr key={week[0]}>
            {week.map((day, i) => {
              const due = of.get(day) ?? [];
              return (
                <td key={day} data-label={`${kWeek[i]} ${day}`} className={due.length === 0 ? 'none' : ''}>
                  <span className="note">{day.slice(5)}</span>
                  {due.length > 0 && (
                    <ul className="plain">
                      {due.slice(0, kMostADay).map((firing) => <li key={`${firing.schedule} ${firing.unix_ms}`}>{timeOf(firing)} <strong>{firing.schedule}</strong></li>)}
                      {due.length > kMostADay && <li>and {due.length - kMostADay} more</li>}
                    </ul>
                  )}
                </td>
              );
            })}
          </tr>
        ))}
      </tbody>
    </table>
  );
}
