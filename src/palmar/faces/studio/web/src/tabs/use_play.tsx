/** Play the closing motion from the start of the case, contact by contact. */

import { useMemo, useState } from "react";
import { Progress } from "../answers/progress";
import { shapeOf } from "../case/case_file";
import { duration, motionOf } from "../play/motion";
import { MotionLayer } from "../play/motion_layer";
import { Timeline } from "../play/timeline";
import { usePlayer } from "../play/use_player";
import { useStudio } from "../shell/studio_context";
import type { MotionValue } from "../wire/records";
import { useAnswer } from "../wire/use_answer";
import { boxOfBounds, type Mode } from "./mode";

const WORLDS: readonly (readonly [name: string, words: string])[] = [
  ["planar", "planar: event by event"],
  ["soft", "soft contacts"],
  ["mujoco", "MuJoCo"],
];

/** Motions that need no sensor; every other behaviour runs under feedback. */
const CLOSING = ["close", "curl_and_close", "close_coupled"];

export function usePlay(active: boolean): Mode {
  const { file, connection, hello } = useStudio();
  const [world, setWorld] = useState("planar");
  const question = useMemo(
    () => (active ? { kind: "simulate", file, parameters: { world } } : null),
    [active, file, world],
  );
  const answer = useAnswer(connection, question);
  const value = answer.parts.get("motion")?.value as MotionValue | undefined;
  const motion = useMemo(() => (value ? motionOf(value) : null), [value]);
  const seconds = motion ? duration(motion) : 0;
  const player = usePlayer(seconds, motion?.pace ?? 1);
  const shape = useMemo(() => shapeOf(file), [file]);
  const feedback = !CLOSING.includes(file.behaviour?.name ?? "close");
  const worlds = WORLDS.filter(([name]) => name !== "mujoco" || hello?.mujoco);
  return {
    moving: active && motion !== null,
    bounds: active ? boxOfBounds(value?.bounds_mm) : null,
    plane: ({ px }) => motion && <MotionLayer motion={motion} shape={shape} time={player.time} px={px} />,
    exports: feedback
      ? [{ words: "run, row by row", wish: { what: "trace", case: file, parameters: { world } } }]
      : [
          { words: "film of the motion", wish: { what: "film", case: file, parameters: { world } } },
          { words: "simulation", wish: { what: "simulation", case: file, parameters: { world } } },
        ],
    controls: (
      <div className="stack">
        <div className="cluster">
          <label className="cluster">
            World
            <select value={world} onChange={(event) => setWorld(event.target.value)}>
              {worlds.map(([name, words]) => (
                <option key={name} value={name}>
                  {words}
                </option>
              ))}
            </select>
          </label>
        </div>
        <Progress answer={answer} />
        {motion && !answer.error && (
          <>
            <p className={`verdict ${motion.caught ? "yes" : "no"}`} data-answer="outcome">
              <span className="sign">{motion.caught ? "✓" : "✗"}</span> {motion.verdict}
            </p>
            <Timeline player={player} seconds={seconds} pace={motion.pace} events={motion.events} />
          </>
        )}
        <p className="small muted">
          Drag the object's centre, or set its start in the panel, to play it from elsewhere.
        </p>
      </div>
    ),
  };
}
