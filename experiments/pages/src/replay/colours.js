// Colours. Kinds of events and layers have the colours of Okabe and Ito, which people with colour blindness tell apart.
// Edges that go are dashed too, because no meaning may depend on colour alone.
import { colourAt, viridis } from "../shared/palette.js";

const themes = {
  light: {
    page: "#ffffff", fog: "#ffffff", chain: "#6b7784", edges: "#64748b", contacts: "#e69f00",
    goes: "#d1350f", comes: "#008a5e", glow: "#7b2fd0", chosen: "#0072b2", cage: "#0072b2", boxes: "#d55e00",
    spheres: "#009e73", box: "#b0508f", hull: "#009e73", closest: "#b3245b", links: "#2f7da8",
    triangles: "#56b4e9", voids: "#cc79a7", axis: "#5b6673", grid: "#d9dee4",
  },
  dark: {
    page: "#14181d", fog: "#14181d", chain: "#aab4bf", edges: "#8a99ab", contacts: "#f0b429",
    goes: "#ff6a45", comes: "#35d39f", glow: "#ffe066", chosen: "#6ac1ff", cage: "#6ac1ff", boxes: "#f07b33",
    spheres: "#2fc296", box: "#e09cc2", hull: "#2fc296", closest: "#ff7fa8", links: "#8accf5",
    triangles: "#4aa3e0", voids: "#e09cc2", axis: "#9aa5b1", grid: "#313a44",
  },
};

// Places of kinds of events in a list of 8 colours. Components, tunnels and voids share no colour.
const placesOfVoids = {
  component_begin: 7, component_split: 7, component_end: 6, component_merge: 6, tunnel_begin: 1, tunnel_end: 4,
  void_begin: 2, void_split: 2, cell_begin: 2, void_end: 3, void_merge: 3, cell_end: 3, void_open: 5, void_close: 0,
};
export const colourOfKind = (structure, kind, k) => (structure === "voids" ? placesOfVoids[kind] : undefined) ?? k % 8;

export const theme = (name) => themes[name];

// Returns the colour at t in 0..1 along the chain, [r, g, b] up to 255. Its dark end is lighter on dark pages.
export function alongChain(t, dark) {
  const lighter = (value, c) => value + ([110, 150, 200][c] - value) * 0.45 * (1 - t);
  return colourAt(viridis, t).map((value, c) => Math.round(dark ? lighter(value, c) : value));
}
