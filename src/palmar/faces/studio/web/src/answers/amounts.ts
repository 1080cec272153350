/** SI amounts in the words of the command line's texts: millimetres, square centimetres, degrees. */

const minus = (text: string): string => text.replace(/^-/, "−");
export const digits = (value: number, most: number): string => minus(String(Number(value.toPrecision(most))));
export const fixed = (value: number, places: number): string =>
  minus((Number(value.toFixed(places)) + 0).toFixed(places));

/** Metres as millimetres with a decimal. */
export const millimetres = (metres: number): string => `${fixed(1000 * metres, 1)} mm`;
/** Square metres as square centimetres, or square metres where that is too large to read. */
export const area = (squareMetres: number): string =>
  squareMetres >= 100 ? `${digits(squareMetres, 4)} m²` : `${digits(1e4 * squareMetres, 4)} cm²`;
/** A place (m) in millimetres. */
export const place = ([x, y]: readonly [number, number]): string => `(${fixed(1000 * x, 1)}, ${fixed(1000 * y, 1)}) mm`;
/** Radians as degrees. */
export const degrees = (radians: number): string => `${fixed((radians * 180) / Math.PI, 2)}°`;
/** Ends (m) of an interval of lengths; no upper end means however large. */
export const span = (low: number | null, high: number | null): string =>
  high === null ? `${millimetres(low ?? 0)} or more` : `${fixed(1000 * (low ?? 0), 1)} to ${millimetres(high)}`;
