/** Closure map of the 4-jointed hand: hover and the hand is drawn, click and it is loaded. */

import { useMemo, useState } from "react";
import { fixed } from "../answers/amounts";
import type { CaseFile, Point } from "../case/case_file";
import { Drawing } from "../drawing/drawing";
import { Hand } from "../drawing/hand";
import { boxOf, joined } from "../drawing/view";
import { ExportMenu } from "../shell/export_menu";
import { useStudio } from "../shell/studio_context";
import { useAnswer } from "../wire/use_answer";
import { MapPicture, type MapRecord } from "./map_picture";

const MAPS: readonly (readonly [name: string, words: string])[] = [
  ["overall", "overall"],
  ["proximal_palm", "proximal links and palm"],
  ["distal_palm", "distal links and palm"],
  ["distal_proximal", "distal and proximal links"],
  ["distal_proximal_palm", "distal, proximal links, palm"],
];

interface HandValue {
  readonly distal: number;
  readonly proximal: number;
  readonly palm: number;
  readonly radius_max: Readonly<Record<string, number | null>>;
  readonly radius_min: Readonly<Record<string, number | null>>;
  readonly case: CaseFile | null;
  readonly drawing: {
    readonly hand: { readonly right_mm: readonly Point[]; readonly left_mm: readonly Point[] };
  } | null;
  readonly hold: {
    readonly radius_mm: number;
    readonly centre_mm: Point;
    readonly right_mm: readonly Point[];
    readonly left_mm: readonly Point[];
  } | null;
}

export function MapTab() {
  const { connection, edit, openTab } = useStudio();
  const [name, setName] = useState("overall");
  const [at, setAt] = useState<Point>([0.25, 0.5]);
  const grid = useMemo(() => ({ kind: "closure_map", parameters: { grid: 101 } }), []);
  const map = useAnswer(connection, grid);
  const record = map.parts.get("map")?.value as MapRecord | undefined;
  const wish = useMemo(() => ({ kind: "map_hand", parameters: { distal: at[0], proximal: at[1] } }), [at]);
  const answer = useAnswer(connection, wish);
  const hand = answer.parts.get("hand")?.value as HandValue | undefined;
  const load = () => {
    if (!hand?.case) return;
    edit(hand.case, null);
    openTab("studio");
  };
  return (
    <div className="two">
      <div className="stack">
        <div className="cluster">
          <h2>What 4-jointed hands hold</h2>
          <select aria-label="Links that hold" value={name} onChange={(event) => setName(event.target.value)}>
            {MAPS.map(([key, words]) => (
              <option key={key} value={key}>
                {words}
              </option>
            ))}
          </select>
        </div>
        {map.error && <p className="error">{map.error}</p>}
        <div className="card">
          {record ? (
            <MapPicture record={record} name={name} at={at} onMove={setAt} onPick={load} />
          ) : (
            <p className="muted">Computing the map…</p>
          )}
        </div>
        <p className="small muted">
          Largest radius held without friction, as a share of half the hand's length; the half palm is 1 − Q − P. Point
          at a hand, or move the cross with the arrow keys; a click or Enter loads it into the studio.
        </p>
      </div>
      <div className="stack">
        <div className="card sheet">{hand && <HeldHand hand={hand} />}</div>
        <div className="card stack">
          <h2>
            Q = {fixed(at[0], 2)}, P = {fixed(at[1], 2)}
          </h2>
          {answer.error && <p className="error">{answer.error}</p>}
          {hand && <Radii hand={hand} />}
          <button type="button" className="primary" disabled={!hand?.case} onClick={load}>
            Load this hand
          </button>
        </div>
        <div className="card">
          <ExportMenu
            things={[
              {
                words: "closure map",
                wish: { what: "map", parameters: { grid: 101 } },
              },
            ]}
          />
        </div>
      </div>
    </div>
  );
}

/** The hand about the largest disk it holds, or open where it holds none. */
function HeldHand({ hand }: { hand: HandValue }) {
  const { hold } = hand;
  const fingers = hold
    ? { right: hold.right_mm, left: hold.left_mm }
    : hand.drawing && { right: hand.drawing.hand.right_mm, left: hand.drawing.hand.left_mm };
  if (!fingers) return <p className="muted">No hand: the links leave no palm.</p>;
  const points = [...fingers.right, ...fingers.left];
  const box = hold
    ? joined(boxOf(points, 5), boxOf([hold.centre_mm], hold.radius_mm))
    : boxOf([...points, [0, 100]], 5);
  return (
    <Drawing
      id="map-hand"
      label="The hand at that point"
      content={box}
      plane={({ px }) => (
        <>
          {hold && (
            <g className="object moving">
              <circle cx={hold.centre_mm[0]} cy={hold.centre_mm[1]} r={hold.radius_mm} />
            </g>
          )}
          <Hand fingers={fingers} thickness={0} px={px} />
        </>
      )}
    />
  );
}

function Radii({ hand }: { hand: HandValue }) {
  const show = (value: number | null | undefined) => (value == null ? "–" : fixed(value, 4));
  return (
    <table className="facts">
      <thead>
        <tr>
          <th>held by</th>
          <th className="number">smallest R*</th>
          <th className="number">largest R*</th>
        </tr>
      </thead>
      <tbody>
        {MAPS.map(([key, words]) => (
          <tr key={key}>
            <th scope="row">{words}</th>
            <td className="number">{show(hand.radius_min[key])}</td>
            <td className="number">{show(hand.radius_max[key])}</td>
          </tr>
        ))}
      </tbody>
    </table>
  );
}
