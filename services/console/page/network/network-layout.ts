// Routes as lines of a railway map: metres along them to scale, how they bend not at all.
import type { Joint, LostStretch, NamedPlace, NetworkPart, Place, Proposal, Robot, Route, Stretch } from '../api';

export type Part = { from_m: number; to_m: number; stretch: Stretch };
// Where it stands, or stood last: then it is drawn as one that is not heard.
export type Standing = Robot & { last: boolean };
export type Row = {
  name: string;
  length_m: number;
  start_m: number;  // from the drawing's left
  joined: boolean;  // a server lists it
  closed: Part[];
  backed: Part[];
  limits: Part[];
  narrow: (Part & { takenBy: string[] })[];
  lost: (Part & { stretch: LostStretch })[];
  names: (NamedPlace & { along_m: number })[];
  joints: Joint[];
  proposed: Proposal[];
  elsewhere: number;  // joints with routes that are not shown
  robots: Standing[];
};
export type Spot = { row: number; along_m: number };
// Of a proposal how sure the server is of it.
export type Link = { joint: Omit<Joint, 'used'>; used: boolean; confidence: number | null; from: Spot; to: Spot };
export type Layout = { rows: Row[]; links: Link[]; end_m: number; strays: Standing[] };

export const withoutRevision = (route: string) => route.slice(0, Math.max(0, route.lastIndexOf('@')));

// "hall@12.5", "hall@2@12.5"; null: it is no place.
export function placeOf(words: string): Place | null {
  const at = words.lastIndexOf('@');
  const metres = words.slice(at + 1);
  if (at <= 0 || metres.trim() === '' || !(Number(metres) >= 0)) return null;
  return { route: words.slice(0, at), along_m: Number(metres) };
}

// To the centimetre.
export const metres = (value: number) => String(Math.round(value * 100) / 100);
export const textOf = (place: Place) => `${place.route}@${metres(place.along_m)}`;
export const rangeOf = (stretch: Stretch) =>
  stretch.from_m > 0 || stretch.to_m !== null
    ? `${metres(stretch.from_m)}..${stretch.to_m === null ? '' : metres(stretch.to_m)}` : '';

export function rowOf(rows: Row[], route: string): number {
  const exact = rows.findIndex((row) => row.name === route);
  return exact >= 0 ? exact : rows.findIndex((row) => row.name === withoutRevision(route));
}

// A joint from the row's own place to the other, and which way one may change over.
export function sidesOf(joint: Omit<Joint, 'used'>, row: string): { here: Place; way: string; there: Place } {
  const own = joint.from.route === row || withoutRevision(joint.from.route) === row;
  const [here, there] = own ? [joint.from, joint.to] : [joint.to, joint.from];
  return { here, way: joint.both ? 'to and from' : own ? 'to' : 'from', there };
}
// Whether it begins or ends there.
export const isOn = ({ from, to }: Omit<Joint, 'used'>, row: string) =>
  [from.route, to.route].some((route) => route === row || withoutRevision(route) === row);

export function spotOf(rows: Row[], place: Place): Spot | null {
  const row = rowOf(rows, place.route);
  return row < 0 ? null : { row, along_m: Math.min(rows[row].length_m, Math.max(0, place.along_m)) };
}

const partOf = (stretch: Stretch, length_m: number): Part => ({
  from_m: Math.min(stretch.from_m, length_m),
  to_m: Math.min(stretch.to_m ?? length_m, length_m),
  stretch,
});

// Those that are joined stand below each other: by breadth, from the first by name.
function inOrder(names: string[], joints: Joint[]): string[] {
  const known = new Set(names);
  const next = new Map<string, string[]>(names.map((name) => [name, []]));
  const nameOf = (route: string) => (known.has(route) ? route : withoutRevision(route));
  for (const { from, to } of joints) {
    next.get(nameOf(from.route))?.push(nameOf(to.route));
    next.get(nameOf(to.route))?.push(nameOf(from.route));
  }
  const ordered: string[] = [];
  const taken = new Set<string>();
  for (const first of [...names].sort()) {
    if (taken.has(first)) continue;
    taken.add(first);
    for (let at = ordered.push(first) - 1; at < ordered.length; ++at) {
      for (const name of next.get(ordered[at])!) {
        if (!known.has(name) || taken.has(name)) continue;
        taken.add(name);
        ordered.push(name);
      }
    }
  }
  return ordered;
}

// The first joint to a row above stands upright.
function place(rows: Row[], links: Link[]) {
  const upward = new Map<number, { here: Spot; above: Spot }>();
  for (const { from, to } of links) {
    if (from.row === to.row) continue;
    const [here, above] = from.row > to.row ? [from, to] : [to, from];
    if (!upward.has(here.row)) upward.set(here.row, { here, above });
  }
  rows.forEach((row, i) => {
    const joint = upward.get(i);
    if (joint) row.start_m = rows[joint.above.row].start_m + joint.above.along_m - joint.here.along_m;
  });
  const least = Math.min(0, ...rows.map((row) => row.start_m));
  for (const row of rows) row.start_m -= least;
}

// `live`: routes that robots are on; those that are joined to none are drawn, too, where `all` are.
export function layOut(part: NetworkPart, live: Route[]): Layout {
  const { network } = part;
  const lengths = new Map(network.routes.map((each) => [each.route, each.length_m]));
  const joined = new Set(lengths.keys());
  if (part.matched === part.routes && network.routes.length === part.routes) {
    for (const route of live) {
      const isListed = lengths.has(route.name) || lengths.has(route.route);
      if (!isListed && route.state === 'active' && route.length_m > 0) lengths.set(route.name, route.length_m);
    }
  }
  const rows = inOrder([...lengths.keys()], network.joints).map((name): Row => ({
    name, length_m: lengths.get(name)!, start_m: 0, joined: joined.has(name),
    closed: [], backed: [], limits: [], narrow: [], lost: [], names: [], joints: [], proposed: [], elsewhere: 0, robots: [],
  }));
  const links: Link[] = [];
  for (const joint of network.joints) {
    const from = spotOf(rows, joint.from);
    const to = spotOf(rows, joint.to);
    if (!from || !to) continue;
    links.push({ joint, used: joint.used, confidence: null, from, to });
    rows[from.row].joints.push(joint);
    if (to.row !== from.row) rows[to.row].joints.push(joint);
  }
  for (const proposal of network.proposed ?? []) {
    const from = spotOf(rows, proposal.from);
    const to = spotOf(rows, proposal.to);
    if (!from || !to) continue;
    links.push({ joint: proposal, used: true, confidence: proposal.confidence, from, to });
    rows[from.row].proposed.push(proposal);
    if (to.row !== from.row) rows[to.row].proposed.push(proposal);
  }
  for (const stretch of network.closed) {
    const row = rows[rowOf(rows, stretch.route)];
    row?.closed.push(partOf(stretch, row.length_m));
  }
  for (const stretch of network.backed ?? []) {
    const row = rows[rowOf(rows, stretch.route)];
    row?.backed.push(partOf(stretch, row.length_m));
  }
  for (const stretch of network.limits) {
    const row = rows[rowOf(rows, stretch.route)];
    row?.limits.push(partOf(stretch, row.length_m));
  }
  for (const { parts, taken_by: takenBy } of network.narrow ?? []) {
    for (const stretch of parts) {
      const row = rows[rowOf(rows, stretch.route)];
      row?.narrow.push({ ...partOf(stretch, row.length_m), takenBy });
    }
  }
  for (const stretch of network.lost ?? []) {
    const row = rows[rowOf(rows, stretch.route)];
    row?.lost.push({ ...partOf(stretch, row.length_m), stretch });
  }
  for (const named of network.names) {
    const spot = spotOf(rows, named.place);
    if (spot) rows[spot.row].names.push({ ...named, along_m: spot.along_m });
  }
  for (const { route, joints } of part.elsewhere) {
    const row = rows[rowOf(rows, route)];
    if (row) row.elsewhere = joints;
  }
  place(rows, links);
  const end_m = Math.max(1, ...rows.map((row) => row.start_m + row.length_m));
  return { rows, links, end_m, strays: [] };
}

export function standing(robot: Robot): Standing | null {
  if (robot.route_id && robot.along_m !== null) return { ...robot, last: false };
  return robot.stood && { ...robot, ...robot.stood, heard: false, last: true };
}
// "driving at 3.2 m", "free, last at 3.2 m".
export const standsHow = (robot: Standing) => `${robot.state}${robot.last ? ', last' : ''} at ${robot.along_m!.toFixed(1)} m`;

// Each on its route, if that is shown and it stands on the revision that is followed: where it is on
// another would be measured along another way.
export function withRobots(layout: Layout, robots: Robot[], live: Route[]): Layout {
  const followed = new Map(live.map((each) => [`${each.route} ${each.teaching}`, each.state === 'active']));
  const byName = new Map(layout.rows.map((row) => [row.name, row]));
  const on = new Map<Row, Standing[]>();
  const strays: Standing[] = [];
  for (const each of robots) {
    const robot = standing(each);
    if (!robot) continue;
    const row = byName.get(robot.route_id) ?? byName.get(robot.route);
    const isOn = row && (followed.get(`${robot.route_id} ${robot.teaching}`) ?? true);
    if (!isOn) strays.push(robot);
    else if (on.has(row)) on.get(row)!.push(robot);
    else on.set(row, [robot]);
  }
  // Rows without robots stay the same objects: there may be hundreds.
  const rows = layout.rows.map((row) => (on.has(row) ? { ...row, robots: on.get(row)! } : row));
  return { ...layout, rows, strays };
}

// "2 of 7 times lately, a metre counts as 1.9".
export const lostText = ({ lost, passed, cost }: LostStretch) => `${lost} of ${passed} times lately, a metre counts as ${cost}`;

// What there is, for who does not see it.
export function told(layout: Layout): string {
  const { rows, links } = layout;
  const closed = rows.flatMap((row) => row.closed.map((part) => `${row.name} ${metres(part.from_m)} to ${metres(part.to_m)} m`));
  const backed = rows.flatMap((row) => row.backed.map((part) => `${row.name} ${metres(part.from_m)} to ${metres(part.to_m)} m`));
  const narrow = rows.flatMap((row) => row.narrow.map((part) => `${row.name} ${metres(part.from_m)} to ${metres(part.to_m)} m`
    + (part.takenBy.length > 0 ? `, taken by ${part.takenBy.join(' and ')}` : '')));
  const lost = rows.flatMap((row) => row.lost.map((part) => `${row.name} ${metres(part.from_m)} to ${metres(part.to_m)} m, ${lostText(part.stretch)}`));
  const robots = rows.flatMap((row) => row.robots.map((robot) => `${robot.name} ${standsHow(robot)} of ${row.name}`));
  const some = (words: string[]) => words.slice(0, 20).join('; ') + (words.length > 20 ? ` and ${words.length - 20} more` : '');
  const proposed = links.filter((link) => link.confidence !== null).length;
  return `${rows.length} routes, ${links.length - proposed} joints${proposed > 0 ? `, ${proposed} proposed` : ''}. `
    + (closed.length > 0 ? `Closed: ${some(closed)}. ` : 'Nothing is closed. ')
    + (backed.length > 0 ? `Driven backwards, too: ${some(backed)}. ` : '')
    + (narrow.length > 0 ? `Narrow: ${some(narrow)}. ` : '')
    + (lost.length > 0 ? `Robots lost their path on ${some(lost)}. ` : '')
    + (robots.length > 0 ? `${some(robots)}.` : 'No robot is on them.');
}
