/** A grip: a point of the drawing that can be dragged with pointer or finger, and moved with the arrow keys. */

import { useEffect, useLayoutEffect, useRef, type KeyboardEvent, type PointerEvent, type RefObject } from "react";
import { flushSync } from "react-dom";
import type { Point } from "../case/case_file";
import { add, minus } from "../case/plane";
import { toPlane, toScreen, type Size, type View } from "./view";

export interface GripSpec {
  readonly id: string;
  /** Where it is (mm). */
  readonly at: Point;
  /** What it moves, for people and for screen readers. */
  readonly label: string;
  /** Its dimension as a number and in words. */
  readonly value: number;
  readonly text: string;
  /** Between what that number must lie. */
  readonly ends: Point;
  readonly look?: "round" | "square" | "diamond";
  readonly onDrag: (to: Point) => void;
  /** Arrow keys: steps to the right and up; without it the grip is dragged by that many rounding steps. */
  readonly onStep?: (across: number, up: number) => void;
  readonly onRemove?: () => void;
}

interface GripProps {
  readonly grip: GripSpec;
  readonly view: View;
  readonly size: Size;
  readonly step: number;
  readonly onSettle: () => void;
  readonly onHold: (held: boolean) => void;
  /** Whether a question raised now would be asked at once. */
  readonly isIdle: () => boolean;
}

/** What is dragged, and from where: the grip less the pointer (mm), and the drawing's corner (px). */
interface Held {
  readonly from: Point;
  readonly corner: Point;
}

const ARROWS: Readonly<Record<string, Point>> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, 1],
  ArrowDown: [0, -1],
};
const SHAPES = {
  round: "M-6 0a6 6 0 1 0 12 0a6 6 0 1 0 -12 0Z",
  square: "M-5.5-5.5H5.5V5.5H-5.5Z",
  diamond: "M0-7.5 7.5 0 0 7.5-7.5 0Z",
};

export function Grip({ grip, view, size, step, onSettle, onHold, isIdle }: GripProps) {
  const held = useRef<Held | null>(null);
  const [x, y] = toScreen(view, size, grip.at);

  const at = (event: { clientX: number; clientY: number }, corner: Point): Point =>
    toPlane(view, size, [event.clientX - corner[0], event.clientY - corner[1]]);
  const down = (event: PointerEvent<SVGGElement>) => {
    if (event.button !== 0) return;
    event.stopPropagation();
    event.currentTarget.setPointerCapture(event.pointerId);
    const box = (event.currentTarget.ownerSVGElement as SVGSVGElement).getBoundingClientRect();
    const corner = [box.left, box.top] as const;
    held.current = { from: minus(grip.at, at(event, corner)), corner };
    onHold(true);
  };
  const move = (event: { clientX: number; clientY: number }) => {
    const now = held.current;
    // At once, so that the frame about to be painted shows it, and the question it raises goes out before that.
    if (now) flushSync(() => grip.onDrag(add(at(event, now.corner), now.from)));
  };
  const rawMove = (event: MouseEvent) => {
    if (isIdle()) move(event);
  };
  const ref = useRawMoves(rawMove);
  const up = () => {
    if (!held.current) return;
    held.current = null;
    onHold(false);
    onSettle();
  };
  const key = (event: KeyboardEvent<SVGGElement>) => {
    const arrow = ARROWS[event.key];
    if (arrow) {
      event.preventDefault();
      const [across, along] = [arrow[0], arrow[1]].map((each) => each * (event.shiftKey ? 10 : 1)) as [number, number];
      if (grip.onStep) grip.onStep(across, along);
      else grip.onDrag(add(grip.at, [across * step, along * step]));
    } else if ((event.key === "Delete" || event.key === "Backspace") && grip.onRemove) {
      event.preventDefault();
      grip.onRemove();
    }
  };
  return (
    <g
      ref={ref}
      className="grip"
      data-grip={grip.id}
      transform={`translate(${x} ${y})`}
      tabIndex={0}
      role="slider"
      aria-label={grip.label}
      aria-valuemin={grip.ends[0]}
      aria-valuemax={grip.ends[1]}
      aria-valuenow={grip.value}
      aria-valuetext={grip.text}
      onPointerDown={down}
      onPointerMove={move}
      onPointerUp={up}
      onPointerCancel={up}
      onKeyDown={key}
      onKeyUp={(event) => event.key in ARROWS && onSettle()}
    >
      <title>{`${grip.label}: ${grip.text}`}</title>
      <circle className="grip-reach" r={16} />
      <circle className="grip-focus" r={12} />
      <path className="grip-mark" d={SHAPES[grip.look ?? "round"]} />
    </g>
  );
}

/** Moves as the pointer makes them, up to a frame before the browser tells of them; without such news only the latter. */
function useRawMoves(onMove: (event: MouseEvent) => void): RefObject<SVGGElement | null> {
  const element = useRef<SVGGElement>(null);
  const latest = useRef(onMove);
  useLayoutEffect(() => {
    latest.current = onMove;
  });
  useEffect(() => {
    const grip = element.current;
    const tell = (event: Event) => latest.current(event as MouseEvent);
    grip?.addEventListener("pointerrawupdate", tell);
    return () => grip?.removeEventListener("pointerrawupdate", tell);
  }, []);
  return element;
}
