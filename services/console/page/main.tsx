import { useCallback, useEffect, useRef, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { AlertBar, unacknowledged } from './alerts/alerts';
import { NoticeChoice, useNotices } from './alerts/notices';
import { stopAll, stopOne, tell, type Order, type Robot, type StopAnswer } from './api';
import { remember } from './doubts';
import { age, useFleet } from './fleet';
import { Home, useChosen } from './home/home';
import { WallNow } from './home/wall-now';
import { Keys } from './keys';
import { Later } from './later';
import { Doors, OnlyLooks, WhoIsIn } from './login';
import { Lost } from './lost';
import { useMay } from './me';
import { Pages, usePage } from './pages';
import { RobotPage } from './robot/page';
import { labels } from './robot/robot';
import { mayMove } from './robot/state';
import { trace } from './robot/trace';
import { StopButton } from './stop';
import { ThemeChoice } from './theme';

// Who was told to stop and has not answered stays in view until it has.
function NotStopped({ robots, lost, now_ms }: { robots: Robot[]; lost: boolean; now_ms: number }) {
  const open = robots.filter((robot) => robot.unanswered_stop_unix_ms !== null);
  if (open.length === 0) return null;
  const seen = (robot: Robot) => {
    const doing = robot.speed_mps !== 0 ? `, moving at ${Math.abs(robot.speed_mps).toFixed(2)} m/s` : '';
    return robot.last_heard_unix_ms === null ? `heard${doing}`
      : `last seen ${age(now_ms - robot.last_heard_unix_ms)} ago${doing}`;
  };
  return (
    <p className="banner" role="alert">
      ⚠ Not stopped:{' '}
      {open.map((robot, i) => (
        <span key={robot.name}>
          {i > 0 && '; '}<a href={`#fleet/${robot.name}`}>{robot.name}</a> ({seen(robot)})
        </span>
      ))}
      . It does not answer and may be moving: use its red button.
      {!lost && ' Stop is sent to it again and again, until it answers or you release it.'}
    </p>
  );
}

// Robots take so long to show what they have answered.
const kShown_ms = 2000;
// Of what is about no robot's stop.
const kRead_ms = 15000;

// What was answered, for as long as the robots are so.
function useStopAnswer(robots: Robot[], lost: boolean, now_ms: number) {
  const [answer, setAnswer] = useState<StopAnswer | null>(null);
  const [at_ms, setAt] = useState(0);
  useEffect(() => {
    if (lost && answer?.ok) setAnswer(null);
    if (answer?.ok && answer.robots.length === 0 && Date.now() > at_ms + kRead_ms) setAnswer(null);
    if (!answer || answer.robots.length === 0 || Date.now() < at_ms + kShown_ms) return;
    const holds = answer.robots.every(({ robot, answered, obeys }) => {
      const is = robots.find((each) => each.name === robot);
      return answered ? !obeys || is?.state === 'stopped' : is?.unanswered_stop_unix_ms != null;
    });
    if (!holds) setAnswer(null);
  }, [answer, at_ms, robots, lost, now_ms]);
  const say = (said: StopAnswer) => {
    setAnswer(said);
    setAt(Date.now());
  };
  return { answer, say };
}

// Of the time that lists tell.
const kStep_ms = 10000;

function Page() {
  const { fleet, settled, lost, now_ms, heard_ms } = useFleet();
  const robots = fleet?.robots ?? [];
  const alerts = fleet?.alerts ?? [];
  const { answer, say } = useStopAnswer(robots, lost, now_ms);
  const { page, open } = usePage();
  const mayOperate = useMay('operate');
  const pinned = useRef<HTMLDivElement>(null);
  // What is brought into view lies below what is pinned, however high that is.
  useEffect(() => {
    const rule = new ResizeObserver(() =>
      document.documentElement.style.setProperty('--pinned', `${pinned.current!.offsetHeight}px`));
    rule.observe(pinned.current!);
    return () => rule.disconnect();
  }, []);
  useEffect(() => {
    remember(fleet?.robots ?? []);
    trace(fleet?.robots ?? []);
  }, [fleet]);
  const onWall = page === 'wall';
  const told = unacknowledged(alerts);
  const shown = page === 'robot' ? open : { fleet: 'Home', cameras: 'Cameras', network: 'Network', routes: 'Routes', schedules: 'Schedules', history: 'History', wall: 'Wall', users: 'Users' }[page];
  useEffect(() => {
    document.title = `${lost ? '⚠ Connection lost' : `${told > 0 ? `(${told}) ` : ''}${shown}`} – Trailcast`;
  }, [told, lost, shown]);
  useNotices(alerts, settled, lost);
  const servers = fleet?.servers ?? [];
  const lost_ms = lost ? heard_ms : null;
  const onStopAll = useCallback(async () => {
    say({ ok: true, text: 'Sending Stop to all robots …', robots: [] });
    say(await stopAll());
  }, []);
  const onStop = useCallback(async (robot: string) => {
    say({ ok: true, text: `Sending Stop to ${robot} …`, robots: [] });
    say(await stopOne(robot));
  }, []);
  const onTell = useCallback(async (robot: string, order: Order) => {
    if (order === 'stop') return onStop(robot);
    say({ ok: true, text: `Sending ${labels[order]} to ${robot} …`, robots: [] });
    const said = await tell(robot, order);
    say({ ...said, text: `${robot}: ${said.text}`, robots: [] });
  }, []);
  const chosen = useChosen(robots, page === 'fleet' || page === 'robot' ? open : '');
  return (
    <Lost.Provider value={lost}>
      <div className="pinned" ref={pinned}>
        <header className="top">
          <h1>{onWall ? <a href="#fleet">Trailcast</a> : 'Trailcast'}</h1>
          {onWall ? <WallNow robots={robots} now_ms={now_ms} /> : <Pages page={page} />}
          {!onWall && <ThemeChoice />}
          {!onWall && <Keys robots={robots} chosen={page === 'fleet' || page === 'robot' ? chosen?.name ?? '' : ''} mayOperate={mayOperate} onStop={onStop} onStopAll={onStopAll} onTell={onTell} />}
          {!onWall && <WhoIsIn />}
          {mayOperate && <StopButton moves={lost || robots.some(mayMove)} onClick={onStopAll} />}
        </header>
        {lost && (
          <p className="banner" role="alert">
            ⚠ Connection lost: Stop will not reach robots. Use the red button on the robot.{' '}
            {fleet ? `Data is from ${age(now_ms - heard_ms)} ago.`
              : 'The console does not answer, or too many pages are open. This page tries again.'}
          </p>
        )}
        <NotStopped robots={robots} lost={lost} now_ms={now_ms} />
        <p className={answer && !answer.ok ? 'answer top-answer bad' : 'answer top-answer'} role="status">
          {answer && (answer.ok ? '' : '⚠ ') + answer.text}
        </p>
      </div>
      {!onWall && <OnlyLooks />}
      {settled && !lost && !servers.some((server) => server.heard) && (
        <p className="banner" role="alert">
          ⚠ Route server offline: there are no routes to choose from, nothing is kept, and only robots in
          direct reach hear this console.
        </p>
      )}
      {!onWall && (
        <AlertBar alerts={alerts} now_ms={now_ms}
          told={robots.filter((robot) => robot.unanswered_stop_unix_ms !== null).map((robot) => robot.name)} />
      )}
      <main className={`${page}${lost ? ' stale' : ''}`}>
        {page === 'fleet' && <Home fleet={fleet} open={open} chosen={chosen} settled={settled} lost_ms={lost_ms} now_ms={now_ms} onStop={onStop} />}
        {onWall && <Later show={({ Wall }) => <Wall fleet={fleet} settled={settled} now_ms={now_ms} />} />}
        {page === 'robot' && <RobotPage key={open} fleet={fleet} name={open} settled={settled} lost_ms={lost_ms} now_ms={now_ms} />}
        {page === 'cameras' && <Later show={({ Cameras }) => <Cameras robots={robots} settled={settled} onStop={onStop} />} />}
        {page === 'network' && <Later show={({ NetworkPage }) => <NetworkPage robots={robots} live={fleet?.routes ?? []} />} />}
        {page === 'routes' && <Later show={({ Routes }) => <Routes open={open} now_ms={now_ms - now_ms % kStep_ms} />} />}
        {page === 'schedules' && <Later show={({ Schedules }) => <Schedules robots={robots.map(({ name }) => name)} />} />}
        {page === 'history' && <Later show={({ History }) => <History open={open} live={fleet?.missions ?? []} now_ms={now_ms} />} />}
        {page === 'users' && <Later show={({ Users }) => <Users />} />}
      </main>
      {!onWall && <footer>
        <p id="stop-help">
          Stop holds the robot, even after a restart, until it is released. <strong>Not an emergency
          stop:</strong> a robot that is out of reach drives on. Use the red button on the robot.
        </p>
        <NoticeChoice />
        <p>
          {servers.map((server) => (
            <span key={server.name}>
              Route server <strong>{server.name}</strong>: {server.last_heard_unix_ms === null ? 'online' : `offline for ${age(now_ms - server.last_heard_unix_ms)}`}.{' '}
            </span>
          ))}
          <a href="#wall">Wall screen</a> · <a href="/api/openapi.yaml">API</a>
        </p>
      </footer>}
    </Lost.Provider>
  );
}

createRoot(document.getElementById('page')!).render(<Doors><Page /></Doors>);
