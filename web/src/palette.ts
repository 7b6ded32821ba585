// Colours that colour-blind readers tell apart: Okabe and Ito's, and a scale of even lightness.

export const COLOURS: Record<string, string> = {
  arm: "#0072B2",
  rod: "#A0672E",
  line: "#5b6470",
  float: "#D55E00",
  goal: "#009E73",
  ghost: "#CC79A7",
  water: "#bfe3f2",
  table: "#eef3f6",
  dark: "#3b434d",
};

const ALONE = ["#8a939e", "#b6bdc6", "#6a737d"];
const ASKING = ["#E69F00", "#56B4E9", "#CC79A7", "#0072B2", "#F0E442", "#D55E00"];

/** A colour for each mode: greys for those without a teacher. */
export function modeColours(modes: string[]): Record<string, string> {
  const colours: Record<string, string> = {};
  let alone = 0;
  let asking = 0;
  for (const mode of modes) {
    if (mode.includes(" ")) colours[mode] = ASKING[asking++ % ASKING.length];
    else colours[mode] = ALONE[alone++ % ALONE.length];
  }
  return colours;
}

export const KINDS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"];

// Viridis at nine places, and a pale scale for regions behind points.
const VIRIDIS = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141],
  [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37],
];
const PALE = [[252, 252, 251], [254, 244, 224], [253, 228, 184], [250, 205, 137]];

function along(scale: number[][], share: number): string {
  const place = Math.min(Math.max(share, 0), 1) * (scale.length - 1);
  const low = Math.min(Math.floor(place), scale.length - 2);
  const rest = place - low;
  const mixed = scale[low].map((x, i) => Math.round(x + rest * (scale[low + 1][i] - x)));
  return `rgb(${mixed.join(",")})`;
}

/** From early to late. */
export const timeColour = (share: number): string => along(VIRIDIS, share);

/** From dull to interesting. */
export const interestColour = (share: number): string => along(PALE, share);
