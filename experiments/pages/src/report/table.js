// A table on the page: sorted by a click on a heading, filtered by typed text, saved as CSV and LaTeX.
import { make } from "../shared/dom.js";
import { save } from "../shared/save.js";
import { num } from "./format.js";
import { fileName, saveButton } from "./save.js";
import { cellText, filterRows, isNumeric, sortRows, toCsv, toLatex } from "./table_text.js";

const kPage = 50, kMostLatexRows = 200;

// `table` has `title`, `columns`, `rows` and, if the rows are to be sorted, `sort: {key, descending}`.
export function tableElement({ title, note, columns, rows, sort = null }) {
  let order = sort, text = "", shown = kPage;
  const numeric = columns.map((column) => isNumeric(column, rows));
  const body = make("tbody"), said = make("p", { class: "soft", role: "status" });
  const more = make("button", { type: "button", onclick: () => { shown += 4 * kPage; show(); } }, "Show more rows");

  const chosen = () => {
    const found = filterRows(rows, columns, text);
    return order ? sortRows(found, columns.find(({ key }) => key === order.key), order.descending) : found;
  };
  const heads = columns.map((column, k) => make("th",
      { scope: "col", class: numeric[k] ? "number" : null, title: column.hint ?? null },
    make("button", {
      type: "button",
      onclick: () => {
        order = order?.key === column.key ? { key: column.key, descending: !order.descending }
          : { key: column.key, descending: numeric[k] };
        show();
      },
    }, column.name)));

  function show() {
    const found = chosen();
    heads.forEach((head, k) => {
      if (columns[k].key === order?.key) head.setAttribute("aria-sort", order.descending ? "descending" : "ascending");
      else head.removeAttribute("aria-sort");
    });
    body.replaceChildren(...found.slice(0, shown).map((row) => make("tr", {},
      ...columns.map((column, k) => make("td", { class: numeric[k] ? "number" : null }, cellText(column, row))))));
    const count = Math.min(shown, found.length);
    said.textContent = `${num(count)} of ${num(rows.length)} rows shown` +
      (found.length < rows.length ? `; the text is in ${num(found.length)}.` : ".");
    more.hidden = count === found.length;
  }
  show();

  const name = fileName(title);
  const example = cellText(columns[Math.max(0, numeric.indexOf(false))], rows[0] ?? {});
  const filter = make("input", {
    type: "search", placeholder: `Filter, as ${example}`, "aria-label": `Filter the rows of table ${title}`,
    oninput: ({ target }) => { text = target.value; shown = kPage; show(); },
  });
  return make("details", { class: "table" },
    make("summary", {}, `${title} (${num(rows.length)} ${rows.length === 1 ? "row" : "rows"})`),
    note ? make("p", { class: "soft" }, note) : null,
    make("div", { class: "buttons" }, rows.length > 5 ? filter : null,
      saveButton("CSV", "Save all rows that match the filter as CSV",
        () => save(`${name}.csv`, toCsv(columns, chosen()), "text/csv")),
      saveButton("LaTeX", `Save the first ${kMostLatexRows} rows that match the filter as a LaTeX tabular`,
        () => save(`${name}.tex`, toLatex(columns, chosen().slice(0, kMostLatexRows)), "application/x-tex"))),
    make("div", { class: "wide", tabindex: "0", role: "region", "aria-label": title },
      make("table", {}, make("thead", {}, make("tr", {}, ...heads)), body)),
    said, more);
}
