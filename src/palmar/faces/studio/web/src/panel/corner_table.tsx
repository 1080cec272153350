/** Corners of a convex polygon as a table: a row for each, in the polygon's own frame. */

import { middle, type Quantity } from "../case/case_file";
import { withCorner } from "../case/plane";

type Corner = readonly [Quantity, Quantity];

interface CornerTableProps {
  readonly corners: readonly Corner[];
  readonly error: string | null;
  /** `index`: of the corner that moved, undefined where one came or went. */
  readonly onChange: (to: readonly Corner[], index?: number) => void;
  readonly onSettle?: () => void;
}

export function CornerTable({ corners, error, onChange, onSettle }: CornerTableProps) {
  const move = (index: number, along: 0 | 1, to: number) =>
    onChange(
      corners.map((each, i) =>
        i !== index ? each : along === 0 ? ([to, each[1]] as const) : ([each[0], to] as const),
      ),
      index,
    );
  const add = (index: number) => {
    const place = withCorner(
      corners.map(([x, y]) => [middle(x, 0), middle(y, 0)] as const),
      index,
    );
    if (place) onChange([...corners.slice(0, index + 1), place, ...corners.slice(index + 1)]);
  };
  return (
    <div className="stack">
      <table className="corners">
        <thead>
          <tr>
            <th>corner</th>
            <th>x (mm)</th>
            <th>y (mm)</th>
            <th>
              <span className="visually-hidden">add or remove</span>
            </th>
          </tr>
        </thead>
        <tbody>
          {corners.map((corner, i) => (
            <tr key={i}>
              <td>{i + 1}</td>
              {([0, 1] as const).map((along) => (
                <td key={along}>
                  <input
                    type="number"
                    aria-label={`Corner ${i + 1}, ${along === 0 ? "x" : "y"} in mm`}
                    value={middle(corner[along], 0)}
                    step={1}
                    onChange={(event) =>
                      Number.isFinite(event.target.valueAsNumber) && move(i, along, event.target.valueAsNumber)
                    }
                    onBlur={onSettle}
                  />
                </td>
              ))}
              <td>
                <div className="cluster">
                  <button
                    type="button"
                    className="tiny"
                    aria-label={`Add a corner after ${i + 1}`}
                    onClick={() => add(i)}
                  >
                    +
                  </button>
                  <button
                    type="button"
                    className="tiny"
                    aria-label={`Remove corner ${i + 1}`}
                    disabled={corners.length <= 3}
                    onClick={() => onChange(corners.filter((_, k) => k !== i))}
                  >
                    ×
                  </button>
                </div>
              </td>
            </tr>
          ))}
        </tbody>
      </table>
      {error && (
        <p className="error small" role="alert">
          {error}
        </p>
      )}
    </div>
  );
}
