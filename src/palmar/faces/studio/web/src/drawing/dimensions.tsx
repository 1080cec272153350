/** The dimensions of hand and object in words beside what they measure, where there is room for them. */

import { memo } from "react";
import type { Point, Shape } from "../case/case_file";
import { add, length, minus, polar } from "../case/plane";
import { toScreen, type Size, type View } from "./view";
import type { Fingers } from "./hand";

interface Note {
  readonly at: Point;
  readonly words: string;
  /** Shift on the screen (px). */
  readonly by: Point;
}

/** Pixels that a dimension of some millimetres takes; between two points it is left out where they are nearer. */
const ROOM = 46;
const OFF = 17;

const mm = (value: number): string => `${Number(value.toFixed(3))} mm`;

export const Dimensions = memo(function Dimensions({
  shape,
  fingers,
  view,
  size,
}: {
  shape: Shape;
  fingers: Fingers;
  view: View;
  size: Size;
}) {
  const notes: Note[] = [{ at: [0, 0], words: mm(2 * shape.halfPalm), by: [0, OFF] }];
  fingers.right.slice(1).forEach((to, i) => {
    const from = fingers.right[i] as Point;
    const arm = minus(to, from);
    const away = length(arm) || 1;
    const middle: Point = [0.5 * (from[0] + to[0]), 0.5 * (from[1] + to[1])];
    const out = OFF + 0.5 * shape.thickness * view.scale;
    notes.push({ at: middle, words: mm(shape.links[i] ?? 0), by: [(out * arm[1]) / away, (out * arm[0]) / away] });
  });
  const fits = notes.filter((each, i) => {
    const measured = i === 0 ? 2 * shape.halfPalm : (shape.links[i - 1] ?? 0);
    return measured * view.scale > ROOM || each.by[0] !== 0;
  });
  if (shape.radius !== null) {
    fits.push({ at: add(shape.at, polar(shape.radius, 45)), words: `R ${mm(shape.radius)}`, by: [34, -12] });
  }
  return (
    <g className="dimensions" aria-hidden="true">
      {fits.map(({ at, words, by }, i) => {
        const [x, y] = toScreen(view, size, at);
        return (
          <text key={i} x={x + by[0]} y={y + by[1] + 4} textAnchor="middle">
            {words}
          </text>
        );
      })}
    </g>
  );
});
