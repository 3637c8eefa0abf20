import { memo, useEffect, useState } from 'react';
import { forget, send, tell, type Answer, type Order, type Robot } from '../api';
import { Copy } from '../copy';
import { age } from '../fleet';
import { Later } from '../later';
import { Snapshot } from './snapshot';
import { useMay } from '../me';
import { Send, Slide } from './send';
import { Badge, mayMove } from './state';
import { StopButton } from '../stop';
import { Strip } from './strip';
import { Charts } from './trace';
import { Vitals } from './vitals';

export const labels: Record<Order, string> = {
  pause: 'Pause', resume: 'Resume', cancel: 'Cancel mission', stop: 'Stop', release: 'Release', end: 'End', home: 'Go home',
};

// A robot takes so long to show what it has answered.
const kShown_ms = 2000;

// The older what is known of a robot, the fainter.
function agedBy(ms: number): string {
  return ms < 30000 ? 'aged-little' : ms < 300000 ? 'aged' : 'aged-much';
}

// Where there is room for it. A phone's link may be slow, and paid for.
const hasRoom = () => window.matchMedia('(min-width: 64rem)').matches;

// Drawn anew only when the robot has changed. `now_ms` counts for one that is not heard, or of which
// the page hears nothing since `lost_ms`.
export const RobotCard = memo(function RobotCard({ robot, lost_ms, now_ms, alone = false }: {
  robot: Robot;
  lost_ms: number | null;
  now_ms: number;
  alone?: boolean;  // on a page of its own
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
  const [wants, setWants] = useState<boolean | null>(null);
  // Whoever drives it has to see where.
  const looking = wants ?? (robot.teaches || hasRoom());
  const [sureGone, setSureGone] = useState(false);
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
  const queue = robot.queue;
  const may = { send: robot.state !== 'shut down' && (mission !== null || robot.state !== 'driving'),
    teach: !mission && queue.length === 0 && !['driving', 'teaching', 'shut down'].includes(robot.state) };
  const seesIt = robot.state !== 'shut down' && robot.heard;
  const mayDismiss = mayOperate && (!robot.heard || robot.state === 'shut down') && robot.unanswered_stop_unix_ms === null && lost_ms === null;
  return (
    <article className={seen_ms === null ? 'robot' : `robot unheard ${agedBy(now_ms - seen_ms)}`} aria-label={robot.name}>
      <header>
        <h2>{robot.name}</h2>
        <Badge state={robot.state} />
        {obeys && <StopButton robot={robot.name} moves={mayMove(robot)} onClick={() => order('stop')} />}
      </header>
      {seen_ms !== null && <p className="last-heard">Last seen {age(now_ms - seen_ms)} ago; data below is stale.</p>}
      {robot.detail && robot.detail !== robot.state && <p className="detail">{robot.detail}</p>}
      <div className="orders">
        {obeys && others.map((each) => (
          <button key={each} onClick={() => order(each)}>{labels[each]}</button>
        ))}
        {obeys && (['send', 'teach'] as const).filter((each) => may[each]).map((each) => (
          <button key={each} aria-expanded={open === each} onClick={() => setOpen(open === each ? '' : each)}>
            {each === 'teach' ? 'Teach …' : mission || queue.length > 0 ? 'Queue …' : 'Send …'}
          </button>
        ))}
        {mayDismiss && (
          <button title="It is listed again once it is heard"
            onClick={async () => (mayMove(robot) && !sureGone ? setSureGone(true) : say(await forget(robot.name)))}>
            {sureGone ? 'Dismiss, though Stop all no longer means it' : 'Dismiss'}
          </button>
        )}
        {seesIt && <button aria-expanded={looking} onClick={() => setWants(!looking)}>Camera</button>}
        {!alone && <a className="button" href={`#robot/${robot.name}`}>Open page</a>}
      </div>
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>
        {answer && (answer.ok ? '' : '⚠ ') + answer.text}
      </p>
      {obeys && open === 'send' && may.send && <Send who={robot.name} onGo={async (orders, photos) => { sent(null); sent(await send(robot.name, orders, photos)); }} />}
      {obeys && open === 'send' && may.send && <Slide label={`Slide to send ${robot.name} home`} onDone={() => order('home')} />}
      {obeys && open === 'teach' && may.teach && <Later show={({ Teach }) => <Teach robot={robot.name} onAnswer={sent} />} />}
      {looking && seesIt && robot.teaches && <Snapshot robot={robot} brief />}
      {obeys && robot.teaches && seen_ms === null && <Later show={({ Teaching }) => <Teaching robot={robot} onAnswer={say} />} />}
      {robot.route && !robot.teaches && robot.route_id && <Strip robot={robot} />}
      {robot.route && !robot.teaches && !robot.route_id && (
        <p className="note">Route {robot.route}: it has not found its place there yet.</p>
      )}
      {looking && seesIt && !robot.teaches && <Snapshot robot={robot} />}
      {mission && (
        <p className="mission">
          Mission of {mission.sent_by || 'somebody'}: {mission.orders || '(orders not told)'} – <strong>{mission.state}</strong>{' '}
          <Copy id={mission.mission} what="mission" />
        </p>
      )}
      {queue.length > 0 && (
        <ol className="queue" aria-label="Queue">
          {queue.map((each) => <li key={each.mission}>{each.orders} <span className="note">{each.detail}</span></li>)}
        </ol>
      )}
      <Charts robot={robot} />
      <Vitals robot={robot} />
    </article>
  );
});
