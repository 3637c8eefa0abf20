import { useEffect, useState } from 'react';
import { get, send, type Answer, type Place, type Robot, type Way } from '../api';
import { textOf } from '../network/network-layout';
import { WayText } from '../network/way-text';
import { Slide } from '../robot/send';
import { isFree } from '../robot/state';

type Found = { way: Way } | { why: string } | null;

const whyNot = (robot: Robot) => (!robot.heard ? 'it is not heard'
  : robot.state === 'shut down' ? 'it is shut down'
  : robot.state === 'teaching' ? 'it teaches a route'
  : robot.mission ? `it is on its mission '${robot.mission.orders}'` : 'it drives');

// The chosen robot, to where somebody has clicked: the way is shown, then a slide sends it.
export function SendTo({ robot, place, onWay, onEnd }: {
  robot: Robot | null;
  place: Place;
  onWay: (way: Way | null) => void;
  onEnd: () => void;
}) {
  const [found, setFound] = useState<Found>(null);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const to = textOf(place);
  const from = robot && isFree(robot) ? robot.name : '';
  useEffect(() => {
    let over = false;
    setFound(null);
    setAnswer(null);
    onWay(null);
    if (!from) return;
    void get<Way>('/api/network/way', { from, to }).then((reply) => {
      if (over) return;
      if (typeof reply === 'string') return setFound({ why: reply });
      if (!reply.orders) return setFound({ why: `${from} is there already.` });
      setFound({ way: reply });
      onWay(reply);
    });
    return () => { over = true; };
  }, [from, to]);
  const go = async (way: Way) => {
    setAnswer({ ok: true, text: 'Sending …' });
    const said = await send(from, way.orders);
    setAnswer({ ...said, text: `${from}: ${said.text}` });
    if (said.ok) onWay(null);
  };
  return (
    <section className="send-to" aria-label={`Send to ${to}`}>
      <p>
        <strong>{to}</strong>{' '}
        {robot === null ? 'Choose a robot to send there.'
          : !from ? `${robot.name} cannot be sent there now: ${whyNot(robot)}.`
          : found === null ? 'Loading the path …'
          : 'why' in found ? `⚠ ${found.why}` : ''}
      </p>
      {found !== null && 'way' in found && <WayText to={to} way={found.way} />}
      {found !== null && 'way' in found && !answer?.ok && <Slide label={`Slide to send ${from} to ${to}`} onDone={() => go(found.way)} />}
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>{answer && (answer.ok ? '' : '⚠ ') + answer.text}</p>
      <button onClick={() => { onWay(null); onEnd(); }}>{answer?.ok ? 'Close' : 'Cancel'}</button>
    </section>
  );
}
