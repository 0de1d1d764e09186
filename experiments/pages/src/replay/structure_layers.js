// Draws the structures that are neither spheres of bases nor edges: boxes, spheres on curves, hull, closest pair, and the order.
import { boxesOf } from "./boxes.js";
import { byId } from "../shared/dom.js";
import { categories, rgb } from "../shared/palette.js";
import { lengthUnit, trim } from "./explain.js";
import { Instances } from "./instances.js";
import { distanceOf } from "./measure.js";
import * as shaders from "./shaders.js";

const edgesOfBox = 12;
const ranksHeight = 26;

export class StructureLayers {
  constructor(app) {
    this.app = app;
    this.closest = null;  // {text, at}: its distance and the place of the text in the scene
    this.order = app.state.layersNamed("order")[0]?.layer ?? null;
    if (!app.scene) return;
    const { uniforms, three } = app.scene;
    this.wires = new Instances({
      vertex: shaders.wireVertex,
      fragment: shaders.segmentFragment,
      uniforms: { ...uniforms, thickness: { value: 1.6 } },
      attributes: { low: [Float32Array, 3, false], high: [Float32Array, 3, false], tint: [Uint8Array, 4, true] },
      segments: true,
      repeat: edgesOfBox,
      transparent: true,
      order: 4,
    });
    this.outline = app.scene.segments(3, 3.5, false);
    three.add(this.wires.mesh, this.outline.mesh);
  }

  // Shows boxes, hull and closest pair at the present positions.
  draw() {
    const { app } = this;
    const { layers, scene, state, positions, meta, radii } = app;
    const boxes = [];
    const add = (list, colour, alpha) => boxes.push(...list.map((box) => ({ ...box, colour: rgb(colour), alpha })));
    if (layers.shows("boxes")) {
      const all = layers.level === "all";
      const takes = layers.nodeFilter();
      for (const { layer, s } of state.layersNamed("supports")) {
        const list = boxesOf(layer.set.packed, meta.dimension, positions, radii, (node) => takes(s, node));
        const colours = categories[app.dark ? "dark" : "light"];
        for (const box of list)
          add([box], all ? colours[layers.levelOf(s, box.node) % 8] : scene.colours.boxes, all ? 0.6 : 0.9);
      }
    }
    if (layers.shows("box")) {
      const words = state.elements("ends").flatMap(([end, bead]) => [0, end, bead]);
      add(boxesOf(words, meta.dimension, positions, () => 0, () => true), scene.colours.box, 1);
    }
    if (state.chosen) {
      const [s, e] = state.chosen;
      const [change] = state.changesOf(s, e).filter(({ name, added }) => name === "supports" && added.length);
      const layer = change && state.structures[s].layers.find(({ name }) => name === "supports");
      const takes = (node) => node === change.added[0];
      if (layer) add(boxesOf(layer.set.packed, meta.dimension, positions, radii, takes), scene.colours.glow, 1);
    }
    this.wires.reserve(boxes.length);
    boxes.forEach(({ low, high, colour, alpha }, k) => {
      this.wires.array("low").set(low, 3 * k);
      this.wires.array("high").set(high, 3 * k);
      this.wires.array("tint").set([...colour, 255 * alpha], 4 * k);
    });
    this.wires.changed(boxes.length, "low", "high", "tint");
    this.wires.visible = true;
    const line = (name) => (pair) => ({ pair, colour: scene.colours[name], dashed: false, alpha: 1 });
    const lines = ["hull", "closest"].flatMap((name) => (layers.shows(name) ? state.elements(name).map(line(name)) : []));
    scene.setLines(this.outline, lines);
    this.drawOrder();
  }

  // Returns the spheres on curves that are shown, as the scene's cages.
  spheres() {
    const { layers, scene, frames, dark } = this.app;
    if (!layers.shows("spheres")) return [];
    const all = layers.level === "all";
    const takes = layers.nodeFilter();
    const colours = categories[dark ? "dark" : "light"].map(rgb);
    const colourOf = (s, node) => (all ? colours[layers.levelOf(s, node) % 8] : rgb(scene.colours.spheres));
    const alpha = all ? 0.45 : 0.8;
    return frames.chords.flatMap(({ s, nodes, spheres }) =>
      [...nodes].flatMap((node, k) =>
        takes(s, node) ? [{ sphere: spheres.subarray(4 * k, 4 * k + 4), colour: colourOf(s, node), alpha }] : [],
      ),
    );
  }

  // Writes the distance of the closest pair beside it. Called after the scene is drawn.
  placeDistance() {
    const { layers, look, scene, state, positions, meta } = this.app;
    const label = byId("closest-label");
    const pair = layers.shows("closest") ? state.elements("closest")[0] : null;
    label.hidden = !pair;
    this.closest = null;
    if (!pair) return;
    label.textContent = `${Number(distanceOf(positions, ...pair).toPrecision(4))} ${lengthUnit(meta)}`;
    const [x, y] = scene.project(look.middleOf(pair));
    const at = [Math.min(scene.uniforms.screen.value.x - 90, Math.max(4, x + 12)), y + 6];
    label.style.transform = `translate(${trim(at[0], 1)}px, ${trim(at[1], 1)}px)`;
    this.closest = { text: label.textContent, at };
  }

  // Draws the order of the beads as a strip: from left to right the beads by rank, in their colours, with their numbers if
  // there is room. Beads of the chosen event and the chosen bead are marked.
  drawOrder() {
    const { app, order } = this;
    const canvas = byId("ranks");
    canvas.hidden = !order || !app.layers.shows("order");
    if (canvas.hidden) return;
    const beads = [...(app.panels.present?.enters ?? []), ...(app.panels.present?.leaves ?? []), app.bead.number];
    const key = [order.version, canvas.clientWidth, app.look.coloursKey, ...beads].join();
    if (key === this.drawnOrder) return;
    this.drawnOrder = key;
    const words = order.set.packed;
    const ranks = new Uint32Array(words.length / 2);
    for (let at = 0; at < words.length; at += 2) ranks[words[at]] = words[at + 1];
    const scale = window.devicePixelRatio || 1;
    [canvas.width, canvas.height] = [Math.round(canvas.clientWidth * scale), ranksHeight * scale];
    const context = canvas.getContext("2d");
    context.font = `${11 * scale}px system-ui, sans-serif`;
    context.textAlign = "center";
    const width = canvas.width / ranks.length;
    const tint = app.scene.beads.array("tint");
    const marks = new Map([[app.bead.number, app.scene.colours.chosen]]);
    for (const bead of app.panels.present?.leaves ?? []) marks.set(bead, app.scene.colours.goes);
    for (const bead of app.panels.present?.enters ?? []) marks.set(bead, app.scene.colours.comes);
    for (let rank = 0; rank < ranks.length; rank += Math.max(1, 1 / width)) {  // at most one for each pixel
      const bead = ranks[Math.floor(rank)];
      context.fillStyle = `rgb(${tint[4 * bead]} ${tint[4 * bead + 1]} ${tint[4 * bead + 2]})`;
      context.fillRect(rank * width, 8 * scale, Math.max(1, width - (width > 4 ? 1 : 0)), canvas.height - 8 * scale);
      if (width < 22 * scale) continue;
      const light = 0.3 * tint[4 * bead] + 0.6 * tint[4 * bead + 1] + 0.1 * tint[4 * bead + 2];
      context.fillStyle = light > 128 ? "#000" : "#fff";
      context.fillText(bead, (rank + 0.5) * width, canvas.height - 5 * scale);
    }
    for (const [bead, colour] of marks) {
      const rank = bead < 0 ? -1 : ranks.indexOf(bead);
      context.fillStyle = colour;
      if (rank >= 0) context.fillRect(rank * width, 0, Math.max(3 * scale, width), 6 * scale);
    }
  }
}
