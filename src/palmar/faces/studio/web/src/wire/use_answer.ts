/** Answers to a question that may change at any time, as they come in. */

import { useEffect, useLayoutEffect, useRef, useState } from "react";
import { flushSync } from "react-dom";
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

/** What has come in and is not shown yet. */
interface Inbox {
  parts: Part[];
  end: End | null;
  frame: number;
}

interface End {
  readonly question: Question;
  readonly error: string | null;
}

interface Shown {
  readonly parts: ReadonlyMap<string, Part>;
  readonly error: string | null;
  readonly wait: string | null;
  /** The question whose answer is complete. */
  readonly done: Question | null;
}

const NOTHING: Shown = { parts: new Map(), error: null, wait: null, done: null };

/** Parts of one name that differ by model stand beside one another. */
export function partName(part: Part): string {
  const model = (part.value as { model?: unknown } | null)?.model;
  return typeof model === "string" ? `${part.part} ${model}` : part.part;
}

/**
 * Asks whenever the question changes (null: asks nothing), before the frame is painted that shows the change. What comes
 * in is shown with the next frame; at once, where it is enough for the next question to be asked.
 */
export function useAnswer(connection: Connection, question: Question | null): Answer {
  const [shown, setShown] = useState<Shown>(NOTHING);
  const inbox = useRef<Inbox>({ parts: [], end: null, frame: 0 });
  const wanted = useRef(question);

  useEffect(() => () => cancelAnimationFrame(inbox.current.frame), []);
  useLayoutEffect(() => {
    wanted.current = question;
    const box = inbox.current;
    const take = (): Inbox => {
      const { parts, end, frame } = box;
      cancelAnimationFrame(frame);
      Object.assign(box, { parts: [], end: null, frame: 0 });
      return { parts, end, frame };
    };
    if (!question) {
      take();
      setShown(NOTHING);
      return;
    }
    const show = () => {
      const { parts, end } = take();
      setShown((before) => merged(before, parts, end));
    };
    const later = () => {
      if (wanted.current) box.frame ||= requestAnimationFrame(show);
    };
    connection.ask({
      ...question,
      onPart: (part, enough) => {
        box.parts.push(part);
        if (enough && wanted.current) flushSync(show);
        else later();
      },
      onEnd: (error) => {
        box.end = { question, error };
        later();
      },
    });
  }, [connection, question]);
  return { ...shown, busy: question !== null && shown.done !== question };
}

/** At the end parts that this request has not renewed are of another question, and go. */
function merged(before: Shown, news: readonly Part[], end: End | null): Shown {
  const parts = new Map(before.parts);
  let wait = before.wait;
  for (const part of news) {
    if (part.part === "wait") wait = (part.value as { words: string }).words;
    else parts.set(partName(part), part);
  }
  if (!end) return { parts, error: news.length > 0 ? null : before.error, wait, done: before.done };
  const newest = Math.max(...[...parts.values()].map((each) => each.seq));
  if (end.error === null) for (const [name, part] of parts) if (part.seq < newest) parts.delete(name);
  return { parts, error: end.error, wait: null, done: end.question };
}
