import { useEffect, useRef, useState } from 'react';
import { get } from '../api';

// openapi.yaml's Run, as the list has it.
export type Summary = {
  run: string;
  file: string;
  bytes: number;
  written_unix_ms: number;
  robot: string;
  route: string;
  revision: string;
  mission: string;
  method: string;
  began_unix_ms: number | null;
  lasted_s: number;
  driven_m: number | null;
  progress: number;
  state: string;       // empty: its log breaks off,
  reason: string;
  under_way: boolean;  // or is still written to
};
export type RunsPage = { runs: Summary[]; next: number; unread: number };

export type Happening = { first: number; last: number; where: string; text: string };
export type Mark = { row: number; at: number; what: string; text: string };
export type Run = Summary & {
  rows: number;
  pictures: boolean;
  story: {
    who: string;
    outcome: string;
    how_far: string;
    missing: string[];
    happened: Happening[];
    lesser: number;
    figures: string[];
  };
  strip: {
    unit: 'm' | 's';
    length: number;
    cells: { at: number[]; row: number[]; sure: number[]; left_m: (number | null)[]; left_sigma_m: (number | null)[] };
    marks: Mark[];
  } | null;
};
export type Axis = 'metres' | 'seconds';

export type Frame = {
  row: number;
  frame: number;
  t_s: number;
  driven_m: number | null;
  phase: string;
  sure: number;
  turn_rad: number;
  left_m: number | null;
  left_sigma_m: number | null;
  says: [string, string][];
};

export type Verdict = 'inside' | 'left' | 'right' | 'rejected';
export type Seen = {
  features: [number, number, number, number, Verdict][];
  picture: number | null;  // the row that it is of
  picture_age_s: number | null;
};

type Reading = { reading: true };
const isReading = (reply: object): reply is Reading => 'reading' in reply;

// Where many wait already, the console answers at once.
const kAgain_ms = 300;

// Null while its log is read.
export function useRun(id: string, axis: Axis): Run | string | null {
  const [run, setRun] = useState<Run | string | null>(null);
  useEffect(() => {
    let still = true;
    const ask = async () => {
      while (still) {
        const reply = await get<Run | Reading>(`/api/runs/${id}`, { along: axis });
        if (!still) return;
        if (typeof reply === 'string' || !isReading(reply)) return setRun(reply);
        await new Promise((again) => window.setTimeout(again, kAgain_ms));
      }
    };
    void ask();
    return () => { still = false; };
  }, [id, axis]);
  return run;
}

const kBlock = 100;
const kMostBlocks = 40;

// Of the row that is looked at now; the last one until it comes.
export function useFrame(id: string, row: number, rows: number): Frame | null {
  const blocks = useRef(new Map<number, Frame[]>());
  const asked = useRef(new Set<number>());
  const [, setCame] = useState(0);
  const last = useRef<Frame | null>(null);
  const block = Math.floor(row / kBlock);
  useEffect(() => {
    let still = true;
    const fetchBlock = async (wanted: number) => {
      if (wanted < 0 || wanted * kBlock >= rows || blocks.current.has(wanted) || asked.current.has(wanted)) return;
      asked.current.add(wanted);
      const reply = await get<{ frames: Frame[] } | Reading>(`/api/runs/${id}/frames`, { first: String(wanted * kBlock) });
      asked.current.delete(wanted);
      if (typeof reply === 'string' || isReading(reply)) return;
      blocks.current.set(wanted, reply.frames);
      if (blocks.current.size > kMostBlocks) blocks.current.delete(blocks.current.keys().next().value!);
      if (still) setCame((times) => times + 1);
    };
    void fetchBlock(block).then(() => fetchBlock(block + 1));
    return () => { still = false; };
  }, [id, block, rows]);
  last.current = blocks.current.get(block)?.[row % kBlock] ?? last.current;
  return last.current;
}

// What was seen in it: who goes through frames quickly is shown the last that came.
export function useSeen(id: string, row: number, wanted: boolean): { row: number; seen: Seen } | null {
  const [shown, setShown] = useState<{ row: number; seen: Seen } | null>(null);
  const latest = useRef(row);
  const busy = useRef(false);
  latest.current = row;
  useEffect(() => {
    if (!wanted || busy.current) return;
    const ask = async () => {
      busy.current = true;
      for (let asked = -1; asked !== latest.current;) {
        asked = latest.current;
        const seen = await get<Seen | Reading>(`/api/runs/${id}/frames/${asked}/seen`, {});
        if (typeof seen !== 'string' && !isReading(seen)) setShown({ row: asked, seen });
      }
      busy.current = false;
    };
    void ask();
  }, [id, row, wanted]);
  return shown;
}

// Under which id it is then found, or why not.
export async function openLog(file: File): Promise<{ run: string } | string> {
  try {
    const reply = await fetch('/api/runs', {
      method: 'POST',
      headers: { 'Content-Type': 'application/octet-stream' },
      body: file,
    });
    const json = await reply.json();
    return json.error ?? json;
  } catch {
    return 'The log was not taken: is it too large, or has the console ended?';
  }
}
