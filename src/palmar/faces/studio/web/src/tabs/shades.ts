/** Shades of the closure map: cividis, which reads alike with and without colour deficiencies, in even steps. */

export const SHADES: readonly string[] = [
  "#002656",
  "#002e6a",
  "#0c3470",
  "#233c6e",
  "#32436d",
  "#3d4a6c",
  "#48526c",
  "#535a6d",
  "#5c616e",
  "#656870",
  "#6f7073",
  "#777777",
  "#817f78",
  "#8c8878",
  "#958f77",
  "#a09875",
  "#aba072",
  "#b6a96f",
  "#c1b26a",
  "#cdbb63",
  "#d7c45c",
  "#e4ce53",
  "#f0d846",
  "#fce236",
];

/** Index of the shade of a value between 0 and `largest`. */
export const shadeOf = (value: number, largest: number): number =>
  Math.min(Math.max(Math.floor((value / largest) * SHADES.length), 0), SHADES.length - 1);
