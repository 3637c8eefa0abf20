// Every plan draws robots and a route's course with these.
import { classPaths, type OnPlan, type Point } from './plan';
import type { Measure, Shape } from './shape';
import { shapes } from '../robot/state';

export function Robots({ marks }: { marks: OnPlan[] }) {
  return (
    <>
      {marks.map(({ robot, x, y, heading, name }) => (
        <g key={robot.name} data-robot={robot.name} className={`on-line ${robot.state.replace(' ', '-')}${robot.heard ? '' : ' unheard'}`}>
          {name && (Math.abs(name.y - y) > 30 || Math.abs(name.x - x) > 1) && <path className="lead" d={`M${x} ${y}L${name.x} ${name.y < y ? name.y + 3 : name.y - 11}`} />}
          <g transform={`translate(${x.toFixed(1)} ${y.toFixed(1)})`}>
            <circle r="11" />
            {robot.state === 'driving'
              ? <path className="glyph" d="M7 0-4 5-2 0-4-5z" transform={`rotate(${(heading * 180 / Math.PI).toFixed(0)})`} />
              : <path className="glyph" d={shapes[robot.state]} transform="translate(-5.6 -5.6) scale(0.7)" />}
          </g>
          {name && <text x={name.x} y={name.y} textAnchor="middle">{robot.name}</text>}
        </g>
      ))}
    </>
  );
}

export function ClassPaths({ shape, measure, draw }: {
  shape: Shape;
  measure: Measure;
  draw: (at: Point) => Point;
}) {
  return (
    <>
      {classPaths(shape, measure, draw).map((d, kind) => d && (
        <path key={kind} className={`course ${measure} kind-${kind}`} d={d} />
      ))}
    </>
  );
}
