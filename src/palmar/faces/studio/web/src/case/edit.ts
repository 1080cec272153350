/** Changes of a case, each from one case to the next. What cannot be (a reflex corner) leaves the case as it was. */

import type { CaseFile, Point, Quantity } from "./case_file";
import { shapeOf } from "./case_file";
import { direction, fingerPoints, isConvex, length, minus, openJoints, turned, wrapped } from "./plane";

export type Section = keyof CaseFile;

/** Rounding that hides how coarse a pointer is: multiples of `step`, without floating point's tail. */
export const rounded = (value: number, step: number): number => Number((Math.round(value / step) * step).toFixed(9));

/** The case with one key of a section set; undefined takes the key away. */
export function withValue(file: CaseFile, section: Section, key: string, value: unknown): CaseFile {
  const { [key]: _, ...rest } = (file[section] ?? {}) as Record<string, unknown>;
  return { ...file, [section]: value === undefined ? rest : { ...rest, [key]: value } } as CaseFile;
}

const withHand = (file: CaseFile, change: Partial<CaseFile["hand"]>): CaseFile => ({
  ...file,
  hand: { ...file.hand, ...change },
});

/** Palm end at `to`: the palm's width follows, both sides alike. */
export const dragPalm = (file: CaseFile, to: Point, step: number): CaseFile =>
  withHand(file, { palm_width_mm: Math.max(step, rounded(2 * Math.abs(to[0]), step)) });

/**
 * Tip or inner joint `joint` (1 = end of the first link) of the right finger at `to`.
 *
 * Of a straight finger the tip sets how far it is open and, by its last link, how long it is; an inner joint moves along
 * the finger, whose length stays. Of a finger that begins bent every point sets its own link and angle.
 */
export function dragFinger(file: CaseFile, joint: number, to: Point, step: number): CaseFile {
  const shape = shapeOf(file);
  const { links } = shape;
  const base: Point = [shape.halfPalm, 0];
  if (shape.bend !== 0 && links.length === 2) return dragBent(file, joint, to, step);
  const away = length(minus(to, base));
  const before = sum(links.slice(0, joint - 1));
  if (joint === links.length) {
    const last = Math.max(step, rounded(away - before, step));
    return withHand(file, {
      finger_links_mm: replaced(file.hand.finger_links_mm, joint - 1, last),
      open_deg: opening(direction(minus(to, base))),
    });
  }
  const pair = (links[joint - 1] ?? 0) + (links[joint] ?? 0);
  const first = clamp(rounded(away - before, step), step, rounded(pair - step, step));
  const moved = replaced(file.hand.finger_links_mm, joint - 1, first);
  return withHand(file, { finger_links_mm: replaced(moved, joint, tidy(pair - first)) });
}

function dragBent(file: CaseFile, joint: number, to: Point, step: number): CaseFile {
  const shape = shapeOf(file);
  const points = fingerPoints(shape.halfPalm, shape.links, openJoints(shape));
  const arm = minus(to, points[joint - 1] as Point);
  const links = replaced(file.hand.finger_links_mm, joint - 1, Math.max(step, rounded(length(arm), step)));
  if (joint === 1) return withHand(file, { finger_links_mm: links, open_deg: opening(direction(arm)) });
  const bend = clamp(Math.round(wrapped(direction(arm) - shape.open)), -179, 179);
  return withValue(withHand(file, { finger_links_mm: links }), "behaviour", "bend_deg", bend);
}

/** Opening nearest to a direction of the right finger: whole degrees, a finger dragged below the palm line is fully open. */
const opening = (degrees: number): number => (degrees < -90 ? 179 : clamp(Math.round(degrees), 0, 179));

/** Link `joint` longer by so much; an inner one at the cost of the next, so that the finger stays as long. */
export function stepFinger(file: CaseFile, joint: number, by: number): CaseFile {
  if (by === 0) return file;
  const { links } = shapeOf(file);
  const [now, next] = [links[joint - 1] ?? 0, links[joint]];
  if (now + by <= 0 || (next !== undefined && next - by <= 0)) return file;
  const moved = replaced(file.hand.finger_links_mm, joint - 1, tidy(now + by));
  return withHand(file, { finger_links_mm: next === undefined ? moved : replaced(moved, joint, tidy(next - by)) });
}

/** The open hand's base joint (of fingers that begin bent, the distal one) turned on by so many degrees. */
export function stepOpening(file: CaseFile, by: number): CaseFile {
  if (by === 0) return file;
  const { open, bend } = shapeOf(file);
  if (bend !== 0) return withValue(file, "behaviour", "bend_deg", clamp(tidy(bend + by), -179, 179));
  return withHand(file, { open_deg: clamp(tidy(open + by), 0, 179) });
}

/** Surface of the fingers at distance `half` (mm) from their joint lines. */
export const dragThickness = (file: CaseFile, half: number, step: number): CaseFile =>
  withHand(file, { finger_thickness_mm: Math.max(0, rounded(2 * half, step)) });

/** Circumference of the disk through `to`. */
export function dragRadius(file: CaseFile, to: Point, step: number): CaseFile {
  if (file.object.shape !== "disk") return file;
  const radius = Math.max(step, rounded(length(minus(to, shapeOf(file).at)), step));
  return { ...file, object: { ...file.object, radius_mm: radius } };
}

/** Corner `index` of the polygon at `to`, as long as it stays convex. */
export function dragCorner(file: CaseFile, index: number, to: Point, step: number): CaseFile {
  if (file.object.shape !== "polygon") return file;
  const shape = shapeOf(file);
  const [x, y] = turned(minus(to, shape.at), -shape.theta);
  const place: Point = [rounded(x, step), rounded(y, step)];
  if (!isConvex(shape.vertices.map((each, i) => (i === index ? place : each)))) return file;
  return { ...file, object: { ...file.object, vertices_mm: replaced(file.object.vertices_mm, index, place) } };
}

/** Without corner `index`; a triangle stays one. */
export function removeCorner(file: CaseFile, index: number): CaseFile {
  if (file.object.shape !== "polygon" || file.object.vertices_mm.length <= 3) return file;
  return { ...file, object: { ...file.object, vertices_mm: file.object.vertices_mm.filter((_, i) => i !== index) } };
}

/** The object's frame at `to`. */
export const dragStart = (file: CaseFile, to: Point, step: number): CaseFile =>
  withValue(file, "start", "at_mm", [rounded(to[0], step), rounded(to[1], step)]);

/** One number of the start's place or velocity. */
export function withStart(file: CaseFile, name: "at_mm" | "velocity_mm_s", along: 0 | 1, to: Quantity): CaseFile {
  const [x, y] = file.start?.[name] ?? (name === "at_mm" ? [0, 120] : [0, 0]);
  return withValue(file, "start", name, along === 0 ? [to, y] : [x, to]);
}

/** The object turned so that its mark points to `to`. */
export const dragTurn = (file: CaseFile, to: Point): CaseFile =>
  withValue(file, "start", "theta_deg", Math.round(direction(minus(to, shapeOf(file).at))));

/** Wall ahead at the height of `to`. */
export const dragWall = (file: CaseFile, to: Point, step: number): CaseFile =>
  withValue(file, "support", "wall_mm", Math.max(step, rounded(to[1], step)));

/** The same object as the other shape: a disk as a square of its size, a polygon as the disk about its origin. */
export function withShape(file: CaseFile, shape: "disk" | "polygon"): CaseFile {
  if (file.object.shape === shape) return file;
  const mass = file.object["mass_kg"] === undefined ? {} : { mass_kg: file.object["mass_kg"] };
  const now = shapeOf(file);
  if (shape === "disk") {
    const radius = rounded(Math.min(...now.vertices.map(length)), 0.1);
    return { ...file, object: { shape, radius_mm: radius, ...mass } };
  }
  const half = rounded(now.radius ?? 30, 0.1);
  const corners: Point[] = [[-half, -half], [half, -half], [half, half], [-half, half]]; // prettier-ignore
  return { ...file, object: { shape, vertices_mm: corners, ...mass } };
}

/** One link of both fingers as long as given. */
export const withLink = (file: CaseFile, index: number, to: Quantity): CaseFile =>
  withHand(file, { finger_links_mm: replaced(file.hand.finger_links_mm, index, to) });

/** The hand with so many links a finger, as long as before; further joints' limits go, they were of other joints. */
export function withLinks(file: CaseFile, count: number): CaseFile {
  const { joint_limits_deg: _, ...hand } = file.hand;
  const total = sum(shapeOf(file).links);
  const links: Quantity[] = Array.from({ length: count }, () => rounded(total / count, 0.1));
  return { ...file, hand: { ...hand, finger_links_mm: links } as CaseFile["hand"] };
}

const tidy = (value: number): number => Number(value.toFixed(9));
const sum = (values: readonly number[]): number => values.reduce((total, each) => total + each, 0);
const clamp = (value: number, low: number, high: number): number => Math.min(Math.max(value, low), high);
const replaced = <T>(list: readonly T[], index: number, value: T): T[] =>
  list.map((each, i) => (i === index ? value : each));
