/** One moment of a motion in the plane: the hand, the object, its way so far, and where they touch. */

import { useMemo } from "react";
import type { Shape } from "../case/case_file";
import { Hand } from "../drawing/hand";
import { ObjectOutline } from "../drawing/object";
import { momentAt, rowAt, type Motion } from "./motion";

interface MotionLayerProps {
  readonly motion: Motion;
  readonly shape: Shape;
  readonly time: number;
  readonly px: number;
  readonly ghost?: boolean;
}

export function MotionLayer({ motion, shape, time, px, ghost = false }: MotionLayerProps) {
  const now = momentAt(motion, time);
  const row = rowAt(motion.times, time);
  const trail = useMemo(
    () => motion.object.slice(0, row + 1).map(([x, y]) => `${x.toFixed(3)},${y.toFixed(3)}`),
    [motion, row],
  );
  const [x, y, theta] = now.object;
  return (
    <g className={ghost ? "motion ghost" : "motion"} data-motion={ghost ? "prediction" : "motion"}>
      <polyline className="trail" points={[...trail, `${x},${y}`].join(" ")} />
      <ObjectOutline shape={shape} at={[x, y]} theta={theta} px={px} look={ghost ? "ghost" : "moving"} />
      <Hand fingers={now} thickness={shape.thickness} px={px} ghost={ghost} />
      {!ghost &&
        now.contacts.map(([cx, cy], i) => <circle key={i} className="contact-point" cx={cx} cy={cy} r={5 * px} />)}
    </g>
  );
}
