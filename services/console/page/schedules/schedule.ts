export type Moment = { unix_ms: number; text: string };
export type Firing = Moment & { schedule: string };
export type Schedule = {
  name: string;
  server: string;
  robots: string[];
  when: string;
  times: { at: string[]; every_min: number | null; from: string | null; until: string | null; days: string[]; once: string | null };
  zone: string;
  orders: string;
  battery_percent: number | null;
  unless_closed: boolean;
  if_arrived: boolean;
  missed: 'skip' | 'once';
  valid_s: number;
  goes_on: boolean;
  by: string;
  paused_by: string | null;
  next: Moment | null;
  last: Moment | null;
  outcome: string | null;  // why nobody was sent the last time
  sent: { robot: string; mission: string | null; outcome: string }[];
};
