import type { Robot } from '../api';

const kLow_percent = 20;

function Battery({ percent }: { percent: number }) {
  const low = percent < kLow_percent;
  return (
    <li className={low ? 'low' : ''}>
      <svg viewBox="0 0 24 12" aria-hidden="true">
        <path className="frame" d="M1 1h19v10H1zM21 4h2v4h-2" />
        <rect x="3" y="3" width={(15 * percent) / 100} height="6" />
      </svg>
      {low ? '⚠ ' : ''}Battery {percent} %{low ? ', low' : ''}
    </li>
  );
}

// Bars, so many of four as the link is good.
function Link({ percent }: { percent: number }) {
  return (
    <li>
      <svg viewBox="0 0 24 12" aria-hidden="true">
        {[0, 1, 2, 3].map((bar) => (
          <rect key={bar} className={percent > 25 * bar ? '' : 'empty'} x={2 + 5 * bar} y={9 - 3 * bar} width="3" height={3 + 3 * bar} />
        ))}
      </svg>
      Radio {percent} %
    </li>
  );
}

export function Vitals({ robot }: { robot: Robot }) {
  const { battery_percent, link_percent, software, follows_by } = robot;
  return (
    <ul className="vitals">
      {battery_percent !== null && <Battery percent={battery_percent} />}
      {link_percent !== null && <Link percent={link_percent} />}
      {follows_by && <li>{follows_by}</li>}
      {software && <li title="Version of its agent">v{software}</li>}
    </ul>
  );
}
