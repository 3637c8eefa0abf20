import { useEffect, useMemo, useState, type FormEvent } from 'react';
import { get, sendAgain, type Answer, type Command, type CommandPage, type Mission, type MissionPage } from '../api';
import { AlertHistory } from '../alerts/alert-history';
import { Copy } from '../copy';
import { age, when } from '../fleet';
import { useMay } from '../me';
import { isOver } from '../missions';
import { PhotoList, PhotoPage, PhotosOf } from '../photos/photos';
import { Slide } from '../robot/send';
import { RunPage } from './run';
import { RunList, RunsOf } from './run-list';

type Search = Record<string, string>;

const states = ['sent', 'accepted', 'refused', 'fetching', 'under way', 'paused', 'arrived', 'failed', 'cancelled', 'expired'];

const at = when;

function Filters({ ofMissions, onSearch }: { ofMissions: boolean; onSearch: (search: Search) => void }) {
  const submit = (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    const search: Search = {};
    for (const [name, value] of new FormData(event.currentTarget)) search[name] = String(value).trim();
    const { from, until, ...rest } = search;
    const unix_ms = (local: string) => (local ? String(new Date(local).getTime()) : '');
    onSearch({ ...rest, from_unix_ms: unix_ms(from), until_unix_ms: unix_ms(until) });
  };
  return (
    <form className="filters" role="search" onSubmit={submit}>
      <label>Robot<input name="robot" autoComplete="off" /></label>
      <label>Route<input name="route" autoComplete="off" /></label>
      {ofMissions && (
        <label>State
          <select name="state" defaultValue="">
            <option value="">any</option>
            {states.map((each) => <option key={each}>{each}</option>)}
          </select>
        </label>
      )}
      <label>Operator<input name="by" autoComplete="off" /></label>
      <label>From<input name="from" type="datetime-local" /></label>
      <label>Until<input name="until" type="datetime-local" /></label>
      <button type="submit">Search</button>
    </form>
  );
}

// Page after page of what a server keeps, the newest first.
function useRecords<Page extends { next: number }, Each>(
  path: string, search: Search, list: (page: Page) => Each[], none = 'There is none.',
) {
  const [records, setRecords] = useState<Each[]>([]);
  const [last, setLast] = useState<Page | string | null>(null);
  const [before, setBefore] = useState(0);
  useEffect(() => {
    let still = true;
    if (before === 0) setLast(null);
    get<Page>(path, { ...search, before: before ? String(before) : '' }).then((page) => {
      if (!still) return;
      setLast(page);
      const found = typeof page === 'string' ? [] : list(page);
      setRecords((had) => (before ? [...had, ...found] : found));
    });
    return () => { still = false; };
    // A search is another object each time, also where it asks for the same again.
  }, [path, search, before]);
  useEffect(() => setBefore(0), [search]);
  const told = last === null ? 'Loading …'
    : typeof last === 'string' ? `⚠ ${last}`
    : records.length === 0 ? none : '';
  const next = last !== null && typeof last !== 'string' ? last.next : 0;
  return {
    records,
    told: told && <p role="status" className={typeof last === 'string' ? 'answer bad' : 'note'}>{told}</p>,
    more: next > 0 && <button onClick={() => setBefore(next)}>Older ones</button>,
  };
}

const commandsOf = (page: CommandPage) => page.commands;
const missionsOf = (page: MissionPage) => page.missions;

function answersOf({ answers }: Command): string {
  if (answers.length === 0) return 'nobody answered';
  return answers.map((each) => `${each.robot}${each.obeys ? '' : ' does not obey'}: ${each.detail}`).join('; ');
}

// What is kept of a mission's life, and what the robot was told meanwhile.
function Life({ mission, now_ms }: { mission: Mission; now_ms: number }) {
  const [search] = useState<Search>({
    robot: mission.robot,
    from_unix_ms: String(mission.sent_unix_ms),
    until_unix_ms: String(Math.max(mission.changed_unix_ms, mission.sent_unix_ms) + 1000),
    limit: '100',
  });
  const { records, told, more } = useRecords('/api/commands', search, commandsOf, 'It was told nothing meanwhile.');
  const over = isOver(mission);
  const mayOperate = useMay('operate');
  const [answer, setAnswer] = useState<Answer | null>(null);
  const happened = [
    { unix_ms: mission.sent_unix_ms, text: `Sent by ${mission.sent_by || 'somebody'}: ${mission.orders || '(orders not told)'}` },
    ...records.map((each) => ({
      unix_ms: each.given_unix_ms,
      text: `${each.given_by} told ${each.whom} to ${each.command}${each.reason ? ` (${each.reason})` : ''} – ${answersOf(each)}`,
    })),
    { unix_ms: mission.changed_unix_ms, text: `${over ? 'Ended' : 'Since then'}: ${mission.state}${mission.detail ? `, ${mission.detail}` : ''}` },
  ].sort((one, other) => one.unix_ms - other.unix_ms);
  return (
    <div className="life">
      <p><Copy id={mission.mission} what="mission" /></p>
      <ol>
        {happened.map((each, i) => (
          <li key={i}><time>{at(each.unix_ms)}</time> {each.text}</li>
        ))}
      </ol>
      {told}{more}
      {mayOperate && over && mission.state !== 'arrived' && mission.orders && !answer && (
        <Slide label={`Slide to send ${mission.robot} once more`} onDone={async () => setAnswer(await sendAgain(mission))} />
      )}
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>{answer && `${answer.ok ? '' : '⚠ '}${mission.robot}: ${answer.text}`}</p>
      <RunsOf mission={mission.mission} />
      {/\bphoto (every|at) /.test(mission.orders) && <PhotosOf mission={mission.mission} now_ms={now_ms} />}
    </div>
  );
}

function MissionLine({ mission, now_ms, opened = false }: { mission: Mission; now_ms: number; opened?: boolean }) {
  const [open, setOpen] = useState(opened);
  const took_s = Math.max(0, mission.changed_unix_ms - mission.sent_unix_ms) / 1000;
  return (
    <>
      <tr className={mission.state.replace(' ', '-')}>
        <td data-label="Sent" title={at(mission.sent_unix_ms)}>{age(now_ms - mission.sent_unix_ms)} ago</td>
        <td data-label="Robot">{mission.robot}</td>
        <td data-label="Orders">
          <button className="opens" aria-expanded={open} onClick={() => setOpen(!open)}>{mission.orders || '(not told)'}</button>
        </td>
        <td data-label="State"><strong>{mission.state}</strong></td>
        <td data-label="Duration">{took_s > 0 ? age(1000 * took_s) : ''}</td>
        <td data-label="Why">{mission.detail}</td>
        <td data-label="Operator">{mission.sent_by}</td>
      </tr>
      {open && <tr className="opened"><td colSpan={7}><Life mission={mission} now_ms={now_ms} /></td></tr>}
    </>
  );
}

function MissionTable({ missions, now_ms, opened }: { missions: Mission[]; now_ms: number; opened?: boolean }) {
  if (missions.length === 0) return null;
  return (
    <table>
      <thead><tr><th>Sent</th><th>Robot</th><th>Orders</th><th>State</th><th>Duration</th><th>Why</th><th>Operator</th></tr></thead>
      <tbody>
        {missions.map((each) => <MissionLine key={`${each.robot} ${each.mission}`} mission={each} now_ms={now_ms} opened={opened} />)}
      </tbody>
    </table>
  );
}

function MissionHistory({ now_ms }: { now_ms: number }) {
  const [search, setSearch] = useState<Search>({});
  const { records, told, more } = useRecords('/api/missions', search, missionsOf);
  return (
    <>
      <Filters ofMissions onSearch={setSearch} />
      {told}
      <MissionTable missions={records} now_ms={now_ms} />
      {more}
    </>
  );
}

// A mission has an address of its own. It is asked for again as it changes.
function OneMission({ name, live, now_ms }: { name: string; live: Mission[]; now_ms: number }) {
  const [robot, mission] = name.split(':');
  const now = live.find((each) => each.robot === robot && each.mission === mission);
  const search = useMemo<Search>(() => ({ robot, mission }), [robot, mission, now?.state, now?.changed_unix_ms]);
  const { records, told } = useRecords('/api/missions', search, missionsOf, 'No server keeps this mission.');
  return (
    <>
      <p><a href="#history">All missions</a></p>
      {told}
      <MissionTable missions={records} now_ms={now_ms} opened />
    </>
  );
}

function CommandHistory({ now_ms }: { now_ms: number }) {
  const [search, setSearch] = useState<Search>({});
  const { records, told, more } = useRecords('/api/commands', search, commandsOf);
  return (
    <>
      <Filters ofMissions={false} onSearch={setSearch} />
      {told}
      {records.length > 0 && (
        <table>
          <thead><tr><th>Given</th><th>Operator</th><th>Command</th><th>Whom</th><th>Why</th><th>Answers</th></tr></thead>
          <tbody>
            {records.map((each, i) => (
              <tr key={`${each.given_unix_ms} ${i}`}>
                <td data-label="Given" title={at(each.given_unix_ms)}>{age(now_ms - each.given_unix_ms)} ago</td>
                <td data-label="Operator">{each.given_by}</td>
                <td data-label="Command"><strong>{each.command}</strong></td>
                <td data-label="Whom">{each.whom}</td>
                <td data-label="Why">{each.reason}</td>
                <td data-label="Answers">{answersOf(each)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      {more}
    </>
  );
}

const kMission = 'mission-';
const kPhotos = 'photos-';
const kPhoto = 'photo-';

export function History({ open, live, now_ms }: { open: string; live: Mission[]; now_ms: number }) {
  const kind = ['commands', 'runs', 'alerts', 'photos'].includes(open) ? open : open.startsWith(kPhotos) ? 'photos' : 'missions';
  if (open.startsWith('run-')) return <RunPage key={open} id={open.slice('run-'.length)} />;
  if (open.startsWith(kPhoto)) return <PhotoPage key={open} id={open.slice(kPhoto.length)} now_ms={now_ms} />;
  return (
    <section aria-label="History" className="history">
      <h2>History</h2>
      <nav className="kinds" aria-label="Of what">
        <a href="#history" aria-current={kind === 'missions' ? 'page' : undefined}>Missions</a>
        <a href="#history/commands" aria-current={kind === 'commands' ? 'page' : undefined}>Commands</a>
        <a href="#history/runs" aria-current={kind === 'runs' ? 'page' : undefined}>Runs</a>
        <a href="#history/photos" aria-current={kind === 'photos' ? 'page' : undefined}>Photos</a>
        <a href="#history/alerts" aria-current={kind === 'alerts' ? 'page' : undefined}>Alerts</a>
      </nav>
      {kind === 'missions' && (open.startsWith(kMission)
        ? <OneMission key={open} name={open.slice(kMission.length)} live={live} now_ms={now_ms} />
        : <MissionHistory now_ms={now_ms} />)}
      {kind === 'commands' && <CommandHistory now_ms={now_ms} />}
      {kind === 'runs' && <RunList now_ms={now_ms} />}
      {kind === 'photos' && <PhotoList key={open} mission={open.startsWith(kPhotos) ? open.slice(kPhotos.length) : ''} now_ms={now_ms} />}
      {kind === 'alerts' && <AlertHistory now_ms={now_ms} />}
    </section>
  );
}
