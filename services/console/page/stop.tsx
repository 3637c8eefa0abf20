import { useContext } from 'react';
import { Lost } from './lost';
import { shapes } from './robot/state';

// It stays pressable while the connection is lost: it may be back before the page has noticed.
export function StopButton({ robot, onClick }: { robot?: string; onClick: () => void }) {
  const lost = useContext(Lost);
  const title = lost ? 'Connection lost: Stop will not arrive. Use the red button on the robot.'
    : 'Holds the robot until it is released. Not an emergency stop.';
  return (
    <button className={`stop${robot ? '' : ' all'}${lost ? ' cut' : ''}`} onClick={onClick} aria-describedby="stop-help" title={title}>
      {robot && <svg viewBox="0 0 16 16" aria-hidden="true"><path d={shapes.stopped} /></svg>}
      {robot ? 'Stop' : 'Stop all'}
      {robot && <span className="hidden"> {robot}</span>}
      {lost && <span className="why"> will not arrive</span>}
    </button>
  );
}
