/** The object's part of the panel: what it is, and where it starts. */

import { useCallback } from "react";
import type { Quantity } from "../case/case_file";
import { withShape, withStart, withValue } from "../case/edit";
import { useStudio } from "../shell/studio_context";
import { ChoiceField } from "./choice_field";
import { CornerTable } from "./corner_table";
import { BoundNumber, errorAt } from "./fields";
import { NumberField } from "./number_field";

export function ObjectFields({ error }: { error: string | null }) {
  const { file, edit } = useStudio();
  const { object } = file;
  return (
    <fieldset>
      <legend>Object</legend>
      <ChoiceField
        label="Shape"
        value={object.shape}
        choices={[
          ["disk", "disk"],
          ["polygon", "polygon"],
        ]}
        onChange={(shape) => edit(withShape(file, shape as "disk" | "polygon"), null)}
      />
      {object.shape === "disk" ? (
        <BoundNumber section="object" name="radius_mm" error={error} />
      ) : (
        <Corners error={error} />
      )}
      <BoundNumber section="object" name="mass_kg" absent={1} error={error} />
    </fieldset>
  );
}

function Corners({ error }: { error: string | null }) {
  const { file, edit, settle } = useStudio();
  if (file.object.shape !== "polygon") return null;
  return (
    <CornerTable
      corners={file.object.vertices_mm}
      error={errorAt(error, "object.vertices_mm")}
      onChange={(to, index) =>
        edit(withValue(file, "object", "vertices_mm", to), index === undefined ? null : `corner${index}`)
      }
      onSettle={settle}
    />
  );
}

export function StartFields({ error }: { error: string | null }) {
  const { file } = useStudio();
  const free = file.support?.kind === "free";
  return (
    <fieldset>
      <legend>Start of the object</legend>
      <PairField name="at_mm" along={0} label="x" unit="mm" ends={[-1000, 1000]} absent={0} error={error} />
      <PairField name="at_mm" along={1} label="y" unit="mm" ends={[-200, 1000]} absent={120} error={error} />
      <BoundNumber section="start" name="theta_deg" error={error} />
      {free && (
        <>
          <PairField
            name="velocity_mm_s"
            along={0}
            label="Velocity along x"
            unit="mm/s"
            ends={FAST}
            absent={0}
            error={error}
          />
          <PairField
            name="velocity_mm_s"
            along={1}
            label="Velocity along y"
            unit="mm/s"
            ends={FAST}
            absent={0}
            error={error}
          />
        </>
      )}
    </fieldset>
  );
}

const FAST = [-200, 200] as const;

interface PairFieldProps {
  readonly name: "at_mm" | "velocity_mm_s";
  readonly along: 0 | 1;
  readonly label: string;
  readonly unit: string;
  readonly ends: readonly [number, number];
  readonly absent: number;
  readonly error: string | null;
}

/** One of the two numbers of a place or velocity. */
function PairField({ name, along, label, unit, ends, absent, error }: PairFieldProps) {
  const { file, edit, settle } = useStudio();
  const change = useCallback(
    (to: Quantity) => edit((now) => withStart(now, name, along, to), `start.${name}`),
    [edit, name, along],
  );
  return (
    <NumberField
      label={label}
      unit={unit}
      value={file.start?.[name]?.[along] ?? absent}
      low={ends[0]}
      high={ends[1]}
      step={1}
      error={along === 0 ? errorAt(error, `start.${name}`) : null}
      onChange={change}
      onSettle={settle}
    />
  );
}
