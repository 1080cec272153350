/** The numbers that the source prints in one chapter beside what palmar finds, and why some differ. */

import { digits } from "../answers/amounts";
import { GuaranteeBadge } from "../answers/guarantee";
import type { Guarantee } from "../wire/records";

/** One of `palmar figures numbers --json`. */
export interface SourceNumber {
  readonly chapter: number;
  readonly section: string;
  readonly figure: string | null;
  readonly what: string;
  readonly unit: string;
  readonly source: readonly number[];
  readonly palmar: readonly number[] | null;
  readonly difference: readonly number[] | null;
  readonly guarantee: Guarantee;
  readonly why: string;
}

/** `figure`: the one that is shown, whose numbers stand out. */
export function SourceNumbers({ numbers, figure }: { numbers: readonly SourceNumber[]; figure: string | null }) {
  return (
    <div className="scroll-across" tabIndex={0} role="region" aria-label="The source's numbers and ours">
      <table className="facts numbers" data-answer="numbers">
        <thead>
          <tr>
            <th>section</th>
            <th>what</th>
            <th className="number">source</th>
            <th className="number">palmar</th>
            <th className="number">difference</th>
            <th>guarantee</th>
          </tr>
        </thead>
        <tbody>
          {numbers.map((each) => (
            <tr key={each.what} aria-current={each.figure !== null && each.figure === figure ? "true" : undefined}>
              <td>
                {each.section}
                {each.figure && <div className="small muted">figure {each.figure}</div>}
              </td>
              <th scope="row">
                {each.what}
                {each.unit && <span className="muted">, {UNITS[each.unit] ?? `in ${each.unit}`}</span>}
                {each.why && <div className="small muted">{each.why}.</div>}
              </th>
              <td className="number">{amount(each.source)}</td>
              <td className="number">{each.palmar ? amount(each.palmar) : "none"}</td>
              <td className="number">{each.difference ? amount(each.difference.map(rounded), 2) : "–"}</td>
              <td>
                <GuaranteeBadge guarantee={each.guarantee} waiting={false} />
              </td>
            </tr>
          ))}
        </tbody>
      </table>
    </div>
  );
}

const rounded = (value: number): number => (Math.abs(value) < 1e-12 ? 0 : value);

const UNITS: Readonly<Record<string, string>> = { deg: "in degrees", "%": "in %" };

/** A number, or a few that belong together. */
function amount(values: readonly number[], most = 4): string {
  const words = values.map((each) => digits(each, most)).join(", ");
  return values.length > 1 ? `(${words})` : words;
}
