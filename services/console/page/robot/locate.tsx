import { useState } from 'react';
import { send, type Answer, type Robot, type Route } from '../api';
import { RoutePicker } from '../routes/route-picker';
import { Line } from './strip';

// It tells a robot that is lost, or was set down by hand, where it stands. The robot looks whether that is so, without moving.
export function Locate({ robot, onAnswer }: { robot: Robot; onAnswer: (answer: Answer | null) => void }) {
  const last = robot.stood ?? robot;
  const [route, setRoute] = useState<Pick<Route, 'name' | 'route' | 'teaching' | 'length_m'> | null>(
    last.route_id ? { name: last.route, route: last.route_id, teaching: last.teaching, length_m: robot.length_m ?? 0 } : null);
  const [typed, setTyped] = useState('');
  const at_m = Number(typed.replace(',', '.'));
  const isPlace = typed.trim() !== '' && Number.isFinite(at_m) && at_m >= 0;
  const tell = async () => {
    if (!route || !isPlace) return;
    onAnswer(null);
    onAnswer(await send(robot.name, `locate ${route.name} ${at_m}`));
  };
  return (
    <section className="send locate" aria-label={`Where ${robot.name} stands`}>
      <RoutePicker label="It stands on route" live={[]} chosen={route as Route | null} onChoose={(to) => { setRoute(to); setTyped(''); }} />
      {route && (
        <Line on={{ route: route.name, route_id: route.route, teaching: route.teaching }} robots={[]} pin={isPlace ? at_m : null}
          onPlace={(along_m) => setTyped(along_m.toFixed(1))} />
      )}
      <label>Metres along it: click on the line, or type
        <input type="text" inputMode="decimal" value={typed} maxLength={9} autoComplete="off" onChange={(event) => setTyped(event.target.value)} />
      </label>
      <button disabled={!route || !isPlace} onClick={() => void tell()}>{route && isPlace ? `It stands at ${at_m} m of ${route.name}` : 'It stands here'}</button>
      <p className="note">It looks there, then along the whole route, and does not move. If it sees that it is elsewhere, it says so.</p>
    </section>
  );
}
