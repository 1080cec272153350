/** The hand found, opened flat, with the objects of the brief and the circle in which their centre may start. */

import { useMemo } from "react";
import { shapeOf } from "../case/case_file";
import { reach } from "../case/plane";
import { Dimensions } from "../drawing/dimensions";
import { Drawing } from "../drawing/drawing";
import { Hand, openFingers } from "../drawing/hand";
import { ObjectOutline } from "../drawing/object";
import { boxOf, joined } from "../drawing/view";
import type { FoundHand } from "./brief_file";

/** Below the hand for its dimensions, as a share of its width. */
const ROOM = 0.06;

export function FoundHandDrawing({ found }: { found: FoundHand }) {
  const shape = useMemo(() => shapeOf(found.case), [found]);
  const fingers = openFingers(shape);
  const whole = [...fingers.right, ...fingers.left];
  const hand = boxOf(whole, 0.5 * shape.thickness);
  const room = ROOM * (hand.right - hand.left);
  const box = joined(
    { ...hand, bottom: hand.bottom - room },
    boxOf([found.place_mm], Math.max(reach(shape), found.error_mm)),
  );
  const [x, y] = found.place_mm;
  const lengths = { ...shape, halfPalm: 0.5 * tenth(2 * shape.halfPalm), links: shape.links.map(tenth) };
  return (
    <>
      <Drawing
        id="designed"
        label="The hand found, open, with the objects at their nominal place"
        content={box}
        plane={({ px }) => (
          <>
            {found.error_mm > 0 && <circle className="region centre" cx={x} cy={y} r={found.error_mm} />}
            {found.radii_mm.slice(0, -1).map((radius) => (
              <g key={radius} className="object ghost">
                <circle cx={x} cy={y} r={radius} />
              </g>
            ))}
            <ObjectOutline shape={shape} at={found.place_mm} theta={0} px={px} look="outline" />
            <Hand fingers={fingers} thickness={shape.thickness} px={px} />
          </>
        )}
        over={({ view, size }) => <Dimensions shape={lengths} fingers={fingers} view={view} size={size} />}
      />
      <p className="legend muted">{captionOf(found)}</p>
    </>
  );
}

/** Rounded so that the words find room; the table has more digits. */
const tenth = (value: number): number => Number(value.toFixed(1));

function captionOf({ radii_mm: radii, error_mm: error }: FoundHand): string {
  const objects = radii.length > 1 ? "the smallest and the largest object" : "the object";
  const circle = error > 0 ? " Blue: wherever in this circle its centre starts, it is caught." : "";
  return `The hand opened flat, ${objects} at the nominal place.${circle}`;
}
