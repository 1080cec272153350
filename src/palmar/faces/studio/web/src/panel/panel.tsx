/** The case as numbers, sliders and choices; the same values as the grips of the drawing. */

import { memo } from "react";
import { HandFields } from "./hand_fields";
import { BehaviourFields, ContactFields } from "./motion_fields";
import { ObjectFields, StartFields } from "./object_fields";

export const Panel = memo(function Panel({ error }: { error: string | null }) {
  return (
    <form className="panel stack" aria-label="Case" onSubmit={(event) => event.preventDefault()}>
      <div className="card">
        <HandFields error={error} />
      </div>
      <div className="card">
        <ObjectFields error={error} />
      </div>
      <div className="card">
        <ContactFields error={error} />
      </div>
      <div className="card">
        <StartFields error={error} />
      </div>
      <div className="card">
        <BehaviourFields error={error} />
      </div>
    </form>
  );
});
