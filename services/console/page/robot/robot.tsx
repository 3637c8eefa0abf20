import { memo, useEffect, useState } from 'react';
import { tell, type Answer, type Order, type Robot } from '../api';
import { age } from '../fleet';
import { Glance } from './glance';
import { useMay } from '../me';
import { Send } from './send';
import { Badge } from './state';
import { StopButton } from '../stop';
import { Strip } from './strip';
import { Teach, Teaching } from './teach';
import { Vitals } from './vitals';

const labels: Record<Order, string> = {
  pause: 'Pause', resume: 'Resume', cancel: 'Cancel mission', stop: 'Stop', release: 'Release', end: 'End',
};

// A robot takes so long to show what it has answered.
const kShown_ms = 2000;

// The older what is known of a robot, the fainter.
function agedBy(ms: number): string {
  return ms < 30000 ? 'aged-little' : ms < 300000 ? 'aged' : 'aged-much';
}

// Drawn anew only when the robot has changed: there may be a hundred. `now_ms` counts for one that
// is not heard, or of which the page hears nothing since `lost_ms`.
export const RobotCard = memo(function RobotCard({ robot, lost_ms, now_ms }: {
  robot: Robot;
  lost_ms: number | null;
  now_ms: number;
}) {
  const seen_ms = robot.last_heard_unix_ms ?? lost_ms;
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [answered_ms, setAnswered] = useState(0);
  // What it answered is so no longer once it does something else.
  useEffect(() => {
    if (Date.now() > answered_ms + kShown_ms) setAnswer(null);
  }, [robot.state, robot.unanswered_stop_unix_ms]);
  const say = (said: Answer) => {
    setAnswer(said);
    setAnswered(Date.now());
  };
  const [open, setOpen] = useState<'' | 'send' | 'teach'>('');
  const [looking, setLooking] = useState(false);
  const order = async (given: Order) => {
    say({ ok: true, text: `Sending ${labels[given]} …` });
    say(await tell(robot.name, given));
  };
  const sent = (to: Answer | null) => {
    say(to ?? { ok: true, text: 'Sending …' });
    if (to?.ok) setOpen('');
  };
  const mayOperate = useMay('operate');
  const obeys = mayOperate && robot.role === 'follower';
  const others = robot.orders.filter((each) => each !== 'stop' && !(robot.teaches && (each === 'end' || each === 'cancel')));
  const mission = robot.mission;
  const maySend = !mission && !['driving', 'teaching', 'shut down'].includes(robot.state);
  return (
    <article id={`robot-${robot.name}`} className={seen_ms === null ? '' : `unheard ${agedBy(now_ms - seen_ms)}`} aria-label={robot.name}>
      <header>
        <h2>{robot.name}</h2>
        <Badge state={robot.state} />
        {obeys && (
          <StopButton robot={robot.name} onClick={() => order('stop')} />
        )}
      </header>
      {seen_ms !== null && <p className="last-heard">Last seen {age(now_ms - seen_ms)} ago; data below is stale.</p>}
      {robot.detail && robot.detail !== robot.state && <p className="detail">{robot.detail}</p>}
      {robot.route && !robot.teaches && robot.route_id && <Strip robot={robot} />}
      {robot.route && !robot.teaches && !robot.route_id && (
        <p className="note">Route {robot.route}: it has not found its place there yet.</p>
      )}
      <Vitals robot={robot} />
      {mission && (
        <p className="mission">
          Mission <code>{mission.mission}</code> of {mission.sent_by || 'somebody'}: {mission.orders || '(orders not told)'}
          {' '}– <strong>{mission.state}</strong>
        </p>
      )}
      <div className="orders">
        {obeys && others.map((each) => (
          <button key={each} onClick={() => order(each)}>{labels[each]}</button>
        ))}
        {obeys && maySend && (['send', 'teach'] as const).map((each) => (
          <button key={each} aria-expanded={open === each} onClick={() => setOpen(open === each ? '' : each)}>
            {each === 'send' ? 'Send …' : 'Teach …'}
          </button>
        ))}
        {robot.state !== 'shut down' && (
          <button aria-expanded={looking} onClick={() => setLooking(!looking)}>Camera</button>
        )}
      </div>
      {looking && robot.state !== 'shut down' && <Glance robot={robot} />}
      {obeys && open === 'send' && maySend && <Send robot={robot.name} onAnswer={sent} />}
      {obeys && open === 'teach' && maySend && <Teach robot={robot.name} onAnswer={sent} />}
      {obeys && robot.teaches && seen_ms === null && <Teaching robot={robot} onAnswer={say} />}
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>
        {answer && (answer.ok ? '' : '⚠ ') + answer.text}
      </p>
    </article>
  );
});
