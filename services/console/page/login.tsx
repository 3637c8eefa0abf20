import { useEffect, useRef, useState, type FormEvent, type ReactNode } from 'react';
import { askWhoIAm, setMe, useMaySeeUsers, useMe } from './me';

function LogIn() {
  const [wrong, setWrong] = useState('');
  const [busy, setBusy] = useState(false);
  const password = useRef<HTMLInputElement>(null);
  const logIn = async (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    const fields = new FormData(event.currentTarget);
    setBusy(true);
    setWrong('');
    try {
      const reply = await fetch('/api/log-in', {
        method: 'POST',
        headers: { 'Content-Type': 'application/json' },
        body: JSON.stringify({ user: fields.get('user'), password: fields.get('password') }),
      });
      const said = await reply.json();
      if (reply.ok) return setMe(said);
      setWrong(said.error);
    } catch {
      setWrong('The console does not answer.');
    } finally {
      setBusy(false);
    }
    password.current?.select();
  };
  return (
    <main className="login">
      <form onSubmit={logIn}>
        <h1>Trailcast</h1>
        <p className="note">Log in to see the robots and to stop them.</p>
        <label>User
          <input name="user" autoComplete="username" autoCapitalize="none" spellCheck={false} required autoFocus maxLength={32} />
        </label>
        <label>Password
          <input name="password" type="password" autoComplete="current-password" required ref={password} maxLength={256} />
        </label>
        <button type="submit" disabled={busy}>{busy ? 'Logging in …' : 'Log in'}</button>
        <p role="alert" className="answer bad">{wrong && `⚠ ${wrong}`}</p>
      </form>
    </main>
  );
}

const kAgain_ms = 2000;

// What only those see who are let in.
export function Doors({ children }: { children: ReactNode }) {
  const me = useMe();
  const [why, setWhy] = useState('');
  const [asks, setAsks] = useState(0);
  useEffect(() => {
    if (me !== null) return;
    let timer: number | undefined;
    let over = false;
    askWhoIAm().then((problem) => {
      setWhy(problem);
      if (!over) timer = window.setTimeout(() => setAsks(asks + 1), kAgain_ms);
    });
    return () => {
      over = true;
      window.clearTimeout(timer);
    };
  }, [me, asks]);
  if (me === null) return <p className="banner" role="alert" hidden={!why}>⚠ {why} This page asks again.</p>;
  return me === 'out' ? <LogIn /> : <>{children}</>;
}

export function WhoIsIn() {
  const me = useMe();
  const maySeeUsers = useMaySeeUsers();
  if (me === null || me === 'out' || !me.logs_in) return null;
  const logOut = async () => {
    try {
      await fetch('/api/log-out', { method: 'POST', headers: { 'Content-Type': 'application/json' }, body: '{}' });
    } finally {
      askWhoIAm();
    }
  };
  return (
    <span className="who">
      {maySeeUsers ? <a href="#users" title="You may administer: users">{me.user}</a> : <span title={`May ${me.role}`}>{me.user}</span>}
      <button onClick={logOut}>Log out</button>
    </span>
  );
}

// Why there are no buttons, where that is so.
export function OnlyLooks() {
  const me = useMe();
  if (me === null || me === 'out' || me.role !== 'look') return null;
  return (
    <p className="looks" role="note">
      View only{me.only_looks ? `: ${me.only_looks}` : ''}.
    </p>
  );
}
