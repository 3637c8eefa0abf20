import { useEffect, useState } from 'react';

// What stands behind the address's #: "#routes", and "#routes/.." for what is open on that page.
const pages = { fleet: 'Home', cameras: 'Cameras', network: 'Network', routes: 'Routes', schedules: 'Schedules', history: 'History' };

// A robot's own page, a wall's screen and the users have no place in the list.
const others = ['wall', 'users'];
export type PageName = keyof typeof pages | 'robot' | 'wall' | 'users';

function here(): { page: PageName; open: string } {
  const [name, open = ''] = window.location.hash.slice(1).split('/');
  return { page: name in pages || (name === 'robot' && open) || others.includes(name) ? (name as PageName) : 'fleet', open };
}

export function usePage(): { page: PageName; open: string } {
  const [at, setAt] = useState(here);
  useEffect(() => {
    const moved = () => setAt(here());
    window.addEventListener('hashchange', moved);
    return () => window.removeEventListener('hashchange', moved);
  }, []);
  return at;
}

export function Pages({ page }: { page: PageName }) {
  return (
    <nav aria-label="Pages">
      {Object.entries(pages).map(([name, label]) => (
        <a key={name} href={`#${name}`} aria-current={name === page || (name === 'fleet' && page === 'robot') ? 'page' : undefined}>{label}</a>
      ))}
    </nav>
  );
}
