import { useEffect, useRef, useState } from 'react';
import { get, startDownload, upload, type Route, type Transfer } from '../api';

const kLookEvery_ms = 400;

function Bar({ done, total, label }: { done: number; total: number; label: string }) {
  const percent = total > 0 ? Math.min(100, Math.round((100 * done) / total)) : 0;
  return (
    <label className="transfer">
      {label}: {percent} % of {(total / 1e6).toFixed(1)} MB
      <progress max={100} value={percent} />
    </label>
  );
}

// Follows a transfer to its end.
function useTransfer(onDone: (transfer: Transfer) => void) {
  const [transfer, setTransfer] = useState<Transfer | string | null>(null);
  const then = useRef(onDone);
  then.current = onDone;
  const id = transfer !== null && typeof transfer !== 'string' && transfer.state === 'under way' ? transfer.transfer : '';
  useEffect(() => {
    if (!id) return undefined;
    const timer = window.setInterval(async () => {
      const now = await get<Transfer>(`/api/transfers/${id}`, {});
      setTransfer(now);
      if (typeof now !== 'string' && now.state === 'done') then.current(now);
    }, kLookEvery_ms);
    return () => window.clearInterval(timer);
  }, [id]);
  return [transfer, setTransfer] as const;
}

function Told({ transfer, doing }: { transfer: Transfer | string | null; doing: string }) {
  if (transfer === null) return null;
  if (typeof transfer === 'string') return <p className="answer bad" role="status">⚠ {transfer}</p>;
  if (transfer.state === 'under way') return <Bar done={transfer.done_bytes} total={transfer.total_bytes} label={doing} />;
  return (
    <p className={transfer.state === 'failed' ? 'answer bad' : 'answer'} role="status">
      {transfer.state === 'failed' ? '⚠ ' : ''}{transfer.route ? `${transfer.route} revision ${transfer.revision}: ` : ''}{transfer.detail}
    </p>
  );
}

export function Download({ route }: { route: Route }) {
  const [transfer, setTransfer] = useTransfer((done) => {
    const link = document.createElement('a');
    link.href = `/api/transfers/${done.transfer}/file`;
    link.download = '';
    link.click();
  });
  const waits = transfer !== null && typeof transfer !== 'string' && transfer.state === 'under way';
  return (
    <>
      <button disabled={waits} onClick={async () => setTransfer(await startDownload(route))}>Download</button>
      <Told transfer={transfer} doing="From the server" />
    </>
  );
}

// A file that a person chose or dropped.
export function Upload({ file }: { file: File }) {
  const [sent, setSent] = useState(0);
  const [transfer, setTransfer] = useTransfer(() => undefined);
  useEffect(() => upload(file, setSent, setTransfer), [file, setTransfer]);
  if (transfer === null) return <Bar done={sent} total={file.size} label={`${file.name} to the console`} />;
  return <Told transfer={transfer} doing={`${file.name} to the server`} />;
}
