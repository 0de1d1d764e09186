// The distance of two beads at the present: in the panel, and as a line in the scene.
import { byId, make } from "../shared/dom.js";
import { decimals, lengthUnit } from "./explain.js";

export const distanceOf = (positions, a, b) => Math.hypot(...[0, 1, 2].map((k) => positions[3 * a + k] - positions[3 * b + k]));

export class Measure {
  constructor(app) {
    this.app = app;
    this.pair = null;
    this.waits = false;  // for the second bead
    this.label = byId("distance-label");
    byId("measure").onclick = () => this.wait(!this.waits);
    byId("measure-clear").onclick = () => this.set(null);
  }

  // The next bead that is chosen will be the second one.
  wait(on) {
    this.waits = on && this.app.bead.number >= 0;
    this.showTexts();
  }

  set(pair) {
    this.pair = pair;
    this.waits = false;
    this.app.changed();
  }

  // Takes a bead as the second one. Returns false if the bead is to be chosen instead.
  takes(bead, wanted) {
    if (bead < 0) this.waits = false;
    const first = this.app.bead.number;
    if ((!this.waits && !wanted) || first < 0 || bead < 0 || bead === first) return false;
    this.set([first, bead]);
    return true;
  }

  get text() {
    if (!this.pair) return "";
    const { meta, positions } = this.app;
    const distance = distanceOf(positions, ...this.pair).toFixed(decimals(meta.quantum));
    return `${distance} ${lengthUnit(meta)}`.trim();
  }

  showTexts() {
    const { app, pair, waits } = this;
    const name = (bead) => app.panels.nameOf(bead);
    const key = [app.bead.number, waits, pair, this.text].join(" ");
    if (key === this.shown) return;  // each change of the page costs time
    this.shown = key;
    byId("measure").disabled = app.bead.number < 0;
    byId("measure").setAttribute("aria-pressed", waits);
    byId("measure-clear").hidden = !pair;
    if (pair && !waits) byId("distance").replaceChildren(make("b", {}, this.text), ` from ${name(pair[0])} to ${name(pair[1])}`);
    else byId("distance").textContent = waits ? "Click the second bead." : "Choose a bead, then shift-click another one.";
  }

  // Adds the line to the marks, and puts its length beside it.
  addMarks(marks) {
    const { app, pair } = this;
    this.label.hidden = !pair;
    if (!pair) return;
    marks.push({ pair, colour: app.scene.colours.axis, dashed: true, alpha: 1 });
    const [x, y] = this.place();
    this.label.textContent = this.text;
    this.label.style.transform = `translate(${x}px, ${y}px)`;
  }

  place() {
    return this.app.scene.project(this.app.look.middleOf(this.pair));
  }
}
