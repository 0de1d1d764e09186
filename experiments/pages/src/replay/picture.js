// Fills the scene: the layers that have changed, marks of the chosen event and bead, and flashes of recent events.
import { rgb } from "../shared/palette.js";
import { noBead } from "./events.js";
import { facesOf, pairsOf } from "./faces.js";

const flashSeconds = 0.5;
const mostFlashes = 8;  // of each structure: more would cover the scene
const flashingCage = 0.5;
const simplexLayers = new Set(["edges", "contacts", "hull", "closest", "links", "triangles", "tetrahedra", "voids"]);
const cellChanges = { void_begin: "cell_begin", void_close: "cell_begin", void_end: "cell_end", void_open: "cell_end" };

export class Picture {
  constructor(app) {
    this.app = app;
    this.cages = [];
  }

  // Shows the layers that are switched on.
  drawLayers() {
    const { layers, scene, state } = this.app;
    scene.beads.visible = layers.shows("beads");
    scene.trace.visible = layers.shows("trace");
    scene.chain.visible = layers.shows("chain");
    // Lines between balls that touch would be hidden within them.
    scene.contacts.mesh.material.depthTest = scene.shrink < 0.75 || !layers.shows("beads");
    for (const [name, target] of [["edges", scene.edges], ["links", scene.links], ["contacts", scene.contacts]]) {
      if (layers.shows(name) && layers.isStale(name)) {
        const words = state.layersNamed(name).map(({ layer }) => layer.set.packed);
        const every = words.length === 1 ? words[0] : Uint32Array.from(words.flatMap((list) => [...list]));
        const all = name === "contacts" ? this.app.look.filterContacts(every) : every;
        // Many lines would cover each other, so they are fainter.
        const bounds = { edges: [400, 150, 40], links: [400, 180, 60], contacts: [60, 230, all.length / 2 > 2000 ? 60 : 110] };
        const [few, most, least] = bounds[name];
        const alpha = Math.max(least, most * Math.min(1, Math.sqrt(few / (all.length / 2))));
        target.setPairs(all, 2, rgb(scene.colours[name]), alpha);
      }
      target.visible = layers.shows(name);
    }
    this.drawFaces();
    if (layers.isStale("hidden")) {
      const hidden = layers.shows("hidden") ? state.elements("hidden").flat() : [];
      scene.paintBeads(new Set(hidden));
    }
    if (layers.isStale("cages")) this.cages = layers.shows("cages")
      ? this.app.layers.cages(scene.colours.cage, this.app.dark) : [];
  }

  // Shows triangles, tetrahedra and voids. Faces between two tetrahedra are fainter, so that the surface is seen.
  drawFaces() {
    const { layers, scene, state } = this.app;
    if (!["triangles", "tetrahedra", "voids"].filter((name) => layers.isStale(name)).length) return;
    const groups = [["triangles", ["triangles", "tetrahedra"], 0.3], ["voids", ["voids"], 0.6]].map(([name, from, alpha]) => {
      const shown = layers.shows(name) ? from.flatMap((other) => state.layersNamed(other)) : [];
      const { words, tetrahedra } = facesOf(shown.map(({ layer }) => layer.set));
      return { words, colour: scene.colours[name], alphas: tetrahedra.map((count) => (count === 2 ? 0.1 : 1) * alpha) };
    });
    scene.setFaces(scene.faces, groups);
  }

  // Marks the changes of the chosen event, the neighbours of the chosen bead and, while playing, the events just passed.
  drawMarks() {
    const { scene, state } = this.app;
    const marks = [];
    const rings = [];
    const faces = [];
    const cages = [...this.cages, ...this.app.structures.spheres()];
    const { goes, comes, glow, chosen } = scene.colours;
    const markFaces = (packed, arity, colour, alpha) => {
      const { words, tetrahedra } = facesOf([{ packed, arity }]);
      faces.push({ words, colour, alphas: tetrahedra.map((count) => (count === 2 ? 0.1 : 0.4) * alpha) });
    };
    const markEvent = (s, e, alpha) => {
      const { name: structure, events } = state.structures[s];
      const change = structure === "voids" ? cellChanges[events.kindOf(e).name] : null;
      if (change)
        markFaces(state.cellsOfVoid(s, e, change), this.app.meta.dimension + 1, change === "cell_begin" ? comes : goes, alpha);
      for (const { name, arity, removed, added } of state.changesOf(s, e)) {
        if (simplexLayers.has(name)) {
          for (const [words, colour, dashed] of [[removed, goes, true], [added, comes, false]]) {
            for (let at = 0; at < words.length; at += arity)
              for (const pair of pairsOf(words.subarray(at, at + arity))) marks.push({ pair, colour, dashed, alpha });
            markFaces(words, arity, colour, alpha);
          }
        } else if (name === "cages" && added.length) {
          const basis = [...added.subarray(1, arity)].filter((bead) => bead !== noBead);
          const strength = state.chosen ? alpha : flashingCage * alpha;
          cages.push({ basis, colour: rgb(glow), alpha: strength });
        }
      }
      const { enters, leaves } = this.app.panels.sentenceOf(s, e);
      const marked = [...enters, ...leaves];
      const others = [...events.beadsOf(e)].filter((bead) => !marked.includes(bead));
      for (const bead of others) rings.push({ bead, colour: glow, alpha });
      for (const bead of leaves) rings.push({ bead, colour: goes, alpha, shape: "cross" });
      for (const bead of enters) rings.push({ bead, colour: comes, alpha, shape: "diamond" });
    };
    if (this.app.bead.number >= 0) {
      const b = this.app.bead.number;
      for (const name of ["edges", "links", "contacts"]) {
        for (const other of this.app.layers.shows(name) ? state.partnersOf(name, b) : [])
          marks.push({ pair: [b, other], colour: chosen, dashed: false, alpha: 0.8 });
      }
    }
    if (state.chosen) markEvent(...state.chosen, 1);
    else if (this.app.player.playing && this.app.layers.shows("flashes")) this.markFlashes(markEvent);
    if (this.app.bead.number >= 0) rings.push({ bead: this.app.bead.number, colour: chosen, alpha: 1 });
    this.app.look.addMarks(marks, rings);
    scene.setMarks(marks, rings);
    scene.setFaces(scene.markedFaces, faces);
    scene.setCages(cages);
  }

  // Marks the events of the last half second of playing, fading.
  markFlashes(markEvent) {
    const { state, player } = this.app;
    const span = flashSeconds * player.speed * player.rate;
    state.structures.forEach(({ events }, s) => {
      const first = events.countBefore(state.time - span);
      let flashes = 0;
      for (let e = state.applied[s] - 1; e >= first && flashes < mostFlashes; --e) {
        if (!this.app.filter.takes(s, e)) continue;
        ++flashes;
        markEvent(s, e, Math.max(0.05, 1 - (state.time - events.time[e]) / span));
      }
    });
  }
}
