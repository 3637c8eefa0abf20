import { useSyncExternalStore } from 'react';

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

// What the console says now; as before where it does not answer, and why not.
export async function askWhoIAm(): Promise<string> {
  try {
    const reply = await fetch('/api/me');
    const said = await reply.json();
    if (reply.status === 401) setMe('out');
    else if (!reply.ok) return said.error;
    else setMe(said);
    return '';
  } catch {
    return 'The console does not answer.';
  }
}

function listen(listener: () => void) {
  listeners.add(listener);
  return () => { listeners.delete(listener); };
}

export function useMe(): Known {
  return useSyncExternalStore(listen, () => known);
}

export function useMay(role: Me['role']): boolean {
  const me = useMe();
  const roles = ['look', 'operate', 'administer'];
  return me !== null && me !== 'out' && roles.indexOf(me.role) >= roles.indexOf(role);
}

// Where nobody logs in there are no users.
export function useMaySeeUsers(): boolean {
  const me = useMe();
  return me !== null && me !== 'out' && me.logs_in && me.role === 'administer';
}
