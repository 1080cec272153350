/** Plan by touch: the sensory plan for an uncertain place, and how what is known of the object shrinks along it. */

import { useMemo, useState } from "react";
import { Progress } from "../answers/progress";
import { shapeOf } from "../case/case_file";
import { GuaranteeBadge } from "../answers/guarantee";
import { Hand } from "../drawing/hand";
import { ObjectOutline } from "../drawing/object";
import { pathOf } from "../drawing/paths";
import { NumberField } from "../panel/number_field";
import type { MomentsValue, PlanRecord } from "../play/plan";
import { PolicyTree } from "../play/policy_tree";
import { Timeline } from "../play/timeline";
import { usePlayer } from "../play/use_player";
import { useStudio } from "../shell/studio_context";
import { useAnswer } from "../wire/use_answer";
import { boxOfBounds, type Mode } from "./mode";
import { PlanOptions, type PlanWish } from "./plan_options";

/** Moments of the way in a second of play. */
const RATE = 12;
const FIRST: PlanWish = { uncertainty: 60, rule: "fewest", approaches: 3, directions: 1 };

export function usePlan(active: boolean): Mode {
  const { file, connection } = useStudio();
  const [wish, setWish] = useState(FIRST);
  const parameters = useMemo(
    () => ({
      uncertainty: { disk_mm: wish.uncertainty },
      approaches_max: wish.approaches,
      rule: wish.rule,
      directions: wish.directions,
    }),
    [wish],
  );
  const question = useMemo(() => (active ? { kind: "plan", file, parameters } : null), [active, file, parameters]);
  const answer = useAnswer(connection, question);
  const record = answer.parts.get("record")?.value as PlanRecord | undefined;
  const way = answer.parts.get("moments")?.value as MomentsValue | undefined;
  const moments = way?.moments ?? [];
  const seconds = Math.max(moments.length - 1, 0) / RATE;
  const player = usePlayer(seconds, 1);
  const moment = moments[Math.min(Math.round(player.time * RATE), moments.length - 1)];
  const shape = useMemo(() => shapeOf(file), [file]);
  const belief = useMemo(() => (moment ? pathOf(moment.belief_mm) : ""), [moment]);
  const events = useMemo(
    () =>
      moments.flatMap((each, i) =>
        i === 0 || each.doing !== moments[i - 1]?.doing ? [{ time: i / RATE, words: each.doing }] : [],
      ),
    [moments],
  );
  const uncertain = {
    label: "Uncertainty: a disk of radius",
    unit: "mm",
    value: wish.uncertainty,
    low: 1,
    high: 300,
    step: 1,
  };
  return {
    moving: active && moment !== undefined,
    bounds: active ? boxOfBounds(way?.bounds_mm) : null,
    plane: ({ px }) =>
      moment && (
        <g data-motion="plan">
          <path className="belief" d={belief} />
          <ObjectOutline shape={shape} at={moment.object_mm} theta={shape.theta} px={px} look="moving" />
          <Hand fingers={{ right: moment.right_mm, left: moment.left_mm }} thickness={shape.thickness} px={px} />
        </g>
      ),
    exports: [{ words: "plan", wish: { what: "plan", case: file, parameters } }],
    controls: (
      <div className="stack">
        <NumberField
          {...uncertain}
          onChange={(to) => typeof to === "number" && setWish({ ...wish, uncertainty: to })}
          onSettle={() => undefined}
        />
        <PlanOptions wish={wish} onWish={setWish} />
        <Progress answer={answer} />
        {record && !answer.error && <PlanFacts record={record} />}
        {moments.length > 0 && <Timeline player={player} seconds={seconds} pace={1} events={events} />}
        {record && !answer.error && <PolicyTree policy={record.policy} />}
      </div>
    ),
  };
}

function PlanFacts({ record }: { record: PlanRecord }) {
  return (
    <div className="stack">
      <p className={`verdict ${record.guaranteed ? "yes" : "no"}`} data-answer="plan">
        <span className="sign">{record.guaranteed ? "✓ caught for certain" : "✗ no plan"}</span>
        {record.guaranteed ? approachesWords(record.approaches_max ?? 0) : record.reason}
      </p>
      <GuaranteeBadge guarantee={record.guarantee} waiting={false} />
    </div>
  );
}

const approachesWords = (most: number): string =>
  most === 0 ? "by closing at once" : `within ${most} approach${most === 1 ? "" : "es"}`;
