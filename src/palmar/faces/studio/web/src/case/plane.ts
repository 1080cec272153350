/** Plane geometry of hand and object in millimetres and degrees: enough to draw and to drag, no mechanics. */

import type { Point, Shape } from "./case_file";

const DEGREE = Math.PI / 180;

export const add = (a: Point, b: Point): Point => [a[0] + b[0], a[1] + b[1]];
export const minus = (a: Point, b: Point): Point => [a[0] - b[0], a[1] - b[1]];
export const length = (a: Point): number => Math.hypot(a[0], a[1]);
export const mirrored = (a: Point): Point => [-a[0], a[1]];
export const polar = (radius: number, degrees: number): Point => [
  radius * Math.cos(degrees * DEGREE),
  radius * Math.sin(degrees * DEGREE),
];

/** Direction of a vector from the x axis (degrees, -180 to 180). */
export const direction = (a: Point): number => Math.atan2(a[1], a[0]) / DEGREE;

/** A point turned about the origin, counter-clockwise. */
export function turned(a: Point, degrees: number): Point {
  const [c, s] = [Math.cos(degrees * DEGREE), Math.sin(degrees * DEGREE)];
  return [c * a[0] - s * a[1], s * a[0] + c * a[1]];
}

/** An angle brought to (-180, 180]. */
export const wrapped = (degrees: number): number => degrees - 360 * Math.ceil((degrees - 180) / 360);

/** Base joint, further joints and tip of the right finger; `joints` (degrees) are the base angle, then from straight. */
export function fingerPoints(halfPalm: number, links: readonly number[], joints: readonly number[]): Point[] {
  const points: Point[] = [[halfPalm, 0]];
  let [at, facing]: [Point, number] = [[halfPalm, 0], 0];
  links.forEach((link, i) => {
    facing += joints[i] ?? 0;
    at = add(at, polar(link, facing));
    points.push(at);
  });
  return points;
}

/** Joint angles (degrees) of a finger of the open hand. */
export const openJoints = (shape: Shape): number[] =>
  shape.links.map((_, i) => (i === 0 ? shape.open : i === 1 ? shape.bend : 0));

/** Whether the corners, in order, make a strictly convex polygon that runs counter-clockwise. */
export function isConvex(corners: readonly Point[]): boolean {
  if (corners.length < 3) return false;
  let turn = 0;
  for (let i = 0; i < corners.length; i += 1) {
    const [a, b, c] = [0, 1, 2].map((k) => corners[(i + k) % corners.length] as Point) as [Point, Point, Point];
    const [u, v] = [minus(b, a), minus(c, b)];
    const cross = u[0] * v[1] - u[1] * v[0];
    if (cross <= 1e-9 * length(u) * length(v)) return false;
    turn += Math.atan2(cross, u[0] * v[0] + u[1] * v[1]);
  }
  return turn < 2.5 * Math.PI;
}

/**
 * A new corner outside the middle of the edge after corner `index`, by as little as keeps the polygon strictly convex;
 * null where there is no room for one.
 */
export function withCorner(corners: readonly Point[], index: number): Point | null {
  const [a, b] = [corners[index] as Point, corners[(index + 1) % corners.length] as Point];
  const edge = minus(b, a);
  const out: Point = [0.05 * edge[1], -0.05 * edge[0]];
  const corner = add([0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])], out);
  const place: Point = [Number(corner[0].toFixed(3)), Number(corner[1].toFixed(3))];
  return isConvex([...corners.slice(0, index + 1), place, ...corners.slice(index + 1)]) ? place : null;
}

/** The object's outline in the hand's frame (empty for a disk). */
export const outline = (shape: Shape, at: Point, theta: number): Point[] =>
  shape.vertices.map((each) => add(turned(each, theta), at));

/** Distance of the object's farthest point from its frame's origin. */
export const reach = (shape: Shape): number => shape.radius ?? Math.max(0, ...shape.vertices.map(length));
