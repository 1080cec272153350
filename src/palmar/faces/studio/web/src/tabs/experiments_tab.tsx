/** The source's figures, redone: each with its number and title, drawn by the same code as `palmar figures`. */

import { useMemo, useState } from "react";
import { ExportMenu } from "../shell/export_menu";
import { useStudio } from "../shell/studio_context";
import { useAnswer } from "../wire/use_answer";

interface FigureTitle {
  readonly number: string;
  readonly title: string;
}

const LIST = { kind: "experiments", channel: "list" };

export function ExperimentsTab() {
  const { connection } = useStudio();
  const [number, choose] = useState<string | null>(null);
  const list = useAnswer(connection, LIST);
  const figures = (list.parts.get("list")?.value as { figures: readonly FigureTitle[] } | undefined)?.figures ?? [];
  const chosen = number ?? figures[0]?.number ?? null;
  const question = useMemo(
    () => (chosen === null ? null : { kind: "experiments", parameters: { figure: chosen } }),
    [chosen],
  );
  const answer = useAnswer(connection, question);
  const figure = answer.parts.get("figure")?.value as (FigureTitle & { svg: string }) | undefined;
  return (
    <div className="two figures-tab">
      <div className="stack">
        <div className="card paper" aria-busy={answer.busy}>
          {answer.error && <p className="error">{answer.error}</p>}
          {figure ? (
            <img
              src={`data:image/svg+xml;charset=utf-8,${encodeURIComponent(figure.svg)}`}
              alt={`Figure ${figure.number}: ${figure.title}`}
            />
          ) : (
            <p className="muted">Drawing…</p>
          )}
        </div>
        {figure && (
          <ExportMenu
            things={[
              {
                words: `figure ${figure.number}`,
                wish: { what: "figure", parameters: { figure: figure.number } },
              },
            ]}
          />
        )}
      </div>
      <div className="card stack">
        <h2>The source's figures, redone</h2>
        {list.error && <p className="error">{list.error}</p>}
        <ul className="plain-list">
          {figures.map((each) => (
            <li key={each.number}>
              <button
                type="button"
                className="plain"
                aria-pressed={each.number === chosen}
                onClick={() => choose(each.number)}
              >
                <strong>{each.number}</strong> {each.title.replace(/^Figure [\d.]+: /, "")}
              </button>
            </li>
          ))}
        </ul>
      </div>
    </div>
  );
}
