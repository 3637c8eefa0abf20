import { useState, type FormEvent } from 'react';
import { editRoute, type Answer, type FoundRoute } from '../api';

// As routes and tags may be called.
export const kName = /^[A-Za-z0-9_.-]{1,64}$/;
const kMostDescription = 256;

// What a route is called, and what is said of it, in all its revisions.
export function Labels({ of, onAnswer }: { of: FoundRoute; onAnswer: (answer: Answer) => void }) {
  const [name, setName] = useState(of.name);
  const [tags, setTags] = useState(of.tags.join(' '));
  const [description, setDescription] = useState(of.description);
  const wanted = tags.split(/[\s,]+/).filter((tag) => tag !== '');
  const bad = [name, ...wanted].find((each) => !kName.test(each));
  const added = wanted.filter((tag) => !of.tags.includes(tag));
  const gone = of.tags.filter((tag) => !wanted.includes(tag));
  const isOther = name !== of.name || added.length > 0 || gone.length > 0 || description.trim() !== of.description;
  const save = async (event: FormEvent) => {
    event.preventDefault();
    onAnswer({ ok: true, text: 'Saving …' });
    let answer: Answer = { ok: true, text: '' };
    if (description.trim() !== of.description) answer = await editRoute(of.route, 'describe', { text: description.trim() });
    if (answer.ok && added.length > 0) answer = await editRoute(of.route, 'tag', { tags: added });
    if (answer.ok && gone.length > 0) answer = await editRoute(of.route, 'untag', { tags: gone });
    if (answer.ok && name !== of.name) answer = await editRoute(of.route, 'rename', { text: name });
    onAnswer(answer.ok ? { ok: true, text: 'Saved.' } : answer);
  };
  return (
    <form className="labels" onSubmit={save}>
      <label>Name
        <input value={name} maxLength={64} autoComplete="off" autoCapitalize="off" spellCheck={false} onChange={(event) => setName(event.target.value)} />
      </label>
      <label>Tags
        <input value={tags} autoComplete="off" autoCapitalize="off" spellCheck={false} placeholder="wet gravel" onChange={(event) => setTags(event.target.value)} />
      </label>
      <label className="long">Description
        <input value={description} maxLength={kMostDescription} autoComplete="off" onChange={(event) => setDescription(event.target.value)} />
      </label>
      <button type="submit" disabled={!isOther || bad !== undefined}>Save</button>
      {bad !== undefined && <p className="note" role="alert">{bad === '' ? 'A route has a name.' : `“${bad}”: letters, digits and "_", "-", "." alone, without spaces.`}</p>}
    </form>
  );
}
