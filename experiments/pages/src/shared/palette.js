// Colours that both pages use: those of Okabe and Ito, which people with colour blindness tell apart, and a scale.

export const categories = {
  light: ["#0072b2", "#e69f00", "#009e73", "#cc79a7", "#56b4e9", "#d55e00", "#8c8c8c", "#b8a900"],
  dark: ["#4aa3e0", "#f0b429", "#2fc296", "#e09cc2", "#8accf5", "#f07b33", "#a8a8a8", "#e0d042"],
};

// From blue over green to yellow: viridis (van der Walt and Smith 2015) without its dark fifth. Its lightness grows evenly.
export const viridis = ["#414487", "#355f8d", "#2a788e", "#21918c", "#22a884", "#44bf70", "#7ad151", "#bddf26", "#fde725"];

// Returns a colour such as "#0072b2" as [r, g, b], up to 255.
export function rgb(colour) {
  const value = parseInt(colour.slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}

export const css = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;

// Returns the colour at t in 0..1 of a scale of colours, [r, g, b].
export function colourAt(scale, t) {
  const place = Math.min(0.999999, Math.max(0, t)) * (scale.length - 1);
  const k = Math.floor(place);
  const to = rgb(scale[k + 1]);
  return rgb(scale[k]).map((value, c) => value + (to[c] - value) * (place - k));
}
