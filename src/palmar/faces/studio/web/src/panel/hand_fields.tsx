/** The hand's part of the panel. */

import { useCallback } from "react";
import { middle, type Quantity } from "../case/case_file";
import { withLink, withLinks, withValue } from "../case/edit";
import { useStudio } from "../shell/studio_context";
import { ChoiceField } from "./choice_field";
import { BoundChoice, BoundNumber, errorAt } from "./fields";
import { NumberField } from "./number_field";

const COUNTS = ["1", "2", "3", "4", "5", "6"];

export function HandFields({ error }: { error: string | null }) {
  const { file, edit } = useStudio();
  const links = file.hand.finger_links_mm;
  const counts = COUNTS.includes(String(links.length)) ? COUNTS : [...COUNTS, String(links.length)];
  return (
    <fieldset>
      <legend>Hand</legend>
      <BoundNumber section="hand" name="palm_width_mm" error={error} />
      <ChoiceField
        label="Links of a finger"
        value={String(links.length)}
        choices={counts.map((each) => [each, each])}
        onChange={(count) => edit(withLinks(file, Number(count)), null)}
      />
      {links.map((link, i) => (
        <LinkField key={i} index={i} value={link} only={links.length === 1} error={error} />
      ))}
      <BoundNumber section="hand" name="finger_thickness_mm" error={error} />
      <BoundNumber section="hand" name="open_deg" error={error} />
      <BoundChoice
        section="hand"
        name="fingers"
        label="Fingers"
        choices={[
          ["crossing", "cross"],
          ["colliding", "collide"],
        ]}
        error={error}
      />
      <BoundNumber section="hand" name="finger_rate_deg_s" absent={30} error={error} />
      {file.support?.kind === "free" && (
        <Optional
          section="hand"
          name="finger_mass_kg"
          begin={0.1}
          words="Fingers give way (have a mass)"
          error={error}
        />
      )}
    </fieldset>
  );
}

interface LinkFieldProps {
  readonly index: number;
  readonly value: Quantity;
  readonly only: boolean;
  readonly error: string | null;
}

/** Length of one link. */
function LinkField({ index, value, only, error }: LinkFieldProps) {
  const { edit, settle } = useStudio();
  const change = useCallback((to: Quantity) => edit((now) => withLink(now, index, to), `link${index}`), [edit, index]);
  return (
    <NumberField
      label={only ? "Finger length" : `Link ${index + 1}${index === 0 ? ", at the palm" : ""}`}
      unit="mm"
      value={value}
      low={0}
      step={1}
      error={index === 0 ? errorAt(error, "hand.finger_links_mm") : null}
      onChange={change}
      onSettle={settle}
    />
  );
}

interface OptionalProps {
  readonly section: "hand" | "support";
  readonly name: string;
  /** The value that it begins with when it is ticked. */
  readonly begin: number;
  readonly words: string;
  readonly error: string | null;
}

/** A number that a case may be without. */
export function Optional({ section, name, begin, words, error }: OptionalProps) {
  const { file, edit } = useStudio();
  const given = (file[section] as Readonly<Record<string, unknown>> | undefined)?.[name];
  const there = given !== undefined && given !== null;
  return (
    <>
      <label className="tick">
        <input
          type="checkbox"
          checked={there}
          onChange={(event) => edit(withValue(file, section, name, event.target.checked ? begin : undefined), null)}
        />
        {words}
      </label>
      {there && <BoundNumber section={section} name={name} absent={middle(given as number, begin)} error={error} />}
    </>
  );
}
