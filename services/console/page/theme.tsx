import { useState } from 'react';
import { keep, kept } from './kept';

const kKept = 'trailcast-theme';
const themes = { system: 'Auto', light: 'Light', dark: 'Dark' };
type Theme = keyof typeof themes;

const dark = window.matchMedia('(prefers-color-scheme: dark)');

const chosen = () => kept<Theme>(kKept, themes, 'system');

function show(theme: Theme) {
  const isDark = theme === 'dark' || (theme === 'system' && dark.matches);
  document.documentElement.dataset.theme = isDark ? 'dark' : 'light';
}

// Before anything is drawn, and as the system changes.
show(chosen());
dark.addEventListener('change', () => show(chosen()));

export function choose(theme: Theme) {
  keep(kKept, theme);
  show(theme);
}

export function ThemeChoice() {
  const [theme, setTheme] = useState(chosen);
  return (
    <label className="theme" title="Colours: as the system has them, light or dark">
      <span className="hidden">Colours</span>
      <select value={theme} onChange={({ target }) => { choose(target.value as Theme); setTheme(target.value as Theme); }}>
        {Object.entries(themes).map(([name, label]) => <option key={name} value={name}>{label}</option>)}
      </select>
    </label>
  );
}
