import { useEffect, useId, useRef, useState, type KeyboardEvent, type PointerEvent } from 'react';
import { drive, send, tell, type Answer, type Robot } from '../api';
import { kName } from '../routes/labels';
import { Slide } from './send';

// A word each; a robot that hears none for 300 ms stands.
const kEvery_ms = 100;
const kTurn_radps = 0.8;
const kPad = 100;

const kTaken = ['follow', 'wait', 'teach'];
const kMostTags = 16;

export function Teach({ robot, onAnswer }: { robot: string; onAnswer: (answer: Answer | null) => void }) {
  const [name, setName] = useState('');
  const [words, setWords] = useState('');
  const id = useId();
  const tags = words.split(/[\s,]+/).filter((tag) => tag !== '');
  const bad = tags.find((tag) => !kName.test(tag) || kTaken.includes(tag));
  const wrong = /\s/.test(name)
    ? `A name has no spaces: ${name.trim().replace(/\s+/g, '-')} would do.`
    : name !== '' && !kName.test(name)
    ? 'A name has letters, digits and "_", "-", "." alone.'
    : bad !== undefined ? `“${bad}” cannot be a tag: one has letters, digits and "_", "-", "." alone, and is not called ${kTaken.join(', ')}.`
    : tags.length > kMostTags ? `At most ${kMostTags} tags.` : '';
  const go = async () => {
    onAnswer(null);
    onAnswer(await send(robot, ['teach', name, ...tags].join(' ')));
  };
  return (
    <div className="send">
      <div className="fields">
        <label htmlFor={`${id}n`}>Name of the route
          <input id={`${id}n`} type="text" value={name} autoComplete="off" autoCapitalize="off" spellCheck={false}
            maxLength={64} onChange={(event) => setName(event.target.value)} />
        </label>
        <label htmlFor={`${id}t`}>Tags
          <input id={`${id}t`} type="text" value={words} autoComplete="off" autoCapitalize="off" spellCheck={false}
            placeholder="wet gravel" onChange={(event) => setWords(event.target.value)} />
        </label>
      </div>
      {wrong && <p className="note" role="alert">{wrong}</p>}
      {!wrong && name === '' && <p className="note">A name that is known already gives that route a new revision.</p>}
      {!wrong && name !== '' && <Slide label={`Slide to have ${robot} teach ${name}`} onDone={go} />}
    </div>
  );
}

type Stick = { ahead: number; left: number };  // -1 to 1 each
const kCentre: Stick = { ahead: 0, left: 0 };

// Says ten times a second where `stick` is, one word at a time, so that none waits behind another;
// and that it is let go.
function useDriving(robot: string, speed_mps: number): { stick: Stick; hold: (to: Stick) => void; trouble: string } {
  const [stick, setStick] = useState(kCentre);
  const [trouble, setTrouble] = useState('');
  const now = useRef({ stick: kCentre, speed_mps, said: kCentre, under_way: false });
  now.current.speed_mps = speed_mps;

  const hold = (to: Stick) => {
    now.current.stick = to;
    setStick(to);
  };
  useEffect(() => {
    const driver = `page-${Math.floor(Math.random() * 2 ** 32).toString(16)}`;
    const say = async () => {
      const state = now.current;
      const at = state.stick;
      const stands = at.ahead === 0 && at.left === 0;
      const stood = state.said.ahead === 0 && state.said.left === 0;
      if (state.under_way || (stands && stood)) return;
      state.under_way = true;
      const why = await drive(robot, {
        linear_mps: at.ahead * state.speed_mps,
        turn_radps: at.left * kTurn_radps,
        driver,
        said_ms: Math.round(performance.now()),
      });
      state.under_way = false;
      state.said = at;
      setTrouble(stands ? '' : why);
    };
    const timer = window.setInterval(say, kEvery_ms);
    const stand = () => {
      hold(kCentre);
      void say();
    };
    const hidden = () => document.hidden && stand();
    window.addEventListener('blur', stand);
    document.addEventListener('visibilitychange', hidden);
    return () => {
      window.clearInterval(timer);
      window.removeEventListener('blur', stand);
      document.removeEventListener('visibilitychange', hidden);
    };
  }, [robot]);
  return { stick, hold, trouble };
}

const kKeys: Record<string, Stick> = {
  w: { ahead: 1, left: 0 }, ArrowUp: { ahead: 1, left: 0 },
  s: { ahead: -1, left: 0 }, ArrowDown: { ahead: -1, left: 0 },
  a: { ahead: 0, left: 1 }, ArrowLeft: { ahead: 0, left: 1 },
  d: { ahead: 0, left: -1 }, ArrowRight: { ahead: 0, left: -1 },
};
const bound = (value: number) => Math.max(-1, Math.min(1, value));

function Pad({ robot, stick, hold }: { robot: string; stick: Stick; hold: (to: Stick) => void }) {
  const keys = useRef(new Set<string>());
  const letGo = () => {
    keys.current.clear();
    hold(kCentre);
  };
  const pressed = () => {
    const held = [...keys.current].map((key) => kKeys[key]);
    hold({
      ahead: bound(held.reduce((sum, key) => sum + key.ahead, 0)),
      left: bound(held.reduce((sum, key) => sum + key.left, 0)),
    });
  };
  const named = (event: KeyboardEvent) => (event.key.length === 1 ? event.key.toLowerCase() : event.key);
  const down = (event: KeyboardEvent) => {
    if (!(named(event) in kKeys) || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault();
    if (event.repeat) return;
    keys.current.add(named(event));
    pressed();
  };
  const up = (event: KeyboardEvent) => {
    if (keys.current.delete(named(event))) pressed();
  };
  const at = (event: PointerEvent<HTMLDivElement>) => {
    const box = event.currentTarget.getBoundingClientRect();
    const x = (event.clientX - box.left) / box.width * 2 - 1;
    const y = (event.clientY - box.top) / box.height * 2 - 1;
    const far = Math.max(1, Math.hypot(x, y));
    // A thumb that means to go straight on is never quite in the middle.
    const dead = (value: number) => (Math.abs(value) < 0.12 ? 0 : value);
    hold({ ahead: dead(-y / far), left: dead(-x / far) });
  };
  return (
    <div
      className="pad" tabIndex={0} role="application"
      aria-label={`Drive ${robot}: hold W, A, S, D or the arrow keys; let go and it stands`}
      onKeyDown={down} onKeyUp={up} onBlur={letGo}
      onPointerDown={(event) => {
        event.currentTarget.setPointerCapture(event.pointerId);
        at(event);
      }}
      onPointerMove={(event) => event.currentTarget.hasPointerCapture(event.pointerId) && at(event)}
      onPointerUp={letGo} onPointerCancel={letGo} onLostPointerCapture={letGo}
      onContextMenu={(event) => event.preventDefault()}
    >
      <svg viewBox={`${-kPad} ${-kPad} ${2 * kPad} ${2 * kPad}`} aria-hidden="true">
        <circle className="rim" r={kPad - 3} />
        <path className="arrows" d="M0-88 12-70H-12zM0 88 12 70H-12zM-88 0-70-12V12zM88 0 70-12V12z" />
        <circle className="knob" cx={-stick.left * 60} cy={-stick.ahead * 60} r="26" />
      </svg>
    </div>
  );
}

// While a robot teaches: what it has, and how it goes on.
export function Teaching({ robot, onAnswer }: { robot: Robot; onAnswer: (answer: Answer) => void }) {
  const [speed, setSpeed] = useState('0.3');
  const [discards, setDiscards] = useState(false);
  const { stick, hold, trouble } = useDriving(robot.name, Number(speed));
  const id = useId();
  const held = robot.state === 'paused' || robot.state === 'stopped';
  const drives = stick.ahead !== 0 || stick.left !== 0;
  // Why it stands although it is driven.
  const told = trouble || (drives && !held ? robot.detail : '');
  const end = async (order: 'end' | 'cancel') => {
    hold(kCentre);
    onAnswer({ ok: true, text: order === 'end' ? 'Sending End …' : 'Sending Discard …' });
    onAnswer(await tell(robot.name, order));
  };
  return (
    <section className="lesson" aria-label={`${robot.name} teaches ${robot.route}`}>
      <dl>
        <div><dt>Route</dt><dd>{robot.route}</dd></div>
        <div><dt>Taught</dt><dd>{robot.along_m === null ? '–' : `${robot.along_m.toFixed(1)} m`}</dd></div>
        <div><dt>Speed</dt><dd>{robot.speed_mps.toFixed(2)} m/s</dd></div>
        <div><dt>Segments</dt><dd>{robot.segments}</dd></div>
        <div><dt>Features in view</dt><dd>{robot.features}</dd></div>
      </dl>
      <div className="drive">
        <Pad robot={robot.name} stick={stick} hold={hold} />
        <div>
          <p>
            {held ? 'It is held, and stands until it is told to resume.'
              : drives && told ? 'It is not driven from here.'
              : drives ? 'You drive. Let go and it stands.'
              : 'Put your thumb on the pad, or click it and hold W A S D or the arrow keys. Or drive the robot by its own joystick.'}
          </p>
          <label htmlFor={`${id}s`}>Max speed
            <select id={`${id}s`} value={speed} onChange={(event) => setSpeed(event.target.value)}>
              <option value="0.15">0.15 m/s</option>
              <option value="0.3">0.3 m/s</option>
              <option value="0.5">0.5 m/s</option>
              <option value="0.8">0.8 m/s</option>
            </select>
          </label>
          <p className="answer bad" role="status">{told && `⚠ ${told}`}</p>
        </div>
      </div>
      <div className="orders">
        <button className="first" onClick={() => end('end')}>End: the route is complete</button>
        {discards
          ? <button className="discard" onClick={() => end('cancel')}>Yes, discard what was taught</button>
          : <button onClick={() => setDiscards(true)}>Discard …</button>}
        {discards && <button onClick={() => setDiscards(false)}>Keep teaching</button>}
        {discards && (
          <p className="note">
            No robot follows what is discarded. What a route server has of it by then stays listed there as cut off, until an
            administrator deletes it.
          </p>
        )}
      </div>
    </section>
  );
}
