/** Undo and redo: cases in order; the steps of one gesture (a drag, a turn of a slider) are one entry. */

import type { CaseFile } from "./case_file";

export interface History {
  readonly past: readonly CaseFile[];
  readonly now: CaseFile;
  readonly future: readonly CaseFile[];
  /** The gesture that made the present case, if it may still go on. */
  readonly gesture: string | null;
}

/** A new case, or how to make it from the present one. */
export type Edited = CaseFile | ((now: CaseFile) => CaseFile);

export type Change =
  | { readonly kind: "edit"; readonly to: Edited; readonly gesture: string | null }
  | { readonly kind: "settle" }
  | { readonly kind: "undo" }
  | { readonly kind: "redo" };

const MOST = 200;

export const begun = (file: CaseFile): History => ({ past: [], now: file, future: [], gesture: null });

/** The history after a change. */
export function changed(history: History, change: Change): History {
  const { past, now, future, gesture } = history;
  switch (change.kind) {
    case "edit": {
      const to = typeof change.to === "function" ? change.to(now) : change.to;
      if (same(to, now)) return history;
      const goesOn = change.gesture !== null && change.gesture === gesture;
      return { past: goesOn ? past : [...past, now].slice(-MOST), now: to, future: [], gesture: change.gesture };
    }
    case "settle":
      return gesture === null ? history : { ...history, gesture: null };
    case "undo": {
      const last = past.at(-1);
      return last ? { past: past.slice(0, -1), now: last, future: [now, ...future], gesture: null } : history;
    }
    case "redo": {
      const [next, ...rest] = future;
      return next ? { past: [...past, now], now: next, future: rest, gesture: null } : history;
    }
  }
}

const same = (a: CaseFile, b: CaseFile): boolean => a === b || JSON.stringify(a) === JSON.stringify(b);
