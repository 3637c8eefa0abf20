import { useState } from 'react';

const kKept = 'trailcast-theme';
const themes = { system: 'Auto', light: 'Light', dark: 'Dark' };
type Theme = keyof typeof themes;

const dark = window.matchMedia('(prefers-color-scheme: dark)');

function kept(): Theme {
  try {
    const theme = window.localStorage.getItem(kKept) ?? '';
    return theme in themes ? (theme as Theme) : 'system';
  } catch {
    return 'system';  // nothing is kept in this browser
  }
}

function show(theme: Theme) {
  const isDark = theme === 'dark' || (theme === 'system' && dark.matches);
  document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
}

// Before anything is drawn, and as the system changes.
show(kept());
dark.addEventListener('change', () => show(kept()));

export function choose(theme: Theme) {
  try {
    window.localStorage.setItem(kKept, theme);
  } catch {
    // It is so until the page is loaded again.
  }
  show(theme);
}

export function ThemeChoice() {
  const [theme, setTheme] = useState(kept);
  return (
    <label className="theme" title="Colours: as the system has them, light or dark">
      <span className="hidden">Colours</span>
      <select value={theme} onChange={({ target }) => { choose(target.value as Theme); setTheme(target.value as Theme); }}>
        {Object.entries(themes).map(([name, label]) => <option key={name} value={name}>{label}</option>)}
      </select>
    </label>
  );
}
