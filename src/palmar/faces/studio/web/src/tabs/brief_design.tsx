/** The smallest hand for a brief: targets and limits on one side, the hand with its front, and the answer. */

import { useMemo, useState } from "react";
import { GuaranteeBadge } from "../answers/guarantee";
import { BriefAnswer, useFound } from "../brief/brief_answer";
import { LimitFields, TargetFields } from "../brief/brief_fields";
import type { FoundHand, FrontPoint, FrontValue } from "../brief/brief_file";
import { FoundHandDrawing } from "../brief/found_hand_drawing";
import { FrontChart, wordsOf } from "../brief/front_chart";
import { readBrief } from "../brief/open_brief";
import { useDesigning } from "../brief/use_design";
import { useElapsed } from "../brief/use_elapsed";
import { ExportMenu } from "../shell/export_menu";
import { useStudio } from "../shell/studio_context";
import type { Guarantee } from "../wire/records";
import { useAnswer } from "../wire/use_answer";

const LIST = { kind: "briefs" };
const POINTS = 9;

export function BriefDesign() {
  const { edit, openTab } = useStudio();
  const { brief, points, front } = useDesigning();
  const { design, fresh } = useFound();
  const [pointed, point] = useState<number | null>(null);
  const known = (front.parts.get("front")?.value as FrontValue | undefined)?.points ?? [];
  const hovered = (points > 0 && known.find((each) => each.error_m === pointed)) || null;
  const hand = hovered ?? design?.hand ?? null;
  const load = (found: FoundHand) => {
    edit(found.case, null);
    openTab("studio");
  };
  const exported = useMemo(
    () => [
      { words: "design", wish: { what: "design", parameters: { brief, front: points } } },
      { words: "brief", wish: { what: "brief", parameters: { brief } } },
    ],
    [brief, points],
  );
  return (
    <div className="designing">
      <form className="panel stack" aria-label="Brief" onSubmit={(event) => event.preventDefault()}>
        <div className="card stack">
          <ShippedBriefs />
          <TargetFields />
        </div>
        <div className="card">
          <LimitFields />
        </div>
      </form>
      <div className="stack middle">
        <div className="card sheet">
          {hand ? (
            <div className={hovered || fresh ? "" : "late"}>
              <FoundHandDrawing found={hand} />
            </div>
          ) : (
            <p className="muted pad">No hand to draw.</p>
          )}
        </div>
        <Front shown={hovered} onShow={(to) => point(to?.error_m ?? null)} onPick={load} />
      </div>
      <div className="stack">
        <BriefAnswer />
        <div className="card stack">
          <button
            type="button"
            className="primary"
            disabled={!fresh || !design?.hand}
            onClick={() => design?.hand && load(design.hand)}
          >
            Load this hand into the Studio
          </button>
          <p className="small muted">With the largest object at the least friction, at its nominal place.</p>
          <ExportMenu things={exported} />
        </div>
      </div>
    </div>
  );
}

interface ListedBrief {
  readonly name: string;
  readonly description: string;
}

/** A shipped brief to begin with; files are opened by the page's head, or dropped. */
function ShippedBriefs() {
  const { connection, say } = useStudio();
  const { edit } = useDesigning();
  const answer = useAnswer(connection, LIST);
  const list = (answer.parts.get("briefs")?.value as { briefs: readonly ListedBrief[] } | undefined)?.briefs ?? [];
  return (
    <div className="field">
      <label htmlFor="shipped-brief">Begin with</label>
      <select
        id="shipped-brief"
        className="wide-control"
        value=""
        onChange={(event) => readBrief(connection, { name: event.target.value }, edit, say)}
      >
        <option value="" disabled>
          a brief…
        </option>
        {list.map((each) => (
          <option key={each.name} value={each.name} title={each.description}>
            {each.name}
          </option>
        ))}
      </select>
    </div>
  );
}

interface FrontProps {
  readonly shown: FrontPoint | null;
  readonly onShow: (point: FrontPoint | null) => void;
  readonly onPick: (point: FrontPoint) => void;
}

/** How much larger a hand gets that tolerates more: asked for by a button, point by point as they are found. */
function Front({ shown, onShow, onPick }: FrontProps) {
  const { brief, front, points, askFront } = useDesigning();
  const { design, fresh } = useFound();
  const part = points > 0 ? front.parts.get("front") : undefined;
  const value = part?.value as FrontValue | undefined;
  const busy = points > 0 && front.busy;
  const seconds = useElapsed(busy);
  const size = fresh ? design?.record.size_m : undefined;
  const error = Number(brief.targets["error_mm"] ?? 0);
  return (
    <div className="card stack" data-answer="front" aria-busy={busy}>
      <div className="cluster">
        <h2>Size against tolerated error</h2>
        {busy ? (
          <>
            <span className="badge wait" role="status">
              {front.wait ?? `${value?.points.length ?? 0} of ${points} points`}
              {seconds > 0 && ` · ${seconds} s`}
            </span>
            <button type="button" onClick={() => askFront(0)}>
              Stop
            </button>
          </>
        ) : (
          <button type="button" onClick={() => askFront(POINTS)} disabled={points > 0 || !fresh || !design?.hand}>
            Draw the front
          </button>
        )}
        {part && !busy && <GuaranteeBadge guarantee={part.guarantee as Guarantee} waiting={false} />}
      </div>
      {points > 0 && front.error && (
        <p className="error" role="alert">
          {front.error}
        </p>
      )}
      {value && (
        <>
          <FrontChart
            points={value.points}
            end={value.least_m && [1e3 * value.least_m[0], 1e3 * value.least_m[1]]}
            chosen={size === undefined ? null : [1e3 * size, error]}
            shown={shown}
            onShow={onShow}
            onPick={onPick}
          />
          <p className="small muted" aria-live="polite">
            {shown
              ? `Palm and both fingers ${wordsOf(shown)}. A click or Enter loads it.`
              : "Square: the hand of the brief. Point at another hand to see it, click to load it; these are found, not tried."}
          </p>
        </>
      )}
    </div>
  );
}
