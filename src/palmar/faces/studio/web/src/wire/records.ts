/** What the server answers, as the page reads it. Records are the command line's JSON: SI units and radians. */

import type { CaseFile } from "../case/case_file";
import type { MultiPolygon } from "../drawing/paths";

export type Guarantee = "closed_form" | "certified" | "sampled" | "construction";
export type Pair = readonly [number, number];

export interface RadiusRange {
  readonly radius_min_m: number | null;
  readonly radius_max_m: number | null;
  readonly intervals_m?: readonly Pair[];
}

/** `palmar closure CASE --json`; what is optional comes with the settled part. */
export interface ClosureRecord {
  readonly structural: RadiusRange | null;
  readonly frictional: RadiusRange | null;
  readonly object: { readonly structural: boolean; readonly frictional: boolean; readonly reason: string | null };
  readonly changes?: readonly {
    readonly closure: string;
    readonly dimension: string;
    readonly now: number;
    readonly to: number;
  }[];
  readonly kept_straight?: { readonly structural: RadiusRange | null; readonly frictional: RadiusRange | null };
  readonly notes?: readonly string[];
}

/** `palmar region CASE --json` without the sets. */
export interface RegionRecord {
  readonly model: string;
  readonly closure: string;
  readonly guarantee: Guarantee;
  readonly area_m2: number;
  readonly allowed_error: { readonly centre_m: Pair | null; readonly radius_m: number };
  readonly band_m2?: number;
  readonly certain_area_m2?: number;
  readonly spacing_m?: number | null;
  readonly resting_m?: readonly Pair[];
  readonly flattening_m: number;
  readonly reason: string | null;
  readonly notes: readonly string[];
}

/** One model's region, its sets in millimetres. */
export interface RegionValue {
  readonly model: string;
  readonly record: RegionRecord;
  readonly centre_mm: MultiPolygon;
  readonly contact_mm: MultiPolygon;
  readonly whole_mm: MultiPolygon;
  readonly outer_mm: MultiPolygon | null;
  readonly certain_mm: MultiPolygon | null;
  readonly allowed_mm: { readonly centre: Pair; readonly radius: number } | null;
}

/** How far the numbers of a region apply. */
export interface ValidityValue {
  readonly model: string;
  readonly validity: {
    readonly quasi_static: {
      readonly holds: boolean;
      readonly verdict: string;
      readonly rate_rad_s: number;
      readonly rate_limit_rad_s: number | null;
    } | null;
    readonly uncovered: readonly string[];
  };
}

/** A model that does not cover the case says why. */
export interface Uncovered {
  readonly model: string;
  readonly uncovered: string;
}

export interface DrawingValue {
  readonly toml: string;
  /** The case with every key and default. */
  readonly case: CaseFile;
  readonly bounds_mm: readonly [number, number, number, number];
}

/** `palmar simulate CASE --json`. */
export interface SimulationRecord {
  readonly outcome: string;
  readonly caught: boolean;
  readonly final: {
    readonly x_m: number;
    readonly y_m: number;
    readonly theta_rad: number;
    readonly finger_rad: readonly (readonly number[])[];
  };
  readonly events: readonly { readonly t_s: number; readonly kind: string; readonly body: string }[];
}

export interface MotionValue {
  readonly outcome: string;
  readonly caught: boolean;
  readonly verdict: string;
  readonly duration_s: number;
  readonly pace: number;
  readonly times_s: readonly number[];
  readonly poses: readonly (readonly [number, number, number])[];
  readonly right_mm: readonly (readonly Pair[])[];
  readonly left_mm: readonly (readonly Pair[])[];
  readonly palm_mm: readonly number[];
  readonly contacts_mm: readonly (readonly Pair[])[];
  readonly events: readonly {
    readonly t_s: number;
    readonly words: string;
    readonly kind: string;
    readonly body: string;
  }[];
  readonly bounds_mm: readonly [number, number, number, number];
}

export interface OutcomesValue {
  readonly x_mm: readonly number[];
  readonly y_mm: readonly number[];
  readonly codes: readonly number[];
  readonly names: readonly string[];
  readonly caught: readonly boolean[];
  readonly counts: Readonly<Record<string, number>>;
  readonly cell_mm: Pair;
}
