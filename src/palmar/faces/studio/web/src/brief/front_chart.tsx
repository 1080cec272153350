/** The front of hand size against tolerated error: a point shows its hand, a click or Enter loads it. */

import { fixed } from "../answers/amounts";
import { roundStep } from "../drawing/view";
import type { FrontPoint } from "./brief_file";

interface FrontChartProps {
  readonly points: readonly FrontPoint[];
  /** Size and error (mm) that the axes reach at least, so that points stay where they are as more come. */
  readonly end: readonly [size: number, error: number] | null;
  /** Size and error (mm) of the hand that answers the brief. */
  readonly chosen: readonly [size: number, error: number] | null;
  readonly shown: FrontPoint | null;
  readonly onShow: (point: FrontPoint | null) => void;
  readonly onPick: (point: FrontPoint) => void;
}

const [LEFT, TOP, WIDTH, HEIGHT] = [56, 12, 470, 210];

export function FrontChart({ points, end, chosen, shown, onShow, onPick }: FrontChartProps) {
  const all = [...points.map(mm), ...(chosen ? [chosen] : []), ...(end ? [end] : [])];
  const [across, up] = [scaleOf(all.map((each) => each[0])), scaleOf([0, ...all.map((each) => each[1])])];
  const x = (size: number) => LEFT + (WIDTH * (size - across.low)) / (across.high - across.low);
  const y = (error: number) => TOP + HEIGHT * (1 - (error - up.low) / (up.high - up.low));
  return (
    <svg className="front" viewBox={`0 0 ${LEFT + WIDTH + 18} ${TOP + HEIGHT + 48}`} role="group" aria-label="Front">
      <g className="axes" aria-hidden="true">
        {across.ticks.map((each) => (
          <g key={each}>
            <line className="grid" x1={x(each)} x2={x(each)} y1={TOP} y2={TOP + HEIGHT} />
            <text x={x(each)} y={TOP + HEIGHT + 17} textAnchor="middle">
              {each}
            </text>
          </g>
        ))}
        {up.ticks.map((each) => (
          <g key={each}>
            <line className="grid" x1={LEFT} x2={LEFT + WIDTH} y1={y(each)} y2={y(each)} />
            <text x={LEFT - 8} y={y(each) + 4} textAnchor="end">
              {each}
            </text>
          </g>
        ))}
        <rect className="frame" x={LEFT} y={TOP} width={WIDTH} height={HEIGHT} />
        <text x={LEFT + WIDTH / 2} y={TOP + HEIGHT + 38} textAnchor="middle">
          palm and both fingers (mm)
        </text>
        <text transform={`translate(14 ${TOP + HEIGHT / 2}) rotate(-90)`} textAnchor="middle">
          tolerated error (mm)
        </text>
      </g>
      <polyline
        className="front-line"
        points={points
          .map(mm)
          .map(([a, b]) => `${x(a)},${y(b)}`)
          .join(" ")}
      />
      {chosen && <path className="front-chosen" d={`M${x(chosen[0]) - 6} ${y(chosen[1]) - 6}h12v12h-12Z`} />}
      {points.map((each) => {
        const [size, error] = mm(each);
        return (
          <g
            key={each.error_m}
            className={each === shown ? "front-point shown" : "front-point"}
            transform={`translate(${x(size)} ${y(error)})`}
            tabIndex={0}
            role="button"
            aria-label={`Load the hand of ${wordsOf(each)}`}
            onPointerEnter={() => onShow(each)}
            onPointerLeave={() => onShow(null)}
            onFocus={() => onShow(each)}
            onBlur={() => onShow(null)}
            onClick={() => onPick(each)}
            onKeyDown={(event) => {
              if (event.key !== "Enter" && event.key !== " ") return;
              event.preventDefault();
              onPick(each);
            }}
          >
            <circle className="front-reach" r={15} />
            <circle className="front-mark" r={5} />
          </g>
        );
      })}
    </svg>
  );
}

export const wordsOf = (point: FrontPoint): string => {
  const [size, error] = mm(point);
  return `${fixed(size, 1)} mm, which tolerates ${fixed(error, 1)} mm`;
};

const mm = (point: FrontPoint): readonly [number, number] => [1e3 * point.size_m, 1e3 * point.error_m];

/** Round ends around some values, and the numbers between them. */
function scaleOf(values: readonly number[]): { low: number; high: number; ticks: number[] } {
  const [least, most] = [Math.min(...values), Math.max(...values)];
  const step = roundStep(Math.max(most - least, 1e-3 * Math.abs(most), 1e-6) / 5);
  const first = Math.floor(least / step);
  const last = Math.max(Math.ceil(most / step), first + 1);
  const ticks = Array.from({ length: last - first + 1 }, (_, i) => Number(((first + i) * step).toPrecision(9)));
  return { low: first * step, high: last * step, ticks };
}
