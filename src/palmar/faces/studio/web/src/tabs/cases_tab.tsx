/** The shipped cases, each drawn small; a click loads one. */

import { memo, useEffect, useMemo, useState } from "react";
import { shapeOf, type CaseFile } from "../case/case_file";
import { reach } from "../case/plane";
import { Hand, openFingers } from "../drawing/hand";
import { ObjectOutline } from "../drawing/object";
import { boxOf, joined } from "../drawing/view";
import { useStudio } from "../shell/studio_context";
import { useAnswer } from "../wire/use_answer";

interface Listed {
  readonly name: string;
  readonly description: string;
}

const LIST = { kind: "cases" };
const NONE: readonly Listed[] = [];

export function CasesTab() {
  const { connection, edit, openTab } = useStudio();
  const answer = useAnswer(connection, LIST);
  const list = (answer.parts.get("cases")?.value as { cases: readonly Listed[] } | undefined)?.cases ?? NONE;
  const files = useFiles(list);
  const load = (file: CaseFile) => {
    edit(file, null);
    openTab("studio");
  };
  return (
    <div className="wide stack">
      <h2>Shipped cases</h2>
      {answer.error && <p className="error">{answer.error}</p>}
      <div className="cases">
        {list.map((each) => {
          const file = files[each.name];
          return (
            <button
              key={each.name}
              type="button"
              className="case-card"
              disabled={!file}
              onClick={() => file && load(file)}
            >
              <strong>{each.name}</strong>
              {file ? <Miniature file={file} /> : <svg aria-hidden="true" />}
              <span className="small">{each.description}</span>
            </button>
          );
        })}
      </div>
    </div>
  );
}

/** The listed cases by name, one after the other. */
function useFiles(list: readonly Listed[]): Readonly<Record<string, CaseFile>> {
  const { connection } = useStudio();
  const [files, setFiles] = useState<Readonly<Record<string, CaseFile>>>({});
  const next = list.find((each) => !(each.name in files));
  useEffect(() => {
    if (!next) return;
    connection.ask({
      kind: "cases",
      channel: "one",
      parameters: { name: next.name },
      onPart: (part) => setFiles((known) => ({ ...known, [next.name]: (part.value as { case: CaseFile }).case })),
      onEnd: () => undefined,
    });
  }, [connection, next]);
  return files;
}

/** Hand and object without axes. */
const Miniature = memo(function Miniature({ file }: { file: CaseFile }) {
  const shape = useMemo(() => shapeOf(file), [file]);
  const fingers = openFingers(shape);
  const tall = shape.links.reduce((sum, each) => sum + each, 0);
  const box = joined(
    boxOf([...fingers.right, ...fingers.left, [0, 0.45 * tall]], 0.5 * shape.thickness),
    boxOf([shape.at], reach(shape)),
  );
  const [width, height] = [box.right - box.left, box.top - box.bottom];
  const px = Math.max(width / 240, height / 120);
  const pad = 8 * px;
  return (
    <svg
      className="miniature"
      viewBox={`${box.left - pad} ${-box.top - pad} ${width + 2 * pad} ${height + 2 * pad}`}
      aria-hidden="true"
    >
      <g transform="scale(1 -1)">
        <ObjectOutline shape={shape} at={shape.at} theta={shape.theta} px={px} />
        <Hand fingers={fingers} thickness={shape.thickness} px={px} />
      </g>
    </svg>
  );
});
