import { useContext, useEffect, useState } from 'react';
import { sendTo, stopOne, stopsSaid, tell, type Answer, type Order, type Robot } from '../api';
import { compareNames, when } from '../fleet';
import { Lost } from '../lost';
import type { PhotosBody } from '../photos/asked';
import { labels } from '../robot/robot';
import { Send } from '../robot/send';
import { mayMove } from '../robot/state';

// Browsers keep six connections to a console. One is for what it tells, and a stop finds one that is free.
const kAtOnce = 3;

// Robots that move are told first, and those that are not heard last, because each takes seconds not to answer.
const rank = (robot: Robot) => (!robot.heard ? 2 : mayMove(robot) ? 0 : 1);

// This tells each robot the same, and returns which did not obey, and why. It leaves out the rest once `ends`.
async function tellEach(robots: Robot[], say: (robot: string) => Promise<Answer>, ends: () => boolean, onSaid: (count: number) => void) {
  const waiting = [...robots].sort((one, other) => rank(one) - rank(other)).map(({ name }) => name);
  const failed: { robot: string; why: string }[] = [];
  let count = 0;
  const work = async () => {
    for (let robot = waiting.shift(); robot !== undefined; robot = waiting.shift()) {
      const said = ends() ? { ok: false, text: 'not told, because a stop was sent meanwhile' } : await say(robot);
      if (!said.ok) failed.push({ robot, why: said.text.startsWith(robot) ? said.text.slice(robot.length).replace(/^:? /, '') : said.text });
      onSaid(++count);
    }
  };
  await Promise.all(Array.from({ length: kAtOnce }, work));
  return failed.sort((one, other) => compareNames(one.robot, other.robot));
}

const counted = (count: number) => `${count} robot${count === 1 ? '' : 's'}`;

// This does one thing to several robots at once. Its answer has a time, because robots go on.
export function Several({ robots, hidden, onClear }: { robots: Robot[]; hidden: number; onClear: () => void }) {
  const [sends, setSends] = useState(false);
  const [busy, setBusy] = useState('');
  const [answer, setAnswer] = useState<{ text: string; bad: boolean; failed: { robot: string; why: string }[] } | null>(null);
  const who = robots.map(({ name }) => name).join(' ');
  useEffect(() => setAnswer(null), [who]);
  const all = async (what: string, say: (robot: string) => Promise<Answer>, isStop = false) => {
    const of = robots.length;
    const stops = stopsSaid();
    setAnswer(null);
    setBusy(`Sending ${what} to ${counted(of)} …`);
    const failed = await tellEach(robots, say, () => !isStop && stopsSaid() !== stops, (count) => setBusy(`Sending ${what} to ${counted(of)}: ${count} done …`));
    setBusy('');
    setAnswer({
      bad: failed.length > 0,
      text: `${what}, ${when(Date.now()).slice(11)}: ${failed.length === 0 ? (of === 1 ? 'it obeyed.' : `all ${of} obeyed.`) : `${of - failed.length} of ${of} obeyed. Did not:`}`,
      failed,
    });
  };
  // All get it or none.
  const sendAll = async (orders: string, photos: PhotosBody) => {
    setSends(false);
    setAnswer(null);
    setBusy(`Sending Mission to ${counted(robots.length)} …`);
    const said = await sendTo(robots.map(({ name }) => name).join(','), orders, photos);
    setBusy('');
    const outcome = !said.ok ? said.text : robots.length === 1 ? 'it obeyed.' : `all ${robots.length} obeyed.`;
    setAnswer({ bad: !said.ok, text: `Mission, ${when(Date.now()).slice(11)}: ${outcome}`, failed: [] });
  };
  const order = (given: Order) => all(labels[given], (robot) => (given === 'stop' ? stopOne(robot) : tell(robot, given)), given === 'stop');
  const moves = robots.some(mayMove);
  const lost = useContext(Lost);
  return (
    <section className="several" aria-label="Selected robots">
      <p>
        <strong>{counted(robots.length)} selected</strong>{hidden > 0 && `, ${hidden} of them not shown`}
        <button className="plain" onClick={onClear}>Clear</button>
      </p>
      <div className="orders">
        {/* A stop waits for nothing that was said before. */}
        <button className={`stop${lost ? ' cut' : moves ? '' : ' stands'}`} onClick={() => void order('stop')} aria-describedby="stop-help">Stop {robots.length}</button>
        <button disabled={busy !== ''} onClick={() => void order('pause')}>Pause</button>
        <button disabled={busy !== ''} onClick={() => void order('resume')}>Resume</button>
        <button disabled={busy !== ''} aria-expanded={sends} onClick={() => setSends(!sends)}>Send …</button>
      </div>
      {sends && busy === '' && (
        <Send who={counted(robots.length)} onGo={(orders, photos) => void sendAll(orders, photos)} />
      )}
      <div role="status">
        {busy && <p className="answer">{busy}</p>}
        {answer && <p className={answer.bad ? 'answer bad' : 'answer'}>{answer.bad && '⚠ '}{answer.text}</p>}
        {answer && answer.failed.length > 0 && (
          <ul>{answer.failed.map(({ robot, why }) => <li key={robot}><a href={`#fleet/${robot}`}>{robot}</a>: {why}</li>)}</ul>
        )}
      </div>
    </section>
  );
}
