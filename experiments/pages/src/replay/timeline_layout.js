// Computes the places of stacked bars, single events and ticks on the timeline. Draws nothing.
import { countWhile } from "./events.js";

// The part of the time that is shown, in steps, and the width in pixels that shows it.
export class Window {
  constructor(from, to, width) {
    this.from = from;
    this.to = to;
    this.width = width;
  }

  x(time) {
    return ((time - this.from) / (this.to - this.from)) * this.width;
  }

  time(x) {
    return this.from + (x / this.width) * (this.to - this.from);
  }
}

// Returns [from, to] after a zoom that keeps `fixed` in place, within 0..end.
export function zoomed([from, to], factor, fixed, end) {
  const span = Math.min(end, Math.max(1e-9 * Math.max(1, end), (to - from) * factor));
  return moved([fixed - ((fixed - from) / (to - from)) * span, 0], span, end);
}

// Returns the range of length `span` that starts at `from`, or as near as fits within 0..end.
export function moved([from], span, end) {
  const start = Math.min(Math.max(0, from), end - span);
  return [start, start + span];
}

export const binWidth = 4;  // pixels
const sparse = 7;           // pixels: events that stand singly are at least so far apart, on average

// Lays out those events of one structure that are in `list`, ascending. Returns {single: true, marks: [{x, event, kind}]}, or
// {single: false, bins: [{x, first, last, counts}], most} with the number of events by kind in each bin.
export function layoutEvents(events, list, window) {
  const before = (time) => countWhile(list.length, (k) => events.time[list[k]] < time);
  const first = before(window.from);
  const last = Math.max(first, before(window.to + 1e-12));
  if ((last - first) * sparse <= window.width) {
    const marks = [];
    for (const e of list.subarray(first, last)) marks.push({ x: window.x(events.time[e]), event: e, kind: events.kind[e] });
    return { single: true, marks };
  }
  const bins = [];
  let most = 0;
  const count = Math.ceil(window.width / binWidth);
  let e = first;
  for (let b = 0; b < count; ++b) {
    const end = b === count - 1 ? last : Math.min(last, before(window.time((b + 1) * binWidth)));
    if (end <= e) continue;
    const counts = new Uint32Array(events.kinds.length);
    for (let k = e; k < end; ++k) ++counts[events.kind[list[k]]];
    bins.push({ x: b * binWidth, first: e, last: end, counts });
    most = Math.max(most, end - e);
    e = end;
  }
  return { single: false, bins, most };
}

// Returns the event of `list` nearest to x, if it is at most `reach` pixels away, or -1.
export function eventNear(events, list, window, x, reach) {
  const time = window.time(x);
  const after = countWhile(list.length, (k) => events.time[list[k]] < time);
  let best = -1;
  for (const k of [after - 1, after]) {
    if (k < 0 || k >= list.length) continue;
    const e = list[k];
    const away = Math.abs(window.x(events.time[e]) - x);
    if (away <= reach && (best < 0 || away < Math.abs(window.x(events.time[best]) - x))) best = e;
  }
  return best;
}

// Returns the ticks of the axis: round numbers about `gap` pixels apart.
export function axisTicks(window, gap = 90) {
  const rough = ((window.to - window.from) * gap) / window.width;
  const power = 10 ** Math.floor(Math.log10(rough));
  const spacing = [1, 2, 5, 10].map((m) => m * power).find((s) => s >= rough) ?? 10 * power;
  const digits = Math.max(0, Math.min(15, -Math.floor(Math.log10(spacing) + 1e-9)));
  const ticks = [];
  for (let k = Math.ceil(window.from / spacing - 1e-9); k * spacing <= window.to + 1e-9 * spacing; ++k)
    ticks.push({ time: k * spacing, label: (k * spacing).toFixed(digits) });
  return ticks;
}

// Returns the spans of a pair within the window, in pixels: [{x, width, span}].
export function layoutSpans(row, window) {
  return row.spans
    .filter(({ from, to }) => to >= window.from && from <= window.to)
    .map((span) => {
      const x = Math.max(0, window.x(span.from));
      return { x, width: Math.max(1, Math.min(window.width, window.x(span.to)) - x), span };
    });
}
