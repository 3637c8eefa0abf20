import { useCallback, useEffect, useState } from 'react';
import { get, type NetworkPart } from '../api';

const kEvery_ms = 3000;

export type Query = { search: string; around: string; limit: string };

// Asked for anew as long as the page is seen. What was there last stays where the console does not answer.
export function useNetwork(query: Query): { part: NetworkPart | null; why: string; again: () => void } {
  const [part, setPart] = useState<NetworkPart | null>(null);
  const [why, setWhy] = useState('');
  const [asks, setAsks] = useState(0);
  useEffect(() => {
    let over = false;
    let timer: number | undefined;
    let last = '';
    const ask = async () => {
      if (!document.hidden) {
        const reply = await get<NetworkPart>('/api/network', query);
        if (over) return;
        setWhy(typeof reply === 'string' ? reply : '');
        const text = JSON.stringify(reply);
        if (typeof reply !== 'string' && text !== last) {
          last = text;
          setPart(reply);
        }
      }
      timer = window.setTimeout(ask, kEvery_ms);
    };
    void ask();
    return () => {
      over = true;
      window.clearTimeout(timer);
    };
  }, [query.search, query.around, query.limit, asks]);
  const again = useCallback(() => setAsks((times) => times + 1), []);
  return { part, why, again };
}
