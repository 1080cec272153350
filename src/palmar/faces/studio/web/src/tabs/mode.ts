/** What a way of using the drawing (play, paint, plan …) adds to it. */

import type { ReactNode } from "react";
import type { Layer } from "../drawing/drawing";
import type { Box } from "../drawing/view";
import type { Exportable } from "../shell/export_menu";

export interface Mode {
  /** Under hand and object, in millimetres. */
  readonly below?: (layer: Layer) => ReactNode;
  /** Over them. */
  readonly plane: (layer: Layer) => ReactNode;
  /** Under the drawing: controls, events, numbers. */
  readonly controls: ReactNode;
  /** What more the drawing has to show (mm). */
  readonly bounds: Box | null;
  /** Whether it draws hand and object itself, so that those of the case are ghosts. */
  readonly moving: boolean;
  readonly exports: readonly Exportable[];
}

/** A box as the server gives it. */
export const boxOfBounds = (given: readonly [number, number, number, number] | undefined): Box | null =>
  given ? { left: given[0], bottom: given[1], right: given[2], top: given[3] } : null;
