/** Light or dark: as the system says until the switch is used. */

import { useEffect, useState } from "react";

export type Theme = "light" | "dark";
const KEPT = "palmar-studio-theme";
const DARK = "(prefers-color-scheme: dark)";

/** The theme in force and its switch; what was chosen is kept in this browser. */
export function useTheme(): readonly [Theme, () => void] {
  const [chosen, setChosen] = useState<Theme | null>(kept);
  const [system, setSystem] = useState<Theme>(() => (matchMedia(DARK).matches ? "dark" : "light"));
  useEffect(() => {
    const query = matchMedia(DARK);
    const follow = () => setSystem(query.matches ? "dark" : "light");
    query.addEventListener("change", follow);
    return () => query.removeEventListener("change", follow);
  }, []);
  const theme = chosen ?? system;
  useEffect(() => {
    document.documentElement.dataset["theme"] = theme;
  }, [theme]);
  const turn = () => {
    const next = theme === "dark" ? "light" : "dark";
    setChosen(next);
    localStorage.setItem(KEPT, next);
  };
  return [theme, turn];
}

function kept(): Theme | null {
  const found = localStorage.getItem(KEPT);
  return found === "light" || found === "dark" ? found : null;
}
