import { useEffect, useState } from 'react';
import { get, type Joint, type NetworkPart } from '../api';
import { isOn, metres, sidesOf, withoutRevision } from './network-layout';

type Met = { called: string; part: NetworkPart };

// A server calls a route by its name, or by its id where others have that name.
async function metBy(name: string, id: string): Promise<Met | string> {
  const ask = (of: string) => get<NetworkPart>('/api/network', { of, limit: '500' });
  const named = await ask(name);
  if (typeof named === 'string') return named;
  if (named.matched > 0) return { called: name, part: named };
  const part = await ask(id);
  return typeof part === 'string' ? part : { called: id, part };
}

function Place({ joint, called, how }: { joint: Omit<Joint, 'used'>; called: string; how: (way: string) => string }) {
  const { here, way, there } = sidesOf(joint, called);
  const route = withoutRevision(there.route) || there.route;
  return <li>At {metres(here.along_m)} m <a href={`#routes/${route}`}>{there.route}</a>, there at {metres(there.along_m)} m: {how(way)}</li>;
}

// The other routes that pass at a place of this one, by the network's joints.
export function Passing({ name, id, again }: { name: string; id: string; again: unknown }) {
  const [met, setMet] = useState<Met | string | null>(null);
  useEffect(() => {
    let still = true;
    metBy(name, id).then((reply) => still && setMet(reply));
    return () => { still = false; };
  }, [name, id, again]);
  if (met === null) return <p className="note">Loading the routes that pass here …</p>;
  if (typeof met === 'string') return <p className="note" role="status">Which routes pass here: {met}</p>;
  const { called, part: { network, left_out } } = met;
  const places = [
    ...network.joints.map((joint) => ({
      joint, how: (way: string) => `joined, ${way} there${joint.used ? '' : ', not used: one is of another revision than robots follow'}`,
    })),
    ...(network.proposed ?? []).map((joint) => ({
      joint, how: () => `proposed, ${Math.round(100 * joint.confidence)} % sure: not joined until somebody confirms it`,
    })),
  ].filter(({ joint }) => isOn(joint, called));
  places.sort((one, other) => sidesOf(one.joint, called).here.along_m - sidesOf(other.joint, called).here.along_m);
  return (
    <section className="life" aria-label="Which routes pass here">
      <h3>Routes that pass here</h3>
      {places.length > 0 && <ul className="plain">{places.map((each, i) => <Place key={i} called={called} {...each} />)}</ul>}
      <p className="note">
        {places.length === 0 && 'No other route is known to pass. '}{left_out > 0 && `${left_out} junctions are left out. `}
        <a href="#network">The network</a> is where routes are joined, and what is proposed is confirmed.
      </p>
    </section>
  );
}
