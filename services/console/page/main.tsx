import { useEffect, useState } from 'react';
import { createRoot } from 'react-dom/client';
import { stopAll, type Fleet, type Robot, type StopAnswer } from './api';
import { remember } from './doubts';
import { age, useFleet } from './fleet';
import { History } from './runs/history';
import { Doors, OnlyLooks, WhoIsIn } from './login';
import { MapPage } from './map/map';
import { useMay } from './me';
import { Missions } from './missions';
import { NetworkPage } from './network/network';
import { Pages, usePage } from './pages';
import { RobotCard } from './robot/robot';
import { Routes } from './routes/routes';
import { Badge } from './robot/state';
import { Lines } from './robot/strip';
import { Lost } from './lost';
import { StopButton } from './stop';

function Attention({ robots, now_ms }: { robots: Robot[]; now_ms: number }) {
  const needing = robots.filter((robot) => robot.needs_person);
  if (needing.length === 0) return null;
  return (
    <section className="attention" aria-label="Needs attention">
      <h2>Needs attention</h2>
      <ul>
        {needing.map((robot) => (
          <li key={robot.name}>
            <a href={`#robot-${robot.name}`}>{robot.name}</a> <Badge state={robot.state} />{' '}
            {robot.last_heard_unix_ms === null ? robot.detail : `last seen ${age(now_ms - robot.last_heard_unix_ms)} ago`}
            {robot.last_heard_unix_ms !== null && robot.mission && `, in the middle of its mission '${robot.mission.orders || robot.mission.mission}'`}
          </li>
        ))}
      </ul>
    </section>
  );
}

function Robots({ fleet, settled, lost_ms, now_ms }: {
  fleet: Fleet | null;
  settled: boolean;
  lost_ms: number | null;
  now_ms: number;
}) {
  const robots = fleet?.robots ?? [];
  return (
    <>
      <Attention robots={robots} now_ms={now_ms} />
      <Lines robots={robots} />
      <section aria-label="Robots" className="robots">
        {!settled && robots.length === 0 && <p className="note">Searching for robots …</p>}
        {settled && robots.length === 0 && (
          <p className="note">No robot is heard. One that is on duty (<code>trailcast-agent serve</code>) shows up here.</p>
        )}
        {robots.map((robot) => (
          <RobotCard key={robot.name} robot={robot} lost_ms={lost_ms} now_ms={robot.heard && lost_ms === null ? 0 : now_ms} />
        ))}
      </section>
      <section aria-label="Missions">
        <h2>Missions</h2>
        <Missions missions={fleet?.missions ?? null} now_ms={now_ms} />
      </section>
    </>
  );
}

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
          {i > 0 && '; '}<a href={`#robot-${robot.name}`}>{robot.name}</a> ({seen(robot)})
        </span>
      ))}
      . It does not answer and may be moving: use its red button.
      {!lost && ' Stop is sent to it again and again, until it answers or you release it.'}
    </p>
  );
}

// Robots take so long to show what they have answered.
const kShown_ms = 2000;

// What was answered, for as long as the robots are so.
function useStopAnswer(robots: Robot[], lost: boolean, now_ms: number) {
  const [answer, setAnswer] = useState<StopAnswer | null>(null);
  const [at_ms, setAt] = useState(0);
  useEffect(() => {
    if (lost && answer?.ok) setAnswer(null);
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
  const { answer, say } = useStopAnswer(fleet?.robots ?? [], lost, now_ms);
  const { page, open } = usePage();
  const mayOperate = useMay('operate');
  useEffect(() => remember(fleet?.robots ?? []), [fleet]);
  const servers = fleet?.servers ?? [];
  const stop = async () => {
    say({ ok: true, text: 'Sending Stop to all robots …', robots: [] });
    say(await stopAll());
  };
  return (
    <Lost.Provider value={lost}>
      <div className="pinned">
        <header className="top">
          <h1>Trailcast</h1>
          <Pages page={page} />
          <WhoIsIn />
          {mayOperate && <StopButton onClick={stop} />}
        </header>
        {lost && (
          <p className="banner" role="alert">
            ⚠ Connection lost: Stop will not reach robots. Use the red button on the robot.{' '}
            {fleet ? `Data is from ${age(now_ms - heard_ms)} ago.`
              : 'The console does not answer, or too many pages are open. This page tries again.'}
          </p>
        )}
        <NotStopped robots={fleet?.robots ?? []} lost={lost} now_ms={now_ms} />
      </div>
      <p className={answer && !answer.ok ? 'answer top-answer bad' : 'answer top-answer'} role="status">
        {answer && (answer.ok ? '' : '⚠ ') + answer.text}
      </p>
      <OnlyLooks />
      {settled && !lost && !servers.some((server) => server.heard) && (
        <p className="banner" role="alert">
          ⚠ Route server offline: there are no routes to choose from, nothing is kept, and only robots in
          direct reach hear this console.
        </p>
      )}
      <main className={lost ? 'stale' : ''}>
        {page === 'fleet' && <Robots fleet={fleet} settled={settled} lost_ms={lost ? heard_ms : null} now_ms={now_ms} />}
        {page === 'map' && <MapPage robots={fleet?.robots ?? []} routes={fleet?.routes ?? []} settled={settled} />}
        {page === 'network' && <NetworkPage robots={fleet?.robots ?? []} live={fleet?.routes ?? []} />}
        {page === 'routes' && <Routes open={open} now_ms={now_ms - now_ms % kStep_ms} />}
        {page === 'history' && <History open={open} now_ms={now_ms} />}
      </main>
      <footer>
        <p id="stop-help">
          Stop holds the robot, even after a restart, until it is released. <strong>Not an emergency
          stop:</strong> a robot that is out of reach drives on. Use the red button on the robot.
        </p>
        <p>
          {servers.map((server) => (
            <span key={server.name}>
              Route server <strong>{server.name}</strong>: {server.last_heard_unix_ms === null ? 'online' : `offline for ${age(now_ms - server.last_heard_unix_ms)}`}.{' '}
            </span>
          ))}
          <a href="/api/openapi.yaml">API</a>
        </p>
      </footer>
    </Lost.Provider>
  );
}

createRoot(document.getElementById('page')!).render(<Doors><Page /></Doors>);
