import { useCallback, useEffect, useState, type FormEvent } from 'react';
import { change, create, get, type Answer } from './api';
import { askWhoIAm, useMaySeeUsers, useMe } from './me';

type Role = 'look' | 'operate' | 'administer';
type User = { user: string; role: Role; has: 'password' | 'token' };

const roles: Record<Role, string> = {
  look: 'look: sees everything, commands nothing',
  operate: 'operate: sends, pauses and stops robots',
  administer: 'administer: changes routes and users, too',
};

function RoleChoice({ role, name, onChange }: { role: Role; name: string; onChange: (role: Role) => void }) {
  return (
    <select aria-label={name} value={role} onChange={(event) => onChange(event.target.value as Role)}>
      {Object.entries(roles).map(([each, text]) => <option key={each} value={each}>{text}</option>)}
    </select>
  );
}

function Line({ user, isMe, onDone }: { user: User; isMe: boolean; onDone: (answer: Answer) => void }) {
  const [sure, setSure] = useState(false);
  const [asks, setAsks] = useState(false);
  const path = `/api/users/${user.user}`;
  const put = async (body: object, text: string) => {
    const reply = await change('PUT', path, body);
    onDone(typeof reply === 'string' ? { ok: false, text: reply } : { ok: true, text });
  };
  const remove = async () => {
    if (!sure) return setSure(true);
    const reply = await change('DELETE', path, null);
    onDone(typeof reply === 'string' ? { ok: false, text: reply } : { ok: true, text: `${user.user} is removed, and logged out.` });
  };
  const setPassword = (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    setAsks(false);
    void put({ password: new FormData(event.currentTarget).get('password') }, `${user.user} has another password, and has to log in again.`);
  };
  return (
    <tr>
      <td data-label="User"><strong>{user.user}</strong>{isMe && ' (you)'}</td>
      <td data-label="Role">
        <RoleChoice name={`Role of ${user.user}`} role={user.role} onChange={(role) => void put({ role }, `${user.user} may ${role} now.`)} />
      </td>
      <td data-label="Logs in by">{user.has}</td>
      <td data-label="Actions">
        <div className="orders">
          {user.has === 'password' && <button aria-expanded={asks} onClick={() => setAsks(!asks)}>Password …</button>}
          <button onClick={() => void remove()} onBlur={() => setSure(false)}>{sure ? `Remove ${user.user}, really` : 'Remove'}</button>
        </div>
        {asks && (
          <form className="filters" onSubmit={setPassword}>
            <label>New password of {user.user}<input name="password" type="password" autoComplete="new-password" minLength={10} maxLength={256} required autoFocus /></label>
            <button type="submit">Set</button>
          </form>
        )}
      </td>
    </tr>
  );
}

function NewUser({ onDone }: { onDone: (answer: Answer, token: string | null) => void }) {
  const [role, setRole] = useState<Role>('operate');
  const [program, setProgram] = useState(false);
  const add = async (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    const form = event.currentTarget;
    const fields = new FormData(form);
    const user = String(fields.get('user')).trim();
    const reply = await create<{ token: string | null }>('/api/users', { user, role, ...(program ? { token: true } : { password: fields.get('password') }) });
    if (typeof reply === 'string') return onDone({ ok: false, text: reply }, null);
    form.reset();
    onDone({ ok: true, text: `${user} may ${role}.` }, reply.token);
  };
  return (
    <form className="filters" aria-label="Add a user" onSubmit={(event) => void add(event)}>
      <label>Name<input name="user" autoComplete="off" autoCapitalize="none" spellCheck={false} maxLength={32} pattern="[A-Za-z0-9_.\-]+" title="Letters, digits, '_', '.' and '-'" required /></label>
      <label>Role<RoleChoice name="Role" role={role} onChange={setRole} /></label>
      <label>Kind
        <select value={program ? 'token' : 'password'} onChange={(event) => setProgram(event.target.value === 'token')}>
          <option value="password">a person, with a password</option>
          <option value="token">a program, with a token</option>
        </select>
      </label>
      {!program && <label>Password, of 10 letters or more<input name="password" type="password" autoComplete="new-password" minLength={10} maxLength={256} required /></label>}
      <button type="submit">Add</button>
    </form>
  );
}

// It shows administrators who may log in.
export function Users() {
  const me = useMe();
  const maySee = useMaySeeUsers();
  const [users, setUsers] = useState<User[] | null>(null);
  const [answer, setAnswer] = useState<Answer | null>(null);
  const [token, setToken] = useState<string | null>(null);
  const load = useCallback(async () => {
    const reply = await get<{ users: User[] }>('/api/users', {});
    if (typeof reply === 'string') setAnswer({ ok: false, text: reply });
    else setUsers(reply.users);
  }, []);
  useEffect(() => {
    if (maySee) void load();
  }, [load, maySee]);
  const done = (said: Answer, drawn: string | null = null) => {
    setAnswer(said);
    setToken(drawn);
    void load();
    void askWhoIAm();  // it may have been oneself
  };
  if (!maySee) return <p className="note">Only a user who may administer sees the users.</p>;
  return (
    <section className="history" aria-label="Users">
      <h2>Users</h2>
      <NewUser onDone={done} />
      <p role="status" className={answer && !answer.ok ? 'answer bad' : 'answer'}>{answer && (answer.ok ? '' : '⚠ ') + answer.text}</p>
      {token && <p className="lacks">Its token, which is shown this once: <code>{token}</code></p>}
      {users === null && !answer && <p className="note">Loading users …</p>}
      {users && (
        <table>
          <thead><tr><th>User</th><th>Role</th><th>Logs in by</th><th>Actions</th></tr></thead>
          <tbody>{users.map((user) => <Line key={user.user} user={user} isMe={me !== null && me !== 'out' && me.user === user.user} onDone={done} />)}</tbody>
        </table>
      )}
    </section>
  );
}
