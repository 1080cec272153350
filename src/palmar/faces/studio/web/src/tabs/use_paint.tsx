/** Paint a grid of starts as caught or lost. */

import { useMemo, useState } from "react";
import { Progress } from "../answers/progress";
import { dragStart } from "../case/edit";
import { Painting } from "../play/painting";
import { useStudio } from "../shell/studio_context";
import type { OutcomesValue } from "../wire/records";
import { useAnswer } from "../wire/use_answer";
import type { Mode } from "./mode";

const GRIDS: readonly (readonly [columns: number, rows: number])[] = [
  [30, 20],
  [60, 40],
  [120, 80],
  [240, 160],
];

export function usePaint(active: boolean): Mode {
  const { file, edit, connection } = useStudio();
  const [grid, setGrid] = useState(1);
  const [columns, rows] = GRIDS[grid] ?? [60, 40];
  const question = useMemo(
    () => (active ? { kind: "paint", file, parameters: { columns, rows } } : null),
    [active, file, columns, rows],
  );
  const answer = useAnswer(connection, question);
  const part = answer.parts.get("outcomes");
  const value = part?.value as OutcomesValue | undefined;
  const counts = Object.entries(value?.counts ?? {}).filter(([, count]) => count > 0);
  return {
    moving: false,
    bounds: null,
    plane: () => null,
    below: (layer) =>
      value && <Painting value={value} layer={layer} onPick={(at) => edit(dragStart(file, at, 1e-6), null)} />,
    exports: [],
    controls: (
      <div className="stack">
        <div className="cluster">
          <label className="cluster">
            Starts
            <select value={grid} onChange={(event) => setGrid(Number(event.target.value))}>
              {GRIDS.map(([x, y], i) => (
                <option key={x} value={i}>
                  {`${x} × ${y}`}
                </option>
              ))}
            </select>
          </label>
          {part && <span className="badge sampled">simulated at points</span>}
        </div>
        <Progress answer={answer} />
        <div className="legend">
          <span>
            <svg width="12" height="12" aria-hidden="true">
              <rect className="start-marks caught" width="12" height="12" />
            </svg>
            caught
          </span>
          <span>
            <svg width="12" height="12" aria-hidden="true">
              <path className="start-marks lost" d="M1 1 11 11M1 11 11 1" />
            </svg>
            lost: escaped or jammed
          </span>
          <span>
            <svg width="12" height="12" aria-hidden="true">
              <path className="start-marks missed" d="M4 6h4" />
            </svg>
            missed
          </span>
        </div>
        <p className="small" data-answer="counts">
          {counts.map(([name, count]) => `${count} ${name}`).join(", ")}
        </p>
        <p className="small muted">A click on a mark puts the start there.</p>
      </div>
    ),
  };
}
