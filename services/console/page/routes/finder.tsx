import { useRef, useState, type DragEvent } from 'react';
import { where, type Found } from '../api';
import { useMay } from '../me';
import { Upload } from './transfers';

// Routes are found by what is seen in a small picture.
const kLongerSide_px = 960;

// The picture, drawn, and as what is sent.
async function shrunk(file: Blob, canvas: HTMLCanvasElement): Promise<Blob | null> {
  const picture = await createImageBitmap(file);
  const scale = Math.min(1, kLongerSide_px / Math.max(picture.width, picture.height));
  canvas.width = Math.max(1, Math.round(picture.width * scale));
  canvas.height = Math.max(1, Math.round(picture.height * scale));
  canvas.getContext('2d')!.drawImage(picture, 0, 0, canvas.width, canvas.height);
  picture.close();
  return new Promise((resolve) => canvas.toBlob(resolve, 'image/jpeg', 0.92));
}

function Places({ found }: { found: Found }) {
  const searched = found.segments_indexed < found.segments_stored || found.routes_unseen > 0
    ? ` ${found.segments_indexed} of ${found.segments_stored} segments were searched, and none of ${found.routes_unseen} further routes.` : '';
  if (found.places.length === 0) return <p className="note">No route looks like this.{searched}</p>;
  return (
    <>
      <ol className="places" aria-label="Where it was taken">
        {found.places.map((place) => (
          <li key={`${place.route} ${place.revision} ${place.segment}`}>
            <a href={`#routes/${place.route}`}>{place.name}</a> revision {place.revision}{place.state !== 'active' && <strong> ({place.state})</strong>}, segment {place.segment} of {place.segments}
            <meter min={0} max={1} value={place.score} aria-label={`likeness ${Math.round(100 * place.score)} %`} /> {Math.round(100 * place.score)} %
          </li>
        ))}
      </ol>
      {searched && <p className="note">{searched}</p>}
    </>
  );
}

// Pictures tell where they were taken, route files are uploaded: dropped, or chosen.
export function Finder() {
  const mayAdminister = useMay('administer');
  const [over, setOver] = useState(false);
  const [shows, setShows] = useState(false);
  const [found, setFound] = useState<Found | string | null>(null);
  const [uploads, setUploads] = useState<{ number: number; file: File }[]>([]);
  const canvas = useRef<HTMLCanvasElement>(null);
  const look = async (file: File) => {
    setFound(null);
    setShows(true);
    try {
      const picture = await shrunk(file, canvas.current!);
      setFound(picture ? await where(picture) : 'This picture is too large for this browser.');
    } catch {
      setShows(false);
      setFound(`${file.name} is no picture that this browser can read.`);
    }
  };
  const take = (files: FileList | null) => {
    for (const file of files ?? []) {
      if (mayAdminister && file.name.endsWith('.trailcast')) {
        setUploads((had) => [...had, { number: had.length, file }]);
      } else {
        void look(file);
      }
    }
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    setOver(false);
    take(event.dataTransfer.files);
  };
  return (
    <div
      className={over ? 'finder over' : 'finder'}
      onDragOver={(event) => { event.preventDefault(); setOver(true); }}
      onDragLeave={() => setOver(false)} onDrop={drop}
    >
      <p>Drop a picture of a robot’s camera here, or of one like it, to find where it was taken{mayAdminister ? '; or a route file, to upload it' : ''}.</p>
      <div className="orders">
        <label className="button">
          Find by picture …
          <input type="file" accept="image/*" className="hidden" onChange={(event) => { take(event.target.files); event.target.value = ''; }} />
        </label>
        {mayAdminister && <label className="button">
          Upload route …
          <input type="file" accept=".trailcast" className="hidden" onChange={(event) => { take(event.target.files); event.target.value = ''; }} />
        </label>}
      </div>
      <canvas ref={canvas} hidden={!shows} aria-label="The picture that is looked for" />
      {shows && found === null && <p className="note" role="status">Looks for it …</p>}
      {typeof found === 'string' && <p className="answer bad" role="status">⚠ {found}</p>}
      {found !== null && typeof found !== 'string' && <Places found={found} />}
      {uploads.map(({ number, file }) => <Upload key={number} file={file} />)}
    </div>
  );
}
