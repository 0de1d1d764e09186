// The page of any other result: its rows and members as tables.
import { capital, list, num, plural } from "../format.js";
import { dataOf, filesOf, kindOf, radiiText } from "../result.js";
import { column } from "../table_text.js";

const known = new Set(["command", "kind", "version", "machine", "settings", "input", "warnings"]);

const flat = (row, prefix = "") => Object.entries(row).flatMap(([name, value]) =>
  value !== null && typeof value === "object" && !Array.isArray(value) ? flat(value, `${prefix}${name}.`)
    : Array.isArray(value) ? (value.length <= 4 && value.every((v) => typeof v !== "object")
      ? [[prefix + name, value.join(", ")]] : []) : [[prefix + name, value]]);

function tableOf(title, rows) {
  const flatRows = rows.map((row) => Object.fromEntries(flat(row)));
  const names = [...new Set(flatRows.flatMap(Object.keys))];
  return { title, rows: flatRows, columns: names.map((name) => column(name, name.replaceAll("_", " "))) };
}

export function generic(result) {
  const kind = kindOf(result), members = Object.entries(result).filter(([name]) => !known.has(name));
  const tables = members.filter(([, value]) => Array.isArray(value) && value.length > 0 && typeof value[0] === "object");
  const figures = members.filter(([, value]) => !Array.isArray(value)).flatMap(([name, value]) => flat({ [name]: value }))
    .map(([name, value]) => ({ name: name.replaceAll("_", " "), value }));
  return {
    title: [capital(kind), filesOf(result).join(", ")].filter(Boolean).join(" of "),
    answer: answerOf(kind, result),
    sections: [{ heading: "Result", parts: [...tables.map(([name, value]) => tableOf(capital(name), value)),
      figures.length > 0 && { title: "Figures", rows: figures, columns: [column("name", "figure"), column("value")] }] }],
  };
}

function answerOf(kind, result) {
  const data = dataOf(result), rows = result.rows ?? [];
  if (result.proper !== undefined) {
    const broken = rows.filter(({ holds }) => !holds).map(({ condition }) => condition);
    return `${data} ${result.proper ? "is a proper necklace: all conditions hold in all frames"
      : `is not a proper necklace, because ${broken.length === 1 ? "condition" : "conditions"} ${list(broken)} ` +
        `${broken.length === 1 ? "fails" : "fail"}`}. The radius of its beads is ` +
      `${radiiText(result.input)}.`;
  }
  if (kind === "update" && rows.length > 0) {
    const timed = rows.filter(({ ratio, stride }) => ratio !== null && stride === rows[0].stride);
    const best = timed.reduce((a, b) => (b.ratio < a.ratio ? b : a), timed[0]);
    return `Technique ${best.technique} is the fastest for ${data}: it takes ${num(best.ratio)} times as long as ` +
      `rebuilding at every ${best.stride > 1 ? `${best.stride} frames` : "frame"}.`;
  }
  if (kind === "stability") {
    const sum = (name) => rows.reduce((all, row) => all + (row[name] ?? 0), 0);
    const broken = rows.filter(({ holds }) => !holds).length, all = plural(rows.length, "row");
    return `${broken === 0 ? `All ${all} hold` : `${num(broken)} of ${all} fail`}: the filtered and the exact arithmetic ` +
      `agree in ${num(sum("agree"))} of ${plural(sum("cases"), "case")}, and ${num(sum("refused"))} are refused.`;
  }
  return `The result has ${plural(rows.length, "row")}${filesOf(result).length > 0 ? ` for ${data}` : ""}.`;
}
