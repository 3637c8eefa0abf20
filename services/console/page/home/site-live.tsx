import { useEffect, useMemo, useState } from 'react';
import { get, type NetworkPart, type Place, type Robot, type Route, type Way } from '../api';
import { Later } from '../later';
import type { Site } from '../map/plan';
import { useMay } from '../me';
import { layOut, textOf, withRobots } from '../network/network-layout';
import { NetworkMap } from '../network/network-map';
import { useNetwork } from '../network/use-network';
import { isFree } from '../robot/state';
import { Lines } from '../robot/strip';
import { SendTo } from './send-to';

const layers = { lines: 'Routes', network: 'Network', shape: 'Shape', site: 'Site' };
type Layer = keyof typeof layers;
const kKept = 'trailcast-layer';
const kQuery = { search: '', around: '', limit: '60' };

function kept(): Layer | null {
  try {
    const layer = window.localStorage.getItem(kKept) ?? '';
    return layer in layers ? (layer as Layer) : null;
  } catch {
    return null;
  }
}

// What shows most of where robots are: the plan, if routes lie upon it, or how routes are joined.
export function useBest(asked: boolean): Layer | null {
  const [best, setBest] = useState<Layer | null>(null);
  useEffect(() => {
    if (!asked) return;
    let over = false;
    void (async () => {
      const site = await get<Site>('/api/site', {});
      if (typeof site !== 'string' && Object.keys(site.placements).length > 0) return over || setBest('site');
      const part = await get<NetworkPart>('/api/network', kQuery);
      if (!over) setBest(typeof part !== 'string' && part.network.joints.length > 0 ? 'network' : 'lines');
    })();
    return () => { over = true; };
  }, []);
  return best;
}

export function NetworkLive({ robots, live, way, pin, onPlace }: {
  robots: Robot[];
  live: Route[];
  way: Way | null;
  pin: Place | null;
  onPlace: (place: Place) => void;
}) {
  const { part, why } = useNetwork(kQuery);
  const [chosen, setChosen] = useState('');
  const still = useMemo(() => part && layOut(part, live), [part, live]);
  const layout = useMemo(() => still && withRobots(still, robots, live), [still, robots, live]);
  if (!layout) return <p className={why ? 'answer bad' : 'note'} role="status">{why ? `⚠ ${why}` : 'Loading the network …'}</p>;
  return (
    <>
      {why && <p className="answer bad" role="status">⚠ {why} What is drawn is from before.</p>}
      {layout.rows.length === 0 && <p className="note">No routes are joined, and no robot is on one. <a href="#network">Join routes</a></p>}
      {layout.rows.length > 0 && (
        <NetworkMap layout={layout} still={still!.rows} chosen={chosen} onChoose={setChosen} onPlace={onPlace}
          overlay={{ way: way?.way.stretches ?? [], stretch: null, pins: pin ? [textOf(pin)] : [] }} />
      )}
      {layout.strays.length > 0 && (
        <p className="note">Not drawn, on other routes or revisions: {layout.strays.slice(0, 20).map((robot) => robot.name).join(', ')}</p>
      )}
    </>
  );
}

// The site, with every robot upon it.
export function SiteLive({ robots, live, settled, chosen }: {
  robots: Robot[];
  live: Route[];
  settled: boolean;
  chosen: Robot | null;
}) {
  const [wanted, setWanted] = useState(kept);
  const best = useBest(wanted === null);
  const layer = wanted ?? best;
  const [place, setPlace] = useState<Place | null>(null);
  const [way, setWay] = useState<Way | null>(null);
  const mayOperate = useMay('operate');
  const choose = (to: Layer) => {
    setWanted(to);
    try {
      window.localStorage.setItem(kKept, to);
    } catch {
      // It is so until the page is loaded again.
    }
  };
  const onPlace = (to: Place) => mayOperate && setPlace({ route: to.route, along_m: Math.round(to.along_m * 10) / 10 });
  const map = { robots, live, pin: place, onPlace };
  return (
    <section className="pane site-live" aria-label="Site">
      <header>
        <h2>Site</h2>
        <div className="layers" role="radiogroup" aria-label="Layer">
          {(Object.keys(layers) as Layer[]).map((each) => (
            <label key={each}>
              <input type="radio" name="layer" checked={layer === each} onChange={() => choose(each)} />
              {layers[each]}
            </label>
          ))}
        </div>
      </header>
      {place && <SendTo key={textOf(place)} robot={chosen} place={place} onWay={setWay} onEnd={() => setPlace(null)} />}
      {layer === null && <p className="note">Loading …</p>}
      {layer === 'lines' && <Lines robots={robots} chosen={chosen?.name ?? ''} settled={settled} pin={place} onPlace={onPlace} />}
      {layer === 'network' && <NetworkLive {...map} way={way} />}
      {layer === 'shape' && <div className="map"><Later show={({ ShapeView }) => <ShapeView {...map} settled={settled} />} /></div>}
      {layer === 'site' && <div className="map"><Later show={({ SiteView }) => <SiteView {...map} />} /></div>}
      {mayOperate && layer !== null && !place && (
        <p className="note">
          {chosen && isFree(chosen) ? `Click on a route to send ${chosen.name} there: its path is shown first.`
            : 'Choose a robot that is available: a click on a route then shows its path there, and sends it.'}
        </p>
      )}
    </section>
  );
}
