/** Sets from the server (GeoJSON MultiPolygon coordinates, millimetres, hand frame) as SVG path data. */

import type { Box } from "./view";

export type MultiPolygon = readonly (readonly (readonly (readonly [number, number])[])[])[];

/** One path with all rings; holes stay open under the even-odd rule. */
export function pathOf(area: MultiPolygon): string {
  const rings: string[] = [];
  for (const polygon of area) {
    for (const ring of polygon) {
      const corners = ring.map(([x, y]) => `${+x.toFixed(4)} ${+y.toFixed(4)}`);
      if (corners.length > 0) rings.push(`M${corners.join("L")}Z`);
    }
  }
  return rings.join("");
}

/** The box of a set, null of an empty one. */
export function boxOfArea(area: MultiPolygon): Box | null {
  let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
  for (const [outer] of area) {
    for (const [x, y] of outer ?? []) {
      left = Math.min(left, x);
      right = Math.max(right, x);
      bottom = Math.min(bottom, y);
      top = Math.max(top, y);
    }
  }
  return left < right ? { left, bottom, right, top } : null;
}
