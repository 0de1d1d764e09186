// The list of layers: it switches them on and off, and is the legend of the picture.
import { categories, rgb } from "./colours.js";
import { byId, count, make } from "../shared/dom.js";
import { noBead } from "./events.js";

const sentences = {
  beads: "blue (first) to yellow (last)",
  chain: "joins consecutive beads",
  cages: "spheres around parts of it",
  edges: "of the power diagram",
  contacts: "join beads in contact",
  hidden: "hatched: no power cell",
  flashes: "of events while playing",
};

export class LayerList {
  constructor(state, meta, changed) {
    this.state = state;
    this.changed = changed;
    this.names = ["beads", "chain"];
    for (const name of ["cages", "edges", "contacts", "hidden"]) if (state.layersNamed(name).length) this.names.push(name);
    if (state.structures.some(({ events }) => events.count)) this.names.push("flashes");
    this.boxes = new Map();
    this.drawn = new Map();
    const several = meta.necklaces.length > 1;
    this.points = meta.radius === 0;  // points of an instance, which are no chain
    for (const name of this.names) {
      const checked = name !== "chain" || !this.points;
      const box = make("input", { type: "checkbox", checked, onchange: () => this.switched() });
      const text = name === "beads" && several ? "a colour for each necklace" : sentences[name];
      this.boxes.set(name, box);
      byId("layers").append(
        make("li", {}, make("label", {}, box, make("span", { class: "sign" }, make("span", { class: `swatch ${name}` })), make("b", {}, name)), make("span", {}, text)),
      );
    }
    this.makeLevels();
    this.setBeadSize();
  }

  // Cages and contacts fit beads of their true size, but such beads cover edges.
  setBeadSize() {
    const touched = this.names.includes("cages") || this.names.includes("contacts");
    byId("bead-size").value = this.points || !this.names.includes("edges") ? 1 : touched ? 0.6 : 0.4;
  }

  switched() {
    this.forget();
    byId("level-row").hidden = !this.shows("cages");
    this.changed();
  }

  makeLevels() {
    this.nodes = this.state.layersNamed("cages").map(({ s }) => this.state.structures[s].nodes);
    const counts = [];
    for (const nodes of this.nodes) {
      for (let k = 2; k < nodes.length; k += 4) counts[nodes[k]] = (counts[nodes[k]] ?? 0) + 1;
    }
    this.counts = counts;
    const slider = byId("level");
    slider.max = Math.max(0, counts.length - 1);
    slider.value = Math.min(slider.max, 3);
    slider.oninput = () => this.levelChanged();
    byId("all-levels").onchange = () => this.levelChanged();
    byId("level-row").hidden = counts.length === 0;
    this.nameLevel();
  }

  levelChanged() {
    this.nameLevel();
    this.forget();
    this.changed();
  }

  nameLevel() {
    const all = byId("all-levels").checked;
    byId("level").disabled = all;
    const level = Number(byId("level").value);
    byId("level-text").textContent = all
      ? `all ${count(this.counts.reduce((a, b) => a + b, 0), "cage")}`
      : `level ${level}: ${count(this.counts[level] ?? 0, "cage")}`;
  }

  get level() {
    return byId("all-levels").checked ? "all" : byId("level").value;
  }

  shows(name) {
    return this.boxes.get(name)?.checked ?? false;
  }

  shown() {
    return this.names.filter((name) => this.shows(name));
  }

  open(view) {
    if (view.layers) for (const [name, box] of this.boxes) box.checked = view.layers.includes(name);
    if (view.level) {
      byId("all-levels").checked = view.level === "all";
      if (view.level !== "all") byId("level").value = view.level;
    }
    byId("level-row").hidden = !this.shows("cages");
    this.nameLevel();
    this.forget();
  }

  // Makes the next picture draw all layers anew.
  forget() {
    this.drawn.clear();
  }

  // Returns whether the elements of a layer differ from those drawn last, and notes the present ones as drawn.
  isStale(name) {
    const version = this.state.layersNamed(name).reduce((sum, { layer }) => sum + layer.version, 0);
    if (this.drawn.get(name) === version) return false;
    this.drawn.set(name, version);
    return true;
  }

  // Returns the cages of the level shown.
  cages(colour, dark) {
    const all = byId("all-levels").checked;
    const level = Number(byId("level").value);
    const colours = categories[dark ? "dark" : "light"].map(rgb);
    const cages = [];
    this.state.layersNamed("cages").forEach(({ layer }, k) => {
      const nodes = this.nodes[k];
      const words = layer.set.packed;
      for (let at = 0; at < words.length; at += layer.arity) {
        const own = nodes[4 * words[at] + 2];
        if (!all && own !== level) continue;
        const basis = [];
        for (let j = at + 1; j < at + layer.arity && words[j] !== noBead; ++j) basis.push(words[j]);
        if (basis.length) cages.push({ basis, colour: all ? colours[own % 8] : rgb(colour), alpha: all ? 0.45 : 0.8 });
      }
    });
    return cages;
  }
}
