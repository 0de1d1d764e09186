// The page of kds collide: which beads collide, in which frames, and which method is the fastest.
import { known, num, percent, plural, seconds } from "../format.js";
import { coursePlot, dotRows, pairMap } from "../plots.js";
import { dataOf, filesOf, lengthName, lengthText, radiiText } from "../result.js";
import { column } from "../table_text.js";

export function collide(result) {
  const { rows, course, input } = result, looked = input.frames;
  const fewest = rows[0], fastest = rows.reduce((a, b) => (b.seconds < a.seconds ? b : a), rows[0]);
  const agree = rows.every(({ pairs }) => pairs === fewest.pairs);
  const distance = Number(result.settings.within);
  const within = distance > 0 ? ` within ${lengthText(distance, input)} of each other` : "";
  const meets = within ? `come${within}` : "collide";
  const bead = (row, end) => result.names[row[end]] ?? `bead ${row[end]}`;
  const most = Math.max(0, ...course.map(({ pairs }) => pairs)), alone = course.length === looked;
  const answer = fewest.pairs === 0 ? `No two beads ${meets} in any of the ${plural(looked, "frame")}.`
    : `Beads ${meets} in ${num(fewest.colliding_frames)} of ${plural(looked, "frame")} ` +
      `(${percent(fewest.colliding_frames / looked)}), ${num(fewest.pairs / looked)} pairs per frame on average and at ` +
      `most ${num(most)}.`;
  const { closest } = fewest;
  const perFrame = (value) => 1e6 * value / looked;
  const times = rows.map((row) => ({ ...row, name: row.method, value: perFrame(row.seconds), lower: perFrame(row.seconds_least),
    upper: perFrame(row.seconds_most), text: `${num(perFrame(row.seconds))} µs per frame ` +
      `(${num(perFrame(row.seconds_least))} to ${num(perFrame(row.seconds_most))})` }));
  const timed = course.some(({ picoseconds }) => known(picoseconds)), axis = timed ? "time (ps)" : "frame";
  const points = course.map((row) => ({ ...row, x: timed ? row.picoseconds : row.frame, y: row.pairs }));
  const frameColumns = [column("frame", alone ? "frame" : "from frame"),
    ...(timed ? [column("picoseconds", "time, ps")] : []), column("pairs", alone ? "pairs" : "pairs, at most"),
    column("i", "first", { value: ({ closest: c }) => (c ? bead(c, "i") : null) }),
    column("j", "second", { value: ({ closest: c }) => (c ? bead(c, "j") : null) }),
    column("distance", lengthName("distance of surfaces", input), { value: ({ closest: c }) => c?.distance ?? null })];
  const methodColumns = [column("method"), column("value", "µs per frame (range of rounds)",
      { key: "microseconds_per_frame", lower: (row) => row.lower, upper: (row) => row.upper }),
    column("pairs"), column("colliding_frames", "frames with collisions"),
    column("family", "pairs of spheres that prove the rest disjoint"),
    column("closest_seconds", "time to the closest pair", { write: seconds })];
  return {
    title: `Collisions in ${filesOf(result).join(", ")}`, answer,
    holds: `Holds for ${dataOf(result)}, radii of ${radiiText(input)}, pairs at least ${result.settings.apart} apart along a ` +
      "chain. Every pair was counted, so counts have no interval.",
    more: [
      closest ? `The closest pair of all frames is ${bead(closest, "i")} and ${bead(closest, "j")} in frame ` +
        `${num(closest.frame)}: their surfaces ${closest.distance < 0 ? `overlap by ${lengthText(-closest.distance, input)}`
          : `are ${lengthText(closest.distance, input)} apart`}.` : null,
      rows.length > 1 ? `Method ${fastest.method} is the fastest with ` +
        `${times.find(({ method }) => method === fastest.method).text}; ` +
        `${agree ? `all ${rows.length} methods find the same pairs` : "the methods find different pairs"}.` : null,
    ].filter(Boolean),
    notes: agree ? [] : ["The methods found different numbers of pairs. This is an error of kds."],
    first: points.length > 1 ? { title: "Colliding pairs over time",
      note: alone ? "" : "Each point shows the most pairs of several frames.",
      draw: (size) => coursePlot(points, size,
        { x: { label: axis }, y: { label: "colliding pairs", zero: true }, height: 320 }), columns: frameColumns,
      rows: points } : null,
    sections: [map(result), rows.length > 1 && { heading: "Methods",
        parts: [{ title: "Time by method", note: "Lines reach from the least to the most of the rounds.",
      draw: (size) => dotRows(times, size, { x: { label: "time per frame (µs)" }, left: 90 }), columns: methodColumns,
      rows: times }] },
    { heading: "Tables", parts: [{ title: "Methods", columns: methodColumns, rows: times },
        points.length > 0 && { title: "Frames", columns: frameColumns, rows: points }] }].filter(Boolean),
  };
}

// Returns the section with the map of colliding beads, in groups of neighbouring beads if there are many, or null.
function map({ map: { beads_in_group: size, groups }, input }) {
  if (groups.length === 0) return null;
  const count = Math.ceil(input.beads / size), most = Math.max(...groups.map(({ pairs }) => pairs));
  const names = Array.from({ length: count }, (_, k) => String(k * size));
  const range = (k) => (size === 1 ? names[k] : `${names[k]} to ${Math.min(input.beads, (k + 1) * size) - 1}`);
  const label = size === 1 ? "share of frames in which the pair collides" : "collisions, relative to the most of two groups";
  const rows = groups.map((pair) => ({ ...pair, first: range(pair.i), second: range(pair.j),
      value: pair.pairs / (size === 1 ? input.frames : most),
    text: `${plural(pair.pairs, "collision")} in ${plural(input.frames, "frame")}` }));
  return { heading: "Where beads collide", parts: [{
    title: size === 1 ? "Map of colliding beads" : `Map of collisions, in groups of ${size} beads`,
    draw: (place) => pairMap(rows, names, place, { label, axis: size === 1 ? "bead" : `first of ${size} beads`, tickFormat: "%" }),
    columns: [column("first"), column("second"), column("pairs", "collisions")], rows }] };
}
