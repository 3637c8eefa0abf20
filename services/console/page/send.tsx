import { useId, useState } from 'react';
import { send, type Answer, type Route } from './api';

// What moves a robot takes a whole slide, or as many presses of an arrow key: a tap on the far end
// does not do.
const kWholeWay = 100;
const kFurthestAtOnce = 45;

function Slide({ label, onDone }: { label: string; onDone: () => void }) {
  const [at, setAt] = useState(0);
  const [from, setFrom] = useState(0);
  const move = (to: number) => {
    if (to - from > kFurthestAtOnce) return setAt(0);
    setFrom(to);
    setAt(to);
    if (to < kWholeWay) return;
    setFrom(0);
    setAt(0);
    onDone();
  };
  const letGo = () => {
    setFrom(0);
    setAt(0);
  };
  return (
    <label className="slide">
      <span>{label}</span>
      <input
        type="range" min={0} max={kWholeWay} step={10} value={at} aria-label={`${label}: slide, or press the right arrow key ten times`}
        onChange={(event) => move(Number(event.target.value))}
        onPointerUp={letGo} onPointerCancel={letGo} onBlur={letGo}
      />
    </label>
  );
}

export function Send({ robot, routes, onAnswer }: {
  robot: string;
  routes: Route[];
  onAnswer: (answer: Answer | null) => void;
}) {
  const [chosen, setChosen] = useState('');
  const [laps, setLaps] = useState(1);
  const [speed, setSpeed] = useState('1');
  const id = useId();
  const route = routes.find((each) => each.route === chosen) ?? routes[0];
  if (!route) return <p className="note">No route is known: teach one, or start the route server.</p>;
  const sameName = routes.filter((each) => each.name === route.name).length > 1;
  const name = sameName ? route.route : route.name;
  const orders = `follow ${name}` + (laps > 1 ? ` laps ${laps}` : '') + (speed !== '1' ? ` speed ${speed}` : '');
  const go = async () => {
    onAnswer(null);
    onAnswer(await send(robot, orders));
  };
  return (
    <div className="send">
      <div className="fields">
        <label htmlFor={`${id}r`}>Route
          <select id={`${id}r`} value={route.route} onChange={(event) => setChosen(event.target.value)}>
            {routes.map((each) => (
              <option key={each.route} value={each.route}>
                {each.name}{each.length_m > 0 ? `, ${each.length_m.toFixed(1)} m` : ''}
              </option>
            ))}
          </select>
        </label>
        <label htmlFor={`${id}l`}>Laps
          <input id={`${id}l`} type="number" min={1} max={100} value={laps}
            onChange={(event) => setLaps(Math.min(100, Math.max(1, Number(event.target.value) || 1)))} />
        </label>
        <label htmlFor={`${id}s`}>Speed
          <select id={`${id}s`} value={speed} onChange={(event) => setSpeed(event.target.value)}>
            <option value="1">as taught</option>
            <option value="0.75">three quarters</option>
            <option value="0.5">half</option>
            <option value="0.25">a quarter</option>
          </select>
        </label>
      </div>
      {laps > 1 && <p className="note">Several laps need a route whose end is its beginning.</p>}
      <Slide label={`Slide to send ${robot} along ${route.name}`} onDone={go} />
    </div>
  );
}
