import type { Robot } from './api';

// Where followers were less sure of their way than this, as far as this page has seen them.
export const kUnsure_m = 0.5;
const kBins = 128;
const kMostRoutes = 64;
const seen = new Map<string, boolean[]>();

export function remember(robots: Robot[]) {
  for (const { route_id, teaching, along_m, length_m, left_sigma_m } of robots) {
    if (!route_id || along_m === null || !length_m || !left_sigma_m || left_sigma_m < kUnsure_m) continue;
    const key = `${route_id} ${teaching}`;
    const bins = seen.get(key) ?? Array.from({ length: kBins }, () => false);
    bins[Math.min(kBins - 1, Math.max(0, Math.floor(kBins * along_m / length_m)))] = true;
    seen.delete(key);
    seen.set(key, bins);
    if (seen.size > kMostRoutes) seen.delete(seen.keys().next().value!);
  }
}

// Stretches of it, in the unit of `length`.
export function doubts(route: string, teaching: string, length: number): { begin: number; end: number }[] {
  const found: { begin: number; end: number }[] = [];
  seen.get(`${route} ${teaching}`)?.forEach((unsure, bin) => {
    if (!unsure) return;
    const begin = length * bin / kBins;
    const last = found[found.length - 1];
    if (last && last.end >= begin) last.end = begin + length / kBins;
    else found.push({ begin, end: begin + length / kBins });
  });
  return found;
}
