/** The address's fragment: which tab is open, and the whole case. A reload, or the receiver of a link, has both again. */

import type { CaseFile } from "./case_file";

export interface Place {
  readonly tab: string | null;
  readonly file: CaseFile | null;
}

/** `#tab=…&case=…`; the case as JSON in URL-safe base 64. */
export function fragmentOf(tab: string, file: CaseFile): string {
  return `#tab=${tab}&case=${encoded(JSON.stringify(file))}`;
}

/** What a fragment holds; a damaged case is none. */
export function readFragment(fragment: string): Place {
  const fields = new URLSearchParams(fragment.replace(/^#/, ""));
  const text = fields.get("case");
  return { tab: fields.get("tab"), file: text === null ? null : readCase(text) };
}

function readCase(text: string): CaseFile | null {
  try {
    const found: unknown = JSON.parse(decoded(text));
    return isCase(found) ? found : null;
  } catch {
    return null;
  }
}

/** Whether what came from outside has what the drawing needs; the server checks the rest. */
export function isCase(found: unknown): found is CaseFile {
  const { hand, object } = (found ?? {}) as { hand?: Record<string, unknown>; object?: Record<string, unknown> };
  if (!hand || !object || !isQuantity(hand["palm_width_mm"])) return false;
  const links = hand["finger_links_mm"];
  if (!Array.isArray(links) || links.length === 0 || !links.every(isQuantity)) return false;
  if (object["shape"] === "disk") return isQuantity(object["radius_mm"]);
  const corners = object["vertices_mm"];
  return object["shape"] === "polygon" && Array.isArray(corners) && corners.length > 2 && corners.every(isCorner);
}

const isQuantity = (value: unknown): boolean => typeof value === "number" || typeof value === "string";
const isCorner = (value: unknown): boolean => Array.isArray(value) && value.length === 2 && value.every(isQuantity);

function encoded(text: string): string {
  const bytes = new TextEncoder().encode(text);
  return btoa(String.fromCharCode(...bytes))
    .replaceAll("+", "-")
    .replaceAll("/", "_")
    .replace(/=+$/, "");
}

function decoded(text: string): string {
  const bytes = Uint8Array.from(atob(text.replaceAll("-", "+").replaceAll("_", "/")), (each) => each.charCodeAt(0));
  return new TextDecoder().decode(bytes);
}
