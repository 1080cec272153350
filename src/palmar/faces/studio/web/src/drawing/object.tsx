/** The object to scale: its outline, and a mark in its frame's origin that shows how it is turned. */

import { memo } from "react";
import type { Point, Shape } from "../case/case_file";
import { add, outline, polar } from "../case/plane";

interface ObjectProps {
  readonly shape: Shape;
  readonly at: Point;
  readonly theta: number;
  /** Size of a pixel (mm). */
  readonly px: number;
  readonly look?: "start" | "moving" | "ghost" | "outline";
}

export const ObjectOutline = memo(function ObjectOutline({ shape, at, theta, px, look = "start" }: ObjectProps) {
  const [across, up] = [polar(5 * px, theta), polar(5 * px, theta + 90)];
  const away = (step: Point): Point => [-step[0], -step[1]];
  const turnMark = shape.radius === null ? null : add(at, polar(shape.radius, theta));
  return (
    <g className={`object ${look}`}>
      {shape.radius !== null ? (
        <circle cx={at[0]} cy={at[1]} r={shape.radius} />
      ) : (
        <path
          d={`M${outline(shape, at, theta)
            .map((each) => each.join(" "))
            .join("L")}Z`}
        />
      )}
      {look === "moving" && turnMark && <line x1={at[0]} y1={at[1]} x2={turnMark[0]} y2={turnMark[1]} />}
      {[across, up].map((step, i) => {
        const [from, to] = [add(at, away(step)), add(at, step)];
        return <line key={i} x1={from[0]} y1={from[1]} x2={to[0]} y2={to[1]} />;
      })}
    </g>
  );
});
