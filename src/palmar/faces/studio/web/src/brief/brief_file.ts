/** A brief as its file has it: what a hand is designed for, and within which limits; millimetres. */

import type { CaseFile, Point, Quantity } from "../case/case_file";

export interface BriefFile {
  readonly targets: Section;
  readonly limits: Section;
}

export type Section = Readonly<Record<string, unknown>>;
export type SectionName = keyof BriefFile;

/** What the page asks for until something else is loaded: an answer in closed form, at once. */
export const FIRST_BRIEF: BriefFile = {
  targets: { radii_mm: "25..45", friction: "0.3..0.8", error_mm: 0 },
  limits: {},
};

/** The brief with one key set; undefined takes the key away. */
export function withKey(brief: BriefFile, section: SectionName, key: string, value: unknown): BriefFile {
  const { [key]: _, ...rest } = brief[section];
  return { ...brief, [section]: value === undefined ? rest : { ...rest, [key]: value } };
}

export const quantityOf = (brief: BriefFile, section: SectionName, key: string, absent: Quantity): Quantity => {
  const given = brief[section][key];
  if (Array.isArray(given) && given.every((each) => typeof each === "number")) return rangeOfList(given);
  return typeof given === "number" || typeof given === "string" ? given : absent;
};

/** Of a list of values the ends count. */
const rangeOfList = (values: readonly number[]): string => `${Math.min(...values)}..${Math.max(...values)}`;

/** The corners of the polygon, null where the brief is about disks. */
export function cornersOf(brief: BriefFile): readonly Point[] | null {
  const given = brief.targets["vertices_mm"];
  return Array.isArray(given) ? (given as readonly Point[]) : null;
}

const SQUARE: readonly Point[] = [[-30, -20], [30, -20], [30, 20], [-30, 20]]; // prettier-ignore

/** The brief about disks, or about a polygon on a table that is not felt for. */
export function withObject(brief: BriefFile, polygon: boolean): BriefFile {
  const { radii_mm: _, vertices_mm: __, ...rest } = brief.targets;
  if (!polygon) return { ...brief, targets: { radii_mm: "25..45", ...rest } };
  const { sensors: ___, approaches_max: ____, support: _____, ...plain } = rest;
  return { ...brief, targets: { vertices_mm: SQUARE, ...plain } };
}

const KEPT = "palmar-studio-brief";

/** The brief that this browser was left with. */
export function keptBrief(): BriefFile {
  try {
    const found: unknown = JSON.parse(localStorage.getItem(KEPT) ?? "null");
    return isBrief(found) ? found : FIRST_BRIEF;
  } catch {
    return FIRST_BRIEF;
  }
}

export function keepBrief(brief: BriefFile): void {
  try {
    localStorage.setItem(KEPT, JSON.stringify(brief));
  } catch {
    // A browser that keeps nothing begins with the first brief again.
  }
}

const isTable = (value: unknown): boolean => typeof value === "object" && value !== null && !Array.isArray(value);

function isBrief(found: unknown): found is BriefFile {
  const { targets, limits } = (found ?? {}) as Record<string, unknown>;
  return isTable(targets) && isTable(limits);
}

/** Whether a dropped text is a brief: cases have no such section. */
export const looksLikeBrief = (text: string): boolean => /^\s*\[targets\]/m.test(text);

/** `palmar design BRIEF --json`, as far as the page reads it. */
export interface DesignRecord {
  readonly possible: boolean;
  readonly size_m?: number;
  readonly size_at_least_m?: number | null;
  readonly verification?: { readonly cases: number; readonly violations: number } | null;
  readonly notes?: readonly string[];
}

/** A hand with its objects, and the circle in which the centre may start. */
export interface FoundHand {
  readonly case: CaseFile;
  readonly radii_mm: readonly number[];
  readonly place_mm: Point;
  readonly error_mm: number;
}

export interface DesignValue {
  readonly record: DesignRecord;
  readonly rows: readonly (readonly [name: string, words: string])[];
  readonly impossible: string | null;
  readonly links: readonly (readonly [links: string, size: string, words: string])[];
  readonly fewest: string | null;
  readonly hand: FoundHand | null;
}

/** What closed forms say before any search. */
export interface BoundValue {
  readonly words: string;
  /** The hand follows by itself; else it takes a search that may last minutes. */
  readonly soon: boolean;
  readonly least_m: number | null;
  readonly impossible: string | null;
}

export interface FrontPoint extends FoundHand {
  readonly size_m: number;
  readonly error_m: number;
}

export interface FrontValue {
  readonly points: readonly FrontPoint[];
  readonly of: number;
  /** Least size and error at the front's end, as far as closed forms tell: the axes reach so far from the beginning. */
  readonly least_m: readonly [size: number, error: number] | null;
}
