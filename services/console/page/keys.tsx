import { useEffect, useRef, useState } from 'react';
import type { Order, Robot } from './api';
import { useMaySeeUsers } from './me';
import { choose } from './theme';
import { labels } from './robot/robot';

type Command = { text: string; run: () => void };

// Whoever types a text, or drives a robot by the letters, means no command.
const isTaken = (target: EventTarget | null) =>
  target instanceof HTMLElement && target.closest('input, textarea, select, [contenteditable], [role=application]') !== null;

const go = (hash: string) => () => { window.location.hash = hash; };

function commandsFor(robots: Robot[], mayOperate: boolean, maySeeUsers: boolean, onStopAll: () => void, onTell: (robot: string, order: Order) => void): Command[] {
  const commands: Command[] = mayOperate ? [{ text: 'Stop all', run: onStopAll }] : [];
  for (const robot of robots) {
    if (mayOperate && robot.role === 'follower') {
      // What moves a robot takes a slide.
      const pressed = (['stop', 'pause', 'resume', 'release', 'cancel'] as const).filter((order) => robot.orders.includes(order));
      for (const order of pressed) commands.push({ text: `${labels[order]}: ${robot.name}`, run: () => onTell(robot.name, order) });
    }
    commands.push({ text: `Show ${robot.name}`, run: go(`fleet/${robot.name}`) }, { text: `Open page of ${robot.name}`, run: go(`robot/${robot.name}`) });
  }
  for (const [hash, name] of [['fleet', 'Home'], ['cameras', 'Cameras'], ['network', 'Network'], ['routes', 'Routes'], ['history', 'History'], ['history/alerts', 'Alerts'], ['wall', 'Wall screen']]) {
    commands.push({ text: `Go to ${name}`, run: go(hash) });
  }
  if (maySeeUsers) commands.push({ text: 'Go to Users', run: go('users') });
  for (const theme of ['system', 'light', 'dark'] as const) commands.push({ text: `Colours: ${theme}`, run: () => choose(theme) });
  return commands;
}

const kMost = 12;

function Palette({ commands, onEnd }: { commands: Command[]; onEnd: () => void }) {
  const dialog = useRef<HTMLDialogElement>(null);
  const [words, setWords] = useState('');
  const [at, setAt] = useState(0);
  useEffect(() => dialog.current!.showModal(), []);
  const wanted = words.toLowerCase().split(/\s+/);
  const found = commands.filter(({ text }) => wanted.every((word) => text.toLowerCase().includes(word))).slice(0, kMost);
  const chosen = Math.min(at, Math.max(0, found.length - 1));
  const run = (command?: Command) => {
    if (!command) return;
    onEnd();
    command.run();
  };
  return (
    <dialog ref={dialog} className="palette" aria-label="Commands" onClose={onEnd} onClick={(event) => event.target === dialog.current && onEnd()}>
      <input
        type="text" role="combobox" aria-expanded="true" aria-controls="palette-list" aria-label="Command"
        aria-activedescendant={found.length > 0 ? `palette-${chosen}` : undefined} autoFocus autoComplete="off" spellCheck={false}
        placeholder="Stop robot-1, show robot-2, go to routes …" value={words}
        onChange={(event) => { setWords(event.target.value); setAt(0); }}
        onKeyDown={(event) => {
          const by = event.key === 'ArrowDown' ? 1 : event.key === 'ArrowUp' ? -1 : 0;
          if (by !== 0) {
            event.preventDefault();
            setAt(Math.max(0, Math.min(found.length - 1, chosen + by)));
          } else if (event.key === 'Enter') {
            event.preventDefault();
            if (words.trim() !== '') run(found[chosen]);  // a stray Enter does nothing
          }
        }}
      />
      <ul id="palette-list" role="listbox" aria-label="Commands">
        {found.map((command, i) => (
          <li key={command.text} id={`palette-${i}`} role="option" aria-selected={i === chosen} onClick={() => run(command)}>{command.text}</li>
        ))}
      </ul>
      {found.length === 0 && <p className="note">No command is so.</p>}
      <p className="note">Enter does it, Esc closes. Without this: S stops the chosen robot, Shift+S all, / or Ctrl+K opens it.</p>
    </dialog>
  );
}

// S stops the chosen robot, Shift+S all; Ctrl+K or / opens the list of what can be done.
export function Keys({ robots, chosen, mayOperate, onStop, onStopAll, onTell }: {
  robots: Robot[];
  chosen: string;
  mayOperate: boolean;
  onStop: (robot: string) => void;
  onStopAll: () => void;
  onTell: (robot: string, order: Order) => void;
}) {
  const [open, setOpen] = useState(false);
  const maySeeUsers = useMaySeeUsers();
  useEffect(() => {
    const pressed = (event: KeyboardEvent) => {
      const isK = event.key.toLowerCase() === 'k' && (event.ctrlKey || event.metaKey);
      if (isK || (event.key === '/' && !isTaken(event.target))) {
        event.preventDefault();
        return setOpen(true);
      }
      if (event.ctrlKey || event.metaKey || event.altKey || event.repeat || event.defaultPrevented || isTaken(event.target)) return;
      if (event.key.toLowerCase() !== 's' || !mayOperate) return;
      if (event.shiftKey) onStopAll();
      else if (chosen) onStop(chosen);
    };
    window.addEventListener('keydown', pressed);
    return () => window.removeEventListener('keydown', pressed);
  }, [chosen, mayOperate, onStop, onStopAll]);
  return (
    <>
      <button className="keys" aria-haspopup="dialog" title="Commands: Ctrl+K or /" onClick={() => setOpen(true)}>
        <span aria-hidden="true">⌘</span><span className="hidden">Commands</span>
      </button>
      {open && <Palette commands={commandsFor(robots, mayOperate, maySeeUsers, onStopAll, onTell)} onEnd={() => setOpen(false)} />}
    </>
  );
}
