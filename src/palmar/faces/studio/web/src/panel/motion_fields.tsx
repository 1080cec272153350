/** Contact, support, sensors and behaviour: everything of the panel that is not hand or object. */

import { withValue } from "../case/edit";
import { useStudio } from "../shell/studio_context";
import { ChoiceField } from "./choice_field";
import { BoundChoice, BoundNumber, errorAt } from "./fields";
import { Optional } from "./hand_fields";

export function ContactFields({ error }: { error: string | null }) {
  const { file } = useStudio();
  const table = file.support?.kind !== "free";
  return (
    <fieldset>
      <legend>Contact and support</legend>
      <BoundNumber section="contact" name="friction" absent={0.7} error={error} />
      <BoundChoice
        section="support"
        name="kind"
        label="Support"
        choices={[
          ["table", "table"],
          ["free", "zero gravity"],
        ]}
        error={error}
      />
      {table ? (
        <>
          <BoundNumber section="support" name="friction" absent={0.3} error={error} />
          <BoundChoice
            section="support"
            name="pressure"
            label="Pressure under it"
            choices={[
              ["uniform", "uniform"],
              ["rim", "on the rim"],
              ["centre", "in the centre"],
            ]}
            error={error}
          />
          <Optional
            section="support"
            name="wall_mm"
            begin={wallHeight(file.hand.finger_links_mm)}
            words="A wall ahead"
            error={error}
          />
        </>
      ) : (
        <BoundNumber section="contact" name="restitution" absent={1} error={error} />
      )}
    </fieldset>
  );
}

/** Far enough ahead for the fingers, a round number. */
const wallHeight = (links: readonly unknown[]): number =>
  10 * Math.ceil(links.reduce<number>((sum, each) => sum + Number(each), 0) / 8);

const LAYOUTS = ["none", "palm", "tips", "distributed", "full"] as const;

export function BehaviourFields({ error }: { error: string | null }) {
  const { file, edit, hello } = useStudio();
  const name = file.behaviour?.name ?? "close";
  const known = hello?.behaviours ?? [{ name: "close", summary: "The hand stands still and closes.", parameters: {} }];
  const chosen = known.find((each) => each.name === name);
  const layout = file.sensors?.layout ?? "none";
  const own = typeof layout === "string" ? null : layout.join(", ");
  return (
    <fieldset>
      <legend>Behaviour and sensors</legend>
      <ChoiceField
        label="Behaviour"
        value={name}
        choices={known.map((each) => [each.name, each.name.replaceAll("_", " ")])}
        error={errorAt(error, "behaviour.name")}
        onChange={(to) => edit(withValue(file, "behaviour", "name", to), null)}
      />
      {chosen && <p className="small muted">{chosen.summary}</p>}
      {Object.entries(chosen?.parameters ?? {}).map(([key, given]) =>
        typeof given === "number" ? (
          <BoundNumber key={key} section="behaviour" name={key} absent={given} error={error} />
        ) : null,
      )}
      <ChoiceField
        label="Sensors"
        value={own ?? String(layout)}
        choices={[...LAYOUTS.map((each) => [each, each] as const), ...(own ? [[own, "as in the file"] as const] : [])]}
        error={errorAt(error, "sensors.layout")}
        onChange={(to) => edit(withValue(file, "sensors", "layout", to), null)}
      />
      {layout !== "none" && (
        <>
          <BoundNumber section="sensors" name="displacement_mm" error={error} />
          <BoundNumber section="sensors" name="pose_error_mm" error={error} />
        </>
      )}
    </fieldset>
  );
}
