/** Export of what is on screen, in the formats of the command line. */

import { memo, useId, useState } from "react";
import { useStudio } from "./studio_context";
import { exportFile, type ExportWish } from "./download";

export interface Exportable {
  readonly words: string;
  readonly wish: Omit<ExportWish, "format">;
}

/** One choice of what and in which of the server's formats, and a button. */
export const ExportMenu = memo(function ExportMenu({ things }: { things: readonly Exportable[] }) {
  const id = useId();
  const [chosen, choose] = useState("");
  const [busy, setBusy] = useState(false);
  const [error, setError] = useState<string | null>(null);
  const { hello } = useStudio();
  const formatsOf = (each: Exportable) => hello?.exports[each.wish.what] ?? [];
  const options = things.flatMap((each) =>
    formatsOf(each).map((format) => ({ each, format, name: `${each.words} ${format}` })),
  );
  const option = options.find(({ name }) => name === chosen) ?? options[0];
  if (!option) return null;
  const save = async () => {
    setBusy(true);
    setError(await exportFile({ ...option.each.wish, format: option.format }));
    setBusy(false);
  };
  return (
    <div className="stack">
      <div className="cluster">
        <label htmlFor={id}>Export</label>
        <select id={id} value={option.name} onChange={(event) => choose(event.target.value)}>
          {things.map((each) => (
            <optgroup key={each.words} label={each.words}>
              {formatsOf(each).map((format) => (
                <option key={format} value={`${each.words} ${format}`}>
                  {`${each.words}, ${format}`}
                </option>
              ))}
            </optgroup>
          ))}
        </select>
        <button type="button" onClick={() => void save()} disabled={busy} aria-label="Save the export">
          {busy ? "Writing…" : "Save"}
        </button>
      </div>
      {error && (
        <p className="error small" role="alert">
          {error}
        </p>
      )}
    </div>
  );
});
