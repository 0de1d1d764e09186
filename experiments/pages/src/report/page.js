// Puts a description of a report on the page. A description has these members:
//   title, answer    the heading, and the sentence that answers the question
//   holds            the data for which the answer holds
//   more             further sentences
//   notes            warnings that follow from the result
//   first, side      the plot of the first screen, and a short table beside it
//   sections         {heading, note, parts}, where parts are figures (figure.js) and tables (table.js)
import { byId, make } from "../shared/dom.js";
import { save } from "../shared/save.js";
import { figureElement } from "./figure.js";
import { saveButton } from "./save.js";
import { tableElement } from "./table.js";

const partElement = (part) => (part.draw ? figureElement(part) : tableElement(part));

const definitions = (pairs) => make("dl", {}, ...pairs.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));

const valueText = (value) => (value === null || value === "" ? null : value === true ? "yes" : value === false ? "no"
  : Array.isArray(value) ? value.join(", ") : typeof value === "object" ? JSON.stringify(value) : String(value));

function settingsOf(result) {
  return Object.entries(result.settings ?? {}).map(([name, value]) => [name, valueText(value)])
    .filter(([, text]) => text !== null && text !== "" && text !== "no");
}

function howMade(meta, result) {
  const machine = result.machine ?? {}, settings = settingsOf(result);
  const facts = [
    ["version", result.version],
    ["machine", [machine.cpu, machine.cores && `${machine.cores} cores`, machine.os, machine.compiler]
      .filter(Boolean).join("; ")],
    ["input", (result.input?.files ?? result.inputs?.map(({ file }) => file) ?? []).join(", ")],
    ...settings,
  ].filter(([, value]) => value);
  const command = result.command ?? "";
  return make("section", { id: "made" }, make("h2", {}, "How it was made"),
    command ? make("p", {}, make("code", {}, command)) : null,
    definitions(facts),
    meta.data?.length ? make("p", {}, "Data beside this page: ", ...meta.data.flatMap((file, k) =>
      [k > 0 ? ", " : "", make("a", { href: encodeURI(file) }, file)]), ".") : null,
    make("div", { class: "buttons" }, saveButton("JSON", "Save the whole result as JSON",
      () => save("result.json", JSON.stringify(result, null, 2), "application/json"))));
}

export function showReport(meta, result, { title, answer, holds = null, more = [], first, side = null, notes = [],
    sections = [] }) {
  document.title = title;
  const goesOn = result.complete === false ? ["The run had not ended when this page was written. Load the page again for newer results."]
    : [];
  const warnings = [...goesOn, ...(result.warnings ?? []), ...notes];
  byId("report").replaceChildren(...[
    make("header", {}, make("h1", {}, title),
      meta.replay ? make("a", { class: "button", href: encodeURI(meta.replay) }, "Open the replay") : null),
    make("p", { id: "answer" }, answer),
    holds ? make("p", { id: "holds" }, holds) : null,
    ...more.map((sentence) => make("p", { class: "more" }, sentence)),
    warnings.length > 0 ? make("details", { id: "warnings", open: warnings.length < 4 },
      make("summary", {}, warnings.length === 1 ? "1 warning" : `${warnings.length} warnings`),
      make("ul", {}, ...warnings.map((warning) => make("li", {}, warning)))) : null,
    first ? make("div", { id: "first", class: side ? "two" : null }, figureElement(first),
      side ? make("div", { id: "side" }, make("h2", {}, side.title), listElement(side)) : null) : null,
    ...sections.map(({ heading, note, parts }) => make("section", {}, make("h2", {}, heading),
      note ? make("p", { class: "soft" }, note) : null, ...parts.filter(Boolean).map(partElement))),
    howMade(meta, result),
  ].filter(Boolean));
}

// A short table without buttons.
const listElement = ({ columns, rows, note, before = null }) => make("div", {},
  before ? make("p", {}, before) : null,
  make("table", { class: "short" },
    make("thead", {}, make("tr", {}, ...columns.map((name) => make("th", { scope: "col" }, name)))),
    make("tbody", {}, ...rows.map((cells) => make("tr", {}, ...cells.map((cell) => make("td", {}, cell)))))),
  note ? make("p", { class: "soft" }, note) : null);

