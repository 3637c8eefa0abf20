import { useEffect, useState } from 'react';

// What stands behind the address's #: "#routes", and "#routes/.." for what is open on that page.
const pages = { fleet: 'Fleet', map: 'Map', routes: 'Routes' };

export type PageName = keyof typeof pages;

function here(): PageName {
  const name = window.location.hash.slice(1).split('/')[0];
  return name in pages ? (name as PageName) : 'fleet';
}

export function usePage(): PageName {
  const [page, setPage] = useState(here);
  useEffect(() => {
    const moved = () => setPage(here());
    window.addEventListener('hashchange', moved);
    return () => window.removeEventListener('hashchange', moved);
  }, []);
  return page;
}

export function Pages({ page }: { page: PageName }) {
  return (
    <nav aria-label="Pages">
      {Object.entries(pages).map(([name, label]) => (
        <a key={name} href={`#${name}`} aria-current={name === page ? 'page' : undefined}>{label}</a>
      ))}
    </nav>
  );
}
