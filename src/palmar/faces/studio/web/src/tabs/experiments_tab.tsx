/** The source's figures, redone by the code of `palmar figures`, and by chapter its numbers beside ours. */

import { useMemo, useState } from "react";
import { ExportMenu } from "../shell/export_menu";
import { useStudio } from "../shell/studio_context";
import { useAnswer } from "../wire/use_answer";
import { SourceNumbers, type SourceNumber } from "./source_numbers";

interface FigureTitle {
  readonly number: string;
  readonly title: string;
}

/** A figure, or a chapter that is numbers alone. */
interface Chosen {
  readonly chapter: number;
  readonly figure: string | null;
}

const LIST = { kind: "experiments", channel: "list" };
const CHAPTERS: Readonly<Record<number, string>> = {
  2: "Which disks and polygons are held",
  3: "Closing on a table",
  4: "Closing in zero gravity",
  5: "Hands of four joints",
  6: "The planar test bed",
};
const chapterOf = (figure: string): number => Number(figure.split(".")[0]);

export function ExperimentsTab() {
  const { connection } = useStudio();
  const [wish, choose] = useState<Chosen | null>(null);
  const list = useAnswer(connection, LIST);
  const figures = (list.parts.get("list")?.value as { figures: readonly FigureTitle[] } | undefined)?.figures ?? [];
  const first = figures[0]?.number;
  const chosen = wish ?? (first === undefined ? null : { chapter: chapterOf(first), figure: first });
  return (
    <div className="two figures-tab">
      <div className="stack">
        {chosen && chosen.figure !== null && <FigureShown number={chosen.figure} />}
        {chosen && <Numbers chapter={chosen.chapter} figure={chosen.figure} />}
      </div>
      <div className="card stack">
        <h2>The source's figures, redone</h2>
        {list.error && <p className="error">{list.error}</p>}
        {Object.entries(CHAPTERS).map(([name, words]) => (
          <Chapter
            key={name}
            chapter={Number(name)}
            words={words}
            figures={figures.filter((each) => chapterOf(each.number) === Number(name))}
            chosen={chosen}
            onChoose={choose}
          />
        ))}
      </div>
    </div>
  );
}

function FigureShown({ number }: { number: string }) {
  const { connection } = useStudio();
  const question = useMemo(() => ({ kind: "experiments", parameters: { figure: number } }), [number]);
  const answer = useAnswer(connection, question);
  const found = answer.parts.get("figure")?.value as (FigureTitle & { svg: string }) | undefined;
  const figure = found?.number === number ? found : undefined;
  return (
    <>
      <div className="card paper" aria-busy={answer.busy}>
        {answer.error && <p className="error">{answer.error}</p>}
        {figure ? (
          <img
            src={`data:image/svg+xml;charset=utf-8,${encodeURIComponent(figure.svg)}`}
            alt={`Figure ${figure.number}: ${figure.title}`}
          />
        ) : (
          <p className="muted" role="status">
            {answer.wait ?? `Drawing figure ${number}…`}
          </p>
        )}
      </div>
      <ExportMenu things={[{ words: `figure ${number}`, wish: { what: "figure", parameters: { figure: number } } }]} />
    </>
  );
}

function Numbers({ chapter, figure }: { chapter: number; figure: string | null }) {
  const { connection } = useStudio();
  const question = useMemo(
    () => ({ kind: "experiments", channel: "numbers", parameters: { numbers: chapter } }),
    [chapter],
  );
  const answer = useAnswer(connection, question);
  const all = (answer.parts.get("numbers")?.value as { numbers: readonly SourceNumber[] } | undefined)?.numbers;
  const numbers = (all ?? []).filter((each) => each.chapter === chapter);
  return (
    <div className="card stack" aria-busy={answer.busy}>
      <h2>Chapter {chapter}: the source's numbers and ours</h2>
      {answer.error && <p className="error">{answer.error}</p>}
      {numbers.length === 0 && answer.busy && <p role="status">{answer.wait ?? "Computing them anew…"}</p>}
      {numbers.length > 0 && <SourceNumbers numbers={numbers} figure={figure} />}
    </div>
  );
}

interface ChapterProps {
  readonly chapter: number;
  readonly words: string;
  readonly figures: readonly FigureTitle[];
  readonly chosen: Chosen | null;
  readonly onChoose: (to: Chosen) => void;
}

function Chapter({ chapter, words, figures, chosen, onChoose }: ChapterProps) {
  const entries: readonly { readonly figure: string | null; readonly title: string }[] =
    figures.length > 0
      ? figures.map(({ number, title }) => ({ figure: number, title }))
      : [{ figure: null, title: "What was measured, and what is found" }];
  return (
    <section className="stack">
      <h3>
        {chapter} {words}
      </h3>
      <ul className="plain-list">
        {entries.map(({ figure, title }) => (
          <li key={figure ?? ""}>
            <button
              type="button"
              className="plain"
              aria-pressed={chosen?.chapter === chapter && chosen.figure === figure}
              onClick={() => onChoose({ chapter, figure })}
            >
              {figure !== null && <strong>{figure}</strong>} {title}
            </button>
          </li>
        ))}
      </ul>
    </section>
  );
}
