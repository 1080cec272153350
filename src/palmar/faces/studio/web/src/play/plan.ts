/** A plan by touch, as the server tells it. */

import type { Point } from "../case/case_file";
import type { MultiPolygon } from "../drawing/paths";
import type { Guarantee, Pair } from "../wire/records";

/** One move and what follows it; places in m, angles in rad, in the hand's frame before the move. */
export interface Policy {
  readonly move: "approach" | "close" | "none";
  readonly turn_rad?: number;
  readonly at_m?: Pair;
  readonly opening_rad?: number;
  readonly distance_m?: number;
  readonly margin_m?: number;
  readonly outcomes?: readonly { readonly sensor: string | null; readonly then: Policy }[];
  readonly if_missed?: Policy;
}

export interface PlanRecord {
  readonly guaranteed: boolean;
  readonly guarantee: Guarantee;
  readonly approaches_max: number | null;
  readonly closings_max: number | null;
  readonly policy: Policy;
  readonly reason: string | null;
  readonly sensors: readonly string[];
}

/** A moment of one object's way through the plan (mm). */
export interface PlanMoment {
  readonly right_mm: readonly Point[];
  readonly left_mm: readonly Point[];
  readonly object_mm: Point;
  readonly belief_mm: MultiPolygon;
  readonly doing: string;
}

export interface MomentsValue {
  readonly moments: readonly PlanMoment[];
  readonly bounds_mm: readonly [number, number, number, number];
}
