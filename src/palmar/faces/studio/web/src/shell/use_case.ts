/** The case with its history, kept in the address's fragment so that a reload and a shared link have it again. */

import { useCallback, useEffect, useReducer, useState } from "react";
import { FIRST_CASE } from "../case/case_file";
import { begun, changed, type Edited } from "../case/history";
import { fragmentOf, readFragment } from "../case/share";

/** How long after the last change (ms) the address follows: browsers limit how often it may. */
const SLOWLY = 250;

export function useCase() {
  const [opened] = useState(() => readFragment(location.hash));
  const [history, dispatch] = useReducer(changed, opened.file ?? FIRST_CASE, begun);
  const [tab, openTab] = useState(opened.tab ?? "studio");
  const file = history.now;

  const edit = useCallback((to: Edited, gesture: string | null) => dispatch({ kind: "edit", to, gesture }), []);
  const settle = useCallback(() => dispatch({ kind: "settle" }), []);
  const undo = useCallback(() => dispatch({ kind: "undo" }), []);
  const redo = useCallback(() => dispatch({ kind: "redo" }), []);

  useEffect(() => {
    const timer = setTimeout(() => window.history.replaceState(null, "", fragmentOf(tab, file)), SLOWLY);
    return () => clearTimeout(timer);
  }, [tab, file]);
  useEffect(() => {
    // Our own writing of the address raises no such event: this is a link that was pasted over it.
    const follow = () => {
      const found = readFragment(location.hash);
      if (found.file) edit(found.file, null);
      if (found.tab) openTab(found.tab);
    };
    window.addEventListener("hashchange", follow);
    return () => window.removeEventListener("hashchange", follow);
  }, [edit]);
  useEffect(() => {
    const key = (event: KeyboardEvent) => {
      if (!(event.ctrlKey || event.metaKey) || event.altKey || isTyping(event.target)) return;
      const name = event.key.toLowerCase();
      if (name === "z") (event.shiftKey ? redo : undo)();
      else if (name === "y") redo();
      else return;
      event.preventDefault();
    };
    window.addEventListener("keydown", key);
    return () => window.removeEventListener("keydown", key);
  }, [undo, redo]);
  const [canUndo, canRedo] = [history.past.length > 0, history.future.length > 0];
  const damaged = location.hash.includes("case=") && opened.file === null;
  return { file, edit, settle, undo, redo, canUndo, canRedo, tab, openTab, damaged };
}

/** A text field has its own undo. */
const isTyping = (target: EventTarget | null): boolean =>
  target instanceof HTMLTextAreaElement || (target instanceof HTMLInputElement && target.type === "text");
