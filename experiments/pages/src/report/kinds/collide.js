// The page of kds collide: which beads collide, in which frames, and which method is the fastest.
import { num, percent, plural, seconds } from "../format.js";
import { coursePlot, dotRows } from "../plots.js";
import { dataOf, filesOf } from "../result.js";
import { column } from "../table_text.js";

export function collide(result) {
  const { rows, frames = [], input } = result, looked = input.frames;
  const fewest = rows[0], fastest = rows.reduce((a, b) => (b.seconds < a.seconds ? b : a), rows[0]);
  const agree = rows.every(({ pairs }) => pairs === fewest.pairs);
  const within = Number(result.settings.within) > 0 ? ` within ${num(Number(result.settings.within))} A of each other` : "";
  const meets = within ? `come${within}` : "collide";
  const bead = (row, end) => row[`name_${end}`] ?? `bead ${row[end]}`;
  const most = frames.reduce((a, b) => (b.pairs > a.pairs ? b : a), frames[0] ?? { pairs: 0, frame: 0 });
  const answer = fewest.pairs === 0 ? `No two beads ${meets} in any of the ${plural(looked, "frame")}.`
    : `Beads ${meets} in ${num(fewest.colliding_frames)} of ${plural(looked, "frame")} (${percent(fewest.colliding_frames / looked)}), ${num(fewest.pairs / looked)} pairs per frame on average and at most ${num(most.pairs)} (frame ${num(most.frame)}).`;
  const { closest } = fewest;
  const perFrame = (value) => 1e6 * value / looked;
  const times = rows.map((row) => ({ ...row, name: row.method, value: perFrame(row.seconds), lower: row.seconds_least === undefined ? null : perFrame(row.seconds_least),
    upper: row.seconds_most === undefined ? null : perFrame(row.seconds_most), text: `${num(perFrame(row.seconds))} µs per frame (${num(perFrame(row.seconds_least))} to ${num(perFrame(row.seconds_most))})` }));
  const points = frames.map((row) => ({ ...row, x: row.picoseconds ?? row.frame, y: row.pairs })), axis = frames[0]?.picoseconds === undefined ? "frame" : "time (ps)";
  const frameColumns = [column("frame"), ...(axis === "frame" ? [] : [column("picoseconds", "time, ps")]), column("collide", "collide"), column("pairs"),
    column("i", "first", { value: ({ closest: c }) => (c ? bead(c, "i") : null) }), column("j", "second", { value: ({ closest: c }) => (c ? bead(c, "j") : null) }),
    column("distance", "distance of surfaces, A", { value: ({ closest: c }) => c?.distance ?? null })];
  const methodColumns = [column("method"), column("value", "µs per frame (range of rounds)", { key: "microseconds_per_frame", lower: (row) => row.lower, upper: (row) => row.upper }),
    column("pairs"), column("colliding_frames", "frames with collisions"), column("family", "pairs of spheres that prove the rest disjoint"), column("closest_seconds", "time to the closest pair", { write: seconds })];
  return {
    title: `Collisions in ${filesOf(result).join(", ")}`, answer,
    holds: `Holds for ${dataOf(result)}, radii of ${num(input.radius_min)}${input.radius_max > input.radius_min ? ` to ${num(input.radius_max)}` : ""} A, pairs at least ${result.settings.apart} apart along a chain. Every pair was counted, so that the counts have no interval.`,
    more: [
      closest ? `The closest pair of all frames is ${bead(closest, "i")} and ${bead(closest, "j")} in frame ${num(closest.frame)}: ${closest.distance < 0 ? `their surfaces overlap by ${num(-closest.distance)} A` : `their surfaces are ${num(closest.distance)} A apart`}.` : null,
      rows.length > 1 ? `Method ${fastest.method} is the fastest with ${times.find(({ method }) => method === fastest.method).text}; ${agree ? `all ${rows.length} methods find the same pairs` : "the methods DIFFER"}.` : null,
    ].filter(Boolean),
    notes: agree ? [] : ["The methods found different numbers of pairs. This is an error of kds."],
    first: points.length > 1 ? { title: "Colliding pairs over time",
      draw: (size) => coursePlot(points, size, { x: { label: axis }, y: { label: "colliding pairs", zero: true }, height: 320 }), columns: frameColumns, rows: points } : null,
    sections: [rows.length > 1 && { heading: "Methods", parts: [{ title: "Time by method", note: "Lines reach from the least to the most of the rounds.",
      draw: (size) => dotRows(times, size, { x: { label: "time per frame (µs)" }, left: 90 }), columns: methodColumns, rows: times }] },
    { heading: "Tables", parts: [{ title: "Methods", columns: methodColumns, rows: times }, points.length > 0 && { title: "Frames", columns: frameColumns, rows: points }] }].filter(Boolean),
  };
}
