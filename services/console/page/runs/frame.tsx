import { useEffect, useState } from 'react';
import { marks, MarksLegend } from '../robot/snapshot';
import type { Frame, Seen, Verdict } from './runs';

const words: Verdict[] = ['inside', 'left', 'right', 'rejected'];
const colours = Object.fromEntries(words.map((word, i) => [word, marks[i].colour])) as Record<Verdict, string>;
const kFull_rad = 0.3;  // a turn that fills half of the bar

type Size = { width: number; height: number };

// Of a log without pictures nobody knows how large they were: as large as features are far apart.
function sizeOf(seen: Seen | null): Size {
  const width = Math.max(320, ...(seen?.features ?? []).map((each) => each[0]));
  const height = Math.max(240, ...(seen?.features ?? []).map((each) => each[1]));
  return { width: Math.ceil(width), height: Math.ceil(height) };
}

function usePicture(address: string | null): { address: string; size: Size } | null {
  const [loaded, setLoaded] = useState<{ address: string; size: Size } | null>(null);
  useEffect(() => {
    if (!address) return setLoaded(null);
    let still = true;
    const image = new Image();
    image.onload = () => {
      if (still) setLoaded({ address, size: { width: image.naturalWidth, height: image.naturalHeight } });
    };
    image.src = address;
    return () => { still = false; };
  }, [address]);
  return loaded;
}

function Feature({ feature: [u, v, toU, toV, verdict], unit }: { feature: Seen['features'][number]; unit: number }) {
  const colour = colours[verdict];
  const tip = verdict === 'left' ? -1 : 1;
  const half = 4 * unit;
  return (
    <g stroke={colour} fill={colour} strokeWidth={unit}>
      <path d={`M${u} ${v}L${toU} ${toV}`} />
      {verdict === 'inside' && <circle cx={u} cy={v} r={2.5 * unit} />}
      {(verdict === 'left' || verdict === 'right') && <path d={`M${u + tip * half} ${v}L${u - tip * half} ${v - half}V${v + half}z`} />}
      {verdict === 'rejected' && <path strokeWidth={1.5 * unit} d={`M${u - half} ${v - half}L${u + half} ${v + half}M${u + half} ${v - half}L${u - half} ${v + half}`} />}
    </g>
  );
}

function Turn({ frame }: { frame: Frame }) {
  const share = Math.max(-1, Math.min(1, frame.turn_rad / kFull_rad));
  const tip = 160 + 150 * share;
  const back = tip - Math.sign(share) * Math.min(8, Math.abs(tip - 160));
  const colour = share > 0 ? colours.right : colours.left;
  return (
    <svg className="turn" viewBox="0 0 320 20" role="img" aria-label={`Turn asked for: ${Math.abs((frame.turn_rad * 180) / Math.PI).toFixed(1)} degrees ${frame.turn_rad > 0 ? 'right' : 'left'}`}>
      <path d="M160 2v16" stroke="#ebebeb" />
      <path d={`M160 10H${back}`} stroke={colour} strokeWidth="4" />
      <path d={`M${tip} 10 ${back} 4v12z`} fill={colour} />
    </svg>
  );
}

// What the robot saw: the picture, if its log has some, with the features over it; and the turn that
// it asked for.
export function FramePicture({ run, frame, seen, row }: { run: string; frame: Frame; seen: Seen | null; row: number }) {
  const picture = usePicture(seen?.picture != null ? `/api/runs/${run}/frames/${seen.picture}/picture` : null);
  const { width, height } = picture?.size ?? sizeOf(seen);
  const unit = width / 320;
  const old = seen?.picture_age_s ?? 0;
  return (
    <figure className="frame">
      <svg viewBox={`0 0 ${width} ${height}`} role="img" data-row={row} aria-label={`What it saw: ${seen?.features.length ?? 0} features${picture ? '' : ', no picture'}`}>
        <rect className="nothing" width={width} height={height} />
        {picture && <image href={picture.address} width={width} height={height} />}
        {seen?.features.map((feature, i) => <Feature key={i} feature={feature} unit={unit} />)}
      </svg>
      <Turn frame={frame} />
      <figcaption className="note">
        {picture ? (old > 0.05 ? `The picture is from ${old.toFixed(1)} s before, the features are of this frame. ` : '')
          : seen?.features.length ? 'The log has no picture of this frame. ' : 'The log does not say where features were. '}
        {(seen?.features.length ?? 0) > 0 && 'Lines lead to where a feature will be at the milestone; of a rejected one, to where it should be.'}
      </figcaption>
      {(seen?.features.length ?? 0) > 0 && <MarksLegend />}
    </figure>
  );
}
