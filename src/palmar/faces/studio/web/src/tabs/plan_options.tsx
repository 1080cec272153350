/** By which rule a plan is made, and within what. */

export interface PlanWish {
  /** Radius of the disk in which the object's centre is (mm). */
  readonly uncertainty: number;
  readonly rule: string;
  readonly approaches: number;
  readonly directions: number;
}

const RULES: readonly (readonly [name: string, words: string])[] = [
  ["fewest", "fewest approaches, by search"],
  ["recentre", "under the middle of what is known"],
  ["strips", "strips side by side"],
  ["closings", "one closing after the other, no touch"],
];

interface PlanOptionsProps {
  readonly wish: PlanWish;
  readonly onWish: (wish: PlanWish) => void;
}

export function PlanOptions({ wish, onWish }: PlanOptionsProps) {
  return (
    <div className="cluster">
      <label className="cluster">
        Rule
        <select value={wish.rule} onChange={(event) => onWish({ ...wish, rule: event.target.value })}>
          {RULES.map(([name, words]) => (
            <option key={name} value={name}>
              {words}
            </option>
          ))}
        </select>
      </label>
      <label className="cluster">
        Approaches at most
        <select
          value={wish.approaches}
          onChange={(event) => onWish({ ...wish, approaches: Number(event.target.value) })}
        >
          {[0, 1, 2, 3, 4, 5, 6].map((each) => (
            <option key={each}>{each}</option>
          ))}
        </select>
      </label>
      <label className="cluster">
        Ways to face
        <select
          value={wish.directions}
          onChange={(event) => onWish({ ...wish, directions: Number(event.target.value) })}
        >
          {[1, 2, 4, 8, 12, 24].map((each) => (
            <option key={each}>{each}</option>
          ))}
        </select>
      </label>
    </div>
  );
}
