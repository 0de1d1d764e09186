// The list of layers: it switches them on and off, and is the legend of the picture.
import { byId, count, make } from "../shared/dom.js";
import { categories, rgb } from "../shared/palette.js";
import { noBead } from "./events.js";

const sentences = {
  beads: "coloured as chosen below",
  trace: "a tube through the chain",
  chain: "joins consecutive beads",
  cages: "spheres around parts of it",
  boxes: "boxes around parts of it",
  spheres: "around parts, without events",
  hull: "convex hull of the beads",
  box: "box around all centres",
  closest: "closest pair and its distance",
  order: "ranks along x, below",
  edges: "of the power diagram",
  links: "edges of the dual complex",
  triangles: "of the dual complex",
  voids: "cavities of the union",
  contacts: "join beads in contact",
  hidden: "hatched: no power cell",
  flashes: "of events while playing",
};

const aroundBeads = new Set(["cages", "boxes", "spheres", "edges", "hull", "closest"]);

export class LayerList {
  constructor(state, meta, changed) {
    this.state = state;
    this.changed = changed;
    this.names = ["beads", "trace", "chain"];
    const has = { boxes: "supports", box: "ends" };
    this.hierarchies = ["cages", "boxes", "spheres"];
    const spheres = meta.structures.some((structure) => structure.spheres);
    for (const name of ["cages", "boxes", "spheres", "edges", "links", "triangles", "voids", "contacts", "hidden", "hull", "box",
      "closest", "order"])
      if (state.layersNamed(has[name] ?? name).length || (name === "spheres" && spheres)) this.names.push(name);
    if (state.structures.some(({ events }) => events.count)) this.names.push("flashes");
    this.boxes = new Map();
    this.drawn = new Map();
    this.points = meta.radius === 0;  // points of an instance, which are no chain
    for (const name of this.names) {
      const others = this.names.some((other) => aroundBeads.has(other));
      const tube = meta.names && this.names.includes("contacts") && !others;  // instead of the chain
      const off = (name === "chain" && (tube || this.points)) || (name === "edges" && this.names.includes("links"));
      const checked = name === "trace" ? tube : !off;
      const box = make("input", { type: "checkbox", checked, onchange: () => this.switched() });
      const text = sentences[name];
      this.boxes.set(name, box);
      const sign = make("span", { class: "sign" }, make("span", { class: `swatch ${name}` }));
      byId("layers").append(make("li", {}, make("label", {}, box, sign, make("b", {}, name)), make("span", {}, text)));
    }
    this.makeLevels();
    this.setBeadSize();
  }

  // Cages and contacts fit beads of their true size, but such beads cover edges.
  setBeadSize() {
    const touched = this.names.includes("cages") || this.names.includes("contacts");
    const thin = this.names.includes("triangles") ? 0.25 : touched ? 0.6 : 0.4;
    byId("bead-size").value = this.shows("trace") ? 0.3 : this.points || !this.names.includes("edges") ? 1 : thin;
  }

  switched() {
    this.forget();
    this.showLevelRow();
    this.changed();
  }

  showLevelRow() {
    byId("level-row").hidden = !this.hierarchies.some((name) => this.shows(name));
  }

  levelOf(s, node) {
    return this.state.structures[s].nodes[4 * node + 2];
  }

  // Returns a function of structure and node that says whether the node is on the level shown.
  nodeFilter() {
    const level = Number(byId("level").value);
    return byId("all-levels").checked ? () => true : (s, node) => this.levelOf(s, node) === level;
  }

  makeLevels() {
    const counts = [];
    const hierarchies = this.state.structures.filter(({ nodes }) => nodes.length);
    this.noun = hierarchies.length === 1 && this.names.includes("cages") ? "cage" : "node";
    for (const { nodes } of hierarchies.slice(0, 1)) {  // all have the same tree
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
      ? `all ${count(this.counts.reduce((a, b) => a + b, 0), this.noun)}`
      : `level ${level}: ${count(this.counts[level] ?? 0, this.noun)}`;
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
    this.showLevelRow();
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
    const colours = categories[dark ? "dark" : "light"].map(rgb);
    const takes = this.nodeFilter();
    const cages = [];
    this.state.layersNamed("cages").forEach(({ layer, s }) => {
      const words = layer.set.packed;
      for (let at = 0; at < words.length; at += layer.arity) {
        const own = this.levelOf(s, words[at]);
        if (!takes(s, words[at])) continue;
        const basis = [];
        for (let j = at + 1; j < at + layer.arity && words[j] !== noBead; ++j) basis.push(words[j]);
        if (basis.length) cages.push({ basis, colour: all ? colours[own % 8] : rgb(colour), alpha: all ? 0.45 : 0.8 });
      }
    });
    return cages;
  }
}
