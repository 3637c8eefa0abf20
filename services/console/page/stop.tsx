import { useContext } from 'react';
import { Lost } from './lost';
import { shapes } from './robot/state';

// It stays pressable while the connection is lost, for that may be back before the page has noticed;
// and while the robot stands, when it is outlined.
export function StopButton({ robot, moves, small = false, onClick }: {
  robot?: string;
  moves: boolean;
  small?: boolean;
  onClick: () => void;
}) {
  const lost = useContext(Lost);
  const title = lost ? 'Connection lost: Stop will not arrive. Use the red button on the robot.'
    : 'Holds the robot until it is released. Not an emergency stop.';
  const kind = `stop${robot ? '' : ' all'}${small ? ' small' : ''}${lost ? ' cut' : moves ? '' : ' stands'}`;
  return (
    <button className={kind} onClick={onClick} aria-describedby="stop-help" title={title} aria-keyshortcuts={robot ? undefined : 'Shift+S'}>
      {robot && <svg viewBox="0 0 16 16" aria-hidden="true"><path d={shapes.stopped} /></svg>}
      {small ? <span className="hidden">Stop {robot}</span> : robot ? 'Stop' : 'Stop all'}
      {robot && !small && <span className="hidden"> {robot}</span>}
      {lost && !small && <span className="why"> will not arrive</span>}
    </button>
  );
}
