/** The answer to a brief: what closed forms say at once, the hand, what binds and how it was tried, or why there is none. */

import { fixed } from "../answers/amounts";
import { GuaranteeBadge } from "../answers/guarantee";
import { useElapsed } from "./use_elapsed";
import type { Guarantee } from "../wire/records";
import type { BoundValue, DesignValue } from "./brief_file";
import { isShownAtField } from "./brief_fields";
import { useDesigning } from "./use_design";

/** What the parts say, and whether they are about the brief as it is now. */
export function useFound() {
  const { answer, searching } = useDesigning();
  const [bound, design] = [answer.parts.get("bound"), answer.parts.get("design")];
  const fresh = bound !== undefined && design !== undefined && design.seq === bound.seq && answer.error === null;
  const told = bound?.value as BoundValue | undefined;
  // What was found for an earlier brief stays, fading, only while a new hand is on its way.
  const follows = answer.busy && answer.error === null && told?.impossible === null && (told.soon || searching);
  return {
    bound: told,
    design: fresh || follows ? (design?.value as DesignValue | undefined) : undefined,
    guarantee: (design?.guarantee ?? null) as Guarantee | null,
    fresh,
    tried: design?.stage === "settled",
  };
}

export function BriefAnswer() {
  const { answer } = useDesigning();
  const { bound, design, guarantee, fresh, tried } = useFound();
  const { error } = answer;
  return (
    <div className="card stack" data-answer="design" aria-busy={answer.busy}>
      <h2>The smallest hand</h2>
      {error && !isShownAtField(error) && (
        <p className="error" role="alert">
          {error}
        </p>
      )}
      {error && isShownAtField(error) && <p className="muted">The brief has a value that cannot be.</p>}
      {bound && !error && <p className="muted">To {bound.words}.</p>}
      {!error && <State bound={bound} found={fresh} tried={tried} />}
      {bound?.impossible && !fresh && !error && <Impossible words={bound.impossible} />}
      {design && (
        <div className={fresh ? "stack" : "stack late"} data-fresh={fresh}>
          {design.impossible && <Impossible words={design.impossible} />}
          {design.rows.length > 0 && (
            <table className="facts">
              <tbody>
                {design.rows.map(([name, words]) => (
                  <tr key={name}>
                    <th scope="row">{name}</th>
                    <td>{name === "guarantee" && guarantee ? <Label guarantee={guarantee} words={words} /> : words}</td>
                  </tr>
                ))}
              </tbody>
            </table>
          )}
          {design.record.notes?.map((each) => (
            <p key={each} className="small muted">
              Note: {each}.
            </p>
          ))}
          {design.links.length > 0 && <ByLinks design={design} />}
        </div>
      )}
    </div>
  );
}

function Label({ guarantee, words }: { guarantee: Guarantee; words: string }) {
  return (
    <>
      <GuaranteeBadge guarantee={guarantee} waiting={false} />
      <div className="small muted">{words.replace(/^\w+: /, "")}</div>
    </>
  );
}

function Impossible({ words }: { words: string }) {
  return (
    <p className="verdict no" data-answer="impossible">
      <span className="sign" aria-hidden="true">
        ✗
      </span>
      <span>{words}</span>
    </p>
  );
}

interface StateProps {
  readonly bound: BoundValue | undefined;
  /** The hand of the present brief is there, and perhaps was tried. */
  readonly found: boolean;
  readonly tried: boolean;
}

/** What is going on, and what can be done about it. */
function State({ bound, found, tried }: StateProps) {
  const { answer, searching, search } = useDesigning();
  const seconds = useElapsed(answer.busy);
  if (!bound) return <p role="status">{answer.wait ?? "Asking…"}</p>;
  const least = bound.least_m === null ? null : `No hand is shorter than ${fixed(1e3 * bound.least_m, 2)} mm.`;
  if (found && tried) return null;
  if (!bound.soon && !searching) {
    if (bound.impossible) return null;
    return (
      <>
        {least && <p>{least}</p>}
        <p className="small muted">
          Such a brief takes a search of seconds to minutes; after five minutes it is stopped.
        </p>
        <button type="button" className="primary" onClick={() => search(true)}>
          Search for the smallest hand
        </button>
      </>
    );
  }
  if (!answer.busy) return null;
  const doing = answer.wait ?? (found ? "Trying 100 000 random cases" : "Searching");
  return (
    <>
      {least && !found && <p>{least}</p>}
      <div className="cluster" role="status">
        <span className="badge wait slow">
          {doing}
          {seconds > 0 && ` · ${seconds} s`}
        </span>
        {searching && (
          <button type="button" onClick={() => search(false)}>
            Give up
          </button>
        )}
      </div>
    </>
  );
}

function ByLinks({ design }: { design: DesignValue }) {
  return (
    <details>
      <summary>By number of links a finger</summary>
      <table className="facts">
        <thead>
          <tr>
            <th>links</th>
            <th className="number">smallest hand</th>
            <th>hand</th>
          </tr>
        </thead>
        <tbody>
          {design.links.map(([links, size, words]) => (
            <tr key={links}>
              <th scope="row">{links}</th>
              <td className="number">{size}</td>
              <td className="small">{words}</td>
            </tr>
          ))}
        </tbody>
      </table>
      {design.fewest && <p>{design.fewest}</p>}
    </details>
  );
}
