/** The object's part of the panel: what it is, and where it starts. */

import { middle, shapeOf, type Point } from "../case/case_file";
import { addCorner, dragStart, removeCorner, withShape, withValue } from "../case/edit";
import { useStudio } from "../shell/studio_context";
import { ChoiceField } from "./choice_field";
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

/** A row for each corner, in the object's own frame. */
function Corners({ error }: { error: string | null }) {
  const { file, edit, settle } = useStudio();
  if (file.object.shape !== "polygon") return null;
  const corners = file.object.vertices_mm;
  const move = (index: number, along: 0 | 1, to: number) => {
    const next = corners.map((each, i) => (i === index ? (along === 0 ? [to, each[1]] : [each[0], to]) : each));
    edit(withValue(file, "object", "vertices_mm", next), `corner${index}`);
  };
  return (
    <div className="stack">
      <table className="corners">
        <thead>
          <tr>
            <th>corner</th>
            <th>x (mm)</th>
            <th>y (mm)</th>
            <th>
              <span className="visually-hidden">add or remove</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {corners.map((corner, i) => (
            <tr key={i}>
              <td>{i + 1}</td>
              {([0, 1] as const).map((along) => (
                <td key={along}>
                  <input
                    type="number"
                    aria-label={`Corner ${i + 1}, ${along === 0 ? "x" : "y"} in mm`}
                    value={middle(corner[along], 0)}
                    step={1}
                    onChange={(event) =>
                      Number.isFinite(event.target.valueAsNumber) && move(i, along, event.target.valueAsNumber)
                    }
                    onBlur={settle}
                  />
                </td>
              ))}
              <td className="cluster">
                <button
                  type="button"
                  className="tiny"
                  aria-label={`Add a corner after ${i + 1}`}
                  onClick={() => edit(addCorner(file, i), null)}
                >
                  +
                </button>
                <button
                  type="button"
                  className="tiny"
                  aria-label={`Remove corner ${i + 1}`}
                  disabled={corners.length <= 3}
                  onClick={() => edit(removeCorner(file, i), null)}
                >
                  ×
                </button>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      {errorAt(error, "object.vertices_mm") && (
        <p className="error small" role="alert">
          {error}
        </p>
      )}
    </div>
  );
}

export function StartFields({ error }: { error: string | null }) {
  const { file, edit, settle } = useStudio();
  const { at } = shapeOf(file);
  const velocity = file.start?.velocity_mm_s ?? [0, 0];
  const put = (to: Point) => edit(dragStart(file, to, 1e-6), "start");
  return (
    <fieldset>
      <legend>Start of the object</legend>
      <NumberField
        label="x"
        unit="mm"
        value={at[0]}
        low={-1000}
        step={1}
        high={1000}
        error={errorAt(error, "start.at_mm")}
        onChange={(x) => put([Number(x), at[1]])}
        onSettle={settle}
      />
      <NumberField
        label="y"
        unit="mm"
        value={at[1]}
        low={-200}
        step={1}
        high={1000}
        onChange={(y) => put([at[0], Number(y)])}
        onSettle={settle}
      />
      <BoundNumber section="start" name="theta_deg" error={error} />
      {file.support?.kind === "free" &&
        ([0, 1] as const).map((along) => (
          <NumberField
            key={along}
            label={`Velocity along ${along === 0 ? "x" : "y"}`}
            unit="mm/s"
            value={velocity[along]}
            low={-200}
            high={200}
            step={1}
            error={along === 0 ? errorAt(error, "start.velocity_mm_s") : null}
            onChange={(to) => {
              const next = along === 0 ? [to, velocity[1]] : [velocity[0], to];
              edit(withValue(file, "start", "velocity_mm_s", next), `velocity${along}`);
            }}
            onSettle={settle}
          />
        ))}
    </fieldset>
  );
}
