/** A plan as the tree it is: what to do, what may be felt, what to do then. */

import { degrees, millimetres, place } from "../answers/amounts";
import type { Policy } from "./plan";

const turning = (policy: Policy): string => (policy.turn_rad ? `turn by ${degrees(policy.turn_rad)}, ` : "");

function headline(policy: Policy): string {
  if (policy.move === "none") return "no way on";
  const at = policy.at_m ? `at ${place(policy.at_m)}` : "";
  const open = policy.opening_rad === undefined ? "" : `, fingers at ${degrees(policy.opening_rad)}`;
  if (policy.move === "close")
    return `${turning(policy)}close ${at}${open}; ${millimetres(policy.margin_m ?? 0)} to spare`;
  return `${turning(policy)}approach ${at}${open}, at most ${millimetres(policy.distance_m ?? 0)}, until a sensor fires`;
}

export function PolicyTree({ policy, depth = 0 }: { policy: Policy; depth?: number }) {
  const after = [
    ...(policy.outcomes ?? []).map((each) => ({
      when: each.sensor?.replaceAll("_", " ") ?? "nothing is felt",
      then: each.then,
    })),
    ...(policy.if_missed ? [{ when: "it was not there", then: policy.if_missed }] : []),
  ];
  if (after.length === 0) return <p className={policy.move === "none" ? "lost-words" : ""}>{headline(policy)}</p>;
  return (
    <details open={depth < 2}>
      <summary>{headline(policy)}</summary>
      <ul className="tree">
        {after.map(({ when, then }, i) => (
          <li key={i}>
            <strong>{when}</strong>
            <PolicyTree policy={then} depth={depth + 1} />
          </li>
        ))}
      </ul>
    </details>
  );
}
