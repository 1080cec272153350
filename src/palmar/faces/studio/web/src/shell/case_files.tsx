/** Files in and out: open and save cases as TOML, drop a case or a brief on the page, share the address. */

import { useEffect, useRef, useState } from "react";
import { looksLikeBrief } from "../brief/brief_file";
import { readBrief } from "../brief/open_brief";
import { useDesigning } from "../brief/use_design";
import type { CaseFile } from "../case/case_file";
import { fragmentOf } from "../case/share";
import { offer } from "./download";
import { useStudio } from "./studio_context";

const LARGEST = 200_000;

/** Buttons of the page's head. */
export function CaseFiles({ tab }: { tab: string }) {
  const { file, edit, connection, openTab, say } = useStudio();
  const { edit: editBrief } = useDesigning();
  const picker = useRef<HTMLInputElement>(null);
  const [shared, setShared] = useState(false);

  const open = async (given: File) => {
    if (given.size > LARGEST) return say(`${given.name}: is larger than ${LARGEST} bytes, a case file is a few lines`);
    const text = await given.text();
    if (looksLikeBrief(text)) {
      const wrong = (line: string | null) => say(line === null ? null : `${given.name}: ${line}`);
      openTab("design");
      return readBrief(connection, { brief: text }, editBrief, wrong);
    }
    connection.ask({
      kind: "read_toml",
      parameters: { text },
      onPart: (part) => {
        say(null);
        edit((part.value as { case: CaseFile }).case, null);
      },
      onEnd: (error) => error && say(`${given.name}: ${error}`),
    });
  };
  const dropping = useDrop((given) => void open(given));
  const save = () =>
    connection.ask({
      kind: "write_toml",
      file,
      onPart: (part) =>
        offer("case.toml", new Blob([(part.value as { toml: string }).toml], { type: "application/toml" })),
      onEnd: say,
    });
  const share = async () => {
    const address = location.href.replace(/#.*$/, "") + fragmentOf(tab, file);
    window.history.replaceState(null, "", address);
    try {
      await navigator.clipboard.writeText(address);
      setShared(true);
      setTimeout(() => setShared(false), 2000);
    } catch {
      say("The link is in the address bar; this browser does not let the page copy it.");
    }
  };
  return (
    <>
      <input
        ref={picker}
        type="file"
        accept=".toml,text/plain"
        hidden
        aria-label="Case file or brief"
        onChange={(event) => {
          const given = event.target.files?.[0];
          if (given) void open(given);
          event.target.value = "";
        }}
      />
      <button
        type="button"
        onClick={() => picker.current?.click()}
        title="Open a case file or a brief; or drop one on the page"
      >
        Open
      </button>
      <button type="button" onClick={save} title="Save the case as TOML">
        Save
      </button>
      <button type="button" onClick={() => void share()} title="Copy an address that holds the whole case">
        {shared ? "Link copied" : "Share"}
      </button>
      {dropping && <div className="drop-veil">Drop a case file or a brief (TOML) to open it</div>}
    </>
  );
}

/** Calls back with a file that is dropped anywhere on the page; whether one hovers. */
function useDrop(take: (file: File) => void): boolean {
  const [over, setOver] = useState(false);
  const taker = useRef(take);
  useEffect(() => {
    taker.current = take;
  });
  useEffect(() => {
    const hover = (event: DragEvent) => {
      event.preventDefault();
      setOver(true);
    };
    const leave = (event: DragEvent) => event.relatedTarget === null && setOver(false);
    const drop = (event: DragEvent) => {
      event.preventDefault();
      setOver(false);
      const file = event.dataTransfer?.files[0];
      if (file) taker.current(file);
    };
    window.addEventListener("dragover", hover);
    window.addEventListener("dragleave", leave);
    window.addEventListener("drop", drop);
    return () => {
      window.removeEventListener("dragover", hover);
      window.removeEventListener("dragleave", leave);
      window.removeEventListener("drop", drop);
    };
  }, []);
  return over;
}
