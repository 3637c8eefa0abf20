import { useEffect, useState, type ReactNode } from 'react';
import { get, type Fleet, type RoutePage } from '../api';
import { keep, kept } from '../kept';
import { useMay } from '../me';

const kKept = 'trailcast-guide';
const kAgain_ms = 3000;
const choices = { show: 'show', hide: 'hide' };

// How many routes servers keep; null as long as none has said.
function useRouteCount(asks: boolean): number | null {
  const [count, setCount] = useState<number | null>(null);
  useEffect(() => {
    if (!asks || (count ?? 0) > 0) return;
    let over = false;
    const look = async () => {
      const page = await get<RoutePage>('/api/routes', { limit: '1' });
      if (!over && typeof page !== 'string') setCount(page.total);
    };
    void look();
    const timer = window.setInterval(() => !document.hidden && void look(), kAgain_ms);
    return () => {
      over = true;
      window.clearInterval(timer);
    };
  }, [asks, count]);
  return count;
}

function Step({ title, done, is, children }: { title: string; done: string; is: boolean; children: ReactNode }) {
  return (
    <li className={is ? 'done' : ''}>
      <strong>{title}</strong>
      <p>{is ? <><span aria-hidden="true">✓ </span>{done}</> : children}</p>
    </li>
  );
}

// Leads from an empty page to a first robot, a first route and a first mission. What ticks a step off is what is heard.
export function Guide({ fleet, settled }: { fleet: Fleet | null; settled: boolean }) {
  const [hidden, setHidden] = useState(() => kept<keyof typeof choices>(kKept, choices, 'show') === 'hide');
  const [shown, setShown] = useState(false);
  const mayOperate = useMay('operate');
  const asks = mayOperate && settled && !hidden;
  const routes = useRouteCount(asks);
  const robot = fleet?.robots.find(({ role }) => role === 'follower')?.name ?? '';
  const mission = fleet?.missions?.find(({ state }) => state === 'arrived' || state === 'under way');
  const missing = robot === '' || routes === 0 || fleet?.missions?.length === 0;
  useEffect(() => {
    if (asks && missing) setShown(true);
  }, [asks, missing]);
  if (!asks || !shown) return null;
  const hide = () => {
    keep(kKept, 'hide');
    setHidden(true);
  };
  return (
    <section className="pane guide" aria-label="First steps">
      <header><h2>First steps</h2><button className="plain" onClick={hide}>Hide</button></header>
      <div role="status"><ol>
        <Step title="A robot" is={robot !== ''} done={`${robot} is heard.`}>
          Start its agent in this network: <code>trailcast-agent serve --ros2 /robot1 --name robot1 --store robot1.db</code>. It shows up by itself.
        </Step>
        <Step title="A route" is={(routes ?? 0) > 0} done={`Route servers keep ${routes} route${routes === 1 ? '' : 's'}.`}>
          {routes === null ? 'No route server has said yet whether it has any.' : <>Choose a robot, press <strong>Teach …</strong> and drive it along the way; <strong>End</strong> keeps the route.</>}
        </Step>
        <Step title="A mission" is={mission !== undefined} done={`${mission?.robot}: ${mission?.orders || 'mission'} – ${mission?.state}.`}>
          Press <strong>Send …</strong>, choose the route, and slide. <strong>Stop</strong> makes the robot stand at any time.
        </Step>
      </ol></div>
    </section>
  );
}
