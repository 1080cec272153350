/** Fields of the panel bound to keys of the case. */

import { useCallback } from "react";
import type { Quantity } from "../case/case_file";
import { withValue, type Section } from "../case/edit";
import type { KeyFacts } from "../wire/hello";
import { useStudio } from "../shell/studio_context";
import { ChoiceField } from "./choice_field";
import { LOOKS, readable, unitOf } from "./labels";
import { NumberField } from "./number_field";

/** Where the server's complaint belongs: `section.key`, or nowhere in particular. */
export function placeOfError(error: string | null): string | null {
  return /\b(hand|object|contact|support|start|sensors|behaviour)\.\w+/.exec(error ?? "")?.[0] ?? null;
}

export const errorAt = (error: string | null, place: string): string | null =>
  placeOfError(error) === place ? error : null;

interface BoundProps {
  readonly section: Section;
  readonly name: string;
  /** Used while neither the case nor the server says anything. */
  readonly absent?: number;
  readonly error: string | null;
}

/** A key's facts from the server. */
export function useFacts(section: string, name: string): KeyFacts | undefined {
  const { hello, file } = useStudio();
  const table = hello?.keys[section];
  const inner =
    section === "object" ? (table?.[file.object.shape] as Readonly<Record<string, KeyFacts>> | undefined) : table;
  return inner?.[name] as KeyFacts | undefined;
}

/** A number of the case. */
export function BoundNumber({ section, name, absent = 0, error }: BoundProps) {
  const { file, edit, settle } = useStudio();
  const facts = useFacts(section, name);
  const place = `${section}.${name}`;
  const look = LOOKS[place] ?? { label: readable(name), step: 1 };
  const given = (file[section] as Readonly<Record<string, unknown>> | undefined)?.[name];
  const fallback = typeof facts?.default === "number" ? facts.default : absent;
  const value = (given ?? fallback) as Quantity;
  const [low, high] = [look.low ?? Math.max(facts?.minimum ?? 0, -1000), look.high];
  const change = useCallback(
    (to: Quantity) => edit((now) => withValue(now, section, name, to), `${section}.${name}`),
    [edit, section, name],
  );
  return (
    <NumberField
      label={look.label}
      unit={unitOf(name, facts?.unit)}
      value={value}
      low={low}
      {...(high === undefined ? {} : { high })}
      step={look.step}
      error={errorAt(error, place)}
      onChange={change}
      onSettle={settle}
    />
  );
}

interface BoundChoiceProps extends BoundProps {
  readonly label: string;
  readonly choices: readonly (readonly [value: string, words: string])[];
}

/** A word of the case; the first choice is what the case means when it says nothing. */
export function BoundChoice({ section, name, label, choices, error }: BoundChoiceProps) {
  const { file, edit } = useStudio();
  const given = (file[section] as Readonly<Record<string, unknown>> | undefined)?.[name];
  return (
    <ChoiceField
      label={label}
      value={typeof given === "string" ? given : (choices[0]?.[0] ?? "")}
      choices={choices}
      error={errorAt(error, `${section}.${name}`)}
      onChange={(to) => edit(withValue(file, section, name, to), null)}
    />
  );
}
