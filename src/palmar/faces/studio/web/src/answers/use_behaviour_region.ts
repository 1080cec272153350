/** The region of a behaviour under feedback: many simulated runs, so it is asked for and not made at every change. */

import { useMemo, useState } from "react";
import type { CaseFile } from "../case/case_file";
import type { Connection } from "../wire/connection";
import type { RegionValue } from "../wire/records";
import { useAnswer, type Answer } from "../wire/use_answer";
import type { Look } from "./use_look";

export interface BehaviourRegion {
  /** The look with that region first, where there is one for the present case. */
  readonly look: Look;
  readonly answer: Answer;
  /** Whether no model has this case's region, so that simulation is the way. */
  readonly offered: boolean;
  readonly ask: () => void;
}

export function useBehaviourRegion(connection: Connection, file: CaseFile, look: Look): BehaviourRegion {
  const [asked, setAsked] = useState<CaseFile | null>(null);
  const current = asked === file ? asked : null;
  const question = useMemo(() => (current ? { kind: "behaviour_region", file: current } : null), [current]);
  const answer = useAnswer(connection, question);
  const part = current ? answer.parts.get("region exact") : undefined;
  const combined = useMemo<Look>(() => {
    if (!part) return look;
    const quick = part.stage === "quick" ? new Set([...look.quick, "exact"]) : look.quick;
    const uncovered = look.uncovered.filter((each) => each.model !== "exact");
    return { ...look, regions: [part.value as RegionValue, ...look.regions], uncovered, quick };
  }, [look, part]);
  const offered = combined.uncovered.some((each) => each.model === "exact") && file.behaviour?.name !== "close";
  return { look: combined, answer, offered, ask: () => setAsked(file) };
}
