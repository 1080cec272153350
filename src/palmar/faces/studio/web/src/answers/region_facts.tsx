/** From where it is caught: area, allowed error and guarantee of every model asked for, side by side. */

import type { RegionRecord, ValidityValue } from "../wire/records";
import { area, degrees, digits, millimetres, place } from "./amounts";
import { Progress } from "./progress";
import { GuaranteeBadge, guaranteeMeaning } from "./guarantee";
import type { BehaviourRegion } from "./use_behaviour_region";
import type { Look } from "./use_look";

const MODELS: readonly (readonly [name: string, meaning: string])[] = [
  ["exact", "the stated mechanics solved"],
  ["corrected", "the source's construction in free space, its sign put right"],
  ["published", "the source's construction"],
];

interface RegionFactsProps {
  readonly simulated: BehaviourRegion;
  readonly models: readonly string[];
  readonly onModels: (models: readonly string[]) => void;
  readonly closure: string;
  readonly onClosure: (closure: string) => void;
}

export function RegionFacts({ simulated, models, onModels, closure, onClosure }: RegionFactsProps) {
  const { look } = simulated;
  const turn = (name: string) => {
    const next = MODELS.map(([each]) => each).filter((each) => models.includes(each) !== (each === name));
    if (next.length > 0) onModels(next);
  };
  const records = look.regions.map((each) => each.record);
  return (
    <section className="stack" aria-label="From where is it caught?">
      <h2>From where is it caught?</h2>
      <div className="cluster" role="group" aria-label="Models">
        {MODELS.map(([name, meaning]) => (
          <label key={name} className="tick" title={meaning}>
            <input type="checkbox" checked={models.includes(name)} onChange={() => turn(name)} />
            {name}
          </label>
        ))}
        <label className="tick" title="takes the contacts as frictionless whatever the case says">
          <input
            type="checkbox"
            checked={closure === "structural"}
            onChange={(event) => onClosure(event.target.checked ? "structural" : "frictional")}
          />
          without friction
        </label>
      </div>
      <Progress answer={{ busy: look.busy, wait: look.wait, error: null }} />
      {records.length > 0 && <FactsTable records={records} look={look} />}
      {records
        .flatMap((each) => [...(each.reason ? [each.reason] : []), ...each.notes])
        .map((each) => (
          <p key={each} className="small muted">
            {each}
          </p>
        ))}
      {look.validity && look.regions.length > 0 && <Validity value={look.validity} />}
      {look.uncovered.map((each) => (
        <p key={each.model} className="error small">
          {each.model} model: {each.uncovered}
        </p>
      ))}
      {simulated.offered && (
        <button type="button" onClick={simulated.ask} disabled={simulated.answer.busy}>
          Simulate this behaviour's region
        </button>
      )}
      <Progress answer={simulated.answer} />
    </section>
  );
}

/** How fast the fingers may close for the numbers above to apply, and what is not known. */
function Validity({ value: { validity } }: { value: ValidityValue }) {
  const slow = validity.quasi_static;
  const limit = slow?.rate_limit_rad_s == null ? "without a limit" : `limit ${degrees(slow.rate_limit_rad_s)}/s`;
  return (
    <>
      {slow && (
        <p className="small muted">
          Closing at {degrees(slow.rate_rad_s)}/s is {slow.verdict} ({limit}).
        </p>
      )}
      {validity.uncovered.map((each) => (
        <p key={each} className="small muted">
          Not known: {each}.
        </p>
      ))}
    </>
  );
}

function FactsTable({ records, look }: { records: readonly RegionRecord[]; look: Look }) {
  const rows: readonly (readonly [string, (record: RegionRecord) => string | null])[] = [
    ["area of the centre region", (each) => area(each.area_m2)],
    ["allowed error", (each) => millimetres(each.allowed_error.radius_m)],
    ["about", (each) => (each.allowed_error.centre_m ? place(each.allowed_error.centre_m) : "nowhere")],
    ["of it certain", (each) => (each.certain_area_m2 === undefined ? null : area(each.certain_area_m2))],
    [
      "resting on the wall, x",
      (each) =>
        each.resting_m?.map(([low, high]) => `${digits(1000 * low, 4)} to ${digits(1000 * high, 4)} mm`).join(", ") ??
        null,
    ],
    ["starts simulated apart", (each) => (each.spacing_m == null ? null : millimetres(each.spacing_m))],
  ];
  return (
    <table className={`facts models${records.length > 2 ? " many" : ""}${look.late ? " late" : ""}`}>
      <thead>
        <tr>
          <td />
          {records.map((each) => (
            <th key={each.model} scope="col">
              {each.model}
            </th>
          ))}
        </tr>
      </thead>
      <tbody>
        {rows
          .map(([name, words]) => [name, records.map(words)] as const)
          .filter(([, values]) => values.some((each) => each !== null))
          .map(([name, values]) => (
            <tr key={name} data-answer={name}>
              <th scope="row">{name}</th>
              {values.map((each, i) => (
                <td key={i}>{each ?? "–"}</td>
              ))}
            </tr>
          ))}
        <tr data-answer="guarantee">
          <th scope="row">guarantee</th>
          {records.map((each) => (
            <td key={each.model}>
              <GuaranteeBadge guarantee={each.guarantee} waiting={look.quick.has(each.model)} />
              {records.length === 1 && <div className="small muted">{guaranteeMeaning(each.guarantee)}</div>}
            </td>
          ))}
        </tr>
      </tbody>
    </table>
  );
}
