/** The studio: the case as numbers on the left, the one drawing in the middle, answers on the right. */

import { useMemo, useState } from "react";
import { ClosureFacts } from "../answers/verdict";
import { RegionFacts } from "../answers/region_facts";
import { useBehaviourRegion } from "../answers/use_behaviour_region";
import { useLook } from "../answers/use_look";
import { Legend } from "../drawing/regions";
import { placeOfError } from "../panel/fields";
import { Panel } from "../panel/panel";
import { ExportMenu, type Exportable } from "../shell/export_menu";
import { useStudio } from "../shell/studio_context";
import type { Mode } from "./mode";
import { ShownSets, Stage, type ShownInStage } from "./stage";
import { useBed } from "./use_bed";
import { usePaint } from "./use_paint";
import { usePlan } from "./use_plan";
import { usePlay } from "./use_play";

const MODES: readonly (readonly [name: string, words: string])[] = [
  ["look", "Regions"],
  ["play", "Play"],
  ["paint", "Paint starts"],
  ["plan", "Plan by touch"],
  ["bed", "Test bed"],
];
const LOOK: Mode = { plane: () => null, controls: null, bounds: null, moving: false, exports: [] };

export function StudioTab() {
  const { file, connection } = useStudio();
  const [models, setModels] = useState<readonly string[]>(["exact"]);
  const [closure, setClosure] = useState("frictional");
  const [mode, setMode] = useState("look");
  const [shown, setShown] = useState<ShownInStage>({ centre: true, contact: true, whole: false, grips: true });
  const simulated = useBehaviourRegion(connection, file, useLook(connection, file, models, closure));
  const { look } = simulated;
  const modes: Readonly<Record<string, Mode>> = {
    look: LOOK,
    play: usePlay(mode === "play"),
    paint: usePaint(mode === "paint"),
    plan: usePlan(mode === "plan"),
    bed: useBed(mode === "bed"),
  };
  const now = modes[mode] ?? LOOK;
  const things = useMemo<Exportable[]>(() => regionExports(file, models, closure), [file, models, closure]);
  const exports = useMemo(() => [...now.exports, ...things], [now.exports, things]);
  return (
    <div className="workbench">
      <Panel error={look.error} />
      <div className="stage">
        {look.error && placeOfError(look.error) === null && (
          <p className="error" role="alert">
            {look.error}
          </p>
        )}
        <div className={`card sheet${look.error ? " stale" : ""}`}>
          <Stage look={look} mode={now} shown={shown} />
          <Legend regions={look.regions} shown={shown} />
        </div>
        <div className="cluster">
          <div className="cluster" role="group" aria-label="What to do with the drawing">
            {MODES.map(([name, words]) => (
              <button key={name} type="button" aria-pressed={mode === name} onClick={() => setMode(name)}>
                {words}
              </button>
            ))}
          </div>
          <ShownSets shown={shown} onShown={setShown} />
        </div>
        {now.controls && (
          <div className="card controls" data-mode={mode}>
            {now.controls}
          </div>
        )}
      </div>
      <div className="stack answers" aria-live="off">
        <div className={`card${look.verdictLate ? " late" : ""}`}>
          {look.closure ? (
            <ClosureFacts closure={look.closure} disk={file.object.shape === "disk"} quick={look.verdictQuick} />
          ) : (
            <p className="muted">{look.error ? "No answer for this case." : "Waiting for the first answer…"}</p>
          )}
        </div>
        <div className="card">
          <RegionFacts
            simulated={simulated}
            models={models}
            onModels={setModels}
            closure={closure}
            onClosure={setClosure}
          />
        </div>
        <div className="card">
          <ExportMenu things={exports} />
        </div>
      </div>
    </div>
  );
}

/** Everything about the case that the command line writes. */
function regionExports(file: unknown, models: readonly string[], closure: string): Exportable[] {
  const model = models[0] ?? "exact";
  const comparison: Exportable[] =
    models.length > 1
      ? [
          {
            words: "comparison of models",
            wish: { what: "comparison", case: file, parameters: { models, closure } },
          },
        ]
      : [];
  return [
    {
      words: "region",
      wish: { what: "region", case: file, parameters: { models: [model], closure } },
    },
    ...comparison,
    {
      words: "region swept 100 mm, solid",
      wish: { what: "solid", case: file, parameters: { models: [model], closure, sweep_mm: [100] } },
    },
    { words: "closure", wish: { what: "closure", case: file } },
    { words: "report", wish: { what: "report", case: file } },
    { words: "case", wish: { what: "case", case: file } },
  ];
}
