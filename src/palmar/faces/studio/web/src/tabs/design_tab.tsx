/** Design: targets in, hands out. */

import { useState } from "react";
import { BriefDesign } from "./brief_design";
import { ClosingDesign } from "./closing_design";
import { SizingDesign } from "./sizing_design";

const STUDIES: readonly (readonly [name: string, words: string])[] = [
  ["brief", "The smallest hand for a brief"],
  ["size", "Dimensions for a range of radii"],
  ["closing", "How two joints a finger should close"],
];

export function DesignTab() {
  const [study, setStudy] = useState("brief");
  return (
    <div className="wide stack">
      <div className="cluster" role="group" aria-label="What to design">
        {STUDIES.map(([name, words]) => (
          <button key={name} type="button" aria-pressed={study === name} onClick={() => setStudy(name)}>
            {words}
          </button>
        ))}
      </div>
      {study === "brief" && <BriefDesign />}
      {study === "size" && <SizingDesign />}
      {study === "closing" && <ClosingDesign />}
    </div>
  );
}
