/** A case as its file has it: sections and keys of the TOML, millimetres and degrees. */

/** A number, or a range of what is not known better, as "0.2..0.8". */
export type Quantity = number | string;
export type Point = readonly [number, number];

export interface HandSection {
  readonly palm_width_mm: Quantity;
  readonly finger_links_mm: readonly Quantity[];
  readonly finger_thickness_mm?: Quantity;
  readonly fingers?: "crossing" | "colliding";
  readonly open_deg?: Quantity;
  readonly [key: string]: unknown;
}

export interface DiskSection {
  readonly shape: "disk";
  readonly radius_mm: Quantity;
  readonly [key: string]: unknown;
}

export interface PolygonSection {
  readonly shape: "polygon";
  readonly vertices_mm: readonly (readonly [Quantity, Quantity])[];
  readonly [key: string]: unknown;
}

export interface ContactSection {
  readonly friction?: Quantity;
  readonly restitution?: Quantity;
  readonly [key: string]: unknown;
}

export interface SupportSection {
  readonly kind?: "table" | "free";
  readonly friction?: Quantity;
  readonly pressure?: "uniform" | "rim" | "centre";
  readonly wall_mm?: Quantity;
  readonly [key: string]: unknown;
}

export interface StartSection {
  readonly at_mm?: readonly [Quantity, Quantity];
  readonly theta_deg?: Quantity;
  readonly velocity_mm_s?: readonly [Quantity, Quantity];
  readonly [key: string]: unknown;
}

export interface SensorsSection {
  readonly layout?: string | readonly string[];
  readonly [key: string]: unknown;
}

export interface BehaviourSection {
  readonly name?: string;
  readonly [key: string]: unknown;
}

export interface CaseFile {
  readonly hand: HandSection;
  readonly object: DiskSection | PolygonSection;
  readonly contact?: ContactSection;
  readonly support?: SupportSection;
  readonly start?: StartSection;
  readonly sensors?: SensorsSection;
  readonly behaviour?: BehaviourSection;
  readonly bed?: Readonly<Record<string, unknown>>;
}

/** The test bed of the source: what the page opens with until something else is loaded. */
export const FIRST_CASE: CaseFile = {
  hand: { palm_width_mm: 120, finger_links_mm: [137, 107] },
  object: { shape: "disk", radius_mm: 38 },
  contact: { friction: 0.7 },
  support: { kind: "table", friction: 0.3 },
};

const RANGE = /^\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*\.\.\s*([-+]?[\d.]+(?:e[-+]?\d+)?)\s*$/i;

/** Lower and upper end of a range, or null of a plain number. */
export function rangeOf(value: Quantity): readonly [number, number] | null {
  const found = typeof value === "string" ? RANGE.exec(value) : null;
  return found ? [Number(found[1]), Number(found[2])] : null;
}

/** The number to draw with: of a range its middle. */
export function middle(value: Quantity | undefined, absent: number): number {
  if (value === undefined) return absent;
  if (typeof value === "number") return value;
  const range = rangeOf(value);
  return range ? 0.5 * (range[0] + range[1]) : absent;
}

/** What a case says, or the default of the case file where it says nothing; ranges at their middle. */
export interface Shape {
  readonly halfPalm: number;
  readonly links: readonly number[];
  readonly thickness: number;
  readonly open: number;
  /** Angle of the distal joint in the open hand (degrees): coupled joints may begin bent. */
  readonly bend: number;
  readonly radius: number | null;
  readonly vertices: readonly Point[];
  readonly at: Point;
  readonly theta: number;
  readonly wall: number | null;
}

/** The dimensions that are drawn. */
export function shapeOf(file: CaseFile): Shape {
  const { hand, object, start, support, behaviour } = file;
  const coupled = behaviour?.name === "close_coupled" && hand.finger_links_mm.length === 2;
  return {
    halfPalm: 0.5 * middle(hand.palm_width_mm, 0),
    links: hand.finger_links_mm.map((each) => middle(each, 0)),
    thickness: middle(hand.finger_thickness_mm, 0),
    open: middle(hand.open_deg, 0),
    bend: coupled ? middle(behaviour["bend_deg"] as Quantity | undefined, 0) : 0,
    radius: object.shape === "disk" ? middle(object.radius_mm, 0) : null,
    vertices:
      object.shape === "polygon" ? object.vertices_mm.map(([x, y]) => [middle(x, 0), middle(y, 0)] as const) : [],
    at: [middle(start?.at_mm?.[0], 0), middle(start?.at_mm?.[1], 120)],
    theta: middle(start?.theta_deg, 0),
    wall: support?.wall_mm == null ? null : middle(support.wall_mm, 0),
  };
}
