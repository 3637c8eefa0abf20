import type { Asked } from './asked';

export function PhotoFields({ asked, onChange }: { asked: Asked; onChange: (asked: Asked) => void }) {
  return (
    <>
      <label>A photo every so many metres
        <input type="number" min={0.2} step="any" value={asked.every} onChange={(event) => onChange({ ...asked, every: event.target.value })} />
      </label>
      <label>Photos at, as dock, hall@12.5
        <input type="text" value={asked.at} maxLength={512} autoComplete="off" autoCapitalize="none" spellCheck={false}
          onChange={(event) => onChange({ ...asked, at: event.target.value })} />
      </label>
    </>
  );
}
