import { useEffect, useId, useState, type FormEvent } from 'react';
import { change, create } from '../api';
import { Field } from '../network/network-changes';
import { apart, bodyOf, type Asked } from '../photos/asked';
import { PhotoFields } from '../photos/fields';
import type { Firing, Schedule } from './schedule';

type How = 'at' | 'every' | 'once';
const hows: Record<How, string> = { at: 'At times of the day', every: 'Every so often', once: 'Once' };
const days = ['mon', 'tue', 'wed', 'thu', 'fri', 'sat', 'sun'];

type Draft = {
  name: string; robots: string; orders: string; photos: Asked;
  how: How; at: string; every_min: string; from: string; until: string; days: string[]; date: string; time: string; zone: string;
  battery: string; unless_closed: boolean; if_arrived: boolean; missed: 'skip' | 'once'; valid_min: string; goes_on: boolean;
};

const zones = (Intl as unknown as { supportedValuesOf?: (of: string) => string[] }).supportedValuesOf?.('timeZone') ?? [];
const ownZone = () => Intl.DateTimeFormat().resolvedOptions().timeZone || 'UTC';

function draftOf(schedule: Schedule | null): Draft {
  const times = schedule?.times;
  const { orders, asked } = apart(schedule?.orders ?? '');
  const how: How = !times || times.at.length > 0 && times.once === null ? 'at' : times.once !== null ? 'once' : 'every';
  return {
    name: schedule?.name ?? '', robots: schedule?.robots.join(', ') ?? '', orders, photos: asked,
    how, at: how === 'at' ? times?.at.join(', ') ?? '08:00' : '08:00',
    every_min: String(times?.every_min ?? 60), from: times?.from ?? '', until: times?.until ?? '',
    days: times && times.days.length > 0 ? times.days : days,
    date: times?.once ?? '', time: how === 'once' ? times?.at[0] ?? '08:00' : '08:00', zone: schedule?.zone ?? ownZone(),
    battery: schedule?.battery_percent ? String(schedule.battery_percent) : '',
    unless_closed: schedule?.unless_closed ?? false, if_arrived: schedule?.if_arrived ?? false, missed: schedule?.missed ?? 'skip',
    valid_min: String(Math.max(1, Math.round((schedule?.valid_s ?? 600) / 60))), goes_on: schedule?.goes_on ?? false,
  };
}

const listed = (text: string) => text.split(/[\s,]+/).filter((word) => word !== '').join(',');

// The server's words for what is filled in. It says what is wrong with them.
function wordsOf(draft: Draft): string {
  const period = draft.from || draft.until ? ` from ${draft.from || '00:00'} until ${draft.until || '24:00'}` : '';
  const on = draft.days.length < days.length ? ` on ${draft.days.join(',')}` : '';
  const when = {
    at: `at ${listed(draft.at)}${on}`,
    every: `every ${draft.every_min}${period}${on}`,
    once: `once ${draft.date} ${draft.time}`,
  }[draft.how];
  const conditions = [
    draft.battery && `battery ${draft.battery}`, draft.unless_closed && 'unless-closed', draft.if_arrived && 'if-arrived',
    `missed ${draft.missed}`, `valid ${60 * Number(draft.valid_min)}`, draft.goes_on && 'goes-on',
  ].filter(Boolean).join(' ');
  return `${draft.name.trim()} to ${listed(draft.robots)} ${when} zone ${draft.zone.trim()} ${conditions} do ${draft.orders.trim()}`;
}

function Check({ label, title, checked, onChange }: { label: string; title?: string; checked: boolean; onChange: (checked: boolean) => void }) {
  return (
    <label className="net-check" title={title}>
      <input type="checkbox" checked={checked} onChange={(event) => onChange(event.target.checked)} />{label}
    </label>
  );
}

function Timed({ label, type, value, min, max, onChange }: {
  label: string; type: 'number' | 'time' | 'date'; value: string; min?: number; max?: number; onChange: (value: string) => void;
}) {
  return (
    <label>{label}
      <input type={type} value={value} min={min} max={max} onChange={(event) => onChange(event.target.value)} />
    </label>
  );
}

// When what is filled in would be due, in the server's words, or what is wrong with it.
function usePreview(body: string, complete: boolean): Firing[] | string {
  const [firings, setFirings] = useState<Firing[] | string>([]);
  useEffect(() => {
    let over = false;
    const timer = window.setTimeout(async () => {
      if (!complete) return setFirings([]);
      const reply = await create<{ firings: Firing[] }>('/api/schedules/preview', JSON.parse(body));
      if (!over) setFirings(typeof reply === 'string' ? reply : reply.firings);
    }, 300);
    return () => {
      over = true;
      window.clearTimeout(timer);
    };
  }, [body, complete]);
  return firings;
}

// Makes a schedule, or changes one.
export function ScheduleForm({ schedule, robots, onDone, onLeave }: {
  schedule: Schedule | null; robots: string[]; onDone: () => void; onLeave: () => void;
}) {
  const [draft, setDraft] = useState(() => draftOf(schedule));
  const [why, setWhy] = useState('');
  const [busy, setBusy] = useState(false);
  const id = useId();
  const set = (part: Partial<Draft>) => setDraft((had) => ({ ...had, ...part }));
  const body = { words: wordsOf(draft), ...bodyOf(draft.photos) };
  const complete = [draft.name, draft.robots, draft.orders, draft.zone].every((text) => text.trim() !== '') &&
    (draft.how !== 'once' || draft.date !== '');
  const firings = usePreview(JSON.stringify(body), complete);
  const save = async (event: FormEvent) => {
    event.preventDefault();
    setBusy(true);
    const reply = schedule === null
      ? await create<object>('/api/schedules', body)
      : await change<object>('PUT', `/api/schedules/${schedule.name}`, body);
    setBusy(false);
    setWhy(typeof reply === 'string' ? reply : '');
    if (typeof reply !== 'string') onDone();
  };
  return (
    <form className="net-change" aria-label={schedule === null ? 'New schedule' : `Change ${schedule.name}`} onSubmit={(event) => void save(event)}>
      <h3>{schedule === null ? 'New schedule' : `Change ${schedule.name}`}</h3>
      <div className="net-fields">
        {schedule === null && <Field label="Name" value={draft.name} onChange={(name) => set({ name })} />}
        <Field label="Robots, with commas between them; cart-* for all whose names begin so" list={`${id}r`} value={draft.robots} onChange={(value) => set({ robots: value })} />
        <datalist id={`${id}r`}>{robots.map((robot) => <option key={robot} value={robot} />)}</datalist>
        <Field label="Orders, as follow hall, or goto loading-bay" value={draft.orders} onChange={(orders) => set({ orders })} />
        <PhotoFields asked={draft.photos} onChange={(photos) => set({ photos })} />
      </div>
      <fieldset>
        <legend>When</legend>
        <div className="layers" role="radiogroup" aria-label="When">
          {(Object.keys(hows) as How[]).map((how) => (
            <label key={how}><input type="radio" name={`${id}h`} checked={draft.how === how} onChange={() => set({ how })} />{hows[how]}</label>
          ))}
        </div>
        <div className="net-fields">
          {draft.how === 'at' && <Field label="Times, as 08:30, 12:00" value={draft.at} onChange={(at) => set({ at })} />}
          {draft.how === 'every' && (
            <>
              <Timed label="Minutes between" type="number" min={1} max={1440} value={draft.every_min} onChange={(every_min) => set({ every_min })} />
              <Timed label="From (midnight if empty)" type="time" value={draft.from} onChange={(from) => set({ from })} />
              <Timed label="Until (midnight if empty)" type="time" value={draft.until} onChange={(until) => set({ until })} />
            </>
          )}
          {draft.how === 'once' && (
            <>
              <Timed label="Date" type="date" value={draft.date} onChange={(date) => set({ date })} />
              <Timed label="Time" type="time" value={draft.time} onChange={(time) => set({ time })} />
            </>
          )}
          <Field label="Time zone" list={`${id}z`} value={draft.zone} onChange={(zone) => set({ zone })} />
          <datalist id={`${id}z`}>{zones.map((zone) => <option key={zone} value={zone} />)}</datalist>
        </div>
        {draft.how !== 'once' && (
          <div className="net-fields" role="group" aria-label="Days">
            {days.map((day) => (
              <Check key={day} label={day[0].toUpperCase() + day.slice(1)} checked={draft.days.includes(day)}
                onChange={(on) => set({ days: days.filter((each) => (each === day ? on : draft.days.includes(each))) })} />
            ))}
          </div>
        )}
      </fieldset>
      <fieldset>
        <legend>Conditions</legend>
        <div className="net-fields">
          <Timed label="Battery at least, % (any if empty)" type="number" min={1} max={100} value={draft.battery} onChange={(battery) => set({ battery })} />
          <label>Times that no server saw to
            <select value={draft.missed} onChange={(event) => set({ missed: event.target.value as Draft['missed'] })}>
              <option value="skip">are left out</option>
              <option value="once">are made up for by one mission</option>
            </select>
          </label>
          <Timed label="Kept for a robot out of reach, minutes" type="number" min={1} max={10080} value={draft.valid_min} onChange={(valid_min) => set({ valid_min })} />
        </div>
        <div className="net-fields">
          <Check label="Not while its route is closed" checked={draft.unless_closed} onChange={(unless_closed) => set({ unless_closed })} />
          <Check label="Only if the last one arrived" checked={draft.if_arrived} onChange={(if_arrived) => set({ if_arrived })} />
          <Check label="Goes on after a restart of the robot" checked={draft.goes_on} onChange={(goes_on) => set({ goes_on })} />
        </div>
      </fieldset>
      <p role="status" className={typeof firings === 'string' || why ? 'answer bad' : 'note'}>
        {why ? `⚠ ${why}` : typeof firings === 'string' ? `⚠ ${firings}`
          : firings.length > 0 ? `Due ${firings.slice(0, 3).map(({ text }) => text).join('; ')}${firings.length > 3 ? '; and so on' : ''}.`
          : complete ? 'Never due.' : 'Fill in a name, robots and orders.'}
      </p>
      <div className="orders">
        <button type="submit" disabled={!complete || busy}>{schedule === null ? 'Make it' : 'Change it'}</button>
        <button type="button" onClick={onLeave}>Cancel</button>
      </div>
    </form>
  );
}
