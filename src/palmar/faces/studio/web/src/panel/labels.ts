/** What keys of the case file are called in the panel, and how sliders move over them. */

export interface Look {
  readonly label: string;
  readonly step: number;
  readonly low?: number;
  readonly high?: number;
}

/** By `section.key`; the units come from the server. */
export const LOOKS: Readonly<Record<string, Look>> = {
  "hand.palm_width_mm": { label: "Palm width", step: 1 },
  "hand.finger_thickness_mm": { label: "Finger thickness", step: 0.5 },
  "hand.open_deg": { label: "Opening angle", step: 1, low: 0, high: 179 },
  "hand.finger_rate_deg_s": { label: "Closing rate", step: 1 },
  "hand.finger_mass_kg": { label: "Mass of a finger", step: 0.01 },
  "hand.finger_torque_N_m": { label: "Largest motor torque", step: 0.01 },
  "object.radius_mm": { label: "Radius", step: 1 },
  "object.mass_kg": { label: "Mass", step: 0.1 },
  "contact.friction": { label: "Friction of the fingers", step: 0.01, low: 0, high: 2 },
  "contact.restitution": { label: "Restitution", step: 0.01, low: 0, high: 1 },
  "support.friction": { label: "Friction of the table", step: 0.01, low: 0, high: 2 },
  "support.wall_mm": { label: "Wall ahead", step: 1 },
  "start.theta_deg": { label: "Orientation", step: 1, low: -180, high: 180 },
  "behaviour.direction_deg": { label: "Direction", step: 1, low: -180, high: 180 },
  "behaviour.bend_deg": { label: "Bend of the open hand", step: 1, low: -179, high: 179 },
  "behaviour.preshape_deg": { label: "Preshape angle", step: 1, low: 0, high: 179 },
  "behaviour.ratio": { label: "Rate of the distal joints", step: 0.05, low: -3, high: 3 },
  "behaviour.delay_s": { label: "Delay", step: 0.05 },
  "behaviour.limp_s": { label: "Let go for", step: 0.05 },
  "behaviour.trigger_N": { label: "Trigger", step: 0.1 },
  "behaviour.grip_N_m": { label: "Grip", step: 0.01 },
  "behaviour.gain": { label: "Gain", step: 0.1 },
  "sensors.displacement_mm": { label: "Movement until felt", step: 0.5 },
  "sensors.pose_error_mm": { label: "Pose error of the hand", step: 0.5 },
};

/** A readable name of a key: "touch_rate_deg_s" -> "Touch rate". */
export function readable(key: string): string {
  const bare = key.replace(/_(mm|deg|kg|s|N|N_m|N_mm|mm_s|deg_s|mm_s2|deg_s2)$/, "").replaceAll("_", " ");
  return bare.charAt(0).toUpperCase() + bare.slice(1);
}

const PRINTED: Readonly<Record<string, string>> = {
  deg: "°",
  "deg/s": "°/s",
  "deg/s^2": "°/s²",
  "mm/s^2": "mm/s²",
  "N m": "N m",
};

/** The unit as printed, from the server's or from the key's suffix. */
export function unitOf(key: string, given: string | null | undefined): string {
  const suffix = /_(mm_s2|deg_s2|mm_s|deg_s|N_mm|N_m|mm|deg|kg|s|N)$/.exec(key)?.[1] ?? "";
  const plain =
    { mm_s2: "mm/s²", deg_s2: "°/s²", mm_s: "mm/s", deg_s: "°/s", N_mm: "N/mm", N_m: "N m", deg: "°" }[suffix] ??
    suffix;
  return given ? (PRINTED[given] ?? given) : plain;
}
