/** The test bed's run beside the prediction: MuJoCo with the bed's motors, and the planar kernel, from the same start. */

import { useMemo, useState } from "react";
import { Progress } from "../answers/progress";
import { degrees, place } from "../answers/amounts";
import { shapeOf } from "../case/case_file";
import { duration, motionOf } from "../play/motion";
import { MotionLayer } from "../play/motion_layer";
import { Timeline } from "../play/timeline";
import { usePlayer } from "../play/use_player";
import { useStudio } from "../shell/studio_context";
import type { MotionValue, SimulationRecord } from "../wire/records";
import { useAnswer } from "../wire/use_answer";
import { boxOfBounds, type Mode } from "./mode";

interface RunValue {
  readonly record: SimulationRecord;
  readonly motion: MotionValue;
}

export function useBed(active: boolean): Mode {
  const { file, connection } = useStudio();
  // A run takes seconds: it is asked for, not made at every change.
  const [asked, ask] = useState<typeof file | null>(null);
  const question = useMemo(() => (active && asked ? { kind: "testbed", file: asked } : null), [active, asked]);
  const answer = useAnswer(connection, question);
  const run = answer.parts.get("run")?.value as RunValue | undefined;
  const prediction = answer.parts.get("prediction")?.value as RunValue | undefined;
  const motions = useMemo(
    () => [run, prediction].map((each) => (each ? motionOf(each.motion) : null)),
    [run, prediction],
  );
  const [real, predicted] = motions;
  const seconds = Math.max(...motions.map((each) => (each ? duration(each) : 0)));
  const player = usePlayer(seconds, real?.pace ?? predicted?.pace ?? 1);
  const shape = useMemo(() => shapeOf(asked ?? file), [asked, file]);
  return {
    moving: active && Boolean(real ?? predicted),
    bounds: active ? boxOfBounds(run?.motion.bounds_mm ?? prediction?.motion.bounds_mm) : null,
    plane: ({ px }) => (
      <>
        {predicted && <MotionLayer motion={predicted} shape={shape} time={player.time} px={px} ghost />}
        {real && <MotionLayer motion={real} shape={shape} time={player.time} px={px} />}
      </>
    ),
    exports: [],
    controls: (
      <div className="stack">
        <div className="cluster">
          <button type="button" className="primary" onClick={() => ask(file)} disabled={answer.busy}>
            {answer.busy ? "Running…" : "Run the test bed from this start"}
          </button>
          {asked && asked !== file && <span className="small muted">The case has changed since that run.</span>}
        </div>
        <Progress answer={answer} />
        {(run || prediction) && (
          <table className="facts" data-answer="bed">
            <thead>
              <tr>
                <td />
                <th>outcome</th>
                <th>ends at</th>
                <th>turned</th>
              </tr>
            </thead>
            <tbody>
              <RunRow name="prediction (dashed)" run={prediction} />
              <RunRow name="MuJoCo, bed's motors" run={run} />
            </tbody>
          </table>
        )}
        {(real ?? predicted) && (
          <Timeline
            player={player}
            seconds={seconds}
            pace={(real ?? predicted)?.pace ?? 1}
            events={(real ?? predicted)?.events ?? []}
          />
        )}
      </div>
    ),
  };
}

function RunRow({ name, run }: { name: string; run: RunValue | undefined }) {
  if (!run) return null;
  const { outcome, caught, final } = run.record;
  return (
    <tr>
      <th scope="row">{name}</th>
      <td>
        {caught ? "✓" : "✗"} {outcome}
      </td>
      <td>{place([final.x_m, final.y_m])}</td>
      <td>{degrees(final.theta_rad)}</td>
    </tr>
  );
}
