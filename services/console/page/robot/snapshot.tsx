import { useEffect, useRef, useState } from 'react';
import type { Robot } from '../api';

const kEvery_ms = 200;
const kAgain_ms = 1000;  // after none came

type Look = {
  text: string;        // what the robot says of the picture
  marked: boolean;     // features are drawn on it
  why: string | null;  // there is no picture
};

// Pulls picture after picture, the next when the last has come: slow networks slow it down, and
// nothing queues. Only while the canvas is in view, in a tab that is.
function pull(robot: string, canvas: HTMLCanvasElement, tell: (look: Look) => void): () => void {
  let over = false;
  let inView = false;
  let asking = false;
  let timer: number | undefined;
  const giveUp = new AbortController();

  const once = async (): Promise<number> => {
    const began = performance.now();
    try {
      const reply = await fetch(`/api/robots/${robot}/snapshot`, { signal: giveUp.signal });
      if (!reply.ok) {
        tell({ text: '', marked: false, why: (await reply.json()).error });
        return kAgain_ms;
      }
      const bitmap = await createImageBitmap(await reply.blob());
      canvas.width = bitmap.width;
      canvas.height = bitmap.height;
      canvas.getContext('2d')!.drawImage(bitmap, 0, 0);
      bitmap.close();
      tell({ text: reply.headers.get('Trailcast-Seen') ?? '', marked: reply.headers.get('Trailcast-Marked') === '1', why: null });
      return Math.max(0, kEvery_ms - (performance.now() - began));
    } catch {
      if (!over) tell({ text: '', marked: false, why: 'The console does not answer.' });
      return kAgain_ms;
    }
  };
  const next = async () => {
    if (asking || over || !inView || document.visibilityState !== 'visible') return;
    asking = true;
    const pause_ms = await once();
    asking = false;
    timer = window.setTimeout(next, pause_ms);
  };
  const look = () => {
    window.clearTimeout(timer);
    void next();
  };
  const observer = new IntersectionObserver(([entry]) => {
    inView = entry.isIntersecting;
    look();
  });
  observer.observe(canvas);
  document.addEventListener('visibilitychange', look);
  return () => {
    over = true;
    giveUp.abort();
    window.clearTimeout(timer);
    observer.disconnect();
    document.removeEventListener('visibilitychange', look);
  };
}

// The colours and shapes of the picture's marks.
export const marks = [
  { label: 'on course', colour: '#00c878', shape: 'M8 4a4 4 0 1 0 0.01 0z' },
  { label: 'steer left', colour: '#46aaff', shape: 'M3 8 13 3v10z' },
  { label: 'steer right', colour: '#ff9600', shape: 'M13 8 3 3v10z' },
  { label: 'rejected', colour: '#e62828', shape: 'M3 3 13 13M13 3 3 13' },
];

export function MarksLegend() {
  return (
    <ul aria-label="Marks in the picture">
      {marks.map((mark) => (
        <li key={mark.label}>
          <svg viewBox="0 0 16 16" aria-hidden="true">
            <path d={mark.shape} fill={mark.colour} stroke={mark.colour} strokeWidth="2" />
          </svg>
          {mark.label}
        </li>
      ))}
    </ul>
  );
}

function beside(robot: Robot): string | null {
  if (robot.left_m === null || robot.left_sigma_m === null) return null;
  return `${Math.abs(robot.left_m).toFixed(2)} m ${robot.left_m < 0 ? 'right' : 'left'} of the path, ± ${robot.left_sigma_m.toFixed(2)} m`;
}

// `brief`: the picture, and in a line what the robot makes of it.
export function Snapshot({ robot, brief = false }: { robot: Robot; brief?: boolean }) {
  const canvas = useRef<HTMLCanvasElement>(null);
  const [look, setLook] = useState<Look>({ text: '', marked: false, why: 'Waiting for a picture …' });
  useEffect(() => {
    return pull(robot.name, canvas.current!, setLook);
  }, [robot.name]);
  const place = beside(robot);
  return (
    <figure className="snapshot">
      <div className={look.why === null ? 'picture' : 'picture old'}>
        <canvas ref={canvas} width="320" height="240" role="img" aria-label={`What the camera of ${robot.name} sees`} />
        {look.why !== null && <p className="why">{look.why}</p>}
      </div>
      {brief && <p className="note">{look.text || '–'}</p>}
      {!brief && <dl>
        {look.text && <><dt>View</dt><dd>{look.text}</dd></>}
        {robot.along_m !== null && (
          <><dt>Position</dt><dd>{robot.along_m.toFixed(2)} m{robot.length_m !== null && ` of ${robot.length_m.toFixed(2)} m`}, segment {robot.segment}</dd></>
        )}
        {place !== null && <><dt>Lateral offset</dt><dd>{place}</dd></>}
      </dl>}
      {look.marked && !brief && <MarksLegend />}
    </figure>
  );
}
