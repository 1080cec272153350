/** The brief and what is answered to it; both stay while other tabs are open, the brief over a reload too. */

import { createContext, useCallback, useContext, useEffect, useMemo, useState } from "react";
import type { Connection } from "../wire/connection";
import { useAnswer, type Answer } from "../wire/use_answer";
import { keepBrief, keptBrief, type BriefFile } from "./brief_file";

export interface Designing {
  readonly brief: BriefFile;
  /** Another brief: its bound comes at once, a long search has to be asked for again. */
  readonly edit: (to: BriefFile | ((now: BriefFile) => BriefFile)) => void;
  readonly answer: Answer;
  readonly searching: boolean;
  /** Begin a search that takes long, or give it up. */
  readonly search: (wanted: boolean) => void;
  readonly front: Answer;
  /** How many points of the front are asked for. */
  readonly points: number;
  readonly askFront: (points: number) => void;
}

interface Wish {
  readonly brief: BriefFile;
  readonly search: boolean;
  /** Null until a front was asked for: 0 then tells the server to stop. */
  readonly front: number | null;
}

/** Asks nothing before the tab was `opened` for the first time. */
export function useDesign(connection: Connection, opened: boolean): Designing {
  const [wish, setWish] = useState<Wish>(() => ({ brief: keptBrief(), search: false, front: null }));
  const [begun, begin] = useState(opened);
  if (opened && !begun) begin(true);
  const { brief, search, front } = wish;
  const question = useMemo(
    () => (begun ? { kind: "brief", parameters: { brief, search } } : null),
    [begun, brief, search],
  );
  const frontQuestion = useMemo(
    () => (front === null ? null : { kind: "brief_front", parameters: { brief, front } }),
    [brief, front],
  );
  const answer = useAnswer(connection, question);
  const frontAnswer = useAnswer(connection, frontQuestion);
  useEffect(() => keepBrief(brief), [brief]);
  const edit = useCallback(
    (to: BriefFile | ((now: BriefFile) => BriefFile)) =>
      setWish((now) => ({
        brief: typeof to === "function" ? to(now.brief) : to,
        search: false,
        front: now.front === null ? null : 0,
      })),
    [],
  );
  const searchFor = useCallback((wanted: boolean) => setWish((now) => ({ ...now, search: wanted })), []);
  const askFront = useCallback((points: number) => setWish((now) => ({ ...now, front: points })), []);
  return useMemo(
    () => ({
      brief,
      edit,
      answer,
      searching: search,
      search: searchFor,
      front: frontAnswer,
      points: front ?? 0,
      askFront,
    }),
    [
      brief,
      edit,
      answer.parts,
      answer.error,
      answer.busy,
      answer.wait,
      search,
      searchFor,
      frontAnswer.parts,
      frontAnswer.error,
      frontAnswer.busy,
      frontAnswer.wait,
      front,
      askFront,
    ],
  );
}

export const DesignContext = createContext<Designing | null>(null);

export function useDesigning(): Designing {
  const found = useContext(DesignContext);
  if (!found) throw new Error("no brief around this part of the page");
  return found;
}
