import { useCallback, useContext, useEffect, useState, type ReactNode } from 'react';
import { Lost } from './lost';
import { askWhoIAm } from './me';

type Seldom = typeof import('./seldom');

let loaded: Seldom | null = null;

// It shows what is loaded only once it is wanted. A console of another version has none of it: this page is then loaded anew.
export function Later({ show }: { show: (pages: Seldom) => ReactNode }) {
  const lost = useContext(Lost);
  const [pages, setPages] = useState(loaded);
  const [why, setWhy] = useState('');
  const load = useCallback(async (again: boolean) => {
    setWhy('');
    try {
      loaded = await import('./seldom');
      setPages(loaded);
    } catch {
      const problem = await askWhoIAm();
      if (again && !problem) window.location.reload();
      setWhy(problem || 'Either the connection is poor, or the console is of another version by now.');
    }
  }, []);
  useEffect(() => {
    if (!loaded) void load(false);
  }, [load, lost]);
  if (pages) return <>{show(pages)}</>;
  if (!why) return <p className="note" role="status">Loading …</p>;
  return (
    <div className="banner" role="alert">
      <p>⚠ This part of the page could not be loaded. {why}</p>
      <button onClick={() => void load(true)}>Try again</button>
    </div>
  );
}
