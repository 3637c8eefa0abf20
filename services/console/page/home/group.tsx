import { useState } from 'react';
import { sendTo, tell, type Answer, type Mission } from '../api';
import { isOver } from '../missions';
import type { PhotosBody } from '../photos/asked';
import { Send } from '../robot/send';

// Sends whichever robot of a group is free first, and tells what waits for one.
export function GroupSend({ group, missions }: { group: string; missions: Mission[] }) {
  const [sends, setSends] = useState(false);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const to = `@${group}`;
  const waiting = missions.filter((mission) => mission.robot === to && !isOver(mission)).reverse();
  const go = async (orders: string, photos: PhotosBody) => {
    setSends(false);
    setAnswer({ ok: true, text: 'Sending …' });
    setAnswer(await sendTo(to, orders, photos));
  };
  return (
    <section className="several" aria-label={`Group ${group}`}>
      <div className="orders">
        <button aria-expanded={sends} onClick={() => setSends(!sends)}>Send one of {group} …</button>
        {waiting.length > 0 && <button onClick={async () => setAnswer(await tell(to, 'cancel'))}>Cancel what waits</button>}
      </div>
      {sends && <Send who={`a free robot of ${group}`} onGo={(orders, photos) => void go(orders, photos)} />}
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>
        {answer && (answer.ok ? '' : '⚠ ') + answer.text}
      </p>
      {waiting.length > 0 && (
        <ol className="queue" aria-label={`Missions that wait for ${group}`}>
          {waiting.map((each) => <li key={each.mission}>{each.orders} <span className="note">{each.detail}</span></li>)}
        </ol>
      )}
    </section>
  );
}
