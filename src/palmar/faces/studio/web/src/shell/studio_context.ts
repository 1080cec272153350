/** What every part of the page shares: the case with its history, the server, and what the page shows. */

import { createContext, useContext } from "react";
import type { CaseFile } from "../case/case_file";
import type { Edited } from "../case/history";
import type { Connection, Status } from "../wire/connection";
import type { Hello } from "../wire/hello";

export interface Studio {
  readonly file: CaseFile;
  /** Changes the case; steps with the same gesture are undone together, null is a change of its own. */
  readonly edit: (to: Edited, gesture: string | null) => void;
  /** The gesture is over. */
  readonly settle: () => void;
  readonly connection: Connection;
  readonly status: Status;
  readonly hello: Hello | null;
  readonly openTab: (name: string) => void;
  /** Shows one line that went wrong beside the head of the page; null takes it away. */
  readonly say: (line: string | null) => void;
}

export const StudioContext = createContext<Studio | null>(null);

export function useStudio(): Studio {
  const found = useContext(StudioContext);
  if (!found) throw new Error("no studio around this part of the page");
  return found;
}
