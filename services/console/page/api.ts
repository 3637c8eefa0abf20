// What openapi.yaml describes, as far as the page uses it.

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
  | 'silent' | 'stopped' | 'paused' | 'starting' | 'free' | 'waiting' | 'teaching' | 'driving'
  | 'arrived' | 'ended' | 'fault';

export type Order = 'pause' | 'resume' | 'cancel' | 'stop' | 'release';

export type Robot = {
  name: string;
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
  speed_mps: number;
  mission: Mission | null;
  orders: Order[];
};

export type Route = {
  name: string;
  route: string;
  revision: number;
  state: string;
  length_m: number;
  description: string;
};

export type Server = {
  name: string;
  heard: boolean;
  last_heard_unix_ms: number | null;
  detail: string;
};

export type Fleet = {
  now_unix_ms: number;
  robots: Robot[];
  servers: Server[];
  routes: Route[];
  missions: Mission[];
};

export type Answer = { ok: boolean; text: string };

const kPatience_ms = 12000;

async function post(path: string, body: object): Promise<{ status: number; json: any }> {
  const giveUp = new AbortController();
  const timer = window.setTimeout(() => giveUp.abort(), kPatience_ms);
  const reply = await fetch(path, {
    method: 'POST',
    headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify(body),
    signal: giveUp.signal,
  });
  const json = await reply.json();
  window.clearTimeout(timer);
  return { status: reply.status, json };
}

const unreachable: Answer = { ok: false, text: 'The console does not answer: it may not have been told.' };

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

export async function stopAll(): Promise<Answer> {
  try {
    const { json } = await post('/api/all/stop', {});
    if (json.error) return { ok: false, text: json.error };
    const disobey = json.robots.filter((each: any) => !each.obeys);
    if (disobey.length === 0) return { ok: true, text: `All ${json.robots.length} robots stand.` };
    const why = (each: any) => `${each.robot}: ${each.answered ? each.detail : 'did not answer'}`;
    return { ok: false, text: disobey.map(why).join('; ') };
  } catch {
    return unreachable;
  }
}

export async function send(robot: string, orders: string): Promise<Answer> {
  try {
    const { status, json } = await post(`/api/robots/${robot}/missions`, { orders });
    if (json.error) return { ok: false, text: json.error };
    const kept = json.state === 'sent';
    const text = kept ? 'A server keeps it until the robot is heard.' : `${json.state} ${json.detail}`;
    return { ok: status === 200, text };
  } catch {
    return unreachable;
  }
}
