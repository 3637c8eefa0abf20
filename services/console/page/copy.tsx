import { useState } from 'react';

const kTold_ms = 2000;

// An id is for programs, and for who reports something: it is copied, and not read.
export function Copy({ id, what }: { id: string; what: string }) {
  const [told, setTold] = useState('');
  const copy = async () => {
    try {
      await navigator.clipboard.writeText(id);
      setTold('Copied');
      window.setTimeout(() => setTold(''), kTold_ms);
    } catch {
      setTold(id);  // the browser allows it over TLS alone: it is read, then
    }
  };
  return (
    <button className="copy" title={id} onClick={copy}>
      {told === '' ? `Copy ${what} id` : told}
    </button>
  );
}
