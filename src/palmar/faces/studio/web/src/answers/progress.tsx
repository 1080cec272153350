/** How an answer stands: at work (and at what, where that takes long), or what was wrong. */

import type { Answer } from "../wire/use_answer";

export function Progress({ answer }: { answer: Pick<Answer, "busy" | "wait" | "error"> }) {
  // The badge fades in by its style after a moment: quick answers do not make it flicker.
  return (
    <>
      {answer.busy && (
        <p role="status">
          <span className="badge wait slow">{answer.wait ?? "working"}</span>
        </p>
      )}
      {answer.error && (
        <p className="error" role="alert">
          {answer.error}
        </p>
      )}
    </>
  );
}
