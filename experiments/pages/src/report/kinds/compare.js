// The page of kds compare: how often each structure changes, by stride, motion and input.
import { baseName, everyFrame, interval, known, list, num, percent, seconds } from "../format.js";
import { seriesPlot, ticksAt } from "../plots.js";
import { distinct } from "../result.js";
import { column, withInterval } from "../table_text.js";

// Rates of a row per picosecond if all inputs have times, otherwise per frame of the file.
function rated(result) {
  const spacing = new Map(result.inputs.map(({ name, frame_picoseconds: ps }) => [name, ps]));
  const timed = result.inputs.every(({ frame_picoseconds: ps }) => ps > 0), unit = timed ? "ps" : "frame";
  const per = (value, row) => (known(value) ? value / (row.stride * (timed ? spacing.get(row.input) : 1)) : null);
  return { unit, rows: result.rows.map((row) => ({ ...row, input: baseName(row.input),
    rate: per(row.events_per_step, row), rate_lower: per(row.events_per_step_lower, row),
    rate_upper: per(row.events_per_step_upper, row) })) };
}

export function compare(result) {
  const { unit, rows } = rated(result);
  const inputs = distinct(rows.map(({ input }) => input)), structures = distinct(rows.map(({ structure }) => structure));
  const motions = distinct(rows.map(({ motion }) => motion)),
    strides = distinct(rows.map(({ stride }) => stride)).sort((a, b) => a - b);
  const find = (structure, input, stride, motion) =>
    rows.find((row) => row.structure === structure && row.input === input && row.stride === stride && row.motion === motion);
  const rate = (row) => interval(row.rate, row.rate_lower, row.rate_upper);
  const claims = structures.map((structure) => {
    const found = inputs.slice(0, 3).map((input) => find(structure, input, strides[0], motions[0])).filter(Boolean);
    const text = found.every(({ events }) => events === 0) ? null
      : list(found.map((row) => `${rate(row)} times${inputs.length > 1 ? ` in ${row.input}` : ""}`));
    return text ? `${structure} changes ${text}` : `${structure} never changes`;
  });
  const more = [];
  const last = strides.at(-1);
  if (strides.length > 1) {
    const falls = structures.flatMap((structure) => {
      const [near, far] = [strides[0], last].map((stride) => find(structure, inputs[0], stride, motions[0]));
      return near?.rate > 0 && far ? [`${percent(far.rate / near.rate)} of the changes of ${structure}`] : [];
    });
    if (falls.length > 0) more.push(`With ${everyFrame(last)}, a run sees ${list(falls)} that it sees with ` +
      `${everyFrame(strides[0])}${inputs.length > 1 ? ` in ${inputs[0]}` : ""}.`);
  }
  const names = structures.flatMap((structure) =>
    motions.map((motion) => ({ structure, motion, name: motions.length > 1 ? `${structure}, ${motion}` : structure })));
  const series = names.map(({ structure, motion, name }) =>
    ({ name, points: rows.filter((row) => row.structure === structure && row.motion === motion && row.rate > 0)
    .sort((a, b) => a.stride - b.stride).map((row) =>
      ({ x: row.stride, y: row.rate, lower: row.rate_lower, upper: row.rate_upper, input: row.input, text: rate(row) })) }))
    .filter(({ points }) => points.length > 0);
  // The counts of kinds stand between these two members.
  const kinds = distinct(result.rows.flatMap((row) => {
    const keys = Object.keys(row);
    return keys.slice(keys.indexOf("events") + 1, keys.indexOf("internal"));
  }));
  const columns = [column("structure"), column("input"), column("stride"), column("motion"),
    withInterval("rate", `events per ${unit} (95%)`),
    withInterval("events_per_step", "events per step (95%)"),
    withInterval("events_per_net_change", "events per net change (95%)"),
    column("events"), ...kinds.map((kind) => column(kind)), column("internal"), column("net_changes", "net changes"),
    column("steps")];
  const quality = [column("structure"), column("input"), column("stride"), column("motion"),
    column("efficiency", "all events per external event"),
    column("compactness", "most certificates at once"), column("locality", "most on one bead"),
    column("created_per_event", "created per event"),
    column("touched_per_event", "touched per event"), column("responsiveness", "time per event", { write: seconds }),
    column("responsiveness_worst", "longest time", { write: seconds }),
    column("seconds", "time (range of rounds)",
      { write: seconds, lower: (row) => row.seconds_least, upper: (row) => row.seconds_most })];
  const data = result.inputs.slice(0, 4).map(({ name, beads, frames }) =>
    `${baseName(name)} (${num(beads)} beads, ${num(frames)} frames)`);
  const facet = inputs.length > 1 ? "input" : null;
  return {
    title: `Changes of structures in ${inputs.length > 3 ? `${inputs.length} inputs` : inputs.join(", ")}`,
    answer: `Per ${unit}, ${list(claims)}.`,
    holds: `Holds for ${list(data)}${inputs.length > 4 ? " and others" : ""}, ${everyFrame(strides[0])} and ${motions[0]} motion.`,
    more,
    first: series.length > 0 ? {
      title: `Events per ${unit} by stride`, note: "Bars are 95% intervals" +
        `${rows.some(({ steps }) => steps < 50) ? "; means of fewer than 50 steps have none" : ""}. The y axis is logarithmic.`,
      draw: (size) => (facet && size.width < 600
        ? inputs.slice(0, 6).flatMap((input) => one(series, size, unit, rows, { input }))
        : one(series, size, unit, rows, { facet, facets: inputs })),
      columns, rows,
    } : null,
    sections: [{ heading: "Tables", parts: [{ title: "Events", columns, rows },
        { title: "Quality and times", columns: quality, rows },
      result.pooled?.length > 0 && { title: "Means over the inputs", rows: result.pooled,
        note: "Student's 95% intervals over inputs, for inputs that are a sample of one kind.",
        columns: [column("structure"), column("stride"), column("motion"), column("inputs"),
          withInterval("events_per_step", "events per step (95%)"),
          withInterval("events_per_bead_step", "events per bead and step (95%)"),
          withInterval("events_per_net_change", "events per net change (95%)")] }] }],
  };
}

const one = (series, size, unit, rows, { facet, facets, input = null }) => seriesPlot(
  series.map(({ name, points }) => ({ name, points: input ? points.filter((point) => point.input === input) : points })), size,
  { facet, facets, x: { ...ticksAt(rows.map(({ stride }) => stride)), label: `stride (frames)${input ? `, ${input}` : ""}` },
    y: { type: "log", label: `events per ${unit}` } });
