// Draws the timeline: axis, a row of events for each structure, and the contact intervals of each pair.
import { byId, count, make } from "../shared/dom.js";
import { categories } from "../shared/palette.js";
import { colourOfKind, theme } from "./colours.js";
import { countWhile } from "./events.js";
import { explainKind, explainStructure, timeUnit } from "./explain.js";
import { listenToTimeline } from "./timeline_input.js";
import { Window, axisTicks, binWidth, layoutEvents, layoutSpans, moved, zoomed } from "./timeline_layout.js";

const rowHeight = 38;
const base = 32;  // bars stand on it, and below are the marks of the chosen bead
const pairHeight = 24;
const eventsBeside = 16;
const inset = 4;  // pixels left of a text, for the line of the present

export class TimelineView {
  // `filter` says which events are shown. `times` are those of the frames in picoseconds, or null. `actions`: seek(time),
  // choose([structure, event]), filtered() after events are switched on or off, changed() after another part of the run is
  // shown, loop() and pairName(pair).
  constructor(state, filter, frames, times, pairs, actions) {
    this.state = state;
    this.end = Math.max(1e-9, state.lastStep);
    this.range = [0, this.end];
    this.actions = actions;
    this.pairs = pairs;
    this.filter = filter;
    this.rows = [];
    this.chips = [];
    this.pairHeight = pairHeight;
    this.pairsOfBead = null;
    this.setFrames(frames, times);
    this.makeRows();
    this.makePairs();
    listenToTimeline(this);
    byId("zoom-in").onclick = () => this.zoom(0.5, this.middle);
    byId("zoom-out").onclick = () => this.zoom(2, this.middle);
    byId("zoom-events").onclick = () => this.showEvents();
    byId("zoom-all").onclick = () => this.show([0, this.end]);
    byId("pairs").addEventListener("scroll", () => this.drawPairs());
  }

  // The axis shows the times of the frames, or else their numbers in the file, if they are evenly spaced.
  setFrames(frames, times) {
    const step = times?.length > 1 ? (times.at(-1) - times[0]) / (times.length - 1) : 0;
    if (step > 0 && times.every((time, k) => Math.abs(time - times[0] - k * step) < 1e-3 * step)) {
      const { name, perPicosecond } = timeUnit(times);
      this.frameOf = { first: times[0] * perPicosecond, spacing: step * perPicosecond, unit: name };
      return;
    }
    const spacing = frames.length > 1 ? frames[1] - frames[0] : 1;
    const even = frames.every((frame, k) => frame === frames[0] + k * spacing);
    this.frameOf = even ? { first: frames[0], spacing, word: "frame" } : { first: 0, spacing: 1, word: "step" };
  }

  get middle() {
    const now = this.state.time;
    return now >= this.range[0] && now <= this.range[1] ? now : (this.range[0] + this.range[1]) / 2;
  }

  get width() {
    return Math.max(1, byId("axis").clientWidth);
  }

  get window() {
    return new Window(this.range[0], this.range[1], this.width);
  }

  makeRows() {
    this.state.structures.forEach((structure, s) => {
      const { events } = structure;
      const { filter } = this;
      const chips = events.kinds.flatMap((kind, k) => {
        const total = filter.totals[s][k];
        if (total === 0) return [];
        const on = make("input", {
          type: "checkbox",
          onchange: () => {
            if (on.checked) filter.off[s].delete(k);
            else filter.off[s].add(k);
            this.filtered();
          },
        });
        const title = `Show and step to ${kind.name}: ${explainKind(structure.name, kind.name)}`;
        const colour = `c${colourOfKind(structure.name, kind.name, k)}`;
        const chip = make("label", { class: `chip ${colour}`, title }, on, `${kind.name} ${total.toLocaleString("en")}`);
        this.chips.push({ s, k, chip, on });
        return [chip];
      });
      if (events.count === 0) chips.push(make("span", { class: "soft" }, "no events"));
      const box = make("input", {
        type: "checkbox",
        checked: true,
        onchange: () => {
          if (box.checked) filter.muted.delete(s);
          else filter.muted.add(s);
          this.filtered();
        },
      });
      const label = make("label", { title: explainStructure(structure.name) }, box, make("b", {}, structure.name));
      const canvas = make("canvas", { role: "img", height: rowHeight });
      canvas.setAttribute(
        "aria-label",
        `${count(filter.counted(s), "event")} of ${structure.name} over time. Keys n and p go from event to event.`,
      );
      if (structure.note) chips.push(make("span", { class: "note", title: structure.note }, structure.note));
      const row = make("div", { class: "row" }, make("div", { class: "row-label" }, label, ...chips), canvas);
      canvas.hidden = events.count === 0;
      byId("rows").append(row);
      this.rows.push({ s, canvas, row, box });
    });
    byId("internal-row").hidden = !this.filter.hasInternal;
    byId("internal").onchange = () => {
      this.filter.internal = byId("internal").checked;
      this.filtered();
    };
    this.showFilter();
  }

  // Takes over a change of the filter by the reader.
  filtered() {
    this.filter.changed();
    this.showFilter();
    this.draw();
    this.actions.filtered();
  }

  // Shows in the boxes what the filter says.
  showFilter() {
    const { filter } = this;
    byId("internal").checked = filter.internal;
    for (const { s, row, box } of this.rows) {
      box.checked = !filter.muted.has(s);
      row.classList.toggle("muted", !box.checked);
    }
    for (const { s, k, chip, on } of this.chips) {
      on.checked = !filter.off[s].has(k);
      chip.hidden = !filter.internal && !this.state.structures[s].events.kinds[k].external;
    }
  }

  makePairs() {
    byId("contact-rows").hidden = this.pairs.length === 0;
    this.showBead(-1, []);
  }

  // Marks the events of a bead and lists its contacts. If `bead` is -1, no event is marked and all contacts are listed.
  showBead(bead, eventsOfBead) {
    this.eventsOfBead = eventsOfBead;
    this.pairsOfBead = bead < 0 ? this.pairs : this.pairs.filter(({ pair }) => pair.includes(bead));
    const what = bead < 0 ? "most changes first" : `with bead ${bead}`;
    byId("pairs-title").textContent = `Contacts over time: ${count(this.pairsOfBead.length, "pair")}, ${what}`;
    byId("pairs-space").style.height = `${this.pairsOfBead.length * pairHeight}px`;
    this.draw();
  }

  show(range) {
    this.range = range;
    this.draw();
    this.actions.changed();
  }

  // Shows the present with some events before and after it, so that they stand singly.
  showEvents() {
    const times = this.state.structures.flatMap(({ events }, s) => {
      const list = this.filter.stops[s];
      const here = countWhile(list.length, (k) => list[k] < this.state.applied[s]);
      return [...list.slice(Math.max(0, here - eventsBeside), here + eventsBeside)].map((e) => events.time[e]);
    });
    const now = this.state.time;
    const nearest = times.sort((a, b) => Math.abs(a - now) - Math.abs(b - now)).slice(0, eventsBeside);
    if (nearest.length === 0) return;
    const half = 1.1 * Math.abs(nearest.at(-1) - now) + 1e-9 * this.end;
    this.show(moved([now - half], Math.min(this.end, 2 * half), this.end));
  }

  zoom(factor, fixed) {
    this.show(zoomed(this.range, factor, fixed, this.end));
  }

  pan(pixels) {
    const span = this.range[1] - this.range[0];
    this.show(moved([this.range[0] + (pixels / this.width) * span], span, this.end));
  }

  // Shows another part of the run if the present has left the window.
  keepInView() {
    const [from, to] = this.range;
    const now = this.state.time;
    if (now < from || now > to) this.show(moved([now - 0.1 * (to - from)], to - from, this.end));
    this.placeHead();
  }

  setDark(dark) {
    this.colours = theme(dark ? "dark" : "light");
    this.categories = categories[dark ? "dark" : "light"];
    this.draw();
  }

  // Returns the drawing context of a canvas, sized to its place on the page.
  context(canvas, height) {
    const scale = window.devicePixelRatio || 1;
    const width = Math.round(this.width * scale);
    if (canvas.width !== width) canvas.width = width;
    if (canvas.height !== Math.round(height * scale)) canvas.height = Math.round(height * scale);
    canvas.style.height = `${height}px`;
    const context = canvas.getContext("2d");
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, this.width, height);
    return context;
  }

  draw() {
    if (!this.colours) return;
    this.drawAxis();
    for (const row of this.rows) this.drawRow(row);
    this.drawPairs();
    const [from, to] = this.range;
    byId("overview-window").style.left = `${(100 * from) / this.end}%`;
    byId("overview-window").style.width = `max(6px, ${(100 * (to - from)) / this.end}%)`;
    byId("zoom-all").disabled = byId("zoom-out").disabled = to - from >= this.end * (1 - 1e-9);
    this.placeHead();
  }

  drawAxis() {
    const context = this.context(byId("axis-canvas"), 20);
    const { first, spacing, word, unit } = this.frameOf;
    const [from, to] = this.range.map((time) => first + spacing * time);
    const inFrames = new Window(from, to, this.width);
    context.font = "11px system-ui, sans-serif";
    context.fillStyle = this.colours.axis;
    context.strokeStyle = this.colours.axis;
    let free = -Infinity;
    axisTicks(inFrames).forEach(({ time, label }, k) => {
      const x = inFrames.x(time);
      context.beginPath();
      context.moveTo(x, 15);
      context.lineTo(x, 20);
      context.stroke();
      const text = k > 0 ? label : unit ? `${label} ${unit}` : `${word} ${label}`;
      const half = context.measureText(text).width / 2;
      const at = Math.min(this.width - half, Math.max(half + inset, x));
      if (at - half < free) return;
      context.textAlign = "center";
      context.fillText(text, at, 11);
      free = at + half + 8;
    });
  }

  drawRow({ s, canvas }) {
    const context = this.context(canvas, rowHeight);
    const { name, events } = this.state.structures[s];
    const colours = events.kinds.map((kind, k) => this.categories[colourOfKind(name, kind.name, k)]);
    const layout = layoutEvents(events, this.filter.lists[s], this.window);
    context.fillStyle = this.colours.grid;
    context.fillRect(0, base, this.width, 1);
    context.fillStyle = this.colours.chosen;
    for (const e of this.eventsOfBead[s] ?? []) {
      const x = this.window.x(events.time[e]);
      const seen = x >= 0 && x <= this.width && this.filter.takesKind(s, events.kind[e]);
      if (seen) context.fillRect(x - 0.75, base + 1, 1.5, rowHeight - base - 1);
    }
    if (layout.single) {
      for (const { x, kind } of layout.marks) {
        context.fillStyle = colours[kind];
        context.fillRect(x - 1, 8, 2, base - 8);
        context.beginPath();
        context.arc(x, 7, 3.5, 0, 2 * Math.PI);
        context.fill();
      }
      return;
    }
    for (const { x, counts } of layout.bins) {
      let y = base;
      counts.forEach((number, kind) => {
        if (!number) return;
        const height = Math.max(0.7, (number / layout.most) * (base - 12));
        context.fillStyle = colours[kind];
        context.fillRect(x, y - height, binWidth - 0.6, height);
        y -= height;
      });
    }
    const text = `at most ${layout.most} in one bar`;
    context.font = "10px system-ui, sans-serif";
    context.textAlign = "right";
    context.fillStyle = this.colours.axis;
    context.fillText(text, this.width, 9);
  }

  drawPairs() {
    if (!this.colours || !this.pairsOfBead) return;
    const place = byId("pairs");
    const height = place.clientHeight;
    if (height === 0) return;
    const context = this.context(byId("pairs-canvas"), height);
    context.font = "10.5px system-ui, sans-serif";
    const first = Math.floor(place.scrollTop / pairHeight);
    const last = Math.min(this.pairsOfBead.length, Math.ceil((place.scrollTop + height) / pairHeight));
    for (let p = first; p < last; ++p) {
      const row = this.pairsOfBead[p];
      const y = p * pairHeight - place.scrollTop;
      context.fillStyle = this.colours.grid;
      context.fillRect(0, y + 18, this.width, 1);
      context.fillStyle = this.colours.contacts;
      for (const { x, width } of layoutSpans(row, this.window)) context.fillRect(x, y + 14, width, 8);
      context.fillStyle = this.colours.axis;
      context.fillText(this.actions.pairName(row.pair), inset, y + 11);
    }
  }

  // Puts the line of the present, and the loop, in their places.
  placeHead() {
    const window = this.window;
    const x = window.x(this.state.time);
    const head = byId("playhead");
    head.hidden = x < 0 || x > window.width;
    head.style.transform = `translateX(${x}px)`;
    const loop = this.actions.loop();
    const shade = byId("loop-shade");
    shade.hidden = !loop;
    if (!loop) return;
    const left = Math.max(0, window.x(loop[0]));
    shade.style.left = `${left}px`;
    shade.style.width = `${Math.max(0, Math.min(window.width, window.x(loop[1])) - left)}px`;
  }
}
