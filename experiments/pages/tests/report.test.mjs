import assert from "node:assert/strict";
import { test } from "node:test";
import { baseName, everyFrame, interval, num, ordinal, percent, seconds } from "../src/report/format.js";
import { describe } from "../src/report/describe.js";
import { meanOf } from "../src/report/kinds/sweep.js";
import { leadOf } from "../src/report/kinds/missed.js";
import { kindOf } from "../src/report/result.js";
import { column, filterRows, latexEscaped, sortRows, toCsv, toLatex, withInterval } from "../src/report/table_text.js";
import { samples } from "./sample_results.mjs";

test("numbers have few figures, separated thousands and units", () => {
  assert.equal(num(5565), "5,565");
  assert.equal(num(85.24), "85.2");
  assert.equal(num(8), "8");
  assert.equal(num(12345.6), "12,346");
  assert.equal(num(0.00001234), "1.23e-5");
  assert.equal(num(null), "–");
  assert.equal(percent(0.07), "7%");
  assert.equal(percent(1e-14), "0%");
  assert.equal(seconds(3.4e-6), "3.40 µs");
  assert.equal(interval(85.24, 74.1, 97.2, "ps"), "85.2 ps (95%: 74.1 to 97.2)");
  assert.equal(interval(85.24, null, 97.2, "ps"), "85.2 ps");
  assert.deepEqual([1, 2, 3, 4, 11, 12, 13, 21, 112].map(ordinal), ["1st", "2nd", "3rd", "4th", "11th", "12th", "13th", "21st", "112th"]);
  assert.equal(everyFrame(1), "every frame");
  assert.equal(baseName("/a/b/c.pdb (chain A/B)"), "c.pdb (chain A/B)");
});

const rows = [{ name: "LEU 42", life: 3 }, { name: "ALA 9", life: null }, { name: "ALA 10", life: 20 }];
const columns = [column("name"), column("life")];

test("rows are sorted by number or text, missing values last", () => {
  const names = (key, descending) => sortRows(rows, columns.find((one) => one.key === key), descending).map(({ name }) => name);
  assert.deepEqual(names("life", true), ["ALA 10", "LEU 42", "ALA 9"]);
  assert.deepEqual(names("life", false), ["LEU 42", "ALA 10", "ALA 9"]);
  assert.deepEqual(names("name", false), ["ALA 9", "ALA 10", "LEU 42"]);
});

test("a filter keeps rows that have each of the names", () => {
  assert.deepEqual(filterRows(rows, columns, "ala 10").map(({ name }) => name), ["ALA 10"]);
  assert.deepEqual(filterRows(rows, columns, "ala, 9").map(({ name }) => name), ["ALA 9"]);
  assert.equal(filterRows(rows, columns, "20").length, 0);
  assert.equal(filterRows(rows, columns, " ").length, 3);
  assert.equal(filterRows(rows, columns, "trp").length, 0);
});

test("CSV quotes what needs it and writes the ends of intervals", () => {
  assert.equal(toCsv([column("name"), withInterval("x", "x (95%)")], [{ name: 'a "b", c', x: 0.1, x_lower: 0, x_upper: null }]),
    'name,x,x_lower,x_upper\n"a ""b"", c",0.1,0,\n');
});

test("LaTeX escapes its signs and aligns numbers to the right", () => {
  assert.equal(latexEscaped("50% of a_b & {c} \\ #1 ~ ^"), "50\\% of a\\_b \\& \\{c\\} \\textbackslash{} \\#1 \\textasciitilde{} \\textasciicircum{}");
  const text = toLatex(columns, rows);
  assert.match(text, /^\\begin\{tabular\}\{lr\}\n\\toprule\nname & life \\\\\n\\midrule\nLEU 42 & 3 \\\\\nALA 9 & -- \\\\\n/);
  assert.match(text, /\\bottomrule\n\\end\{tabular\}\n$/);
});

test("means over seeds have Student's interval from three values on", () => {
  assert.deepEqual(meanOf([1, 3]), { y: 2, lower: null, upper: null });
  const { y, lower, upper } = meanOf([1, 2, 3]);
  assert.equal(y, 2);
  assert.ok(Math.abs(upper - lower - 2 * 4.303 / Math.sqrt(3)) < 1e-9);
});

test("missed leads with every 8th frame", () => {
  const row = (stride, missed, found) => ({ stride, missed, found });
  assert.equal(leadOf([row(1, 0, 9), row(2, 1, 8), row(8, 5, 4), row(16, 7, 2)]).stride, 8);
  assert.equal(leadOf([row(1, 0, 9), row(2, 1, 8), row(4, 9, 0)]).stride, 2);
});

test("each kind of result has a sentence with its numbers", () => {
  const sentence = (name) => describe(samples[name]).answer;
  assert.equal(sentence("contacts"), "1 of 10 pairs of residues is in contact for more than 90% of the time (1 of 1 even at the lower end of the 95% interval); a contact lasts 85.2 ps (95%: 74 to 97) on average.");
  assert.equal(sentence("missed"), "Looking only at every 8th frame misses 67% (95%: 61% to 72%) of the 100 contacts (within 6 Å); every 2nd frame misses 20% (95%: 15% to 25%).");
  assert.match(sentence("missed_none"), /^No two beads come into contact.*--cutoff/);
  assert.equal(sentence("compare"), "Per ps, wrapped changes 4.50 (95%: 4 to 5) times in a.dcd and 6 times in b.dcd and contacts never changes.");
  assert.equal(sentence("run"), "These structures changed: wrapped 180 times (20 per step) and power 90 times (10 per step). All 20 audits passed.");
  assert.match(sentence("trade"), /^For cages, wrapped --between chord is 4 times as fast .* It takes 5 µs \(4 to 6\) per frame, the exact run 20 µs \(18 to 22\.0\)\.$/);
  assert.equal(sentence("collide"), "Beads collide in 1 of 2 frames (50%), 1.50 pairs per frame on average and at most 3.");
  assert.equal(sentence("sweep"), "Mean life of a contact (ps) of kds contacts: 50 (95%: 40 to 60) at cutoff 6, 80 (95%: 70 to 90) at cutoff 8 in a.dcd; 20 at cutoff 6, 30 at cutoff 8 in b.dcd.");
  assert.match(sentence("info"), /proper necklace/);
});

test("contacts are sorted by occupancy, not by flickering", () => {
  const [table] = describe(samples.contacts).sections[0].parts;
  assert.deepEqual(table.rows.map(({ contacts }) => contacts), [2, 90]);
});

const tableNamed = (name, title) =>
  describe(samples[name]).sections.flatMap(({ parts }) => parts).find((part) => part && !part.draw && part.title === title);

test("events of all kinds have a column in the table of compare", () => {
  const { columns } = tableNamed("compare", "Events");
  for (const kind of ["enter", "leave", "interchange"]) assert.ok(columns.some(({ key }) => key === kind), kind);
});

test("internal kinds of a run are in its table, and not counted", () => {
  const { rows } = tableNamed("run", "Events by kind");
  assert.deepEqual(rows.filter(({ internal }) => internal).map(({ structure, kind }) => [structure, kind]), [["power", "wander"]]);
});

test("the closest pair of collide has its names, or the numbers of its beads", () => {
  assert.equal(describe(samples.collide).more[0],
    "The closest pair of all frames is LEU 42 CA and bead 5 in frame 1: their surfaces overlap by 0.300 Å.");
});

test("a sweep says which of its rows are left out", () => {
  assert.ok(describe(samples.sweep).notes.includes("1 more line of results is in results.csv."));
});

test("the kind of a result is its field or its command", () => {
  assert.equal(kindOf({ command: "kds contacts a.dcd" }), "contacts");
  assert.equal(kindOf({ kind: "trade", command: "kds x" }), "trade");
});
