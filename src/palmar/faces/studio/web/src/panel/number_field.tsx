/** One value as a number and a slider. Ranges ("0.2..0.8") can be typed where the case file allows them. */

import { memo, useId, useState, type KeyboardEvent } from "react";
import { middle, rangeOf, type Quantity } from "../case/case_file";
import { roundStep } from "../drawing/view";

export interface NumberFieldProps {
  readonly label: string;
  readonly unit?: string;
  readonly value: Quantity;
  /** Ends of the slider; without an upper end it is about twice what the value is when the slider is taken. */
  readonly low?: number;
  readonly high?: number;
  readonly step: number;
  /** The server's objection to this value. */
  readonly error?: string | null;
  readonly onChange: (value: Quantity) => void;
  readonly onSettle: () => void;
}

const NUMBER = /^[-+]?(\d+\.?\d*|\.\d+)(e[-+]?\d+)?$/i;

/** What was typed as a number or a range, null if it is neither yet. */
export function typed(text: string): Quantity | null {
  const plain = text
    .trim()
    .replace("−", "-")
    .replace(/^([-+]?\d+),(\d+)$/, "$1.$2");
  if (NUMBER.test(plain)) return Number(plain);
  return rangeOf(plain) ? plain : null;
}

/** Fields whose value stays are not made anew while another one is dragged. */
export const NumberField = memo(function NumberField({
  label,
  unit = "",
  value,
  low = 0,
  high,
  step,
  error,
  onChange,
  onSettle,
}: NumberFieldProps) {
  const id = useId();
  const [draft, setDraft] = useState<string | null>(null);
  const [held, setHeld] = useState<number | null>(null);
  const now = middle(value, low);
  const top = high ?? held ?? upperEnd(now, step);
  const shown = draft ?? String(value);
  const bad = draft !== null && typed(draft) === null;

  const type = (text: string) => {
    setDraft(text);
    const found = typed(text);
    if (found !== null) onChange(found);
  };
  const leave = () => {
    setDraft(null);
    onSettle();
  };
  const key = (event: KeyboardEvent<HTMLInputElement>) => {
    if (event.key === "Enter") leave();
    if (event.key !== "ArrowUp" && event.key !== "ArrowDown") return;
    event.preventDefault();
    const by = (event.key === "ArrowUp" ? 1 : -1) * step * (event.shiftKey ? 10 : 1);
    setDraft(null);
    onChange(Number(Math.max(low, now + by).toFixed(9)));
  };
  return (
    <div className="field">
      <label htmlFor={id}>{label}</label>
      <input
        id={id}
        className="number"
        type="text"
        inputMode="decimal"
        autoComplete="off"
        value={shown}
        aria-invalid={bad || Boolean(error)}
        aria-describedby={error ? `${id}-error` : undefined}
        onChange={(event) => type(event.target.value)}
        onBlur={leave}
        onKeyDown={key}
      />
      <span className="unit">{unit}</span>
      <input
        type="range"
        aria-label={`${label}, slider`}
        min={low}
        max={Math.max(top, now)}
        step={step}
        value={now}
        onPointerDown={() => setHeld(upperEnd(now, step))}
        onPointerUp={() => {
          setHeld(null);
          onSettle();
        }}
        onKeyUp={onSettle}
        onChange={(event) => onChange(Number(event.target.value))}
      />
      {bad && <p className="error small">{label}: a number, or a range as 0.2..0.8</p>}
      {error && (
        <p className="error small" id={`${id}-error`} role="alert">
          {error}
        </p>
      )}
    </div>
  );
});

const upperEnd = (value: number, step: number): number => roundStep(Math.max(2 * Math.abs(value), 20 * step));
