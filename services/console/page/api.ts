// What openapi.yaml describes, as far as the page uses it.
import { apart, bodyOf, type PhotosBody } from './photos/asked';

export type Mission = {
  mission: string;
  robot: string;
  orders: string;
  sent_by: string;
  state: string;
  task: number;
  detail: string;
  sent_unix_ms: number;
  changed_unix_ms: number;
};

export type RobotState =
  | 'offline' | 'stopped' | 'paused' | 'starting' | 'available' | 'waiting' | 'teaching' | 'driving'
  | 'arrived' | 'failed' | 'shut down' | 'fault';

export type Order = 'pause' | 'resume' | 'cancel' | 'stop' | 'release' | 'end' | 'home';

export type Robot = {
  name: string;
  group: string;  // those that are numbered alike are one: "cart" of "cart-1"
  role: string;
  state: RobotState;
  detail: string;
  needs_person: boolean;
  heard: boolean;
  last_heard_unix_ms: number | null;
  route: string;
  segment: number;
  segments: number;
  progress: number;
  along_m: number | null;
  length_m: number | null;
  route_id: string;   // empty until it has found itself there
  teaching: string;
  left_m: number | null;        // beside its path
  left_sigma_m: number | null;  // how sure it is of that
  stood: { route: string; route_id: string; teaching: string; along_m: number } | null;  // last, if it says so no more
  speed_mps: number;
  on_duty: boolean;
  battery_percent: number | null;
  link_percent: number | null;
  software: string;
  follows_by: string;  // a sentence; empty while it follows nothing
  teaches: boolean;
  features: number;
  mission: Mission | null;
  queue: Mission[];  // what it is to do after that, the next first
  unanswered_stop_unix_ms: number | null;  // since when it is told to stop and does not answer
  orders: Order[];
};

// A revision of a route, as `trailcast routes --json` has it.
export type Route = {
  name: string;
  route: string;
  revision: number;
  state: string;
  segments: number;
  length_m: number;
  bytes: number;
  scout: string;
  camera: string;
  taught_unix_ms: number;
  tags: string[];
  place: { latitude: number; longitude: number } | { site_x_m: number; site_y_m: number } | null;
  description: string;
  teaching: string;
};

export type Server = {
  name: string;
  heard: boolean;
  last_heard_unix_ms: number | null;
  detail: string;
};

// What somebody has to see to; it ends by itself once its cause has.
export type Alert = {
  alert: string;
  kind: string;
  severity: 'alarm' | 'warning';
  robot: string | null;
  server: string | null;
  reason: string;
  place: string;
  action: string;
  known: boolean;  // false: it is of before the console started, and nothing was heard of it since
  since_unix_ms: number;
  acknowledged_by: string | null;
  acknowledged_unix_ms: number | null;
  ended_unix_ms: number | null;
};

export type Fleet = {
  now_unix_ms: number;
  alerts: Alert[];
  robots: Robot[];
  servers: Server[];
  routes: Route[];
  missions: Mission[] | null;  // not known yet
};

// What has changed of it: of robots by name, of one that is new all; the rest as a whole where it is there.
export type Change = Partial<Omit<Fleet, 'robots'>> & {
  now_unix_ms: number;
  robots: (Partial<Robot> & { name: string })[];
  gone: string[];
};

// Of a search, with who holds each and how many of its segments its server has lost.
export type FoundRoute = Route & { held_by: string[]; segments_lost: number };
export type RoutePage = { routes: FoundRoute[]; total: number; next: string; similar: string[] };

export type Answer = { ok: boolean; text: string };

const kPatience_ms = 12000;

// Errors that servers word for the command line: what is to be typed there is of no use here.
export const withoutCommands = (text: string) => text.replace(/(?:[:;,] |\. )[^.:;]*'trailcast [\s\S]*$/, '');

async function ask(path: string, request: RequestInit, patience_ms = kPatience_ms): Promise<{ status: number; json: any }> {
  const giveUp = new AbortController();
  const timer = window.setTimeout(() => giveUp.abort(), patience_ms);
  try {
    const reply = await fetch(path, { ...request, signal: giveUp.signal });
    const json = await reply.json();
    if (typeof json.error === 'string') json.error = withoutCommands(json.error);
    return { status: reply.status, json };
  } finally {
    window.clearTimeout(timer);
  }
}

function post(path: string, body: object, patience_ms = kPatience_ms): Promise<{ status: number; json: any }> {
  return ask(path, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
  }, patience_ms);
}

// What is there, or why not, in words.
export async function get<Reply>(path: string, parameters: Record<string, string | string[]>): Promise<Reply | string> {
  const query = new URLSearchParams();
  for (const [name, value] of Object.entries(parameters)) {
    for (const each of Array.isArray(value) ? value : [value]) if (each) query.append(name, each);
  }
  try {
    const { json } = await ask(`${path}?${query}`, {});
    return json.error ?? (json as Reply);
  } catch {
    return 'The console does not answer.';
  }
}

// What is there then, or why nothing has changed.
export async function change<Reply>(method: 'POST' | 'PUT' | 'DELETE', path: string, body: object | null): Promise<Reply | string> {
  try {
    const { json } = await ask(path, {
      method,
      headers: { 'Content-Type': 'application/json' },
      body: body ? JSON.stringify(body) : undefined,
    });
    return json.error ?? (json as Reply);
  } catch {
    return 'The console does not answer.';
  }
}

// What is there then, or why it is not.
export async function create<Reply>(path: string, body: object): Promise<Reply | string> {
  try {
    const { json } = await post(path, body);
    return json.error ?? (json as Reply);
  } catch {
    return 'The console does not answer.';
  }
}

const unreachable: Answer = { ok: false, text: 'The console does not answer: the robot may not have been told.' };

export async function tell(robot: string, order: Order): Promise<Answer> {
  try {
    const { status, json } = await post(`/api/robots/${robot}/${order}`, {});
    if (json.error) return { ok: false, text: json.error };
    if (!json.answered) return { ok: false, text: `${robot} did not answer: it may not have heard.` };
    return { ok: status === 200, text: (json.obeys ? '' : 'Does not obey: ') + json.detail };
  } catch {
    return unreachable;
  }
}

// A word of who drives: good for a moment, and then of no use. Why it is not passed on, if it is not.
const kDrivePatience_ms = 1000;
export async function drive(
  robot: string, word: { linear_mps: number; turn_radps: number; driver: string; said_ms: number },
): Promise<string> {
  try {
    const { json } = await post(`/api/robots/${robot}/drive`, word, kDrivePatience_ms);
    return json.error ?? '';
  } catch {
    return 'The console does not answer: the robot stands.';
  }
}

export async function acknowledge(alert: string): Promise<Answer> {
  try {
    const { json } = await post(`/api/alerts/${alert}/acknowledge`, {});
    return json.error ? { ok: false, text: json.error } : { ok: true, text: '' };
  } catch {
    return { ok: false, text: 'The console does not answer.' };
  }
}

// List a robot no more that is not heard.
export async function forget(robot: string): Promise<Answer> {
  try {
    const { json } = await post(`/api/robots/${robot}/forget`, {});
    return json.error ? { ok: false, text: json.error } : { ok: true, text: `${robot} is listed again once it is heard.` };
  } catch {
    return { ok: false, text: 'The console does not answer.' };
  }
}

// With what it says of each robot, which may change.
export type StopAnswer = Answer & { robots: { robot: string; answered: boolean; obeys: boolean }[] };

// What is told to several robots, one after the other, ends where a stop was said meanwhile.
let stops = 0;
export const stopsSaid = () => stops;

export async function stopOne(robot: string): Promise<StopAnswer> {
  ++stops;
  try {
    const { status, json } = await post(`/api/robots/${robot}/stop`, {});
    if (json.error) return { ok: false, text: `${robot}: ${json.error}`, robots: [] };
    const said = !json.answered ? 'did not answer: it may not have heard' : json.obeys ? json.detail : `does not obey: ${json.detail}`;
    return { ok: status === 200, text: `${robot}: ${said}`, robots: [json] };
  } catch {
    return { ...unreachable, robots: [] };
  }
}

export async function stopAll(): Promise<StopAnswer> {
  ++stops;
  try {
    const { status, json } = await post('/api/all/stop', {});
    if (json.error) return { ok: false, text: json.error, robots: [] };
    return { ok: status === 200, text: json.text, robots: json.robots };
  } catch {
    return { ...unreachable, robots: [] };
  }
}

export async function send(robot: string, orders: string, photos: PhotosBody = {}): Promise<Answer> {
  try {
    const { status, json } = await post(`/api/robots/${robot}/missions`, { orders, ...photos });
    if (json.error) return { ok: false, text: json.error };
    const kept = json.state === 'sent';
    const text = kept ? `Queued${json.detail ? `: ${json.detail}` : ', until the robot is heard'}.` : `${json.state} ${json.detail}`;
    return { ok: status === 200, text };
  } catch {
    return unreachable;
  }
}

// Sends one of a group ("@cart"), or several, which all get it or none.
export async function sendTo(to: string, orders: string, photos: PhotosBody = {}): Promise<Answer> {
  try {
    const { status, json } = await post('/api/missions', { to, orders, ...photos });
    if (json.error) return { ok: false, text: json.error };
    const text = json.missions.map(({ robot, state, detail }: Mission) => `${robot}: ${state}${detail ? `: ${detail}` : ''}`).join('; ');
    return { ok: status === 200, text };
  } catch {
    return unreachable;
  }
}

// Sends a mission's orders again; to a place, by the best path from where the robot stands now.
export async function sendAgain({ robot, orders }: Mission): Promise<Answer> {
  const [first, to] = orders.split(' ');
  if (first !== 'goto') return send(robot, orders);
  const way = await get<Way>('/api/network/way', { from: robot, to });
  if (typeof way === 'string') return { ok: false, text: way };
  return way.orders ? send(robot, way.orders, bodyOf(apart(orders).asked)) : { ok: true, text: `${robot} is there already.` };
}

// A page of what servers keep; `next` 0 on the last.
export type MissionPage = { missions: Mission[]; next: number };

export type Command = {
  given_by: string;
  command: string;
  whom: string;
  reason: string;
  given_unix_ms: number;
  answers: { robot: string; obeys: boolean; detail: string }[];
};
export type CommandPage = { commands: Command[]; next: number };

// Of routes and of how they are joined, as a server has kept it, the newest first.
export type RouteChange = { at_unix_ms: number; by: string | null; routes: string[]; what: string };
export type Changes = {
  since_unix_ms: number;
  history: { kept_since_unix_ms: number; total: number; changes: RouteChange[] };
};

export type RouteAction = 'activate' | 'rollback' | 'retire' | 'delete' | 'rename' | 'tag' | 'untag' | 'describe';

export async function editRoute(
  route: string, action: RouteAction, of: { revision?: number; text?: string; tags?: string[] } = {},
): Promise<Answer> {
  try {
    const { json } = await post(`/api/routes/${route}/edits`, { action, ...of });
    if (json.error) return { ok: false, text: json.error };
    const isState = ['activate', 'rollback', 'retire', 'delete'].includes(action);
    const changed = (json.changed as Route[]).map((each) => `revision ${each.revision} is ${isState ? each.state : 'changed'}`);
    return { ok: true, text: changed.length > 0 ? `Done: ${changed.join(', ')}.` : 'Nothing to change: it is so already.' };
  } catch {
    return { ok: false, text: 'The console does not answer: it may have been changed, or not.' };
  }
}

// Where a picture was taken, the likest first, and how much was searched.
export type Found = {
  places: { name: string; route: string; revision: number; state: string; segment: number; segments: number; score: number }[];
  segments_indexed: number;
  segments_stored: number;
  routes_unseen: number;
};

export async function where(picture: Blob): Promise<Found | string> {
  try {
    const { json } = await ask('/api/where', {
      method: 'POST',
      headers: { 'Content-Type': picture.type },
      body: picture,
    });
    return json.error ?? (json as Found);
  } catch {
    return 'The console does not answer.';
  }
}

// A place on a route; the route may be "hall@2", of another revision than robots follow.
export type Place = { route: string; along_m: number };
export type Joint = { from: Place; to: Place; both: boolean; used: boolean };
// That a server has found by what scouts saw; 0.5 to 1.
export type Proposal = Omit<Joint, 'used'> & { confidence: number };
export type Stretch = { route: string; from_m: number; to_m: number | null; speed?: number; cost?: number };
// How often robots came over it lately, and lost their path there.
export type LostStretch = Stretch & { passed: number; lost: number; cost: number };
export type NamedPlace = { name: string; place: Place; home: boolean; dock: boolean; taken_by: string[]; used: boolean };

// Routes that were asked for, with what is on them and between them; and of how many.
export type NetworkPart = {
  network: {
    routes: { route: string; length_m: number }[];
    joints: Joint[];
    proposed?: Proposal[];  // not of an older server
    closed: Stretch[];
    backed?: Stretch[];  // not of an older server
    limits: Stretch[];
    narrow?: { parts: Stretch[]; taken_by: string[] }[];  // not of an older server
    lost?: LostStretch[];  // likewise
    names: NamedPlace[];
    charge: { below_percent: number; until_percent: number } | null;
    charging: { robot: string; text: string }[];
  };
  elsewhere: { route: string; joints: number }[];
  matched: number;
  routes: number;
  joints: number;
  left_out: number;
  whole: boolean;
};

export type Way = {
  way: { length_m: number; stretches: { route: string; from_m: number; to_m: number; speed: number; turn_rad?: number }[] };
  orders: string;
};

// What is so then, in the words of `trailcast network`.
export async function editNetwork(words: string): Promise<{ ok: boolean; now: string[]; why: string }> {
  try {
    const { json } = await post('/api/network/edits', { words });
    if (json.error) return { ok: false, now: [], why: json.error };
    return { ok: true, now: json.now as string[], why: '' };
  } catch {
    return { ok: false, now: [], why: 'The console does not answer: it may have been changed, or not.' };
  }
}

// A route on its way as a file: to be downloaded, or uploaded and then delivered to a server.
export type Transfer = {
  transfer: string;
  upload: boolean;
  state: 'under way' | 'done' | 'failed';
  route: string;
  revision: number;
  done_bytes: number;
  total_bytes: number;
  detail: string;
};

export async function startDownload({ route, teaching }: Route): Promise<Transfer | string> {
  try {
    const { json } = await post('/api/transfers', { route, teaching });
    return json.error ?? (json as Transfer);
  } catch {
    return 'The console does not answer.';
  }
}

// fetch does not tell how much was sent. What is returned gives it up.
export function upload(file: File, onSent: (bytes: number) => void, onEnd: (transfer: Transfer | string) => void): () => void {
  const request = new XMLHttpRequest();
  request.upload.onprogress = (event) => onSent(event.loaded);
  request.onerror = () => onEnd('The upload was cut off: is the file too large, or has the console ended?');
  request.onload = () => {
    try {
      const json = JSON.parse(request.responseText);
      onEnd(json.error ?? (json as Transfer));
    } catch {
      onEnd('The console gave no answer that this page understands.');
    }
  };
  request.open('POST', '/api/transfers/uploads');
  request.setRequestHeader('Content-Type', 'application/octet-stream');
  request.send(file);
  return () => request.abort();
}
