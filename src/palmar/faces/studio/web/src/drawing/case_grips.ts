/** The grips of a case: one for everything in the drawing that has a dimension. */

import { shapeOf, type CaseFile, type Point, type Shape } from "../case/case_file";
import * as edit from "../case/edit";
import { add, fingerPoints, mirrored, openJoints, outline, polar, wrapped } from "../case/plane";
import type { GripSpec } from "./grip";

/** Takes the new case and the gesture it is part of. */
export type Edit = (to: CaseFile, gesture: string) => void;

/** Lengths of a case file (mm) end there, and coordinates to either side. */
const LARGEST = 1e6;
const LENGTH: Point = [0, LARGEST];
const PLACE: Point = [-LARGEST, LARGEST];

const mm = (value: number): string => `${Number(value.toFixed(4))} mm`;
const deg = (value: number): string => `${Number(value.toFixed(3))}°`;

export function caseGrips(file: CaseFile, step: number, change: Edit): GripSpec[] {
  const shape = shapeOf(file);
  const sides = [1, -1] as const;
  return [
    ...sides.flatMap((side) => [
      palmGrip(file, shape, side, step, change),
      ...fingerGrips(file, shape, side, step, change),
    ]),
    ...thicknessGrip(file, shape, step, change),
    startGrip(file, shape, step, change),
    ...objectGrips(file, shape, step, change),
    ...wallGrip(file, shape, step, change),
  ];
}

type Side = 1 | -1;
const sideName = (side: Side): string => (side === 1 ? "right" : "left");
const onSide = (side: Side, at: Point): Point => (side === 1 ? at : mirrored(at));

function palmGrip(file: CaseFile, shape: Shape, side: Side, step: number, change: Edit): GripSpec {
  const id = `palm-${sideName(side)}`;
  return {
    id,
    at: [side * shape.halfPalm, 0],
    look: "square",
    label: `Palm, ${sideName(side)} end`,
    value: 2 * shape.halfPalm,
    text: `palm width ${mm(2 * shape.halfPalm)}`,
    ends: LENGTH,
    onDrag: (to) => change(edit.dragPalm(file, to, step), id),
  };
}

function fingerGrips(file: CaseFile, shape: Shape, side: Side, step: number, change: Edit): GripSpec[] {
  const points = fingerPoints(shape.halfPalm, shape.links, openJoints(shape));
  const total = shape.links.reduce((sum, each) => sum + each, 0);
  return points.slice(1).map((point, i) => {
    const joint = i + 1;
    const tip = joint === shape.links.length;
    const id = `${tip ? "tip" : `joint${joint}`}-${sideName(side)}`;
    const angle = shape.bend !== 0 && tip ? `, bent by ${deg(shape.bend)}` : `, open at ${deg(shape.open)}`;
    return {
      id,
      at: onSide(side, point),
      label: tip ? `Tip of the ${sideName(side)} finger` : `Joint ${joint} of the ${sideName(side)} finger`,
      value: tip ? total : (shape.links[i] ?? 0),
      text: tip ? `finger length ${mm(total)}${angle}` : `link ${joint} ${mm(shape.links[i] ?? 0)}`,
      ends: tip ? LENGTH : [0, (shape.links[i] ?? 0) + (shape.links[i + 1] ?? 0)],
      onDrag: (to) => change(edit.dragFinger(file, joint, onSide(side, to), step), id),
      onStep: (across, up) => {
        const longer = edit.stepFinger(file, joint, side * across * step);
        change(tip ? edit.stepOpening(longer, up) : longer, id);
      },
    };
  });
}

function thicknessGrip(file: CaseFile, shape: Shape, step: number, change: Edit): GripSpec[] {
  if (shape.thickness === 0) return [];
  const base: Point = [shape.halfPalm, 0];
  const middle = add(base, polar(0.5 * (shape.links[0] ?? 0), shape.open));
  const out = polar(0.5 * shape.thickness, shape.open - 90);
  const half = (to: Point): number =>
    Math.abs((to[0] - middle[0]) * out[0] + (to[1] - middle[1]) * out[1]) / Math.hypot(...out);
  const thickness: GripSpec = {
    id: "thickness",
    at: add(middle, out),
    look: "square",
    label: "Thickness of the fingers",
    value: shape.thickness,
    text: mm(shape.thickness),
    ends: LENGTH,
    onDrag: (to) => change(edit.dragThickness(file, half(to), 0.5 * step), "thickness"),
    onStep: (across, up) =>
      change(edit.dragThickness(file, 0.5 * shape.thickness + 0.5 * (across - up) * step, 0.5 * step), "thickness"),
  };
  return [thickness];
}

function startGrip(file: CaseFile, shape: Shape, step: number, change: Edit): GripSpec {
  const [x, y] = shape.at;
  return {
    id: "start",
    at: shape.at,
    label: "Start of the object",
    value: x,
    text: `x ${mm(x)}, y ${mm(y)}`,
    ends: PLACE,
    onDrag: (to) => change(edit.dragStart(file, to, step), "start"),
  };
}

function objectGrips(file: CaseFile, shape: Shape, step: number, change: Edit): GripSpec[] {
  if (shape.radius !== null) {
    const radius = shape.radius;
    return [
      {
        id: "radius",
        at: add(shape.at, polar(radius, 45)),
        look: "diamond",
        label: "Radius of the object",
        value: radius,
        text: `radius ${mm(radius)}`,
        ends: LENGTH,
        onDrag: (to) => change(edit.dragRadius(file, to, step), "radius"),
        onStep: (across, up) =>
          change(edit.dragRadius(file, add(shape.at, [radius + (across + up) * step, 0]), step), "radius"),
      },
    ];
  }
  const corners = outline(shape, shape.at, shape.theta).map((at, i): GripSpec => {
    const [x, y] = shape.vertices[i] as Point;
    return {
      id: `corner${i + 1}`,
      at,
      look: "diamond",
      label: `Corner ${i + 1} of the object`,
      value: x,
      text: `${mm(x)}, ${mm(y)} in its own frame`,
      ends: PLACE,
      onDrag: (to) => change(edit.dragCorner(file, i, to, step), `corner${i + 1}`),
      onRemove: () => change(edit.removeCorner(file, i), `remove${i + 1}`),
    };
  });
  const far = 1.25 * Math.max(...shape.vertices.map((each) => Math.hypot(...each)));
  const turn: GripSpec = {
    id: "turn",
    at: add(shape.at, polar(far, shape.theta)),
    label: "Orientation of the object",
    value: wrapped(shape.theta),
    text: deg(shape.theta),
    ends: [-180, 180],
    onDrag: (to) => change(edit.dragTurn(file, to), "turn"),
    onStep: (across, up) => change(edit.withValue(file, "start", "theta_deg", shape.theta + up - across), "turn"),
  };
  return [...corners, turn];
}

function wallGrip(file: CaseFile, shape: Shape, step: number, change: Edit): GripSpec[] {
  if (shape.wall === null) return [];
  const wall: GripSpec = {
    id: "wall",
    at: [0, shape.wall],
    look: "square",
    label: "Wall ahead of the palm",
    value: shape.wall,
    text: mm(shape.wall),
    ends: LENGTH,
    onDrag: (to) => change(edit.dragWall(file, to, step), "wall"),
  };
  return [wall];
}
