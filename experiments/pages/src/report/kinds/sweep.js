// The page of kds sweep collect: results of each input by each axis. Nothing is pooled but seeds.
import { baseName, capital, interval, known, list, num, plural } from "../format.js";
import { caption, seriesPlot, ticksAt } from "../plots.js";
import { distinct } from "../result.js";
import { column } from "../table_text.js";

const leading = { run: "events per step", contacts: "residence", missed: "missed_fraction", compare: "events_per_step",
  collide: "pairs" };
const words = { residence: "mean life of a contact", missed_fraction: "share of contacts missed", "events.total": "events",
  events_per_step: "events per step" };
const identity = new Set(["structure", "technique", "method", "want", "setting", "factor", "cutoff", "stride", "condition"]);
const kMostInputs = 8;

// The lists of a sweep that the page may cut, and the files that have all of their lines.
const tableNames = { rows: "results", means: "means", failed: "failures", warned: "warnings" };
const fileOf = { rows: "results.csv", means: "pooled.csv", failed: "failed.csv", warned: "warnings.csv" };

const isNumber = (value) => value !== null && value !== "" && Number.isFinite(Number(value));

// 97.5% quantiles of Student's distribution for 2 to 30 degrees of freedom.
const student = [4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201, 2.179, 2.16, 2.145, 2.131, 2.12, 2.11,
  2.101, 2.093, 2.086, 2.08, 2.074, 2.069, 2.064, 2.06, 2.056, 2.052, 2.048, 2.045, 2.042];

export function meanOf(values) {
  const n = values.length, mean = values.reduce((sum, v) => sum + v, 0) / n;
  if (n < 3) return { y: mean, lower: null, upper: null };
  const half = (student[n - 3] ?? 1.96) * Math.sqrt(values.reduce((sum, v) => sum + (v - mean) ** 2, 0) / (n - 1) / n);
  return { y: mean, lower: mean - half, upper: mean + half };
}

// Returns the rows of one command of the sweep, the dimensions in which they differ, and the measures that plots can show.
function viewOf(result, command) {
  const rows = result.rows.filter((row) => row.command === command).map((row) => ({ ...row, input: baseName(row.input),
    ...(row["events.total"] === undefined ? {}
      : { "events per step": row["events.total"] / Math.max(1, row["input.frames"] - 1) }) }));
  const names = distinct(rows.flatMap(Object.keys)), { axes, pooled } = result;
  const varied = (name) => distinct(rows.map((row) => row[name] ?? null)).length > 1;
  const fields = names.filter((name) => !["task", "command", "input"].includes(name) && !axes.includes(name));
  const own = fields.filter((name) => identity.has(name.replace("result.", ""))
    && !axes.some((axis) => axis === `${name}s` && varied(axis)));
  const dimensions = [...axes, ...own].filter(varied).filter((name) => !pooled.includes(name));
  const measures = fields.filter((name) => !own.includes(name)
    && !/_lower$|_upper$|^input\.|_frame$|^engine\.|^stages\./.test(name) && rows.some((row) => typeof row[name] === "number"));
  const numeric = dimensions.filter((name) => rows.every((row) => row[name] === null || row[name] === undefined
      || isNumber(row[name])));
  return { command, rows, dimensions, measures, axis: numeric[0] ?? dimensions[0] ?? "input",
    measure: measures.includes(leading[command]) ? leading[command] : measures[0], numeric };
}

// Series of one input: points by `axis`, one series for each combination of the other dimensions.
function seriesOf(view, input, axis, measure) {
  const rest = view.dimensions.filter((name) => name !== axis), groups = new Map();
  for (const row of view.rows.filter((other) => other.input === input && typeof other[measure] === "number")) {
    const name = rest.map((dimension) => `${dimension} ${row[dimension] ?? "none"}`).join(", ") || measure;
    const x = view.numeric.includes(axis) ? Number(row[axis]) : String(row[axis]);
    if (!groups.has(name)) groups.set(name, new Map());
    groups.get(name).set(x, [...(groups.get(name).get(x) ?? []), row]);
  }
  return [...groups].map(([name, points]) => ({ name, points: [...points].map(([x, rows]) => ({ x, ...(rows.length === 1
    ? { y: rows[0][measure], lower: rows[0][`${measure}_lower`] ?? null, upper: rows[0][`${measure}_upper`] ?? null }
      : meanOf(rows.map((row) => row[measure]))) }))
    .map((point) => ({ ...point, text: interval(point.y, point.lower, point.upper) }))
      .sort((a, b) => (typeof a.x === "number" ? a.x - b.x : a.x.localeCompare(b.x))) }));
}

const unitOf = (view, measure) => (/^(residence|median|total|longest)$/.test(measure) ? ` (${view.rows[0].unit})` : "");

// "Events per step by stride (kds run, motion linear): a.dcd: 9.42 at 1, 10.7 at 2; b.dcd: ..."
function sentenceOf(view) {
  if (view.axis === "input" || !view.measure) return null;
  const inputs = distinct(view.rows.map(({ input }) => input)).slice(0, 3)
    .map((input) => ({ input, one: seriesOf(view, input, view.axis, view.measure)[0] })).filter(({ one }) => one);
  if (inputs.length === 0) return null;
  const { name } = inputs[0].one, measure = words[view.measure] ?? view.measure.replaceAll("_", " ").replaceAll(".", " ");
  const ends = ({ points }) => distinct([points[0], points.at(-1)])
    .map(({ x, text }) => `${text} at ${view.axis} ${x}`).join(", ");
  return `${capital(measure)}${unitOf(view, view.measure)} of kds ${view.command}${name === view.measure ? "" : ` (${name})`}: ` +
    `${inputs.map(({ input, one }) => `${ends(one)} in ${input}`).join("; ")}.`;
}

export function sweep(result) {
  const commands = distinct(result.rows.map(({ command }) => command)),
    views = commands.map((command) => viewOf(result, command));
  const inputs = distinct(result.rows.map(({ input }) => input).filter(known).map(baseName)), left = result.tasks - result.done;
  const state = `${num(result.done)} of ${plural(result.tasks, "task")} ${result.done === 1 ? "has" : "have"} ` +
    `results${left > 0 ? `; ${num(left)} failed or are open` : ""}`;
  const claims = views.map(sentenceOf).filter(Boolean);
  const title = commands.length === 0 ? "Sweep" : `Sweep of ${list(commands.map((command) => `kds ${command}`))}`;
  const holds = inputs.length === 0 ? null : `Holds for ${plural(inputs.length, "input")}, each by itself: ` +
    `${list(inputs.slice(0, 6))}${inputs.length > 6 ? " and others" : ""}.`;
  const listed = (title, rows) => (rows.length > 0
    ? { title, rows, columns: distinct(rows.flatMap(Object.keys)).map((name) => column(name)) } : null);
  const cut = Object.entries(result.left_out).map(([name, count]) =>
    `${plural(count, "more line")} of ${tableNames[name]} ${count === 1 ? "is" : "are"} in ${fileOf[name]}.`);
  const tables = views.map((view) => ({ title: `Results of kds ${view.command}`, rows: view.rows, columns: [column("input"),
    ...distinct([...view.dimensions, view.measure, ...view.measures])
      .map((name) => (view.rows.some((row) => row[`${name}_lower`] !== undefined && row[`${name}_upper`] !== undefined)
      ? column(name, `${name} (95%)`, { lower: (row) => row[`${name}_lower`], upper: (row) => row[`${name}_upper`] })
        : column(name)))] }));
  const pooled = result.means.length > 0 ? { title: `Means over ${list(result.pooled)}`, rows: result.means,
    note: "Student's 95% intervals over the tasks that differ in the pooled axes only.",
    columns: distinct(result.means.flatMap(Object.keys)).filter((name) => name !== "lower" && name !== "upper")
      .map((name) => column(name, name, name === "mean" ? { lower: (row) => row.lower, upper: (row) => row.upper } : {})) }
      : null;
  const figures = views.map((view) => figureOf(view));
  return {
    title, answer: claims[0] ?? `${state}.`, holds, more: [...claims.slice(1, 6), ...(left > 0 ? [] : [`${state}.`])],
    notes: [...(left > 0 ? [`${state}. failed.csv has the reasons.`] : []), ...cut],
    first: figures[0] ?? null,
    sections: [...figures.slice(1).map((figure) => ({ heading: figure.heading, parts: [figure] })),
      { heading: "Tables", parts: [listed("Tasks without a result", result.failed),
        listed("Warnings of tasks", result.warned), ...tables, pooled] }],
  };
}

// Returns a figure with a plot for each input, one below another. The reader chooses the measure and the axis.
function figureOf(view) {
  const axes = view.dimensions.length > 0 ? view.dimensions : ["input"], inputs = distinct(view.rows.map(({ input }) => input));
  const controls = [{ name: "measure", options: view.measures, value: view.measure },
    { name: "axis", options: axes, value: view.axis }].filter(({ options }) => options.length > 1);
  const points = ({ measure = view.measure, axis = view.axis }) =>
    inputs.flatMap((input) => seriesOf(view, input, axis, measure)
    .flatMap(({ name, points }) => points.map((point) => ({ input, series: name, measure, axis, ...point }))));
  return {
    heading: `kds ${view.command}`, title: `kds ${view.command}: each input`,
    note: "Bars are 95% intervals where the results have them." +
      (inputs.length > kMostInputs ? ` The first ${kMostInputs} of ${inputs.length} inputs are drawn; the table has all.`
        : ""), controls,
    draw: (size, { measure = view.measure, axis = view.axis }) => inputs.slice(0, kMostInputs).flatMap((input, k) => {
      const series = seriesOf(view, input, axis, measure), xs = series.flatMap(({ points }) => points.map(({ x }) => x));
      if (xs.length === 0) return [];
      const scale = !view.numeric.includes(axis) ? { type: "point", domain: distinct(xs), padding: 0.5 }
        : xs.every((x) => x > 0) ? ticksAt(xs) : {};
      return [caption(input, size), ...seriesPlot(series, size,
          { x: { ...scale, label: axis }, y: { label: `${words[measure] ?? measure}${unitOf(view, measure)}`, zero: true },
          height: 240 }).slice(k === 0 ? 0 : -1)];
    }),
    columns: ["input", "measure", "axis", "x", "series"]
      .map((name) => column(name)).concat([column("y", "value",
        { key: "value", lower: (p) => p.lower, upper: (p) => p.upper })]), rows: points,
  };
}
