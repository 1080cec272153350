/** The view of a drawing: fitted to its content by itself until the user zooms or pans. */

import { useCallback, useEffect, useLayoutEffect, useRef, useState, type RefObject } from "react";
import type { Point } from "../case/case_file";
import { fitted, holds, seen, zoomed, type Box, type Size, type View } from "./view";

export interface ViewControl {
  readonly view: View;
  readonly size: Size;
  readonly zoom: (factor: number, about?: Point) => void;
  readonly pan: (across: number, up: number) => void;
  readonly fit: () => void;
}

/** Content that fills less than this share of a fitted drawing is fitted anew. */
const SLACK = 0.62;
const FIRST: Size = { width: 640, height: 480 };

/** `frozen`: while something is being dragged the view stays as it is. */
export function useView(frame: RefObject<SVGSVGElement | null>, content: Box, frozen: boolean): ViewControl {
  const size = useSize(frame);
  const [own, setOwn] = useState<View | null>(null);
  const last = useRef<{ view: View; size: Size } | null>(null);
  let view = own ?? last.current?.view ?? fitted(content, size);
  if (!own && !(frozen && last.current)) view = refitted(last.current, content, size);
  useLayoutEffect(() => {
    last.current = { view, size };
  });
  const zoom = useCallback(
    (factor: number, about?: Point) =>
      setOwn(zoomed(last.current?.view ?? view, size, about ?? [0.5 * size.width, 0.5 * size.height], factor)),
    [size, view],
  );
  const pan = useCallback(
    (across: number, up: number) => {
      const now = last.current?.view ?? view;
      setOwn({ ...now, centre: [now.centre[0] - across / now.scale, now.centre[1] + up / now.scale] });
    },
    [view],
  );
  const [, again] = useState(0);
  const fit = useCallback(() => {
    last.current = null;
    setOwn(null);
    again((count) => count + 1);
  }, []);
  useWheel(frame, zoom);
  return { view, size, zoom, pan, fit };
}

/** The last view while it still suits, so that the drawing does not breathe with every change. */
function refitted(last: { view: View; size: Size } | null, content: Box, size: Size): View {
  const best = fitted(content, size);
  if (!last || last.size !== size) return best;
  const suits = holds(seen(last.view, size), content) && last.view.scale > SLACK * best.scale;
  return suits ? last.view : best;
}

function useSize(frame: RefObject<SVGSVGElement | null>): Size {
  const [size, setSize] = useState(FIRST);
  useLayoutEffect(() => {
    const element = frame.current;
    if (!element) return;
    const measure = () => {
      const { width, height } = element.getBoundingClientRect();
      setSize((now) => (now.width === width && now.height === height ? now : { width, height }));
    };
    measure();
    const observer = new ResizeObserver(measure);
    observer.observe(element);
    return () => observer.disconnect();
  }, [frame]);
  return size;
}

/** The wheel zooms about the pointer; React's own wheel listeners cannot keep the page from scrolling. */
function useWheel(frame: RefObject<SVGSVGElement | null>, zoom: (factor: number, about: Point) => void): void {
  useEffect(() => {
    const element = frame.current;
    if (!element) return;
    const turn = (event: WheelEvent) => {
      event.preventDefault();
      const box = element.getBoundingClientRect();
      zoom(Math.exp(-0.0015 * event.deltaY), [event.clientX - box.left, event.clientY - box.top]);
    };
    element.addEventListener("wheel", turn, { passive: false });
    return () => element.removeEventListener("wheel", turn);
  }, [frame, zoom]);
}
