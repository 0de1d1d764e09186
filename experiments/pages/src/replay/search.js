// The box that finds residues and beads by name, and opens a copied view.
import { byId, make } from "../shared/dom.js";
import { findResidues } from "./residues.js";
import { openView } from "./saved_view.js";

const mostSuggestions = 2000;

export class Search {
  // `found(residue, bead)` is called with what is found.
  constructor(app, residues, found) {
    const box = byId("find");
    const { list } = residues;
    if (list.length <= mostSuggestions) byId("residues").append(...list.map(({ title }) => make("option", { value: title })));
    let [last, place] = ["", -1];
    // Enter goes to the first residue, and again to the next one of that name.
    const go = () => {
      const text = box.value.trim();
      if (text.startsWith("#") && text.includes("=")) return openView(app, text);
      const all = findResidues(residues, text);
      if (text === "" || all.length === 0) {
        byId("found").textContent = text ? `Nothing is named ${text}.` : "";
        return text ? undefined : found(-1, -1);
      }
      place = text === last ? (place + 1) % all.length : 0;
      last = text;
      const residue = all[place];
      const { beads, title } = list[residue];
      const atom = (bead) => app.names?.[bead].split("/")[2]?.toUpperCase();
      const number = Number(text.match(/^(?:bead\s*|#)(\d+)$/i)?.[1] ?? -1);
      const named = beads.find((bead) => bead === number || atom(bead) === text.toUpperCase().split(/[\s/]/).at(-1));
      byId("found").textContent = all.length > 1 ? `${title}: ${place + 1} of ${all.length}` : "";
      return found(residue, named ?? beads.find((bead) => atom(bead) === "CA") ?? beads[0]);
    };
    box.addEventListener("change", go);
    box.addEventListener("input", () => { byId("found").textContent = ""; });
    box.addEventListener("keydown", ({ key }) => {
      if (key === "Enter" && box.value.trim() === last) go();
      if (key === "Escape") box.blur();
    });
  }
}
