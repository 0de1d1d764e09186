// Choices of the reader beyond the layers: colours, which contacts are drawn, the contact map, found residues and
// distances, names under the pointer.
import { beadColours, colourModes } from "./bead_colours.js";
import { contactFilter, ContactMap } from "./contact_map.js";
import { byId, count, make } from "../shared/dom.js";
import { css } from "../shared/palette.js";
import { timeUnit } from "./explain.js";
import { Measure } from "./measure.js";
import { Search } from "./search.js";

const foundZoom = 2;
const manyLines = 1000;
const lowPage = 700;  // pixels: a lower page, as in a notebook, has no room for the map at first
const mapEvery = 200;  // ms, while playing

export class Look {
  constructor(app, residues, pairs) {
    Object.assign(this, { app, residues, pairs });
    this.residue = -1;  // found by its name
    this.pair = null;   // of residues, chosen in the map
    const modes = colourModes(app.meta, app.names, pairs);
    for (const [value, text] of modes) byId("colour").add(new Option(text, value));
    byId("colour").onchange = () => this.changed();
    const changing = pairs.filter(({ changes }) => changes > 0).length;
    const rules = [["all", `all ${count(pairs.length, "pair")}`], ["changing", `${changing.toLocaleString("en")} that change`]];
    for (const most of [100, 30, 10]) if (changing > most) rules.push([most, `${most} most changing`]);
    for (const [value, text] of rules) byId("lines").add(new Option(text, value));
    byId("lines").value = changing > manyLines ? "100" : changing ? "changing" : "all";
    byId("lines").onchange = () => this.changed();
    byId("lines-row").hidden = byId("map-toggle").hidden = pairs.length === 0;
    byId("map-toggle").onclick = () => this.showMap(!this.mapShown);
    this.measure = new Measure(app);
    this.search = new Search(app, residues, (residue, bead) => this.find(residue, bead));
    this.showMap(pairs.length > 0 && window.innerHeight >= lowPage);
    this.listenToPointer();
  }

  changed() {
    this.app.layers.forget();
    this.app.changed();
  }

  // Returns the words of contacts that are drawn.
  filterContacts(words) {
    const rule = byId("lines").value;
    if (this.rule !== rule) this.filter = contactFilter(this.pairs, (this.rule = rule));
    return this.filter(words);
  }

  // Makes the colours of beads anew if the choice or the theme has changed.
  colours() {
    const { app } = this;
    const key = `${byId("colour").value} ${app.dark}`;
    if (key === this.coloursKey) return;
    this.coloursKey = key;
    const { meta, dark } = app;
    const durationText = (steps) => this.durationText(steps);
    const { of, legend } = beadColours(byId("colour").value, { ...this, meta, dark, durationText });
    app.scene.setColours(of);
    this.legend = legend;
    const swatch = (colour, own = "plain") => make("span", { class: `swatch ${own}`, style: `background: ${colour}` });
    const parts = legend.ramp
      ? [legend.low, swatch(`linear-gradient(90deg, ${legend.ramp.map(css)})`, "ramp"), legend.high]
      : legend.entries.map(([colour, text]) => make("span", {}, swatch(css(colour)), ` ${text}`));
    byId("colour-legend").replaceChildren(...parts);
    byId("colour-legend").title = legend.title;
  }

  // Writes a length of time, given in steps.
  durationText(steps) {
    const { times, frameNumbers } = this.app;
    const perStep = (list) => (list.length > 1 ? (list.at(-1) - list[0]) / (list.length - 1) : 1);
    const { name, perPicosecond } = timeUnit(times ?? []);
    const [length, unit] = times ? [steps * perStep(times) * perPicosecond, name] : [steps * perStep(frameNumbers), "frames"];
    return `${Number(length.toPrecision(2))} ${unit}`;
  }

  // The map.

  showMap(on) {
    this.mapShown = on;
    byId("map-panel").hidden = !on;
    byId("map-toggle").setAttribute("aria-pressed", on);
    if (on && !this.map && this.residues.list.length)
      this.map = new ContactMap(this.app, this.residues, this.pairs, (pair) => this.goToPair(pair));
    this.map?.resize();
    this.app.changed();
  }

  // Marks a pair of residues and goes to its next event. A later event of the chosen pair follows with the next click.
  goToPair(pair) {
    this.pair = pair;
    const event = this.map.nextEvent(pair);
    if (event) return this.app.chooseEvent(event).then(() => this.bringIntoSight(this.beadsOfPair()));
    this.app.say(`This pair has no event${this.app.filter.words.length ? " that is switched on" : ""}.`);
    this.bringIntoSight(this.beadsOfPair());
    this.app.changed();
    return Promise.resolve();
  }

  beadsOfPair() {
    return this.pair ? this.pair.flatMap((residue) => this.residues.list[residue].beads) : [];
  }

  // Moves the view to some beads if one of them is out of sight.
  bringIntoSight(beads) {
    const { app } = this;
    if (!app.scene || beads.length === 0) return;
    const { x: width, y: height } = app.scene.uniforms.screen.value;
    const out = beads.some((bead) => {
      const [x, y] = app.scene.project(app.placeOf(bead));
      return x < 0 || y < 0 || x > width || y > height;
    });
    if (out) app.scene.lookAt(this.middleOf(beads));
  }

  middleOf(beads) {
    const places = beads.map((bead) => this.app.placeOf(bead));
    return [0, 1, 2].map((axis) => places.reduce((sum, place) => sum + place[axis], 0) / places.length);
  }

  find(residue, bead) {
    this.residue = residue;
    if (bead < 0) return this.app.changed();
    this.app.scene?.lookAt(this.app.placeOf(bead), foundZoom);
    return this.app.chooseBead(bead);
  }

  // Names under the pointer.

  listenToPointer() {
    const tip = byId("tip");
    const canvas = byId("scene");
    const hide = () => (tip.hidden = true);
    canvas.addEventListener("pointermove", (event) => {
      if (event.buttons || event.pointerType === "touch" || !this.app.scene) return hide();
      const bead = this.app.scene.pick(event.clientX, event.clientY);
      tip.hidden = bead < 0;
      if (bead < 0) return undefined;
      tip.textContent = this.nameOf(bead);
      const { left, top, width } = canvas.getBoundingClientRect();
      const x = Math.min(event.clientX - left + 14, width - tip.offsetWidth - 4);
      tip.style.transform = `translate(${x}px, ${event.clientY - top + 16}px)`;
      return undefined;
    });
    canvas.addEventListener("pointerleave", hide);
  }

  nameOf(bead) {
    const { title } = this.residues.list[this.residues.of[bead]];
    const atom = this.app.names?.[bead].split("/")[2];
    return atom ? `${title} ${atom}, bead ${bead}` : title;
  }

  // Hooks of the app.

  addMarks(marks, rings) {
    const { chosen, glow } = this.app.scene.colours;
    const found = this.residue < 0 ? [] : this.residues.list[this.residue].beads;
    for (const bead of found) rings.push({ bead, colour: chosen, alpha: 0.5 });
    for (const bead of this.beadsOfPair()) rings.push({ bead, colour: glow, alpha: 0.35 });
    this.measure.addMarks(marks);
  }

  showTexts() {
    this.measure.showTexts();
    const now = performance.now();
    if (!this.map || !this.mapShown || (this.app.player.playing && now - (this.mapAt ?? 0) < mapEvery)) return;
    this.mapAt = now;
    this.map.draw();
  }

  resize() {
    this.map?.resize();
    this.showTexts();
  }

  release() {
    this.pair = null;
    this.residue = -1;
    this.measure.wait(false);
  }

  // Returns these choices for a link. `open` takes such an object; members may be missing.
  get view() {
    return {
      colour: byId("colour").value,
      lines: byId("lines").value,
      size: Number(byId("bead-size").value),
      map: this.mapShown ? byId("map-measure").value : "none",
      residue: this.residue < 0 ? null : this.residue,
      pair: this.pair,
      distance: this.measure.pair,
    };
  }

  open(view) {
    const offers = (id, value) => [...byId(id).options].some((option) => option.value === value);
    for (const id of ["colour", "lines"]) if (offers(id, view[id])) byId(id).value = view[id];
    if (view.size) byId("bead-size").value = view.size;
    if (offers("map-measure", view.map)) byId("map-measure").value = view.map;
    const count = this.residues.list.length;
    this.residue = view.residue < count ? view.residue : -1;
    this.pair = view.pair?.every((residue) => residue < count) ? view.pair : null;
    this.measure.waits = false;
    this.measure.pair = view.distance?.every((bead) => bead < this.app.meta.beads) ? view.distance : null;
    if (view.map && this.pairs.length) this.showMap(view.map !== "none");
    this.changed();
  }
}
