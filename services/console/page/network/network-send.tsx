import { useEffect, useState } from 'react';
import { get, send, type Answer, type Robot, type Way } from '../api';
import { standing } from './network-layout';
import { WayText } from './way-text';
import { PhotoFields } from '../photos/fields';
import { bodyOf, noPhotos } from '../photos/asked';
import { Slide } from '../robot/send';
import { isFree } from '../robot/state';

export type Shown = { robot: string; to: string; way: Way };

function whereOf(robot: Robot): string {
  const stands = standing(robot);
  return stands ? `${stands.last ? 'last ' : ''}at ${stands.along_m!.toFixed(1)} m of ${stands.route}` : 'its place is not known';
}

// To a place by the shortest way, which is shown before it is sent.
export function SendThere({ robots, to, onTo, names, shown, onShown, onAnswer }: {
  robots: Robot[];
  to: string;
  onTo: (to: string) => void;
  names: string[];
  shown: Shown | null;
  onShown: (shown: Shown | null) => void;
  onAnswer: (answer: Answer | null) => void;
}) {
  const [robot, setRobot] = useState('');
  const [from, setFrom] = useState('');
  const [photos, setPhotos] = useState(noPhotos);
  const free = robots.filter(isFree);
  const chosen = free.find((each) => each.name === robot)?.name ?? free[0]?.name ?? '';
  // A way is of one robot, to one place.
  useEffect(() => onShown(null), [chosen, from, to]);
  const ask = async () => {
    onAnswer({ ok: true, text: 'Loading the path …' });
    const way = await get<Way>('/api/network/way', { from: from.trim() || chosen, to: to.trim() });
    if (typeof way === 'string') {
      onShown(null);
      return onAnswer({ ok: false, text: way });
    }
    if (!way.orders) {
      onShown(null);
      return onAnswer({ ok: true, text: `${from.trim() || chosen} is there already.` });
    }
    onAnswer(null);
    onShown({ robot: chosen, to: to.trim(), way });
  };
  const go = async () => {
    if (!shown) return;
    onAnswer({ ok: true, text: 'Sending …' });
    const answer = await send(shown.robot, shown.way.orders, bodyOf(photos));
    onAnswer({ ...answer, text: `${shown.robot}: ${answer.text}` });
    if (answer.ok) onShown(null);
  };
  if (free.length === 0) return <p className="note">No robot is free: each drives, is on a mission, or is not heard.</p>;
  return (
    <>
      <div className="net-fields">
        <label>Robot
          <select value={chosen} onChange={(event) => setRobot(event.target.value)}>
            {free.map((each) => (
              <option key={each.name} value={each.name}>
                {each.name}, {whereOf(each)}
              </option>
            ))}
          </select>
        </label>
        <label>To (click there, or a name, or ROUTE@METRES)
          <input type="text" list="net-places" value={to} maxLength={128} autoComplete="off" autoCapitalize="none" spellCheck={false}
            onChange={(event) => onTo(event.target.value)} />
        </label>
        <label>From, if the robot has not said where it stands
          <input type="text" list="net-places" value={from} maxLength={128} autoComplete="off" autoCapitalize="none" spellCheck={false}
            onChange={(event) => setFrom(event.target.value)} />
        </label>
        <datalist id="net-places">{names.map((name) => <option key={name} value={name} />)}</datalist>
        <button disabled={!to.trim()} onClick={ask}>Show the path</button>
      </div>
      {shown && (
        <div className="net-way">
          <WayText to={shown.to} way={shown.way} />
          <div className="net-fields"><PhotoFields asked={photos} onChange={setPhotos} /></div>
          <Slide label={`Slide to send ${shown.robot} to ${shown.to}`} onDone={go} />
        </div>
      )}
    </>
  );
}
