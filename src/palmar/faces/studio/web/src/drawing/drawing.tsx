/** A drawing in millimetres: axes, what is in the plane, what lies over it (grips, labels), and ways to zoom and pan. */

import { useMemo, useRef, useState, type PointerEvent, type ReactNode } from "react";
import { Axes } from "./axes";
import { useView } from "./use_view";
import { GUTTER, planeTransform, type Box, type Size, type View } from "./view";

export interface Layer {
  readonly view: View;
  readonly size: Size;
  /** Size of a pixel (mm). */
  readonly px: number;
}

interface DrawingProps {
  readonly label: string;
  readonly content: Box;
  readonly frozen?: boolean;
  /** In millimetres, y up; clipped to the frame. */
  readonly plane: (layer: Layer) => ReactNode;
  /** In pixels. */
  readonly over?: (layer: Layer) => ReactNode;
  readonly id: string;
}

export function Drawing({ label, content, frozen = false, plane, over, id }: DrawingProps) {
  const frame = useRef<SVGSVGElement>(null);
  const { view, size, zoom, pan, fit } = useView(frame, content, frozen);
  const [panning, setPanning] = useState(false);
  const layer = useMemo<Layer>(() => ({ view, size, px: 1 / view.scale }), [view, size]);
  const down = (event: PointerEvent<SVGSVGElement>) => {
    if (event.button > 1) return;
    event.currentTarget.setPointerCapture(event.pointerId);
    setPanning(true);
  };
  const move = (event: PointerEvent<SVGSVGElement>) => {
    if (panning) pan(event.movementX, event.movementY);
  };
  const [width, height] = [size.width - GUTTER.left - GUTTER.right, size.height - GUTTER.top - GUTTER.bottom];
  return (
    <div className="drawing">
      <svg
        ref={frame}
        role="group"
        aria-label={label}
        className={panning ? "panning" : ""}
        onPointerDown={down}
        onPointerMove={move}
        onPointerUp={() => setPanning(false)}
        onPointerCancel={() => setPanning(false)}
      >
        <clipPath id={`${id}-frame`}>
          <rect x={GUTTER.left} y={GUTTER.top} width={Math.max(width, 0)} height={Math.max(height, 0)} />
        </clipPath>
        <Axes view={view} size={size} />
        <g clipPath={`url(#${id}-frame)`}>
          <g transform={planeTransform(view, size)}>{plane(layer)}</g>
        </g>
        {over?.(layer)}
      </svg>
      <div className="zoom" role="group" aria-label="Zoom">
        <button type="button" onClick={() => zoom(1.25)} aria-label="Zoom in">
          +
        </button>
        <button type="button" onClick={() => zoom(0.8)} aria-label="Zoom out">
          −
        </button>
        <button type="button" onClick={fit} aria-label="Fit the drawing">
          Fit
        </button>
      </div>
    </div>
  );
}
