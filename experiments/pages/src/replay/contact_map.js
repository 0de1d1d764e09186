// The contact map: residue by residue, which pairs are in contact now, and how long or how often in the run.
import { byId, count } from "../shared/dom.js";
import { countWhile } from "./events.js";
import { trim } from "./explain.js";

// Joins the contacts of beads, {pair, spans, s}, to those of residues: a map from key to {pair, share, changes, events}. `share` is
// the part of the run with a contact, `changes` counts how often contact begins or ends, `events` are [structure, event].
export function residueContacts({ of, list }, pairs, lastStep) {
  const contacts = new Map();
  for (const { pair, spans, s } of pairs) {
    const own = [of[pair[0]], of[pair[1]]].sort((a, b) => a - b);
    if (own[0] === own[1]) continue;
    const key = own[0] * list.length + own[1];
    if (!contacts.has(key)) contacts.set(key, { pair: own, spans: [], events: [] });
    const contact = contacts.get(key);
    contact.spans.push(...spans);
    for (const { begins, ends } of spans) for (const e of [begins, ends]) if (e >= 0) contact.events.push([s, e]);
  }
  for (const contact of contacts.values()) {
    let [time, end, changes] = [0, -1, 0];
    for (const { from, to, begins } of contact.spans.sort((a, b) => a.from - b.from || b.to - a.to)) {
      if (from > end) {
        changes += (begins >= 0) + (end >= 0);
        time += to - from;
      } else time += Math.max(0, to - end);
      end = Math.max(end, to);
    }
    contact.changes = changes + (end < lastStep);
    contact.share = lastStep > 0 ? time / lastStep : 1;
    delete contact.spans;
  }
  return contacts;
}

const margin = { left: 52, bottom: 20 };
const measures = {
  share: ({ share }) => share,
  changes: ({ changes }, most) => Math.sqrt(changes / most),
};

export class ContactMap {
  // `choose(pair of residues)` is called after a click.
  constructor(app, residues, pairs, choose) {
    this.app = app;
    this.residues = residues;
    this.contacts = residueContacts(residues, pairs, app.state.lastStep);
    this.most = [...this.contacts.values()].reduce((most, { changes }) => Math.max(most, changes), 1);
    this.canvas = byId("map");
    this.hovered = null;
    this.canvas.addEventListener("pointermove", (event) => this.hover(this.pairAt(event)));
    this.canvas.addEventListener("pointerleave", () => this.hover(null));
    this.canvas.addEventListener("click", (event) => {
      const pair = this.pairAt(event);
      if (pair) choose(pair);
    });
    byId("map-measure").onchange = () => app.changed();
    this.resize();
  }

  // Takes over the size of its place on the page.
  resize() {
    [this.width, this.height] = [this.canvas.clientWidth, this.canvas.clientHeight];
    this.size = Math.max(50, Math.min(this.width - margin.left, this.height - margin.bottom));
  }

  contactOf([a, b]) {
    return this.contacts.get(Math.min(a, b) * this.residues.list.length + Math.max(a, b));
  }

  // Returns the pair of residues at the pointer. If squares are small, the contact next to it counts.
  pairAt({ clientX, clientY }) {
    const { left, top } = this.canvas.getBoundingClientRect();
    const count = this.residues.list.length;
    const at = [clientX - left - margin.left, clientY - top].map((pixels) => Math.floor((pixels / this.size) * count));
    if (at.some((place) => place < 0 || place >= count)) return null;
    const reach = Math.ceil((3 * count) / this.size);
    let [best, nearest] = [at, Infinity];
    for (let dx = -reach; dx <= reach; ++dx) {
      for (let dy = -reach; dy <= reach; ++dy) {
        const pair = [at[0] + dx, at[1] + dy];
        if (pair[0] === pair[1] || pair.some((place) => place < 0 || place >= count) || !this.contactOf(pair)) continue;
        if (dx * dx + dy * dy < nearest) [best, nearest] = [pair, dx * dx + dy * dy];
      }
    }
    return best.sort((a, b) => a - b);
  }

  textOf(pair) {
    const name = pair.map((residue) => this.residues.list[residue].title).join(" – ");
    const contact = this.contactOf(pair);
    if (!contact) return `${name}: never in contact`;
    const now = this.now().some(([a, b]) => a === pair[0] && b === pair[1]);
    const { share, changes } = contact;
    return `${name}: ${now ? "in contact now" : "apart now"}, ${trim(100 * share, 1)}% of the run, ${count(changes, "change")}`;
  }

  hover(pair) {
    if (String(pair) === String(this.hovered)) return;
    this.hovered = pair;
    this.draw();
  }

  // The event of a pair that follows the present, or its first one, or null. Events that are switched off do not count.
  nextEvent(pair) {
    const { state, filter } = this.app;
    const { structures, applied } = state;
    const order = ([s, e]) => structures[s].events.order[e];
    const events = (this.contactOf(pair)?.events ?? []).filter(([s, e]) => filter.takes(s, e))
      .sort((a, b) => order(a) - order(b));
    return events.find(([s, e]) => e >= applied[s]) ?? events[0] ?? null;
  }

  // The pairs of residues that are in contact at the present.
  now() {
    const { of } = this.residues;
    const found = [];
    for (const { layer } of this.app.state.layersNamed("contacts")) {
      const words = layer.set.packed;
      for (let at = 0; at < words.length; at += layer.arity) {
        const [a, b] = [of[words[at]], of[words[at + 1]]];
        if (a !== b) found.push(a < b ? [a, b] : [b, a]);
      }
    }
    return found;
  }

  // Draws the map if anything in it has changed.
  draw() {
    const { canvas, app } = this;
    if (!this.width || !app.timeline?.colours) return;
    const scale = window.devicePixelRatio || 1;
    const pair = this.hovered ?? app.look.pair;
    const versions = app.state.layersNamed("contacts").map(({ layer }) => layer.version);
    const size = [this.width, this.height, scale];
    const key = [versions, this.hovered, app.look.pair, size, byId("map-measure").value, app.dark].join(" ");
    if (key === this.shown) return;
    this.shown = key;
    const [width, height] = [Math.round(this.width * scale), Math.round(this.height * scale)];
    if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
    const context = canvas.getContext("2d");
    context.setTransform(scale, 0, 0, scale, 0, 0);
    context.clearRect(0, 0, this.width, this.height);
    this.drawTo(context, this.size, scale);
    byId("map-text").textContent = pair ? this.textOf(pair) : "Click a square to go to the pair's next event.";
  }

  // Draws the map: above the diagonal all contacts of the run, below it those of the present.
  drawTo(context, size, scale) {
    const { colours } = this.app.timeline;
    const square = size / this.residues.list.length;
    const side = Math.max(square, 1.5);
    context.save();
    context.translate(margin.left, 0);
    const measure = byId("map-measure").value;
    const key = [measure, size, scale, colours.page].join();
    if (this.drawnKey !== key) {
      this.drawnKey = key;
      this.whole = document.createElement("canvas");
      this.whole.width = this.whole.height = Math.ceil(size * scale);
      const run = this.whole.getContext("2d");
      run.scale(scale, scale);
      run.fillStyle = colours.chosen;
      for (const contact of this.contacts.values()) {
        run.globalAlpha = 0.1 + 0.9 * measures[measure](contact, this.most);
        run.fillRect(contact.pair[1] * square, contact.pair[0] * square, side, side);
      }
    }
    context.drawImage(this.whole, 0, 0, this.whole.width / scale, this.whole.height / scale);
    context.fillStyle = colours.contacts;
    for (const [a, b] of this.now()) context.fillRect(a * square, b * square, side, side);
    context.strokeStyle = colours.axis;
    context.lineWidth = 0.5;
    context.strokeRect(0.25, 0.25, size - 0.5, size - 0.5);
    context.beginPath();
    context.moveTo(0, 0);
    context.lineTo(size, size);
    context.stroke();
    const box = (pair, colour) => {
      context.strokeStyle = colour;
      context.lineWidth = 1.5;
      const reach = Math.max(side, 5);
      for (const [x, y] of [pair, [pair[1], pair[0]]])
        context.strokeRect((x + 0.5) * square - reach / 2 - 1, (y + 0.5) * square - reach / 2 - 1, reach + 2, reach + 2);
    };
    if (this.app.look.pair) box(this.app.look.pair, colours.glow);
    if (this.hovered) box(this.hovered, colours.axis);
    this.drawAxes(context, size, square, colours);
    context.restore();
  }

  drawAxes(context, size, square, colours) {
    const { list } = this.residues;
    context.fillStyle = colours.axis;
    context.font = "10px system-ui, sans-serif";
    const place = (text, x, y, align) => {
      context.textAlign = align;
      context.fillText(text, x, y, margin.left - 4);
    };
    const few = (pixels) => Math.max(1, Math.ceil(pixels / square));
    const middle = (r) => (r + 0.5) * square;
    for (let r = 0; r < list.length; r += few(26)) place(list[r].title, -4, Math.max(9, middle(r) + 3), "right");
    for (let r = 0; r < list.length; r += few(72))
      place(list[r].title, Math.min(size - 20, Math.max(20, middle(r))), size + 13, "center");
  }
}

// Returns a filter of the words of contacts. `rule` is "all", "changing", or a number: that many pairs change most.
export function contactFilter(pairs, rule) {
  if (rule === "all") return (words) => words;
  const changing = countWhile(pairs.length, (k) => pairs[k].changes > 0);  // the most changes come first
  const shown = pairs.slice(0, rule === "changing" ? changing : Math.min(changing, Number(rule)));
  const keys = new Set(shown.map(({ pair: [a, b] }) => a * 4294967296 + b));
  return (words) => {
    const kept = [];
    for (let at = 0; at < words.length; at += 2)
      if (keys.has(words[at] * 4294967296 + words[at + 1])) kept.push(words[at], words[at + 1]);
    return Uint32Array.from(kept);
  };
}
