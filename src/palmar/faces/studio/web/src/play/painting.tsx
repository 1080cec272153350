/** A grid of starts by what becomes of them: filled squares are caught, crosses are lost, dots are never touched. */

import { memo, useMemo, type MouseEvent } from "react";
import type { Point } from "../case/case_file";
import type { Layer } from "../drawing/drawing";
import { toPlane } from "../drawing/view";
import type { OutcomesValue } from "../wire/records";

/** Marks of one look as one path: thousands of starts stay quick to draw. */
interface Marks {
  readonly look: "caught" | "lost" | "missed";
  readonly path: string;
}

export function marksOf(value: OutcomesValue): Marks[] {
  const [w, h] = [0.78 * value.cell_mm[0], 0.78 * value.cell_mm[1]];
  const arm = 0.3 * Math.min(w, h);
  const parts: Record<Marks["look"], string[]> = { caught: [], lost: [], missed: [] };
  value.codes.forEach((code, i) => {
    const name = value.names[code];
    const x = value.x_mm[i % value.x_mm.length] as number;
    const y = value.y_mm[Math.floor(i / value.x_mm.length)] as number;
    if (value.caught[code]) parts.caught.push(`M${x - w / 2} ${y - h / 2}h${w}v${h}h${-w}Z`);
    else if (name === "missed") parts.missed.push(`M${x - arm / 4} ${y}h${arm / 2}`);
    else if (name !== "invalid")
      parts.lost.push(`M${x - arm} ${y - arm}l${2 * arm} ${2 * arm}M${x - arm} ${y + arm}l${2 * arm} ${-2 * arm}`);
  });
  return (["caught", "lost", "missed"] as const).map((look) => ({ look, path: parts[look].join("") }));
}

interface PaintingProps {
  readonly value: OutcomesValue;
  readonly layer: Layer;
  /** A start was clicked on (mm). */
  readonly onPick: (at: Point) => void;
}

export const Painting = memo(function Painting({ value, layer, onPick }: PaintingProps) {
  const marks = useMemo(() => marksOf(value), [value]);
  const pick = (event: MouseEvent<SVGGElement>) => {
    const box = (event.currentTarget.ownerSVGElement as SVGSVGElement).getBoundingClientRect();
    const [x, y] = toPlane(layer.view, layer.size, [event.clientX - box.left, event.clientY - box.top]);
    onPick([nearest(value.x_mm, x), nearest(value.y_mm, y)]);
  };
  return (
    <g className="painting" onPointerDown={(event) => event.stopPropagation()} onClick={pick}>
      {marks.map(({ look, path }) => (
        <path key={look} className={`start-marks ${look}`} data-marks={look} d={path} />
      ))}
    </g>
  );
});

const nearest = (values: readonly number[], to: number): number =>
  values.reduce((best, each) => (Math.abs(each - to) < Math.abs(best - to) ? each : best));
