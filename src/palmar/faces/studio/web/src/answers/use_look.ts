/** Verdict and regions of the case as it is edited: quick answers while it changes, the exact ones once they are there. */

import { useMemo } from "react";
import type { CaseFile } from "../case/case_file";
import type { Connection, Part } from "../wire/connection";
import type { ClosureRecord, DrawingValue, RegionValue, Uncovered, ValidityValue } from "../wire/records";
import { useAnswer, type Question } from "../wire/use_answer";

export interface Look {
  readonly closure: ClosureRecord | null;
  readonly drawing: DrawingValue | null;
  /** In the order in which the models were asked for. */
  readonly regions: readonly RegionValue[];
  readonly uncovered: readonly Uncovered[];
  /** Models whose exact answer has not come yet. */
  readonly quick: ReadonlySet<string>;
  /** Whether the verdict is a quick one, to be followed by the whole. */
  readonly verdictQuick: boolean;
  /** The verdict is that of an earlier case: this one's is still to come. */
  readonly verdictLate: boolean;
  readonly validity: ValidityValue | null;
  /** The regions are those of an earlier case: this one's are still to come. */
  readonly late: boolean;
  readonly error: string | null;
  readonly busy: boolean;
  readonly wait: string | null;
}

export function useLook(connection: Connection, file: CaseFile, models: readonly string[], closure: string): Look {
  const question = useMemo<Question>(() => {
    const answered = new Set<unknown>();
    const enough = (part: Part): boolean => {
      if (part.part === "region") answered.add((part.value as { model: string }).model);
      return answered.size >= models.length;
    };
    return { kind: "look", file, parameters: { models, closure }, enough };
  }, [file, models, closure]);
  const { parts, error, busy, wait } = useAnswer(connection, question);
  return useMemo(() => {
    const found = models.flatMap((model) => parts.get(`region ${model}`) ?? []);
    const newest = Math.max(...[...parts.values()].map((each) => each.seq));
    const values = found.map((part) => part.value as RegionValue | Uncovered);
    return {
      closure: (parts.get("closure")?.value ?? null) as ClosureRecord | null,
      verdictQuick: parts.get("closure")?.stage === "quick",
      verdictLate: (parts.get("closure")?.seq ?? newest) < newest,
      validity: (parts.get(`validity ${models[0]}`)?.value ?? null) as ValidityValue | null,
      drawing: (parts.get("drawing")?.value ?? null) as DrawingValue | null,
      regions: values.filter((each): each is RegionValue => "record" in each),
      uncovered: values.filter((each): each is Uncovered => "uncovered" in each),
      quick: new Set(found.filter((part) => part.stage === "quick").map((part) => (part.value as Uncovered).model)),
      late: found.some((part) => part.seq < newest),
      error,
      busy,
      wait,
    };
  }, [parts, error, busy, wait, models]);
}
