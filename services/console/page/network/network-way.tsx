import { useEffect, useRef } from 'react';
import { get, type Answer, type Way } from '../api';
import { Field, type Draft } from './network-changes';
import { WayText } from './way-text';

// From one place to another, for whoever wants to know: nobody is sent.
export function FindWay({ draft, onDraft, names, way, onWay, onAnswer }: {
  draft: Draft;
  onDraft: (draft: Draft) => void;
  names: string[];
  way: Way | null;
  onWay: (way: Way | null) => void;
  onAnswer: (answer: Answer | null) => void;
}) {
  const [from, to] = [draft.first.trim(), draft.second.trim()];
  const latest = useRef<object | null>(null);
  // An answer is about the places that it was asked for.
  useEffect(() => {
    onWay(null);
    onAnswer(null);
    return () => { latest.current = null; };
  }, [from, to]);
  const ask = async () => {
    const question = {};
    latest.current = question;
    onAnswer({ ok: true, text: 'Loading the path …' });
    const found = await get<Way>('/api/network/way', { from, to });
    if (latest.current !== question) return;
    const there = typeof found !== 'string' && !found.orders;
    onWay(typeof found === 'string' || there ? null : found);
    onAnswer(typeof found === 'string' ? { ok: false, text: found } : there ? { ok: true, text: 'That is the same place.' } : null);
  };
  return (
    <>
      <div className="net-fields">
        <Field label="From (click there, or a name, a robot, ROUTE@METRES)" list="net-places" value={draft.first} onChange={(value) => onDraft({ ...draft, first: value })} />
        <Field label="To" list="net-places" value={draft.second} onChange={(value) => onDraft({ ...draft, second: value })} />
        <datalist id="net-places">{names.map((name) => <option key={name} value={name} />)}</datalist>
        <button disabled={!from || !to} onClick={ask}>Find a path</button>
      </div>
      {way && <div className="net-way"><WayText to={to} way={way} /></div>}
    </>
  );
}
