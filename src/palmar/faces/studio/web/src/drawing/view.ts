/** What part of the plane the drawing shows, and the way between millimetres (y up) and the drawing's pixels (y down). */

import type { Point } from "../case/case_file";

export interface Box {
  readonly left: number;
  readonly bottom: number;
  readonly right: number;
  readonly top: number;
}

export interface Size {
  readonly width: number;
  readonly height: number;
}

/** Middle of the drawing (mm) and pixels per mm. */
export interface View {
  readonly centre: Point;
  readonly scale: number;
}

/** Room for the axes' numbers: left and bottom of the drawing (px). */
export const GUTTER = { left: 52, bottom: 38, right: 14, top: 14 } as const;

const SMALLEST = 1e-4;
const LARGEST = 1e5;

/** The view that shows a box whole, with some air around it. */
export function fitted(box: Box, size: Size): View {
  const width = Math.max(size.width - GUTTER.left - GUTTER.right, 1);
  const height = Math.max(size.height - GUTTER.bottom - GUTTER.top, 1);
  const [across, up] = [Math.max(box.right - box.left, 1e-6), Math.max(box.top - box.bottom, 1e-6)];
  const scale = 0.94 * Math.min(width / across, height / up);
  const shift = [(GUTTER.left - GUTTER.right) / (2 * scale), (GUTTER.bottom - GUTTER.top) / (2 * scale)] as const;
  return { centre: [0.5 * (box.left + box.right) - shift[0], 0.5 * (box.bottom + box.top) - shift[1]], scale };
}

/** Millimetres -> pixels. */
export function toScreen(view: View, size: Size, at: Point): Point {
  return [
    0.5 * size.width + view.scale * (at[0] - view.centre[0]),
    0.5 * size.height - view.scale * (at[1] - view.centre[1]),
  ];
}

/** Pixels -> millimetres. */
export function toPlane(view: View, size: Size, at: Point): Point {
  return [
    view.centre[0] + (at[0] - 0.5 * size.width) / view.scale,
    view.centre[1] - (at[1] - 0.5 * size.height) / view.scale,
  ];
}

/** The view made `factor` times larger about a pixel that stays where it is. */
export function zoomed(view: View, size: Size, about: Point, factor: number): View {
  const scale = Math.min(Math.max(view.scale * factor, SMALLEST), LARGEST);
  const held = toPlane(view, size, about);
  const now = toPlane({ ...view, scale }, size, about);
  return { scale, centre: [view.centre[0] + held[0] - now[0], view.centre[1] + held[1] - now[1]] };
}

/** SVG transform that puts millimetres with y up into pixels. */
export function planeTransform(view: View, size: Size): string {
  const [x, y] = toScreen(view, size, [0, 0]);
  return `translate(${x} ${y}) scale(${view.scale} ${-view.scale})`;
}

export const joined = (a: Box, b: Box): Box => ({
  left: Math.min(a.left, b.left),
  bottom: Math.min(a.bottom, b.bottom),
  right: Math.max(a.right, b.right),
  top: Math.max(a.top, b.top),
});

/** The box of some points, grown by `by`. */
export function boxOf(points: readonly Point[], by = 0): Box {
  const [xs, ys] = [points.map((each) => each[0]), points.map((each) => each[1])];
  return {
    left: Math.min(...xs) - by,
    bottom: Math.min(...ys) - by,
    right: Math.max(...xs) + by,
    top: Math.max(...ys) + by,
  };
}

/** Whether `inner` lies in `outer`. */
export const holds = (outer: Box, inner: Box): boolean =>
  inner.left >= outer.left && inner.right <= outer.right && inner.bottom >= outer.bottom && inner.top <= outer.top;

/** What of the plane is seen inside the gutters. */
export function seen(view: View, size: Size): Box {
  const [left, top] = toPlane(view, size, [GUTTER.left, GUTTER.top]);
  const [right, bottom] = toPlane(view, size, [size.width - GUTTER.right, size.height - GUTTER.bottom]);
  return { left, top, right, bottom };
}

/** Round step (1, 2 or 5 times a power of ten) not below `rough`. */
export function roundStep(rough: number): number {
  const unit = 10 ** Math.floor(Math.log10(rough));
  return unit * ([1, 2, 5, 10].find((each) => each * unit >= rough * (1 - 1e-9)) ?? 10);
}

/** To what dimensions are rounded that are dragged: the power of ten nearest to a pixel. */
export const dragStep = (view: View): number => 10 ** Math.round(Math.log10(1 / view.scale) - 0.15);
