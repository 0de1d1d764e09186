// Tables without a browser: order, filter, CSV and LaTeX.
//
// A column has a `name` (its heading), a `key` (its name in CSV) and `value(row)`. It may have `lower(row)` and `upper(row)`,
// the ends of an interval, `write(value)`, which makes text of a number, and a `hint` for the pointer.
import { briefInterval, known, num } from "./format.js";

export const column = (key, name = key, options = {}) => ({ key, name, value: (row) => row[key], ...options });

// A column with the interval of fields KEY_lower and KEY_upper.
export const withInterval = (key, name, options = {}) =>
  column(key, name, { lower: (row) => row[`${key}_lower`], upper: (row) => row[`${key}_upper`], ...options });

export function cellText(column, row) {
  const value = column.value(row);
  if (column.lower) return briefInterval(value, column.lower(row), column.upper(row), column.write);
  if (!known(value)) return "–";
  if (typeof value === "boolean") return value ? "yes" : "no";
  return typeof value === "number" ? (column.write ?? num)(value) : String(value);
}

// Returns whether the column holds numbers.
export const isNumeric = (column, rows) => {
  const row = rows.find((other) => known(column.value(other)));
  return row ? typeof column.value(row) === "number" : Boolean(column.lower);
};

// Sorts by a column, missing values last in both directions. Equal rows keep their order.
export function sortRows(rows, { value, order = value }, descending) {
  const sign = descending ? -1 : 1;
  return [...rows].sort((one, other) => {
    const [a, b] = [order(one), order(other)];
    if (!known(a) || !known(b)) return known(b) - known(a);
    if (typeof a === "number" && typeof b === "number") return sign * (a - b);
    return sign * String(a).localeCompare(String(b), "en", { numeric: true });
  });
}

// Returns the rows whose names contain the text, with or without its blanks. "LEU 42, PHE 47" asks for both names. Tables
// without names are searched for numbers.
export function filterRows(rows, columns, text) {
  const phrases = text.toLowerCase().split(",").map((phrase) => phrase.replace(/ +/g, "").trim()).filter(Boolean);
  if (phrases.length === 0) return rows;
  const named = columns.filter((column) => !isNumeric(column, rows)), searched = named.length > 0 ? named : columns;
  return rows.filter((row) => {
    const cells = searched.map((column) => cellText(column, row).toLowerCase().replaceAll(" ", "")).join("\n");
    return phrases.every((phrase) => cells.includes(phrase));
  });
}

const csvCell = (value) => {
  if (!known(value)) return "";
  const text = String(value);
  return /[",\r\n]/.test(text) ? `"${text.replaceAll('"', '""')}"` : text;
};
const csvLine = (cells) => `${cells.map(csvCell).join(",")}\n`;

export function toCsv(columns, rows) {
  const fields = columns.flatMap(({ key, value, lower, upper }) =>
    lower ? [[key, value], [`${key}_lower`, lower], [`${key}_upper`, upper]] : [[key, value]]);
  return csvLine(fields.map(([key]) => key)) +
    rows.map((row) => csvLine(fields.map(([, value]) => value(row)))).join("");
}

const latexSigns = {
  "\\": "\\textbackslash{}", "{": "\\{", "}": "\\}", $: "\\$", "&": "\\&", "#": "\\#", _: "\\_", "%": "\\%",
  "~": "\\textasciitilde{}", "^": "\\textasciicircum{}", "–": "--", "µ": "\\textmu{}", "×": "$\\times$", "Å": "\\AA{}",
  "<": "\\textless{}", ">": "\\textgreater{}", "|": "\\textbar{}", "→": "$\\to$", "≥": "$\\geq$", "≤": "$\\leq$",
};
export const latexEscaped = (text) => String(text).replace(/[\\{}$&#_%~^–µ×Å<>|→≥≤]/g, (sign) => latexSigns[sign]);

// Returns a tabular with the rules of package booktabs.
export function toLatex(columns, rows) {
  const shape = columns.map((column) => (isNumeric(column, rows) ? "r" : "l")).join("");
  const line = (cells) => `${cells.map(latexEscaped).join(" & ")} \\\\\n`;
  return `\\begin{tabular}{${shape}}\n\\toprule\n${line(columns.map(({ name }) => name))}\\midrule\n` +
    `${rows.map((row) => line(columns.map((column) => cellText(column, row)))).join("")}\\bottomrule\n\\end{tabular}\n`;
}
