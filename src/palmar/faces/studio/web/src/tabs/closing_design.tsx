/** Two joints a finger: strategies of closing by the size of their region, and preshape angles, for the case at hand. */

import { useState } from "react";
import { area, degrees, digits, millimetres } from "../answers/amounts";
import { GuaranteeBadge } from "../answers/guarantee";
import type { CaseFile } from "../case/case_file";
import { withValue } from "../case/edit";
import { useStudio } from "../shell/studio_context";
import type { Guarantee } from "../wire/records";
import { useAnswer, type Question } from "../wire/use_answer";

interface Strategy {
  readonly name: string;
  readonly behaviour: string;
  readonly preshape_rad: number | null;
  readonly ratio: number | null;
  readonly area_m2: number;
  readonly guarantee: Guarantee;
  readonly spacing_m: number | null;
}

interface StrategiesValue {
  readonly best: string;
  readonly strategies: readonly Strategy[];
}

interface PreshapeValue {
  readonly angle_rad: number | null;
  readonly friction: number | null;
}

export function ClosingDesign() {
  const { file, connection } = useStudio();
  const [asked, ask] = useState<{ strategies: Question; preshape: Question; file: CaseFile } | null>(null);
  const begin = () =>
    ask({
      file,
      strategies: { kind: "design", channel: "strategies", file, parameters: { study: "strategies" } },
      preshape: { kind: "design", channel: "preshape", file, parameters: { study: "preshape" } },
    });
  const strategies = useAnswer(connection, asked?.strategies ?? null);
  const preshape = useAnswer(connection, asked?.preshape ?? null);
  const found = strategies.parts.get("strategies")?.value as StrategiesValue | undefined;
  const angle = preshape.parts.get("preshape")?.value as PreshapeValue | undefined;
  const busy = strategies.busy || preshape.busy;
  return (
    <div className="card stack">
      <div className="cluster">
        <button type="button" className="primary" onClick={begin} disabled={busy}>
          {busy ? "Searching…" : "Search for the studio's case"}
        </button>
        <span className="small muted">The case needs fingers of two links. A search takes some seconds.</span>
      </div>
      {(strategies.error ?? preshape.error) && (
        <p className="error" role="alert">
          {strategies.error ?? preshape.error}
        </p>
      )}
      {angle && (
        <p>
          {angle.angle_rad === null
            ? "No distal angle lets the disk ride on the finger."
            : `Theory's preshape: the disk rides on the finger at a distal angle of ${degrees(angle.angle_rad)}, up to a friction of ${digits(angle.friction ?? 0, 3)}.`}
        </p>
      )}
      {found && asked && <Strategies found={found} file={asked.file} />}
    </div>
  );
}

function Strategies({ found, file }: { found: StrategiesValue; file: CaseFile }) {
  const { edit, openTab } = useStudio();
  const straight = found.strategies[0]?.area_m2 ?? 0;
  const use = (each: Strategy) => {
    let next = withValue(file, "behaviour", "name", each.behaviour);
    if (each.preshape_rad !== null)
      next = withValue(next, "behaviour", "preshape_deg", (each.preshape_rad * 180) / Math.PI);
    if (each.ratio !== null) next = withValue(next, "behaviour", "ratio", each.ratio);
    edit(next, null);
    openTab("studio");
  };
  return (
    <table className="facts">
      <thead>
        <tr>
          <th>strategy</th>
          <th>how</th>
          <th className="number">area</th>
          <th className="number">of straight closing</th>
          <th>guarantee</th>
          <th>
            <span className="visually-hidden">load</span>
          </th>
        </tr>
      </thead>
      <tbody>
        {found.strategies.map((each) => (
          <tr key={each.name}>
            <th scope="row">
              {each.name}
              {each.name === found.best && " ★ largest"}
            </th>
            <td>{howWords(each)}</td>
            <td className="number">{area(each.area_m2)}</td>
            <td className="number">{straight > 0 ? `${digits((100 * each.area_m2) / straight, 3)} %` : "–"}</td>
            <td>
              <GuaranteeBadge guarantee={each.guarantee} waiting={false} />
              {each.spacing_m !== null && <div className="small muted">starts {millimetres(each.spacing_m)} apart</div>}
            </td>
            <td>
              <button type="button" onClick={() => use(each)}>
                Load
              </button>
            </td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}

function howWords(each: Strategy): string {
  if (each.preshape_rad !== null) return `curled by ${degrees(each.preshape_rad)}`;
  return each.ratio === null ? "" : `distal ${digits(each.ratio, 3)} times as fast`;
}
