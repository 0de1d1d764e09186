// Plots that several kinds of results share. Each function returns drawings (SVG) from top to bottom: a key and the plot.
import { axisX, axisY, dot, gridX, gridY, legend, line, plot, rect, ruleX, tip, pointer, areaY } from "@observablehq/plot";
import { categories, colourAt, css, viridis } from "../shared/palette.js";
import { known } from "./format.js";

const kSvg = "http://www.w3.org/2000/svg";
const symbols = ["circle", "square", "triangle", "diamond", "star", "cross", "wye", "times"];
const dashes = ["", "6 3", "2 3", "8 3 2 3", "1 2", "10 4", "4 2", "2 6"];
const outlines = {
  circle: "M5,0A5,5 0 1,1 -5,0A5,5 0 1,1 5,0Z", square: "M-4.4,-4.4H4.4V4.4H-4.4Z", triangle: "M0,-5.5L5,4H-5Z",
  diamond: "M0,-6L4,0L0,6L-4,0Z", star: "M0,-6L1.5,-2H6L2.3,.8L3.7,5L0,2.4L-3.7,5L-2.3,.8L-6,-2H-1.5Z",
  cross: "M-2,-6H2V-2H6V2H2V6H-2V2H-6V-2H-2Z", wye: "M-1.5,6V1L-5.5,-2L-4,-5L0,-2L4,-5L5.5,-2L1.5,1V6Z",
  times: "M-5,-3L-3,-5L0,-2L3,-5L5,-3L2,0L5,3L3,5L0,2L-3,5L-5,3L-2,0Z",
};

export const look = (k, dark) => ({
  colour: categories[dark ? "dark" : "light"][k % 8], symbol: symbols[k % 8], dash: dashes[k % 8],
});

function element(name, attributes, parent) {
  const made = document.createElementNS(kSvg, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  parent?.append(made);
  return made;
}

// Draws names beside their colours, symbols and dashes, in lines that fit `width`.
export function key(names, { width, dark }, lines = true) {
  const svg = element("svg", { width, "font-size": 12, "font-family": "system-ui, Helvetica, Arial, sans-serif",
      fill: "currentColor" });
  const sign = lines ? 36 : 18;
  let x = 4, y = 12;
  names.forEach((name, k) => {
    const { colour, symbol, dash } = look(k, dark), wide = sign + 7 * name.length + 16;
    if (x > 4 && x + wide > width) [x, y] = [4, y + 18];
    const group = element("g", { transform: `translate(${x},${y})` }, svg);
    if (lines) element("path", { d: "M0,0H28", stroke: colour, "stroke-width": 2, "stroke-dasharray": dash }, group);
    element("path", { d: outlines[symbol], fill: colour, transform: `translate(${lines ? 14 : 6},0)` }, group);
    element("text", { x: sign, y: 4 }, group).textContent = name;
    x += wide;
  });
  svg.setAttribute("height", y + 10);
  svg.setAttribute("viewBox", `0 0 ${width} ${y + 10}`);
  return svg;
}

// A line of text above a plot.
export function caption(name, { width }) {
  const svg = element("svg", { width, height: 24, viewBox: `0 0 ${width} 24`, "font-size": 13,
      "font-family": "system-ui, Helvetica, Arial, sans-serif", fill: "currentColor" });
  element("text", { x: 4, y: 17, "font-weight": 600 }, svg).textContent = name;
  return svg;
}

// Returns the colour of a share from 0 to 1. The largest stands out from the page, whether that is light or dark.
export function shade(dark) {
  const colours = dark ? viridis : [...viridis].reverse();
  return (t) => css(colourAt(colours, t).map(Math.round));
}

const scaleKey = (label, { width, dark }, domain = [0, 1], tickFormat = undefined) =>
  legend({ color: { type: "linear", domain, interpolate: shade(dark), label }, width: Math.min(width, 320), label,
      tickFormat, marginLeft: 8, marginRight: 14 });

export const style = { fontSize: "12px", fontFamily: "system-ui, Helvetica, Arial, sans-serif", background: "none" };

// Marks of one series: a line, 95% intervals and dots.
const seriesMarks = ({ name, points }, k, size, { x, y, facet }) => {
  const { colour, symbol, dash } = look(k, size.dark), fx = facet ? { fx: facet } : {};
  const bounded = points.filter(({ lower, upper }) => known(lower) && known(upper));
  return [
    line(points, { x: "x", y: "y", stroke: colour, strokeWidth: 2, strokeDasharray: dash, ...fx }),
    ruleX(bounded, { x: "x", y1: "lower", y2: "upper", stroke: colour, strokeWidth: 1.5, ...fx }),
    dot(points, { x: "x", y: "y", fill: colour, symbol, r: 4.5, tip: true, ...fx,
      title: (p) => `${name}\n${x.label}: ${p.x}\n${y.label}: ${p.text ?? p.y}`, }),
  ];
};

// Draws `series`, each with a name and points {x, y, lower, upper, text}. `options` has the scales x and y and, for several
// plots beside each other, `facet`, the name of a member of the points, and `facets`, its values.
export function seriesPlot(series, size, options) {
  const { x, y, facet, facets, height = 360 } = options, [scale, axis] = axisOf(x);
  const drawing = plot({
    width: size.width, height, style, marginLeft: 62, marginBottom: 42, marginRight: 20,
    x: scale, y: { grid: true, nice: true, ...y }, fx: { label: null, padding: 0.08, domain: facets },
    marks: [...axis, ...series.flatMap((one, k) => seriesMarks(one, k, size, { x, y, facet }))],
  });
  return series.length > 1 ? [key(series.map(({ name }) => name), size), drawing] : [drawing];
}

// A logarithmic scale with ticks at the values themselves.
export const ticksAt = (values) => ({ type: "log", ticks: [...new Set(values)].sort((a, b) => a - b) });

// A logarithmic scale with ticks at 1, 2 and 5 times the powers of ten.
export function decades(values) {
  const [least, most] = [Math.min(...values) / 1.15, Math.max(...values) * 1.15], ticks = [];
  for (let power = Math.floor(Math.log10(least)); power <= Math.log10(most); ++power)
    ticks.push(...[1, 2, 5].map((digit) => digit * 10 ** power).filter((tick) => tick >= least && tick <= most));
  return { type: "log", domain: [least, most], ticks };
}

// Returns [scale, marks of its axis]. Observable Plot leaves out labels of logarithmic scales, so their ticks are marks.
const axisOf = ({ ticks, ...x }) => (x.type === "log" && ticks
  ? [{ ...x, axis: null }, [gridX(ticks), axisX(ticks,
      { text: (v) => v.toLocaleString("en", { maximumSignificantDigits: 4 }), label: x.label })]]
  : [{ grid: x.type !== "point", ...x }, []]);

// Draws a line through points {x, y, lower, upper, text}, with a band from `lower` to `upper` where they are known.
export function coursePlot(points, size, { x, y, step = false, height = 280 }) {
  const { colour } = look(0, size.dark), curve = step ? "step-after" : "linear";
  return [plot({
    width: size.width, height, style, marginLeft: 62, marginBottom: 42, marginRight: 20,
    x: { grid: true, ...x }, y: { grid: true, ...y },
    marks: [
      areaY(points.filter(({ lower }) => known(lower)),
        { x: "x", y1: "lower", y2: "upper", fill: colour, fillOpacity: 0.2, curve }),
      line(points, { x: "x", y: "y", stroke: colour, strokeWidth: 1.8, curve }),
      tip(points, pointer({ x: "x", y: "y", title: (p) => `${x.label}: ${p.x}\n${y.label}: ${p.text ?? p.y}` })),
    ],
  })];
}

// Draws a map of pairs {i, j, value, text} with 0 <= value <= 1 over elements with names.
export function pairMap(pairs, names, size, { label, axis, tickFormat }) {
  const longest = Math.max(4, ...names.map((name) => name.length)), margin = Math.min(150, 24 + 6 * longest);
  const side = Math.min(size.width, 416 + margin), inner = side - margin - 16;
  const step = Math.max(1, Math.ceil(names.length * 13 / inner));
  const ticks = names.map((_, k) => k).filter((k) => k % step === 0);
  const both = pairs.length > 6000 ? pairs : pairs.flatMap((pair) => [pair, { ...pair, i: pair.j, j: pair.i }]);
  const half = Math.max(0.5, 0.8 * names.length / inner);  // small pairs are drawn a little larger, to be seen
  const domain = [-0.5, names.length - 0.5], tickName = (k) => names[k];
  return [scaleKey(label, { ...size, width: side }, [0, 1], tickFormat), plot({
    width: side, height: side, style, marginLeft: margin, marginBottom: margin, marginTop: 22, marginRight: 16,
    x: { domain, label: axis }, y: { domain, label: axis },
    color: { type: "linear", domain: [0, 1], interpolate: shade(size.dark) },
    marks: [
      gridX(ticks, { strokeOpacity: 0.08 }), gridY(ticks, { strokeOpacity: 0.08 }),
      axisX(ticks, { tickFormat: tickName, tickRotate: -90, label: axis, labelOffset: margin - 8, fontSize: 10 }),
      axisY(ticks, { tickFormat: tickName, label: axis, fontSize: 10 }),
      rect(both, { x1: (p) => p.i - half, x2: (p) => p.i + half, y1: (p) => p.j - half, y2: (p) => p.j + half, fill: "value",
          shapeRendering: "crispEdges" }),
      tip(both, pointer({ x: "i", y: "j", title: (p) => `${names[p.i]}, ${names[p.j]}\n${p.text}`, maxRadius: 12 })),
    ],
  })];
}

// Draws a dot for each row, {name, group, value, lower, upper, text}. The axis is logarithmic if values differ by more than 30
// times.
export function dotRows(rows, size, { x, groups = [], height = null, left = 150 }) {
  const names = [...new Set(rows.map(({ name }) => name))];
  const values = rows.flatMap(({ value, lower, upper }) => [value, lower, upper]).filter((value) => value > 0);
  const far = values.length > 0 && Math.max(...values) > 30 * Math.min(...values);
  const kind = (row) => Math.max(0, groups.indexOf(row.group));
  const shown = far ? rows.filter(({ value }) => value > 0) : rows;
  const [scale, axis] = axisOf({ ...(far ? decades(values) : { zero: true }), ...x });
  const drawing = plot({
    width: size.width, height: height ?? 70 + 26 * names.length, style, marginLeft: Math.min(left, size.width * 0.42),
    marginBottom: 42, marginRight: 30,
    x: scale,
    y: { type: "point", domain: names, label: null, tickSize: 0, grid: true },
    marks: [...axis, ...Array.from({ length: Math.max(1, groups.length) },
        (_, k) => rowMarks(shown.filter((row) => kind(row) === k), k, size)).flat()],
  });
  return groups.length > 1 ? [key(groups, size, false), drawing] : [drawing];
}

const rowMarks = (rows, k, size) => {
  const { colour, symbol } = look(k, size.dark);
  const bounded = rows.filter(({ lower }) => known(lower));
  return [
    line(bounded.flatMap((row) => [{ ...row, at: row.lower }, { ...row, at: row.upper }]),
      { x: "at", y: "name", z: "name", stroke: colour, strokeWidth: 2 }),
    dot(rows, { x: "value", y: "name", fill: colour, symbol, r: 5, tip: true, title: (row) => `${row.name}\n${row.text}` }),
  ];
};

export { axisOf, dot, plot };
