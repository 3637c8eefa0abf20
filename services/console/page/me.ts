import { useEffect, useSyncExternalStore } from 'react';

// Who looks at this page, and what the console lets them do.
export type Me = {
  user: string | null;
  role: 'look' | 'operate' | 'administer';
  logs_in: boolean;           // whether one has to
  only_looks: string | null;  // why nobody gives orders here
};

// 'out': one has to log in first.
export type Known = Me | 'out' | null;

let known: Known = null;
const listeners = new Set<() => void>();

export function setMe(now: Known) {
  if (JSON.stringify(now) === JSON.stringify(known)) return;
  known = now;
  listeners.forEach((listener) => listener());
}

// What the console says now; as before where it does not answer.
export async function askWhoIAm() {
  try {
    const reply = await fetch('/api/me');
    if (reply.status === 401) setMe('out');
    if (reply.ok) setMe(await reply.json());
  } catch {
    // The page says that it has lost its console.
  }
}

function listen(listener: () => void) {
  listeners.add(listener);
  return () => { listeners.delete(listener); };
}

export function useMe(): Known {
  const me = useSyncExternalStore(listen, () => known);
  useEffect(() => {
    if (known === null) askWhoIAm();
  }, []);
  return me;
}

export function useMay(role: Me['role']): boolean {
  const me = useMe();
  const roles = ['look', 'operate', 'administer'];
  return me !== null && me !== 'out' && roles.indexOf(me.role) >= roles.indexOf(role);
}
