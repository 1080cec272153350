/** The page: its head with tabs, history, files and theme; below it the tab that is open. */

import { useMemo, useState, type KeyboardEvent } from "react";
import { DesignContext, useDesign } from "../brief/use_design";
import { CasesTab } from "../tabs/cases_tab";
import { DesignTab } from "../tabs/design_tab";
import { ExperimentsTab } from "../tabs/experiments_tab";
import { MapTab } from "../tabs/map_tab";
import { StudioTab } from "../tabs/studio_tab";
import { useConnection } from "../wire/use_connection";
import { CaseFiles } from "./case_files";
import { StudioContext, type Studio } from "./studio_context";
import { useTheme } from "./theme";
import { useCase } from "./use_case";

const TABS = [
  ["studio", "Studio", StudioTab],
  ["map", "Closure map", MapTab],
  ["design", "Design", DesignTab],
  ["experiments", "Experiments", ExperimentsTab],
  ["cases", "Cases", CasesTab],
] as const;
const ALONG: Readonly<Record<string, number>> = { ArrowLeft: -1, ArrowRight: 1 };

export function App() {
  const [connection, status, hello] = useConnection();
  const { file, edit, settle, undo, redo, canUndo, canRedo, tab, openTab, damaged } = useCase();
  const [line, say] = useState(damaged ? "The link's case could not be read; this is the first case instead." : null);
  const [theme, turnTheme] = useTheme();
  const designing = useDesign(connection, tab === "design");
  const studio = useMemo<Studio>(
    () => ({ file, edit, settle, connection, status, hello, openTab, say }),
    [file, edit, settle, connection, status, hello, openTab],
  );
  const open = TABS.find(([name]) => name === tab) ?? TABS[0];
  const Tab = open[2];
  const walk = (event: KeyboardEvent) => {
    const by = ALONG[event.key];
    if (by === undefined) return;
    const next = TABS[(TABS.indexOf(open) + by + TABS.length) % TABS.length] as (typeof TABS)[number];
    openTab(next[0]);
    document.getElementById(`tab-${next[0]}`)?.focus();
  };
  return (
    <StudioContext value={studio}>
      <DesignContext value={designing}>
        <div className="page">
          <header className="bar">
            <h1>palmar studio</h1>
            <div className="tabs" role="tablist" aria-label="Pages" onKeyDown={walk}>
              {TABS.map(([name, words]) => (
                <button
                  key={name}
                  id={`tab-${name}`}
                  type="button"
                  role="tab"
                  aria-selected={name === open[0]}
                  aria-controls="page-body"
                  tabIndex={name === open[0] ? 0 : -1}
                  onClick={() => openTab(name)}
                >
                  {words}
                </button>
              ))}
            </div>
            <span className="spring" />
            <div className="cluster" role="group" aria-label="History and files">
              <button type="button" onClick={undo} disabled={!canUndo} title="Undo (Ctrl+Z)">
                Undo
              </button>
              <button type="button" onClick={redo} disabled={!canRedo} title="Redo (Ctrl+Shift+Z)">
                Redo
              </button>
              <CaseFiles tab={open[0]} />
              <button
                type="button"
                onClick={turnTheme}
                aria-label={`Switch to ${theme === "dark" ? "light" : "dark"} colours`}
              >
                {theme === "dark" ? "Light" : "Dark"}
              </button>
            </div>
          </header>
          <div>
            {status !== "ready" && (
              <p className="notice" role="status">
                {status === "lost"
                  ? "The connection to palmar studio is lost; trying again. Nothing you have set is lost."
                  : "Connecting to palmar studio…"}
              </p>
            )}
            {line && (
              <p className="notice" role="alert">
                {line}{" "}
                <button type="button" className="tiny" onClick={() => say(null)} aria-label="Dismiss">
                  ×
                </button>
              </p>
            )}
          </div>
          <main>
            <div id="page-body" role="tabpanel" aria-labelledby={`tab-${open[0]}`}>
              <Tab />
            </div>
          </main>
        </div>
      </DesignContext>
    </StudioContext>
  );
}
