// The page of kds trade: which setting saves time at which error, and which one to take.
import { capital, interval, known, num, percent, plural } from "../format.js";
import { axisOf, decades, dot, dotRows, key, look, plot, style } from "../plots.js";
import { dataOf, filesOf } from "../result.js";
import { column } from "../table_text.js";

// For each thing wanted: its main error, by which settings are compared, and other errors of its table.
const errors = {
  contacts: { main: "contacts_missed", name: "contacts missed",
    also: ["contacts_spurious", "contacts_unsure", "contact_time_mean"] },
  cages: { main: "radius_mean", name: "radii too large, on average", also: ["radius_max", "beads_outside", "events_missed"] },
  diagram: { main: "cells_wrong", name: "wrong cells", also: ["edges_missed", "events_missed", "events_invented"] },
  events: { main: "events_missed", name: "events missed", also: ["events_invented", "event_time_mean", "event_time_max"] },
};
const shares = /missed|spurious|unsure|wrong|invented|^radius/;

const settingText = ({ structures, ...options }) =>
  [structures, ...Object.entries(options).map(([name, value]) =>
      (name === "stride" ? `--frames ::${value}` : `--${name} ${value}`))].join(" ").replace("--certify yes", "--certify");

// Returns groups of rows. Each begins with its exact run, whose ratio is 1.
export function groupsOf(result) {
  const frames = result.input.frames, rounds = Number(result.settings.rounds), groups = [];
  for (const [index, row] of result.rows.entries()) {
    const { want, cost, error, setting } = row;
    const exact = Object.keys(setting).length === 1 && cost.ratio === 1;
    if (exact || groups.length === 0) groups.push({ want, structure: setting.structures, rows: [] });
    // The ratio takes into account that a stride may leave out the last frames.
    const first = groups.at(-1).rows[0], time = first ? first.time * cost.ratio : 1e6 * cost.seconds / frames;
    const scale = rounds > 1 && cost.seconds > 0 ? time / cost.seconds : null;
    groups.at(-1).rows.push({ ...error, index, name: settingText(setting), exact, front: row.pareto, time,
      time_lower: scale && cost.seconds_least * scale, time_upper: scale && cost.seconds_most * scale,
      ratio: cost.ratio, events: cost.events, memory: cost.memory / 1e6, error: errors[want] ? error[errors[want].main] : null });
  }
  return groups.map((group, k) => {
    const { sentence, row } = result.recommendations[k];
    return { ...group, text: sentence, taken: group.rows.find(({ index }) => index === row) ?? null };
  });
}

function frontPlot({ want, rows, taken }, size) {
  const shown = rows.filter(({ error }) => known(error));
  const named = ["exact run", "on the front", "other settings", ...(taken ? ["the setting to take"] : [])];
  const kind = (row) => (row.exact ? 0 : row.front ? 1 : 2);
  const title = (row) => `${row.name}\n${interval(row.time, null, null, "µs per frame")}\n${errors[want].name}: ` +
    `${percent(row.error)}`;
  const ring = look(3, size.dark);
  const [scale, axis] = axisOf({ ...decades(shown.map(({ time }) => time)), label: "time per frame of the trajectory (µs)" });
  return [key(named, size, false), plot({
    width: size.width, height: 340, style, marginLeft: 62, marginBottom: 42, marginRight: 20,
    x: scale,
    y: { type: "sqrt", grid: true, label: errors[want].name, tickFormat: "%", zero: true },
    marks: [
      ...axis,
      ...[2, 1, 0].map((k) => dot(shown.filter((row) => kind(row) === k),
          { x: "time", y: "error", fill: look(k, size.dark).colour, symbol: look(k, size.dark).symbol, r: 5, tip: true, title })),
      dot(taken ? [taken] : [], { x: "time", y: "error", stroke: ring.colour, strokeWidth: 2.5, symbol: ring.symbol, r: 11 }),
    ],
  })];
}

const nameOf = ({ want, structure }) => (want === "events" ? `events of ${structure}` : want === "scenes"
  ? "parts of the scene" : want);

const columnsOf = (want) => [column("name", "setting"),
  column("time", "µs per frame (range)", { lower: (row) => row.time_lower, upper: (row) => row.time_upper }),
  column("ratio", "time / exact"), ...(errors[want]
    ? [errors[want].main, ...errors[want].also]
    .map((name) => column(name, name.replaceAll("_", " "), shares.test(name) ? { write: percent } : {})) : []),
  column("displacement", "beads moved by at most"), column("front", "on the front"), column("events"),
  column("memory", "memory, MB")];

const figureOf = (group) => (errors[group.want] && group.rows.some(({ error }) => error > 0)
  ? { title: `Time and error: ${nameOf(group)}`,
    note: "The lower left is best. A setting is on the front if no other one is both as fast and as accurate in all " +
      "errors of the table. The y axis has a square-root scale.",
    draw: (size) => frontPlot(group, size), columns: columnsOf(group.want), rows: group.rows }
  : group.want === "scenes" ? { title: "Time of parts of the scene", columns: columnsOf(group.want), rows: group.rows,
    draw: (size) => dotRows(group.rows.map((row) =>
        ({ ...row, value: row.time, lower: row.time_lower, upper: row.time_upper, text: `${num(row.time)} µs per frame` })),
      size, { x: { label: "time per frame (µs)" }, left: 260 }) } : null);

function sentenceOf({ text, taken, rows }) {
  const clean = text.replaceAll("`", ""), exact = rows[0];
  if (!taken || taken === exact) return clean;
  const timeOf = ({ time, time_lower: least, time_upper: most }) =>
    `${num(time)} µs${known(least) ? ` (${num(least)} to ${num(most)})` : ""}`;
  return `${clean} It takes ${timeOf(taken)} per frame, the exact run ${timeOf(exact)}.`;
}

export function trade(result) {
  const groups = groupsOf(result), useful = groups.filter((group) => figureOf(group)),
    lead = useful.find(({ taken, rows }) => taken && taken !== rows[0]) ?? useful[0] ?? groups[0];
  const others = groups.filter((group) => group !== lead);
  const front = lead.rows.filter((row) => row.front || row.exact).sort((a, b) => a.time - b.time);
  return {
    title: `Speed and accuracy for ${filesOf(result).join(", ")}`, answer: sentenceOf(lead),
    holds: `Holds for ${dataOf(result)}. ${Number(result.settings.rounds) > 1
      ? `Times are medians of ${result.settings.rounds} rounds, with the range of the rounds.`
      : "One run was timed; --rounds 5 gives a range."} Errors are measured at ${result.settings.times} times; the ` +
      "truth is straight motion between all frames.",
    first: figureOf(lead), side: figureOf(lead) && errors[lead.want]
      ? { title: "The front", columns: ["setting", "µs per frame", errors[lead.want].name],
      rows: front.map((row) => [row === lead.taken ? `${row.name} (take this)` : row.exact ? `${row.name} (exact)`
          : row.name, num(row.time), percent(row.error)]), note: "The tables below have all settings." } : null,
    sections: [...useful.filter((group) => group !== lead)
      .map((group) => ({ heading: capital(nameOf(group)), note: sentenceOf(group), parts: [figureOf(group)] })),
      { heading: "Tables", note: others.filter((group) => !useful.includes(group)).map(sentenceOf).join(" ") || null,
        parts: groups.map((group) => ({ title: `Settings for ${nameOf(group)}`, columns: columnsOf(group.want),
          rows: group.rows })) }],
  };
}
