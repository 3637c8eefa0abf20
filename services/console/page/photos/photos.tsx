import { useEffect, useMemo, useState, type FormEvent } from 'react';
import { get } from '../api';
import { Copy } from '../copy';
import { age, when } from '../fleet';

type Photo = {
  id: string;
  taken_unix_ms: number;
  robot: string;
  mission: string;
  route: string;
  revision: number;
  place: string | null;
  spot_m: number;
  along_m: number;
  sure: boolean;
  backwards: boolean;
  width_px: number;
  height_px: number;
};

type Changes = {
  aligned: boolean;
  why: string;
  overlap: number | null;
  changes: { x: number; y: number; width: number; height: number }[];
};

type Search = { robot?: string; route?: string; mission?: string; place?: string };

const spotOf = (photo: Photo) => photo.place ?? `${photo.route}@${photo.spot_m}`;
const pictureOf = (photo: Photo) => `/api/photos/${photo.id}/picture`;

function Thumbnails({ photos, now_ms, chosen, onChoose }: {
  photos: Photo[]; now_ms: number; chosen?: string; onChoose?: (photo: Photo) => void;
}) {
  const shown = (photo: Photo) => (
    <>
      <img src={pictureOf(photo)} width={photo.width_px} height={photo.height_px} loading="lazy"
        alt={`${spotOf(photo)}, by ${photo.robot}, ${when(photo.taken_unix_ms)}`} />
      <span>{spotOf(photo)}</span>
      <small>{photo.robot}, {age(now_ms - photo.taken_unix_ms)} ago{photo.sure ? '' : ', place not sure'}</small>
    </>
  );
  return (
    <ul className="photos">
      {photos.map((photo) => (
        <li key={photo.id}>
          {onChoose
            ? <button aria-pressed={photo.id === chosen} onClick={() => onChoose(photo)}>{shown(photo)}</button>
            : <a href={`#history/photo-${photo.id}`}>{shown(photo)}</a>}
        </li>
      ))}
    </ul>
  );
}

// `silent` are servers whose photos are not among them.
type Page = { photos: Photo[]; next: number; silent: string[] };

function usePhotos(search: Search, first: number) {
  const [photos, setPhotos] = useState<Photo[]>([]);
  const [last, setLast] = useState<Page | string | null>(null);
  useEffect(() => {
    let still = true;
    if (first === 0) setLast(null);
    get<Page>('/api/photos', { ...search, first: first ? String(first) : '' }).then((page) => {
      if (!still) return;
      setLast(page);
      const found = typeof page === 'string' ? [] : page.photos;
      setPhotos((had) => (first ? [...had, ...found] : found));
    });
    return () => { still = false; };
  }, [search, first]);
  return { photos, last };
}

// A mission's photos have an address of their own.
export function PhotoList({ mission, now_ms }: { mission: string; now_ms: number }) {
  const [search, setSearch] = useState<Search>({ mission });
  const [first, setFirst] = useState(0);
  const { photos, last } = usePhotos(search, first);
  const submit = (event: FormEvent<HTMLFormElement>) => {
    event.preventDefault();
    const given = new FormData(event.currentTarget);
    const word = (name: string) => String(given.get(name) ?? '').trim();
    setFirst(0);
    setSearch({ robot: word('robot'), route: word('route'), mission: word('mission'), place: word('place') });
  };
  const next = last !== null && typeof last !== 'string' ? last.next : 0;
  const silent = last !== null && typeof last !== 'string' ? last.silent : [];
  const folder = new URLSearchParams(Object.entries(search).filter(([, value]) => value)).toString();
  return (
    <>
      <form className="filters" role="search" onSubmit={submit}>
        <label>Robot<input name="robot" autoComplete="off" /></label>
        <label>Route<input name="route" autoComplete="off" /></label>
        <label>Place<input name="place" autoComplete="off" placeholder="dock, hall@12.5" /></label>
        <label>Mission<input name="mission" autoComplete="off" defaultValue={mission} /></label>
        <button type="submit">Search</button>
      </form>
      {last === null && <p role="status" className="note">Loading …</p>}
      {typeof last === 'string' && <p role="status" className="answer bad">⚠ {last}</p>}
      {silent.length > 0 && (
        <p role="status" className="answer bad">
          ⚠ {silent.join(', ')} {silent.length === 1 ? 'does' : 'do'} not answer: photos that {silent.length === 1 ? 'this route server keeps' : 'these route servers keep'} are not listed.
        </p>
      )}
      {last !== null && typeof last !== 'string' && silent.length === 0 && photos.length === 0 && (
        <p role="status" className="note">
          There are no photos. A mission takes them with <code>photo every 5</code> or <code>photo at hall@12</code> before
          its orders; a robot out of reach keeps its own until it is back.
        </p>
      )}
      {photos.length > 0 && <p><a className="button" href={`/api/photos.tar?${folder}`} download>Download as folder</a></p>}
      <Thumbnails photos={photos} now_ms={now_ms} />
      {next > 0 && <button onClick={() => setFirst(next)}>Older ones</button>}
    </>
  );
}

// On a mission's life.
export function PhotosOf({ mission, now_ms }: { mission: string; now_ms: number }) {
  const search = useMemo<Search>(() => ({ mission }), [mission]);
  const { photos } = usePhotos(search, 0);
  if (photos.length === 0) return null;
  return (
    <div>
      <p><a href={`#history/photos-${mission}`}>Its photos</a></p>
      <Thumbnails photos={photos.slice(0, 12)} now_ms={now_ms} />
    </div>
  );
}

function Figure({ photo, src, caption, changes = [] }: { photo: Photo; src: string; caption: string; changes?: Changes['changes'] }) {
  return (
    <figure className="photo">
      <svg viewBox={`0 0 ${photo.width_px} ${photo.height_px}`} role="img" aria-label={caption}>
        <image href={src} width={photo.width_px} height={photo.height_px} />
        {changes.map((each, i) => (
          <rect key={i} className="changed" x={each.x} y={each.y} width={each.width} height={each.height} />
        ))}
      </svg>
      <figcaption>{caption}</figcaption>
    </figure>
  );
}

function told(changes: Changes | string | null): string {
  if (changes === null) return 'Comparing …';
  if (typeof changes === 'string') return `⚠ ${changes}`;
  if (!changes.aligned) return `⚠ ${changes.why}`;
  const count = changes.changes.length;
  if (count === 0) return 'No change was found.';
  return count === 1 ? 'One change is marked.' : `${count} changes are marked.`;
}

// This visit beside an earlier one, which lies over it where the two align.
function Beside({ photo, before }: { photo: Photo; before: Photo }) {
  const [changes, setChanges] = useState<Changes | string | null>(null);
  useEffect(() => {
    let still = true;
    setChanges(null);
    get<Changes>(`/api/photos/${photo.id}/changes`, { since: before.id }).then((reply) => {
      if (still) setChanges(reply);
    });
    return () => { still = false; };
  }, [photo.id, before.id]);
  const aligned = changes !== null && typeof changes !== 'string' && changes.aligned;
  const marks = aligned ? changes.changes : [];
  return (
    <>
      <p role="status">{told(changes)}</p>
      <div className="beside">
        <Figure photo={photo} src={pictureOf(photo)} changes={marks} caption={`This visit: ${when(photo.taken_unix_ms)}, ${photo.robot}`} />
        <Figure photo={aligned ? photo : before} changes={marks}
          src={aligned ? `/api/photos/${photo.id}/earlier?since=${before.id}` : pictureOf(before)}
          caption={`Before: ${when(before.taken_unix_ms)}, ${before.robot}${aligned ? ', as this camera stood' : ''}`} />
      </div>
    </>
  );
}

// A photo has an address of its own.
export function PhotoPage({ id, now_ms }: { id: string; now_ms: number }) {
  const [found, setFound] = useState<{ photo: Photo; visits: Photo[] } | string | null>(null);
  const [chosen, setChosen] = useState('');
  useEffect(() => {
    let still = true;
    get<{ photo: Photo; visits: Photo[] }>(`/api/photos/${id}`, {}).then((reply) => {
      if (still) setFound(reply);
    });
    return () => { still = false; };
  }, [id]);
  if (found === null) return <p role="status" className="note">Loading …</p>;
  if (typeof found === 'string') return <p role="status" className="answer bad">⚠ {found}</p>;
  const { photo, visits } = found;
  const others = visits.filter((each) => each.mission !== photo.mission);
  const before = others.find((each) => each.id === chosen)
    ?? others.find((each) => each.taken_unix_ms < photo.taken_unix_ms) ?? others[0];
  return (
    <section aria-label={spotOf(photo)} className="history">
      <p><a href="#history/photos">All photos</a> · <a href={`#history/photos-${photo.mission}`}>This mission’s</a></p>
      <h2>{spotOf(photo)}</h2>
      <p className="note">
        {when(photo.taken_unix_ms)}, {photo.robot}, {photo.route} at {photo.along_m.toFixed(1)} m
        {photo.sure ? '' : ', place not sure'}{photo.backwards ? ', in reverse gear' : ''} <Copy id={photo.mission} what="mission" />
      </p>
      {before ? <Beside photo={photo} before={before} />
        : <Figure photo={photo} src={pictureOf(photo)} caption={`${when(photo.taken_unix_ms)}, ${photo.robot}: there is no other visit yet`} />}
      {others.length > 0 && (
        <>
          <h3>Other visits</h3>
          <Thumbnails photos={others} now_ms={now_ms} chosen={before?.id} onChoose={(each) => setChosen(each.id)} />
        </>
      )}
    </section>
  );
}
