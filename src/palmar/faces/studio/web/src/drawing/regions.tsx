/** The sets of regions in the plane, and the legend that explains them. */

import { memo, useMemo } from "react";
import type { RegionValue } from "../wire/records";
import { pathOf, type MultiPolygon } from "./paths";

/** Which sets of the first region are drawn; those of further models are outlines of the centre region. */
export interface Shown {
  readonly centre: boolean;
  readonly contact: boolean;
  readonly whole: boolean;
}

interface Band {
  readonly look: string;
  readonly words: string;
  readonly area: MultiPolygon;
}

/** Error bands below this share of the area are too thin to draw. */
const VISIBLE = 5e-3;

/** What is drawn of the regions, lowest first. */
export function bandsOf(regions: readonly RegionValue[], shown: Shown): Band[] {
  const [first, ...others] = regions;
  if (!first) return [];
  const bands: Band[] = [];
  if (shown.whole)
    bands.push({ look: "whole", words: "whole region: all of the object starts inside", area: first.whole_mm });
  if (first.outer_mm && (first.record.band_m2 ?? 0) > VISIBLE * first.record.area_m2)
    bands.push({ look: "outer", words: "no start beyond this line is caught", area: first.outer_mm });
  if (shown.centre) {
    bands.push({
      look: "centre",
      words: `centre region, ${first.model} model: the object's centre starts inside`,
      area: first.centre_mm,
    });
    if (first.certain_mm)
      bands.push({ look: "certain", words: "certain: by bounds instead of simulation", area: first.certain_mm });
  }
  if (shown.contact)
    bands.push({ look: "contact", words: "contact region: first contacts lie inside", area: first.contact_mm });
  for (const each of others)
    bands.push({ look: each.model, words: `centre region, ${each.model} model`, area: each.centre_mm });
  return bands.filter((each) => each.area.length > 0);
}

export const Regions = memo(function Regions({ regions, shown }: { regions: readonly RegionValue[]; shown: Shown }) {
  const paths = useMemo(
    () => bandsOf(regions, shown).map((each) => ({ look: each.look, path: pathOf(each.area) })),
    [regions, shown],
  );
  const allowed = regions[0]?.allowed_mm;
  return (
    <g className="regions">
      {paths.map(({ look, path }) => (
        <path key={look} className={`region ${look}`} data-region={look} d={path} />
      ))}
      {shown.centre && allowed && allowed.radius > 0 && (
        <circle className="allowed" cx={allowed.centre[0]} cy={allowed.centre[1]} r={allowed.radius} />
      )}
    </g>
  );
});

export function Legend({ regions, shown }: { regions: readonly RegionValue[]; shown: Shown }) {
  const bands = bandsOf(regions, shown);
  const allowed = shown.centre && regions[0]?.allowed_mm;
  return (
    <div className="legend" aria-label="Legend">
      {bands.map(({ look, words }) => (
        <span key={look}>
          <svg width="26" height="12" aria-hidden="true">
            <rect className={`region ${look}`} x="1" y="1" width="24" height="10" />
          </svg>
          {words}
        </span>
      ))}
      {allowed && (
        <span>
          <svg width="14" height="14" aria-hidden="true">
            <circle className="allowed" cx="7" cy="7" r="6" />
          </svg>
          allowed error: the largest circle in the centre region
        </span>
      )}
    </div>
  );
}
