/** Briefs from the server: a shipped one by its name, or a file's text read by the brief's own rules. */

import type { Connection } from "../wire/connection";
import type { BriefFile } from "./brief_file";

export function readBrief(
  connection: Connection,
  parameters: { readonly name: string } | { readonly brief: string },
  take: (brief: BriefFile) => void,
  say: (line: string | null) => void,
): void {
  connection.ask({
    kind: "briefs",
    channel: "one",
    parameters,
    onPart: (part) => {
      say(null);
      take((part.value as { brief: BriefFile }).brief);
    },
    onEnd: (error) => error && say(error),
  });
}
