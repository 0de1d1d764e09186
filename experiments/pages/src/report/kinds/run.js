// The page of kds run and kds replay: what changed and how often, audits, and times.
import { capital, known, list, num, plural, seconds } from "../format.js";
import { coursePlot, dotRows } from "../plots.js";
import { leftOutSection, leftOutSentence } from "../left_out.js";
import { dataOf, endOf, filesOf, lengthText } from "../result.js";
import { column } from "../table_text.js";

// Returns the unit of time of rates, and the length of the run in this unit.
function spanOf({ input }) {
  const [first, last] = input.picoseconds ?? [0, 0];
  if (last > first) return { unit: "ps", length: last - first };
  return { unit: "step", length: input.frames > 1 ? input.frames - 1 : 1 };
}

const kindsOf = (events) => Object.entries(events).filter(([kind]) => kind !== "total");

function sentences(result, structures) {
  const { unit, length } = spanOf(result);
  const changes = structures.filter(([, { events }]) => events.total > 0).map(([name, { events }]) =>
    `${name} ${plural(events.total, "time")} (${num(events.total / length)} per ${unit})`);
  const still = structures.filter(([, { events }]) => events.total === 0).map(([name]) => name);
  const run = structures.reduce((sum, [, { audits }]) => sum + (audits?.run ?? 0), 0);
  const failed = structures.reduce((sum, [, { audits }]) => sum + (audits?.failed ?? 0), 0);
  const audited = run === 0 ? "No audit was run" : failed === 0 ? `All ${plural(run, "audit")} passed`
    : `${num(failed)} of ${plural(run, "audit")} failed`;
  const again = result.replay ? (result.replay.same ? "The run repeats the log: all events are the same. "
    : `The run differs from the log: ${result.replay.difference}. `) : "";
  const changed = changes.length === 0 ? "" : changes.length === 1 ? `${capital(changes[0].replace(/ /, " changed "))}. `
    : `These structures changed: ${list(changes)}. `;
  const unchanged = still.length === 0 ? "" : `${capital(list(still))} had no events. `;
  const answer = `${again}${changed}${unchanged}${audited}.`;
  const timed = structures.filter(([, { static_seconds: anew }]) => anew > 0);
  const ratios = timed.map(([name, s]) => {
    const [least, most] = [s.seconds_least / s.static_seconds_most, s.seconds_most / s.static_seconds_least].map((x) => num(x));
    const range = known(s.seconds_least) && s.static_seconds_most > 0 ? ` (${least} to ${most} over the rounds)` : "";
    return `${num(s.seconds / s.static_seconds)}${range} times as long for ${name}`;
  });
  const rounds = timed.every(([, s]) => known(s.seconds_least)) ? "" : " One run was timed; --rounds 5 gives a range.";
  const more = timed.length === 0 ? [] : [`Maintaining the structure took ${list(ratios)} as rebuilding it at every frame ` +
    `(below 1: maintaining is faster).${rounds}`];
  if (result.closest_approach) {
    const { distance, beads, names, frame, u } = result.closest_approach;
    more.push(`The least distance of two beads is ${lengthText(distance[1], result.input, 4)}, between ` +
      `${names ? list(names) : `beads ${beads.join(" and ")}`} at frame ${num(frame + u, 6)}.`);
  }
  if (result.stride) more.push(leftOutSentence(result));
  return [answer, more];
}

export function run(result) {
  const structures = Object.entries(result.structures ?? {}), names = structures.map(([name]) => name);
  const { unit, length } = spanOf(result);
  const [answer, more] = sentences(result, structures);
  const kinds = structures.flatMap(([name, { events, internal }]) => kindsOf(events).map(([kind, count]) => ({
    structure: name, kind, count, rate: count / length, internal: internal.includes(kind),
  })));
  const rows = kinds.filter((row) => !row.internal && row.count > 0).map((row) => ({
    name: structures.length > 1 ? `${row.structure}: ${row.kind}` : row.kind, group: row.structure, value: row.rate,
    text: `${num(row.rate)} per ${unit}; ${plural(row.count, "event")}`,
  }));
  const eventColumns = [column("structure"), column("kind"), column("count", "events"), column("rate", `events per ${unit}`),
    column("internal")];
  const times = structures.map(([name, s]) => ({ name, ...s,
      ratio: s.static_seconds > 0 ? s.seconds / s.static_seconds : null, events: s.events.total }));
  const stages = [...new Set(structures.flatMap(([, s]) => Object.keys(s.stages ?? {})))];
  return {
    title: `${result.replay ? "Replay" : "Run"} of ${filesOf(result).join(", ")}`, answer, more,
    holds: `Holds for ${dataOf(result)}. Every event was counted, so counts have no interval.`,
    first: rows.length > 0 ? {
      title: `Events per ${unit} by kind`, note: "Kinds without events and internal kinds are in the table.",
      draw: (size) => dotRows(rows, size, { groups: names, x: { label: `events per ${unit}` } }), columns: eventColumns,
      rows: kinds,
    } : null,
    sections: [
      overTime(result, structures),
      leftOutSection(result),
      { heading: "Tables", parts: [
        { title: "Events by kind", columns: eventColumns, rows: kinds,
          note: "Internal events change only bookkeeping. Totals leave them out." },
        { title: "Times and audits", rows: times, columns: [column("name", "structure"), column("events"),
          column("seconds", "maintaining (range)",
            { write: seconds, lower: (row) => row.seconds_least, upper: (row) => row.seconds_most }),
          column("static_seconds", "building at every frame (range)",
            { write: seconds, lower: (row) => row.static_seconds_least, upper: (row) => row.static_seconds_most }),
          column("ratio", "kinetic / static"), column("build_seconds", "first build", { write: seconds }), column("rebuilds"),
          column("audits", "audits", { value: ({ audits }) => audits?.run ?? null }),
          column("failed", "failed audits", { value: ({ audits }) => audits?.failed ?? null })] },
        { title: "Certificates", rows: times, columns: [column("name", "structure"),
            ...["created", "never_failing", "cancelled", "failed", "peak", "per_bead_max"].map((key) =>
          column(key, { never_failing: "never failing", peak: "most at once", per_bead_max: "most on one bead" }[key] ?? key,
            { value: ({ certificates }) => certificates?.[key] ?? null }))],
          note: "A certificate is a condition that proves the structure correct. A structure changes when certificates " +
            "fail: one failure may cause several events, or none." },
        { title: "Decisions by stage of the arithmetic",
          rows: stages.map((stage) => ({ stage,
            ...Object.fromEntries(structures.map(([name, s]) => [name, s.stages?.[stage] ?? null])) })),
          columns: [column("stage"), ...names.map((name) => column(name))] },
      ] },
    ].filter(Boolean),
  };
}

// Returns the section of events over time, or null if the result has none.
function overTime(result, structures) {
  const changing = structures.filter(([, s]) => s.over_time?.events.some((count) => count > 0));
  const parts = changing.map(([name, { over_time: { steps, events, frames, picoseconds } }]) => {
    const points = events.map((count, k) => ({ x: (picoseconds ?? frames)[k], y: count / steps })),
      unit = picoseconds ? "time (ps)" : "frame";
    return { title: `Events of ${name} per step over time`,
      draw: (size) => coursePlot([...points, { ...points.at(-1), x: endOf(result, picoseconds) }], size,
        { step: true, x: { label: unit }, y: { label: "events per step", zero: true }, height: 220 }),
      columns: [column("x", unit), column("y", "", { key: "events_per_step" })], rows: points };
  });
  return parts.length > 0 ? { heading: "When it changed", parts } : null;
}
