/** Design: targets in, hands out. */

import { useState } from "react";
import { ClosingDesign } from "./closing_design";
import { SizingDesign } from "./sizing_design";

const STUDIES: readonly (readonly [name: string, words: string])[] = [
  ["size", "Dimensions for a range of radii"],
  ["closing", "How two joints a finger should close"],
];

export function DesignTab() {
  const [study, setStudy] = useState("size");
  return (
    <div className="wide stack">
      <div className="cluster" role="group" aria-label="What to design">
        {STUDIES.map(([name, words]) => (
          <button key={name} type="button" aria-pressed={study === name} onClick={() => setStudy(name)}>
            {words}
          </button>
        ))}
      </div>
      {study === "size" ? <SizingDesign /> : <ClosingDesign />}
    </div>
  );
}
