/** One map as coloured cells over both link lengths, with a scale, and a cross that is moved by pointer and keys. */

import { memo, useMemo, type KeyboardEvent, type PointerEvent } from "react";
import type { Point } from "../case/case_file";
import { SHADES, shadeOf } from "./shades";

export interface MapRecord {
  readonly distal: readonly number[];
  readonly proximal: readonly number[];
  readonly radius_max: Readonly<Record<string, readonly (number | null)[]>>;
}

interface MapPictureProps {
  readonly record: MapRecord;
  readonly name: string;
  readonly at: Point;
  readonly onMove: (at: Point) => void;
  readonly onPick: () => void;
}

const [LEFT, TOP, SIDE] = [52, 12, 460];
const BAR = LEFT + SIDE + 26;
const LARGEST = (1 + Math.SQRT2) / 4;
const KEYS: Readonly<Record<string, Point>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};

export function MapPicture({ record, name, at, onMove, onPick }: MapPictureProps) {
  const count = Math.round(Math.sqrt(record.distal.length));
  const place = (event: PointerEvent<SVGRectElement>): Point => {
    const box = event.currentTarget.getBoundingClientRect();
    return [clamp((event.clientX - box.left) / box.width), clamp(1 - (event.clientY - box.top) / box.height)];
  };
  const key = (event: KeyboardEvent<SVGRectElement>) => {
    const step = KEYS[event.key];
    if (event.key === "Enter" || event.key === " ") onPick();
    else if (step) {
      const by = event.shiftKey ? 0.05 : 0.01;
      onMove([clamp(at[0] + by * step[0]), clamp(at[1] + by * step[1])]);
    } else return;
    event.preventDefault();
  };
  const [x, y] = [LEFT + SIDE * at[0], TOP + SIDE * (1 - at[1])];
  return (
    <svg className="map" viewBox={`0 0 ${BAR + 62} ${TOP + SIDE + 46}`} role="group" aria-label="Closure map">
      <Cells values={record.radius_max[name] ?? []} count={count} />
      {[0, 0.25, 0.5, 0.75, 1].map((each) => (
        <g key={each} className="axes">
          <text x={LEFT + SIDE * each} y={TOP + SIDE + 17} textAnchor="middle">
            {each}
          </text>
          <text x={LEFT - 8} y={TOP + SIDE * (1 - each) + 4} textAnchor="end">
            {each}
          </text>
        </g>
      ))}
      <g className="axes">
        <rect className="frame" x={LEFT} y={TOP} width={SIDE} height={SIDE} />
        <text x={LEFT + SIDE / 2} y={TOP + SIDE + 38} textAnchor="middle">
          distal link Q
        </text>
        <text transform={`translate(14 ${TOP + SIDE / 2}) rotate(-90)`} textAnchor="middle">
          proximal link P
        </text>
      </g>
      <Scale />
      <path className="map-cross" d={`M${x - 9} ${y}h18M${x} ${y - 9}v18`} />
      <rect
        className="map-reach"
        x={LEFT}
        y={TOP}
        width={SIDE}
        height={SIDE}
        tabIndex={0}
        role="slider"
        aria-label="Hand on the map"
        aria-valuemin={0}
        aria-valuemax={1}
        aria-valuenow={at[0]}
        aria-valuetext={`distal link ${at[0].toFixed(2)}, proximal link ${at[1].toFixed(2)}`}
        onPointerMove={(event) => onMove(place(event))}
        onPointerDown={(event) => onMove(place(event))}
        onClick={onPick}
        onKeyDown={key}
      />
    </svg>
  );
}

const clamp = (value: number): number => Math.min(Math.max(Number(value.toFixed(4)), 0), 1);

/** Cells of one shade as one path. */
const Cells = memo(function Cells({ values, count }: { values: readonly (number | null)[]; count: number }) {
  const paths = useMemo(() => {
    const cell = SIDE / (count - 1);
    const parts: string[][] = SHADES.map(() => []);
    values.forEach((value, i) => {
      if (value === null) return;
      const [column, row] = [i % count, Math.floor(i / count)];
      const [x, y] = [LEFT + cell * (column - 0.5), TOP + SIDE - cell * (row + 0.5)];
      parts[shadeOf(value, LARGEST)]?.push(
        `M${x.toFixed(2)} ${y.toFixed(2)}h${cell.toFixed(2)}v${cell.toFixed(2)}h${-cell.toFixed(2)}Z`,
      );
    });
    return parts.map((each) => each.join(""));
  }, [values, count]);
  return (
    <g className="map-cells">
      {paths.map((path, i) => path && <path key={i} d={path} fill={SHADES[i]} stroke={SHADES[i]} />)}
    </g>
  );
});

function Scale() {
  const step = SIDE / SHADES.length;
  return (
    <g className="axes">
      {SHADES.map((shade, i) => (
        <rect key={shade} x={BAR} y={TOP + SIDE - step * (i + 1)} width={14} height={step + 0.5} fill={shade} />
      ))}
      {[0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6].map((each) => (
        <text key={each} x={BAR + 20} y={TOP + SIDE * (1 - each / LARGEST) + 4}>
          {each}
        </text>
      ))}
      <text x={BAR + 7} y={TOP + SIDE + 17} textAnchor="middle">
        R*
      </text>
    </g>
  );
}
