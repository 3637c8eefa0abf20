import { useState } from 'react';
import type { NetworkPart } from '../api';

type Network = NetworkPart['network'];

function Percent({ label, value, onChange }: { label: string; value: string; onChange: (value: string) => void }) {
  return (
    <label>{label}
      <input type="number" min={1} max={100} value={value} onChange={(event) => onChange(event.target.value)} />
    </label>
  );
}

// When robots charge, and which do, in the server's words.
export function Charging({ network: { charge, charging, names }, onEdit }: { network: Network; onEdit: ((words: string) => void) | null }) {
  const [below, setBelow] = useState('20');
  const [until, setUntil] = useState('90');
  const docks = names.filter((named) => named.dock).length;
  if (!onEdit && !charge && docks === 0) return null;
  return (
    <section className="net-change" aria-label="Charging">
      <h2>Charging</h2>
      <p className="note">
        {charge
          ? `A robot with less than ${charge.below_percent} % goes to a free dock once its mission has ended, and goes on with its queue at ${charge.until_percent} %.`
          : 'Robots are not sent to docks by themselves.'}
        {docks === 0 && ' No place shown here is a dock: name one.'}
      </p>
      {charging.length > 0 && (
        <ul className="plain">
          {charging.map(({ robot, text }) => <li key={robot}><a href={`#fleet/${robot}`}>{robot}</a> {text}</li>)}
        </ul>
      )}
      {onEdit && (
        <div className="net-fields">
          <Percent label="Charge below, %" value={below} onChange={setBelow} />
          <Percent label="Until, %" value={until} onChange={setUntil} />
          <button onClick={() => onEdit(`charge below ${below} until ${until}`)}>{charge ? 'Change' : 'Send robots to charge'}</button>
          {charge && <button onClick={() => onEdit('charge never')}>Never</button>}
        </div>
      )}
    </section>
  );
}
