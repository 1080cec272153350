/** Answers to a question that may change at any time, as they come in. */

import { useEffect, useRef, useState } from "react";
import type { CaseFile } from "../case/case_file";
import type { Connection, Part } from "./connection";

export interface Question {
  readonly kind: string;
  readonly channel?: string;
  readonly file?: CaseFile | string;
  readonly parameters?: Readonly<Record<string, unknown>>;
  readonly enough?: (part: Part) => boolean;
}

export interface Answer {
  /** Newest part by name (of regions by name and model); those of the question before until it is replaced. */
  readonly parts: ReadonlyMap<string, Part>;
  readonly error: string | null;
  /** More parts are to come. */
  readonly busy: boolean;
  /** What the server is busy with, where that takes longer than people expect. */
  readonly wait: string | null;
}

interface Inbox {
  parts: Part[];
  end: { readonly error: string | null } | null;
  frame: number;
  wanted: boolean;
}

const NOTHING: Answer = { parts: new Map(), error: null, busy: false, wait: null };

/** Parts of one name that differ by model stand beside one another. */
export function partName(part: Part): string {
  const model = (part.value as { model?: unknown } | null)?.model;
  return typeof model === "string" ? `${part.part} ${model}` : part.part;
}

/** Asks whenever the question changes (null: asks nothing). What comes in within a frame is shown together. */
export function useAnswer(connection: Connection, question: Question | null): Answer {
  const [answer, setAnswer] = useState<Answer>(NOTHING);
  const inbox = useRef<Inbox>({ parts: [], end: null, frame: 0, wanted: false });

  useEffect(() => () => cancelAnimationFrame(inbox.current.frame), []);
  useEffect(() => {
    const box = inbox.current;
    const drop = () => {
      cancelAnimationFrame(box.frame);
      Object.assign(box, { parts: [], end: null, frame: 0 });
    };
    box.wanted = question !== null;
    if (!question) {
      drop();
      setAnswer(NOTHING);
      return;
    }
    const show = () => {
      const { parts, end } = box;
      drop();
      setAnswer((before) => merged(before, parts, end));
    };
    const later = () => {
      if (box.wanted) box.frame ||= requestAnimationFrame(show);
    };
    setAnswer((before) => ({ ...before, busy: true }));
    connection.ask({
      ...question,
      onPart: (part) => {
        box.parts.push(part);
        later();
      },
      onEnd: (error) => {
        box.end = { error };
        later();
      },
    });
  }, [connection, question]);
  return answer;
}

/** At the end parts that this request has not renewed are of another question, and go. */
function merged(before: Answer, news: readonly Part[], end: Inbox["end"]): Answer {
  const parts = new Map(before.parts);
  let wait = before.wait;
  for (const part of news) {
    if (part.part === "wait") wait = (part.value as { words: string }).words;
    else parts.set(partName(part), part);
  }
  if (!end) return { parts, error: news.length > 0 ? null : before.error, busy: true, wait };
  const newest = Math.max(...[...parts.values()].map((each) => each.seq));
  if (end.error === null) for (const [name, part] of parts) if (part.seq < newest) parts.delete(name);
  return { parts, error: end.error, busy: false, wait: null };
}
