/** Time of a motion that is played or scrubbed. */

import { useCallback, useEffect, useState } from "react";

export interface Player {
  readonly time: number;
  readonly playing: boolean;
  readonly toggle: () => void;
  readonly seek: (time: number) => void;
}

/**
 * `seconds`: how long the motion takes; `pace`: how much of it passes in a second. Another motion is shown at the same
 * time, so that what a change does to the end can be watched at the end.
 */
export function usePlayer(seconds: number, pace: number): Player {
  const [time, setTime] = useState(0);
  const [playing, setPlaying] = useState(false);
  useEffect(() => {
    if (!playing) return;
    let last = performance.now();
    let frame = requestAnimationFrame(function step(now) {
      const passed = ((now - last) / 1000) * pace;
      last = now;
      setTime((before) => Math.min(before + passed, seconds));
      frame = requestAnimationFrame(step);
    });
    return () => cancelAnimationFrame(frame);
  }, [playing, pace, seconds]);
  useEffect(() => {
    if (playing && time >= seconds) setPlaying(false);
  }, [playing, time, seconds]);
  const toggle = useCallback(() => {
    setTime((before) => (!playing && before >= seconds ? 0 : before));
    setPlaying(!playing);
  }, [playing, seconds]);
  const seek = useCallback((to: number) => {
    setPlaying(false);
    setTime(to);
  }, []);
  return { time: Math.min(time, seconds), playing, toggle, seek };
}
