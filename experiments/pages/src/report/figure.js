// A plot on the page: drawn again when its width or the colours of the page change, and saved as SVG, PNG and CSV.
import { make } from "../shared/dom.js";
import { save } from "../shared/save.js";
import { fileName, pngOfSvg, saveButton } from "./save.js";
import { toCsv } from "./table_text.js";

const kSvg = "http://www.w3.org/2000/svg", kSavedWidth = 720;
const schemes = matchMedia("(prefers-color-scheme: dark)");

// Puts drawings below each other in one SVG on white.
export function stacked(drawings, title) {
  const svg = document.createElementNS(kSvg, "svg");
  let height = 8, width = 0;
  const groups = drawings.map((drawing) => {
    const group = document.createElementNS(kSvg, "g");
    for (const name of ["fill", "font-family", "font-size", "text-anchor"])
      if (drawing.hasAttribute(name)) group.setAttribute(name, drawing.getAttribute(name));
    group.setAttribute("transform", `translate(0,${height})`);
    group.append(...[...drawing.childNodes].filter(({ nodeName }) => nodeName !== "style"));
    height += Number(drawing.getAttribute("height")) + 6;
    width = Math.max(width, Number(drawing.getAttribute("width")));
    return group;
  });
  const size = { xmlns: kSvg, width, height, viewBox: `0 0 ${width} ${height}`, color: "#1f2933" };
  for (const [name, value] of Object.entries(size)) svg.setAttribute(name, value);
  svg.setAttribute("font-family", "system-ui, Helvetica, Arial, sans-serif");
  const name = document.createElementNS(kSvg, "title"), paper = document.createElementNS(kSvg, "rect");
  name.textContent = title;
  for (const [key, value] of Object.entries({ width: "100%", height: "100%", fill: "#fff" })) paper.setAttribute(key, value);
  svg.append(name, paper, ...groups);
  return { text: new XMLSerializer().serializeToString(svg), width, height };
}

// `figure` has `title`, `note`, `draw({width, dark}, choice)`, which returns drawings from top to bottom, and `columns` and
// `rows`, the numbers of the plot. Each of its `controls` is a menu, {name, options, value}, whose value is in the choice.
export function figureElement({ title, note, draw, columns, rows, controls = [] }) {
  const place = make("div", { class: "plot" });
  const choice = Object.fromEntries(controls.map(({ name, value }) => [name, value]));
  let drawn = 0;
  const show = () => {
    const width = Math.floor(place.clientWidth);
    if (width === 0) return;
    drawn = width;
    const drawings = draw({ width, dark: schemes.matches }, choice);
    for (const drawing of drawings) {
      drawing.setAttribute("role", "img");
      drawing.setAttribute("aria-label", title);
    }
    place.replaceChildren(...drawings);
  };
  // Not within the observer, because a drawing changes the size of its place.
  new ResizeObserver(() => requestAnimationFrame(() => { if (Math.floor(place.clientWidth) !== drawn) show(); })).observe(place);
  schemes.addEventListener("change", show);
  const menus = controls.map(({ name, options, value }) => make("label", {}, `${name} `, make("select", {
    onchange: ({ target }) => { choice[name] = target.value; show(); },
  }, ...options.map((option) => make("option", { value: option, selected: option === value }, option)))));

  const name = fileName(title);
  const saved = () => stacked(draw({ width: kSavedWidth, dark: false }, choice), title);
  const numbers = () => (typeof rows === "function" ? rows(choice) : rows);
  return make("figure", {},
    make("figcaption", {}, make("b", {}, title), note ? make("span", { class: "soft" }, ` ${note}`) : null),
    menus.length > 0 ? make("div", { class: "buttons" }, ...menus) : null, place,
    make("div", { class: "buttons" },
      saveButton("SVG", `Save the plot as SVG: ${title}`, () => save(`${name}.svg`, saved().text, "image/svg+xml")),
      saveButton("PNG", `Save the plot as PNG: ${title}`, async () => {
        const { text, width, height } = saved();
        save(`${name}.png`, await pngOfSvg(text, width, height));
      }),
      saveButton("CSV", `Save the numbers of the plot as CSV: ${title}`,
        () => save(`${name}.csv`, toCsv(columns, numbers()), "text/csv"))));
}
