/** The label that every answer carries: how far it can be trusted. */

import type { Guarantee } from "../wire/records";

const WORDS: Readonly<Record<Guarantee, readonly [name: string, meaning: string]>> = {
  closed_form: ["closed form", "proven for the stated model"],
  certified: ["certified", "every point verified with an error bound"],
  sampled: ["sampled", "simulated at points, spacing stated"],
  construction: ["construction", "a geometric construction whose soundness is not proven"],
};

export const guaranteeMeaning = (guarantee: Guarantee): string => WORDS[guarantee][1];

/** `waiting`: a quick answer for which the exact one has not come yet. */
export function GuaranteeBadge({ guarantee, waiting }: { guarantee: Guarantee; waiting: boolean }) {
  const [name, meaning] = WORDS[guarantee];
  return (
    <span className="cluster">
      <span className={`badge ${guarantee}`} title={meaning}>
        {name}
      </span>
      {waiting && <span className="badge wait slow">quick, exact follows</span>}
    </span>
  );
}
