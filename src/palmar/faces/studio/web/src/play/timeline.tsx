/** Play, pause and scrub a motion; its events in order, each a way to its moment. */

import type { MotionEvent } from "./motion";
import type { Player } from "./use_player";

interface TimelineProps {
  readonly player: Player;
  readonly seconds: number;
  readonly pace: number;
  readonly events: readonly MotionEvent[];
}

const paceWords = (pace: number): string => {
  if (pace === 1) return "in real time";
  return pace > 1 ? `${Number(pace.toPrecision(2))} times faster` : `${Number((1 / pace).toPrecision(2))} times slower`;
};

export function Timeline({ player, seconds, pace, events }: TimelineProps) {
  const { time } = player;
  const passed = events.filter((each) => each.time <= time + 1e-9).length;
  const step = (by: number) => {
    const next = by > 0 ? events[passed] : events.filter((each) => each.time < time - 1e-9).at(-1);
    player.seek(next?.time ?? (by > 0 ? seconds : 0));
  };
  return (
    <div className="stack">
      <div className="cluster">
        <button
          type="button"
          className="primary"
          onClick={player.toggle}
          aria-label={player.playing ? "Pause" : "Play"}
        >
          {player.playing ? "❚❚ Pause" : "▶ Play"}
        </button>
        <button type="button" onClick={() => step(-1)} aria-label="Event before">
          ◂ event
        </button>
        <button type="button" onClick={() => step(1)} aria-label="Next event">
          event ▸
        </button>
        <span className="small muted">
          {time.toFixed(3)} of {seconds.toFixed(3)} s, {paceWords(pace)}
        </span>
      </div>
      <input
        type="range"
        aria-label="Time of the motion"
        aria-valuetext={`${time.toFixed(3)} seconds`}
        min={0}
        max={seconds}
        step={seconds / 1000 || 1}
        value={time}
        onChange={(event) => player.seek(Number(event.target.value))}
      />
      <div className="scroll">
        <table className="events">
          <thead>
            <tr>
              <th className="number">time (s)</th>
              <th>event</th>
            </tr>
          </thead>
          <tbody>
            {events.map((each, i) => (
              <tr key={i} className={i < passed ? "passed" : ""} aria-current={i === passed - 1 ? "step" : undefined}>
                <td className="number">{each.time.toFixed(3)}</td>
                <td>
                  <button type="button" className="plain" onClick={() => player.seek(each.time)}>
                    {each.words}
                  </button>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </div>
  );
}
