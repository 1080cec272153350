/** Axes in millimetres along the left and bottom edge, with a light grid behind everything. */

import { memo } from "react";
import { GUTTER, roundStep, seen, toScreen, type Size, type View } from "./view";

const BETWEEN = 64;

/** Round numbers between two ends. */
function ticks(low: number, high: number, step: number): number[] {
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.max(0, Math.floor(high / step + 1e-9) - first + 1);
  return Array.from({ length: Math.min(count, 200) }, (_, i) => Number(((first + i) * step).toFixed(9)));
}

const words = (value: number): string => String(value).replace("-", "−");

export const Axes = memo(function Axes({ view, size, unit = "mm" }: { view: View; size: Size; unit?: string }) {
  const step = roundStep(BETWEEN / view.scale);
  const box = seen(view, size);
  const bottom = size.height - GUTTER.bottom;
  const right = size.width - GUTTER.right;
  return (
    <g className="axes" aria-hidden="true">
      {ticks(box.left, box.right, step).map((x) => {
        const [px] = toScreen(view, size, [x, 0]);
        return (
          <g key={`x${x}`}>
            <line className={x === 0 ? "grid zero" : "grid"} x1={px} x2={px} y1={GUTTER.top} y2={bottom} />
            <text x={px} y={bottom + 15} textAnchor="middle">
              {words(x)}
            </text>
          </g>
        );
      })}
      {ticks(box.bottom, box.top, step).map((y) => {
        const [, py] = toScreen(view, size, [0, y]);
        return (
          <g key={`y${y}`}>
            <line className={y === 0 ? "grid zero" : "grid"} x1={GUTTER.left} x2={right} y1={py} y2={py} />
            <text x={GUTTER.left - 6} y={py + 4} textAnchor="end">
              {words(y)}
            </text>
          </g>
        );
      })}
      <rect
        className="frame"
        x={GUTTER.left}
        y={GUTTER.top}
        width={Math.max(0, right - GUTTER.left)}
        height={Math.max(0, bottom - GUTTER.top)}
      />
      <text className="axis-name" x={0.5 * (GUTTER.left + right)} y={size.height - 6} textAnchor="middle">
        x ({unit})
      </text>
      <text
        className="axis-name"
        transform={`translate(13 ${0.5 * (GUTTER.top + bottom)}) rotate(-90)`}
        textAnchor="middle"
      >
        y ({unit})
      </text>
    </g>
  );
});
