/** Which palm, or which finger, holds every radius of a range: targets in, the sufficient dimensions and a hand out. */

import { useMemo, useState } from "react";
import { span } from "../answers/amounts";
import { shapeOf, type CaseFile } from "../case/case_file";
import { Drawing } from "../drawing/drawing";
import { Hand, openFingers } from "../drawing/hand";
import { ObjectOutline } from "../drawing/object";
import { boxOf, joined } from "../drawing/view";
import { NumberField } from "../panel/number_field";
import { useStudio } from "../shell/studio_context";
import type { Pair } from "../wire/records";
import { useAnswer } from "../wire/use_answer";

interface SizingValue {
  readonly sought: string;
  readonly intervals_m: readonly (readonly [number, number | null])[];
  readonly reason: string | null;
  readonly case?: CaseFile | null;
}

interface Targets {
  readonly low: number;
  readonly high: number;
  readonly given: "palm_width_mm" | "finger_length_mm";
  readonly size: number;
  readonly friction: number;
}

const FIRST: Targets = { low: 20, high: 60, given: "palm_width_mm", size: 120, friction: 0 };

export function SizingDesign() {
  const { connection, edit, openTab } = useStudio();
  const [targets, setTargets] = useState(FIRST);
  const question = useMemo(() => {
    const radius: Pair = [Math.min(targets.low, targets.high), Math.max(targets.low, targets.high)];
    return {
      kind: "design",
      parameters: { study: "size", radius_mm: radius, [targets.given]: targets.size, friction: targets.friction },
    };
  }, [targets]);
  const answer = useAnswer(connection, question);
  const sizing = answer.parts.get("sizing")?.value as SizingValue | undefined;
  const found = sizing?.case ?? null;
  const number = (
    key: "low" | "high" | "size" | "friction",
    label: string,
    unit: string,
    step: number,
    high: number,
  ) => (
    <NumberField
      label={label}
      unit={unit}
      value={targets[key]}
      low={0}
      high={high}
      step={step}
      onChange={(to) => typeof to === "number" && setTargets({ ...targets, [key]: to })}
      onSettle={() => undefined}
    />
  );
  const load = () => {
    if (!found) return;
    edit(found, null);
    openTab("studio");
  };
  const sought = targets.given === "palm_width_mm" ? "finger length" : "palm width";
  return (
    <div className="two flush">
      <div className="card sheet">
        {found ? <FoundHand file={found} /> : <p className="muted pad">No hand to draw.</p>}
      </div>
      <div className="stack">
        <div className="card stack">
          <h2>Targets</h2>
          {number("low", "Smallest radius", "mm", 1, 200)}
          {number("high", "Largest radius", "mm", 1, 200)}
          {number("friction", "Friction", "", 0.01, 2)}
          <label className="cluster">
            Given
            <select
              value={targets.given}
              onChange={(event) => setTargets({ ...targets, given: event.target.value as Targets["given"] })}
            >
              <option value="palm_width_mm">the palm's width, a finger is sought</option>
              <option value="finger_length_mm">the finger's length, a palm is sought</option>
            </select>
          </label>
          {number("size", targets.given === "palm_width_mm" ? "Palm width" : "Finger length", "mm", 1, 600)}
        </div>
        <div className="card stack" data-answer="sizing">
          <h2>Sufficient: {sought}</h2>
          {answer.error && (
            <p className="error" role="alert">
              {answer.error}
            </p>
          )}
          {sizing?.intervals_m.map(([low, high], i) => (
            <p key={i}>{span(low, high)}</p>
          ))}
          {sizing && sizing.intervals_m.length === 0 && <p>None: {sizing.reason}.</p>}
          <button type="button" className="primary" disabled={!found} onClick={load}>
            Load the smallest such hand
          </button>
        </div>
      </div>
    </div>
  );
}

function FoundHand({ file }: { file: CaseFile }) {
  const shape = useMemo(() => shapeOf(file), [file]);
  const fingers = openFingers(shape);
  const size = shape.radius ?? 0;
  const box = joined(boxOf([...fingers.right, ...fingers.left], 5), boxOf([[0, size]], size));
  return (
    <Drawing
      id="found"
      label="The hand found"
      content={box}
      plane={({ px }) => (
        <>
          <ObjectOutline shape={shape} at={[0, size]} theta={0} px={px} />
          <Hand fingers={fingers} thickness={shape.thickness} px={px} />
        </>
      )}
    />
  );
}
