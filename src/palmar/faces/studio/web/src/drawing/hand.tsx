/** Palm and fingers to scale. */

import { memo } from "react";
import type { Point, Shape } from "../case/case_file";
import { fingerPoints, mirrored, openJoints } from "../case/plane";

/** Joints, base joint first, and tip of each finger (mm). */
export interface Fingers {
  readonly right: readonly Point[];
  readonly left: readonly Point[];
}

/** The open hand of a case in its own frame. */
export function openFingers(shape: Shape): Fingers {
  const right = fingerPoints(shape.halfPalm, shape.links, openJoints(shape));
  return { right, left: right.map(mirrored) };
}

const trail = (points: readonly Point[]): string =>
  `M${points.map(([x, y]) => `${x.toFixed(4)} ${y.toFixed(4)}`).join("L")}`;

interface HandProps {
  readonly fingers: Fingers;
  readonly thickness: number;
  /** Size of a pixel (mm). */
  readonly px: number;
  readonly ghost?: boolean;
}

export const Hand = memo(function Hand({ fingers, thickness, px, ghost = false }: HandProps) {
  const sides = [fingers.right, fingers.left];
  const bases = sides.flatMap((each) => each.slice(0, 1));
  return (
    <g className={ghost ? "hand ghost" : "hand"}>
      {thickness > 0 &&
        sides.map((points, i) => (
          <g key={i}>
            <path className="capsule-edge" d={trail(points)} strokeWidth={thickness} />
            <path className="capsule" d={trail(points)} strokeWidth={Math.max(thickness - 2.6 * px, 0)} />
          </g>
        ))}
      {sides.map((points, i) => (
        <path key={i} className={thickness > 0 ? "joint-line" : "finger"} d={trail(points)} />
      ))}
      <path className="palm" d={trail(bases)} />
      {sides.flatMap((points, i) =>
        points
          .slice(0, -1)
          .map(([x, y], k) => (
            <circle key={`${i} ${k}`} className="joint" cx={x} cy={y} r={px * (k === 0 ? 4.5 : 3.4)} />
          )),
      )}
    </g>
  );
});
