/** The one drawing of hand, object and regions, with its grips. */

import { memo, useCallback, useMemo, useState } from "react";
import type { Look } from "../answers/use_look";
import { shapeOf, type CaseFile, type Shape } from "../case/case_file";
import { reach } from "../case/plane";
import { caseGrips } from "../drawing/case_grips";
import { Dimensions } from "../drawing/dimensions";
import { Drawing, type Layer } from "../drawing/drawing";
import { Grip } from "../drawing/grip";
import { Hand, openFingers, type Fingers } from "../drawing/hand";
import { ObjectOutline } from "../drawing/object";
import { boxOfArea } from "../drawing/paths";
import { Regions, type Shown } from "../drawing/regions";
import { boxOf, dragStep, joined, toScreen, type Box } from "../drawing/view";
import { useStudio } from "../shell/studio_context";
import type { Mode } from "./mode";

export interface ShownInStage extends Shown {
  readonly grips: boolean;
}

interface StageProps {
  readonly look: Look;
  readonly mode: Mode;
  readonly shown: ShownInStage;
}

export function Stage({ look, mode, shown }: StageProps) {
  const { file, edit, settle, connection } = useStudio();
  const [held, setHeld] = useState(false);
  const shape = useMemo(() => shapeOf(file), [file]);
  const fingers = useMemo(() => openFingers(shape), [shape]);
  const regions = useMemo(() => regionBox(look), [look.regions]);
  const content = [regions, mode.bounds].reduce<Box>(
    (box, each) => (each ? joined(box, each) : box),
    caseBox(shape, fingers),
  );
  const hold = useCallback((now: boolean) => setHeld(now), []);
  const isIdle = useCallback(() => connection.isIdle("look"), [connection]);
  return (
    <Drawing
      id="stage"
      label="Hand, object and regions, in millimetres"
      content={content}
      frozen={held}
      plane={(layer) => (
        <>
          <g className={look.late ? "late" : ""}>
            <Regions regions={look.regions} shown={shown} />
          </g>
          {shape.wall !== null && <Wall height={shape.wall} layer={layer} />}
          {mode.below?.(layer)}
          {mode.moving ? null : (
            <>
              <ObjectOutline shape={shape} at={shape.at} theta={shape.theta} px={layer.px} />
              <Hand fingers={fingers} thickness={shape.thickness} px={layer.px} />
            </>
          )}
          {mode.moving && <ObjectOutline shape={shape} at={shape.at} theta={shape.theta} px={layer.px} look="ghost" />}
          {mode.moving && <Hand fingers={fingers} thickness={shape.thickness} px={layer.px} ghost />}
          {mode.plane(layer)}
        </>
      )}
      over={(layer) => (
        <>
          {shown.centre && <AllowedError look={look} layer={layer} />}
          {!mode.moving && <Dimensions shape={shape} fingers={fingers} view={layer.view} size={layer.size} />}
          {shown.grips && (
            <Grips file={file} layer={layer} onEdit={edit} onSettle={settle} onHold={hold} isIdle={isIdle} />
          )}
        </>
      )}
    />
  );
}

interface GripsProps {
  readonly file: CaseFile;
  readonly layer: Layer;
  readonly onEdit: (to: CaseFile, gesture: string) => void;
  readonly onSettle: () => void;
  readonly onHold: (held: boolean) => void;
  readonly isIdle: () => boolean;
}

const Grips = memo(function Grips({ file, layer, onEdit, onSettle, onHold, isIdle }: GripsProps) {
  const step = dragStep(layer.view);
  return (
    <g className="grips">
      {caseGrips(file, step, onEdit).map((grip) => (
        <Grip
          key={grip.id}
          grip={grip}
          view={layer.view}
          size={layer.size}
          step={step}
          onSettle={onSettle}
          onHold={onHold}
          isIdle={isIdle}
        />
      ))}
    </g>
  );
});

/** The allowed error's radius in words, above its circle. */
function AllowedError({ look, layer }: { look: Look; layer: Layer }) {
  const circle = look.regions[0]?.allowed_mm;
  if (!circle || circle.radius <= 0) return null;
  const [x, y] = toScreen(layer.view, layer.size, [circle.centre[0], circle.centre[1] + circle.radius]);
  return (
    <text className="dimension" x={x} y={y - 6} textAnchor="middle">
      ± {circle.radius.toFixed(1)} mm
    </text>
  );
}

/** A wall across the drawing, hatched behind. */
function Wall({ height, layer }: { height: number; layer: Layer }) {
  const wide = layer.size.width * layer.px;
  const [left, thick] = [layer.view.centre[0] - wide, 12 * layer.px];
  return (
    <g>
      <pattern id="wall-hatch" width={6 * layer.px} height={6 * layer.px} patternUnits="userSpaceOnUse">
        <path className="hatch" d={`M0 0L${6 * layer.px} ${6 * layer.px}`} />
      </pattern>
      <rect className="wall-behind" x={left} y={height} width={2 * wide} height={thick} />
      <line className="wall" x1={left} x2={left + 2 * wide} y1={height} y2={height} />
    </g>
  );
}

function caseBox(shape: Shape, fingers: Fingers): Box {
  const half = 0.5 * shape.thickness;
  const hand = boxOf([...fingers.right, ...fingers.left], half);
  const size = 1.3 * reach(shape);
  const box = joined(hand, boxOf([shape.at], size));
  return shape.wall === null ? box : joined(box, boxOf([[0, shape.wall]]));
}

const regionBox = (look: Look): Box | null =>
  look.regions
    .flatMap((each) => [each.centre_mm, each.whole_mm, each.contact_mm])
    .map(boxOfArea)
    .reduce<Box | null>((box, each) => (box && each ? joined(box, each) : (box ?? each)), null);

const SETS: readonly (readonly [keyof ShownInStage, string])[] = [
  ["centre", "centre"],
  ["contact", "contact"],
  ["whole", "whole"],
  ["grips", "grips"],
];

/** Ticks for what is drawn. */
export function ShownSets({ shown, onShown }: { shown: ShownInStage; onShown: (shown: ShownInStage) => void }) {
  return (
    <div className="cluster" role="group" aria-label="Shown in the drawing">
      {SETS.map(([name, words]) => (
        <label key={name} className="tick">
          <input
            type="checkbox"
            checked={shown[name]}
            onChange={(event) => onShown({ ...shown, [name]: event.target.checked })}
          />
          {words}
        </label>
      ))}
    </div>
  );
}
