import { memo } from 'react';
import type { Joint } from '../api';
import { lostText, metres, rangeOf, sidesOf, standsHow, textOf, type Part, type Row } from './network-layout';

const kMostRobots = 20;

const partText = ({ from_m, to_m }: Part) => `${metres(from_m)} to ${metres(to_m)} m`;
function limitText({ stretch, ...part }: Part): string {
  const speed = stretch.speed !== undefined && stretch.speed !== 1 ? `, ${stretch.speed} times the taught speed` : '';
  const cost = stretch.cost !== undefined && stretch.cost !== 1 ? `, a metre counts as ${stretch.cost}` : '';
  return partText({ stretch, ...part }) + speed + cost;
}

function jointText(joint: Omit<Joint, 'used'>, row: string): string {
  const { here, way, there } = sidesOf(joint, row);
  return `${metres(here.along_m)} m ${way} ${textOf(there)}`;
}

type Props = {
  chosen: string;
  onChoose: (route: string) => void;
  onAround: (route: string) => void;
  onEdit: ((words: string) => void) | null;  // null: for who only looks
};

// Drawn anew only when something of it has changed.
const Line = memo(function Line({ row, isChosen, onChoose, onAround, onEdit }: Omit<Props, 'chosen'> & { row: Row; isChosen: boolean }) {
  const take = (label: string, of: string, words: string) => onEdit && (
    <button className="small" onClick={() => onEdit(words)}>{label}<span className="hidden"> {of}</span></button>
  );
  return (
    <tr className={isChosen ? 'chosen' : ''}>
      <td data-label="Route">
        <span>
          <button className="opens" aria-pressed={isChosen} onClick={() => onChoose(isChosen ? '' : row.name)}>{row.name}</button>{' '}
          {row.length_m.toFixed(1)} m
        </span>
      </td>
      <td data-label="Junctions">
        <ul className="plain">
          {row.joints.map((joint, i) => (
            <li key={i}>{jointText(joint, row.name)}{joint.used ? '' : ' (not used)'} {take('Remove', `${textOf(joint.from)} and ${textOf(joint.to)}`, `part ${textOf(joint.from)} ${textOf(joint.to)}`)}</li>
          ))}
          {row.proposed.map((proposal, i) => (
            <li key={`p${i}`}>
              proposed, {Math.round(100 * proposal.confidence)} % sure: {jointText(proposal, row.name)}{' '}
              {take('Confirm', `${textOf(proposal.from)} and ${textOf(proposal.to)}`, `confirm ${textOf(proposal.from)} ${textOf(proposal.to)}`)}{' '}
              {take('Refuse', `${textOf(proposal.from)} and ${textOf(proposal.to)}`, `refuse ${textOf(proposal.from)} ${textOf(proposal.to)}`)}
            </li>
          ))}
          {row.elsewhere > 0 && (
            <li>{row.elsewhere} with routes that are not shown <button className="small" onClick={() => onAround(row.name)}>Show around {row.name}</button></li>
          )}
        </ul>
      </td>
      <td data-label="Restrictions">
        <ul className="plain">
          {row.closed.map((part, i) => (
            <li key={i}><strong className="lost">closed</strong> {partText(part)} {take('Open', `${row.name} ${partText(part)}`, `open ${part.stretch.route} ${rangeOf(part.stretch)}`)}</li>
          ))}
          {row.backed.map((part, i) => (
            <li key={`b${i}`}>two-way (reverse) {partText(part)} {take('Forward only', `on ${row.name} ${partText(part)}`, `ahead ${part.stretch.route} ${rangeOf(part.stretch)}`)}</li>
          ))}
          {row.narrow.map((part, i) => (
            <li key={`n${i}`}>narrow {partText(part)}{part.takenBy.length > 0 && `, taken by ${part.takenBy.join(' and ')}`} {take('Not narrow', `${row.name} ${partText(part)}`, `wide ${part.stretch.route} ${rangeOf(part.stretch)}`)}</li>
          ))}
          {row.limits.map((part, i) => (
            <li key={`l${i}`}>{limitText(part)} {take('No limit', `on ${row.name} ${partText(part)}`, `limit ${part.stretch.route} ${rangeOf(part.stretch)}`)}</li>
          ))}
          {row.lost.map((part, i) => (
            <li key={`x${i}`}>robots lost their path {partText(part)}: {lostText(part.stretch)}</li>
          ))}
        </ul>
      </td>
      <td data-label="Places">
        <ul className="plain">
          {row.names.map((named) => (
            <li key={named.name}>{named.name} at {metres(named.along_m)} m{named.home ? ', a home' : ''}{named.dock ? ', a dock' : ''}{named.taken_by.length > 0 && `, taken by ${named.taken_by.join(' and ')}`}{named.used ? '' : ' (of another revision)'} {take('Forget', named.name, `forget ${named.name}`)}</li>
          ))}
        </ul>
      </td>
      <td data-label="Robots">
        <ul className="plain">
          {row.robots.slice(0, kMostRobots).map((robot) => (
            <li key={robot.name}><a href={`#fleet/${robot.name}`}>{robot.name}</a> {standsHow(robot)}</li>
          ))}
          {row.robots.length > kMostRobots && <li>and {row.robots.length - kMostRobots} more</li>}
        </ul>
      </td>
    </tr>
  );
});

// The same in words, with what takes single things back.
export function NetworkTable({ rows, chosen, ...does }: Props & { rows: Row[] }) {
  return (
    <table>
      <thead>
        <tr><th>Route</th><th>Junctions</th><th>Restrictions</th><th>Places</th><th>Robots</th></tr>
      </thead>
      <tbody>
        {rows.map((row) => <Line key={row.name} row={row} isChosen={row.name === chosen} {...does} />)}
      </tbody>
    </table>
  );
}
