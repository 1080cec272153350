/** The brief as fields: targets that the hand must meet, limits within which it may be built. */

import { useCallback, useState } from "react";
import { middle, type Quantity } from "../case/case_file";
import { ChoiceField } from "../panel/choice_field";
import { CornerTable } from "../panel/corner_table";
import { NumberField } from "../panel/number_field";
import { cornersOf, quantityOf, withKey, withObject, type SectionName } from "./brief_file";
import { useDesigning } from "./use_design";

/** Where the server's complaint belongs, or null. */
const placeOf = (error: string | null): string | null => /\b(targets|limits)\.\w+/.exec(error ?? "")?.[0] ?? null;

/** Whether a field of the form shows the complaint. */
export const isShownAtField = (error: string | null): boolean => FIELDS.has(placeOf(error) ?? "");

interface NumberProps {
  readonly section: SectionName;
  readonly name: string;
  readonly label: string;
  readonly unit?: string;
  readonly absent: Quantity;
  readonly high?: number;
  readonly step: number;
}

const NUMBERS = {
  radii: { section: "targets", name: "radii_mm", label: "Radii", unit: "mm", absent: 40, step: 1 },
  friction: { section: "targets", name: "friction", label: "Friction", absent: 0, high: 2, step: 0.01 },
  error: { section: "targets", name: "error_mm", label: "Placement error", unit: "mm", absent: 0, step: 1 },
  restitution: { section: "targets", name: "restitution", label: "Restitution", absent: "0..1", high: 1, step: 0.01 },
  palm: { section: "limits", name: "palm_width_mm", label: "Palm width", unit: "mm", absent: "0..1000000", step: 1 },
  finger: {
    section: "limits",
    name: "finger_length_mm",
    label: "Finger length",
    unit: "mm",
    absent: "0..1000000",
    step: 1,
  },
  hand: { section: "limits", name: "hand_length_mm", label: "Whole hand, at most", unit: "mm", absent: 1e6, step: 1 },
  thickness: {
    section: "limits",
    name: "finger_thickness_mm",
    label: "Finger thickness",
    unit: "mm",
    absent: 0,
    step: 0.5,
  },
  margin: { section: "limits", name: "margin", label: "Margin, as a share", absent: 0.01, high: 0.5, step: 0.005 },
} as const satisfies Readonly<Record<string, NumberProps>>;
const FIELDS = new Set([
  ...Object.values(NUMBERS).map((each) => `${each.section}.${each.name}`),
  "targets.vertices_mm",
  "targets.approaches_max",
  "targets.sensors",
  "limits.links",
]);

export function TargetFields() {
  const { brief, edit, answer } = useDesigning();
  const { error } = answer;
  const corners = cornersOf(brief);
  const free = brief.targets["support"] === "free";
  const sensors = typeof brief.targets["sensors"] === "string" ? brief.targets["sensors"] : "none";
  return (
    <fieldset>
      <legend>Targets</legend>
      <ChoiceField
        label="Objects"
        value={corners ? "polygon" : "disks"}
        choices={[
          ["disks", "disks"],
          ["polygon", "polygon"],
        ]}
        onChange={(to) => edit((now) => withObject(now, to === "polygon"))}
      />
      {corners ? (
        <CornerTable
          corners={corners}
          error={placeOf(error) === "targets.vertices_mm" ? error : null}
          onChange={(to) => edit((now) => withKey(now, "targets", "vertices_mm", to))}
        />
      ) : (
        <BriefNumber {...NUMBERS.radii} />
      )}
      <BriefNumber {...NUMBERS.friction} />
      <BriefNumber {...NUMBERS.error} />
      {!corners && (
        <ChoiceField
          label="Support"
          value={free ? "free" : "table"}
          choices={[
            ["table", "table"],
            ["free", "zero gravity"],
          ]}
          onChange={(to) => edit((now) => withKey(now, "targets", "support", to))}
        />
      )}
      {free && <BriefNumber {...NUMBERS.restitution} />}
      {!corners && !free && (
        <ChoiceField
          label="Sensors"
          value={sensors}
          choices={["none", "palm", "tips", "distributed", "full"].map((each) => [each, each] as const)}
          error={placeOf(error) === "targets.sensors" ? error : null}
          onChange={(to) => edit((now) => withKey(now, "targets", "sensors", to === "none" ? undefined : to))}
        />
      )}
      {sensors !== "none" && (
        <ChoiceField
          label="Approaches, at most"
          value={String(brief.targets["approaches_max"] ?? 1)}
          choices={["1", "2", "3", "4", "5", "6"].map((each) => [each, each] as const)}
          error={placeOf(error) === "targets.approaches_max" ? error : null}
          onChange={(to) => edit((now) => withKey(now, "targets", "approaches_max", Number(to)))}
        />
      )}
    </fieldset>
  );
}

const LINKS = [1, 2, 3, 4, 5, 6];

export function LimitFields() {
  const { brief, edit, answer } = useDesigning();
  const given = brief.limits["links"];
  const links: readonly number[] = Array.isArray(given) ? (given as number[]) : [1, 2, 3];
  const tick = (count: number, there: boolean) => {
    const next = LINKS.filter((each) => (each === count ? there : links.includes(each)));
    if (next.length > 0) edit((now) => withKey(now, "limits", "links", next));
  };
  return (
    <fieldset>
      <legend>Limits</legend>
      <OptionalNumber {...NUMBERS.palm} begin="40..120" words="Limit the palm" />
      <OptionalNumber {...NUMBERS.finger} begin="0..200" words="Limit the fingers" />
      <OptionalNumber {...NUMBERS.hand} begin={300} words="Limit palm and both fingers together" />
      <div className="field" role="group" aria-label="Links a finger that are allowed">
        <span>Links a finger</span>
        <span className="cluster wide-control">
          {LINKS.map((count) => (
            <label key={count} className="tick">
              <input
                type="checkbox"
                checked={links.includes(count)}
                onChange={(event) => tick(count, event.target.checked)}
              />
              {count}
            </label>
          ))}
        </span>
      </div>
      {placeOf(answer.error) === "limits.links" && (
        <p className="error small" role="alert">
          {answer.error}
        </p>
      )}
      <BriefNumber {...NUMBERS.thickness} />
      <ChoiceField
        label="Fingers"
        value={brief.limits["fingers"] === "colliding" ? "colliding" : "crossing"}
        choices={[
          ["crossing", "cross"],
          ["colliding", "collide"],
        ]}
        onChange={(to) => edit((now) => withKey(now, "limits", "fingers", to))}
      />
      <BriefNumber {...NUMBERS.margin} />
    </fieldset>
  );
}

/** A number or a range of the brief. */
function BriefNumber({ section, name, label, unit = "", absent, high, step }: NumberProps) {
  const { brief, edit, answer } = useDesigning();
  const value = quantityOf(brief, section, name, absent);
  const change = useCallback((to: Quantity) => edit((now) => withKey(now, section, name, to)), [edit, section, name]);
  return (
    <NumberField
      label={label}
      unit={unit}
      value={value}
      low={0}
      {...(high === undefined ? {} : { high })}
      step={step}
      error={placeOf(answer.error) === `${section}.${name}` ? answer.error : null}
      onChange={change}
      onSettle={nothing}
    />
  );
}

/** A limit that a brief may be without. */
function OptionalNumber({
  begin,
  words,
  ...number
}: NumberProps & { readonly begin: Quantity; readonly words: string }) {
  const { brief, edit } = useDesigning();
  const { section, name, absent } = number;
  const given = brief[section][name];
  // What the file says when it says nothing comes back from the server, too: no limit that means anything.
  const there = given !== undefined && middle(quantityOf(brief, section, name, 0), 0) < middle(absent, 0);
  const [last, keep] = useState<Quantity>(begin);
  const tick = (on: boolean) => {
    if (!on) keep(quantityOf(brief, section, name, begin));
    edit((now) => withKey(now, section, name, on ? last : undefined));
  };
  return (
    <>
      <label className="tick">
        <input type="checkbox" checked={there} onChange={(event) => tick(event.target.checked)} />
        {words}
      </label>
      {there && <BriefNumber {...number} />}
    </>
  );
}

const nothing = (): void => undefined;
