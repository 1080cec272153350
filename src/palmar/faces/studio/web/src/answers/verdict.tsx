/** Can this hand hold it: verdicts, radius ranges, and what would have to change. */

import type { ClosureRecord, RadiusRange } from "../wire/records";
import { digits, span } from "./amounts";

const HOW: Readonly<Record<string, string>> = { structural: "without friction", frictional: "with friction" };

function Verdict({ yes, words }: { yes: boolean; words: string }) {
  return (
    <p className={`verdict ${yes ? "yes" : "no"}`}>
      <span className="sign">{yes ? "✓ held" : "✗ not held"}</span> {words}
    </p>
  );
}

const rangeWords = (range: RadiusRange | null): string => {
  if (!range) return "none";
  return (range.intervals_m ?? [[range.radius_min_m, range.radius_max_m] as const])
    .map(([low, high]) => span(low, high))
    .join(" and ");
};

export function ClosureFacts({ closure, disk, quick }: { closure: ClosureRecord; disk: boolean; quick: boolean }) {
  const { object, changes = [], kept_straight: straight, notes = [] } = closure;
  return (
    <section className="stack" aria-label="Can this hand hold it?">
      <h2>Can this hand hold it?</h2>
      {quick && <span className="badge wait slow">quick, exact follows</span>}
      <div data-answer="verdict">
        <Verdict yes={object.structural} words="without friction" />
        <Verdict yes={object.frictional} words="with friction" />
      </div>
      {object.reason && <p className="small muted">{object.reason}</p>}
      {disk && (
        <dl className="figures">
          <dt>radii without friction</dt>
          <dd data-answer="structural">{rangeWords(closure.structural)}</dd>
          <dt>radii with friction</dt>
          <dd data-answer="frictional">{rangeWords(closure.frictional)}</dd>
          {straight && (
            <>
              <dt>fingers kept straight</dt>
              <dd>
                {rangeWords(straight.structural)}; {rangeWords(straight.frictional)}
              </dd>
            </>
          )}
        </dl>
      )}
      {changes.length > 0 && (
        <ul className="small">
          {changes.map((each) => (
            <li key={`${each.closure} ${each.dimension}`}>{changeWords(each)}</li>
          ))}
        </ul>
      )}
      {notes.map((each) => (
        <p key={each} className="small muted">
          {each}
        </p>
      ))}
    </section>
  );
}

function changeWords({ closure, dimension, now, to }: NonNullable<ClosureRecord["changes"]>[number]): string {
  const [scale, unit] = dimension === "friction" ? [1, ""] : [1000, " mm"];
  const what = dimension.replaceAll("_", " ");
  return `to hold it ${HOW[closure] ?? closure}: ${what} ${digits(scale * now, 4)} → ${digits(scale * to, 4)}${unit}`;
}
