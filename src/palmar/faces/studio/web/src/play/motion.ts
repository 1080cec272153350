/** One motion over time, in the drawing's units: millimetres, degrees, seconds. */

import type { Point } from "../case/case_file";
import type { MotionValue } from "../wire/records";

export interface MotionEvent {
  readonly time: number;
  readonly words: string;
}

/** Rows belong to `times`; fingers as the places of their joints, base joint first, and tip, in the frame of the hand's start. */
export interface Motion {
  readonly times: readonly number[];
  /** x, y, theta of the object. */
  readonly object: readonly (readonly [number, number, number])[];
  readonly right: readonly (readonly Point[])[];
  readonly left: readonly (readonly Point[])[];
  readonly contacts: readonly (readonly Point[])[];
  readonly events: readonly MotionEvent[];
  readonly caught: boolean;
  readonly verdict: string;
  /** Seconds of the motion in one second of play. */
  readonly pace: number;
}

export interface Moment {
  readonly object: readonly [number, number, number];
  readonly right: readonly Point[];
  readonly left: readonly Point[];
  readonly contacts: readonly Point[];
}

export const duration = (motion: Motion): number => motion.times.at(-1) ?? 0;

/** The last row that is not later than `time`. */
export function rowAt(times: readonly number[], time: number): number {
  let [low, high] = [0, times.length - 1];
  while (low < high) {
    const middle = Math.ceil((low + high) / 2);
    if ((times[middle] as number) <= time) low = middle;
    else high = middle - 1;
  }
  return low;
}

/** What is where at a time: linear between the rows; contacts are those of the row before. */
export function momentAt(motion: Motion, time: number): Moment {
  const row = rowAt(motion.times, time);
  const next = Math.min(row + 1, motion.times.length - 1);
  const [from, to] = [motion.times[row] ?? 0, motion.times[next] ?? 0];
  const share = to > from ? Math.min(Math.max((time - from) / (to - from), 0), 1) : 0;
  const mix = (a: number, b: number): number => a + share * (b - a);
  const points = (rows: Motion["right"]): Point[] => {
    const [a, b] = [rows[row] ?? [], rows[next] ?? []];
    return a.map((each, i) => [mix(each[0], (b[i] ?? each)[0]), mix(each[1], (b[i] ?? each)[1])]);
  };
  const [a, b] = [motion.object[row] ?? [0, 0, 0], motion.object[next] ?? [0, 0, 0]];
  return {
    object: [mix(a[0], b[0]), mix(a[1], b[1]), mix(a[2], b[2])],
    right: points(motion.right),
    left: points(motion.left),
    contacts: motion.contacts[row] ?? [],
  };
}

/** A motion as the server tells it. */
export function motionOf(value: MotionValue): Motion {
  return {
    times: value.times_s,
    object: value.poses,
    right: value.right_mm,
    left: value.left_mm,
    contacts: value.contacts_mm,
    events: value.events.map((each) => ({ time: each.t_s, words: each.words })),
    caught: value.caught,
    verdict: value.verdict,
    pace: value.pace,
  };
}
