// The panels of the chosen event and of the chosen bead.
import { byId, count, make } from "../shared/dom.js";
import { colourOfKind } from "./colours.js";
import { noBead } from "./events.js";
import { eventSentence, rangeText, sideText, textOf } from "./event_sentence.js";
import { decimals, dyadic, exactText, explainKind, lowerText, residueOf, timeText, trim, upperText } from "./explain.js";

const longList = 12;

export class Panels {
  // `data`: meta, frames, times, names, state, filter, radii, positions(). `actions`: bead(b) chooses a bead, follow(on), and
  // beadEvent(way) goes to the bead's next (1) or previous event.
  constructor(data, actions) {
    this.data = data;
    this.actions = actions;
  }

  timeText(step, u) {
    const { frames, times } = this.data;
    return timeText(step, u, frames, times);
  }

  nameOf(bead) {
    return this.data.names?.[bead] ?? `bead ${bead}`;
  }

  beadButton(bead) {
    if (bead === noBead) return make("span", {}, "outside");
    const text = this.data.names ? `${bead} ${this.data.names[bead]}` : `${bead}`;
    return make("button", { class: "bead", title: `Choose bead ${bead}`, onclick: () => this.actions.bead(bead) }, text);
  }

  beadButtons(beads) {
    const list = make("div", { class: "beads" }, ...beads.slice(0, longList).map((bead) => this.beadButton(bead)));
    if (beads.length > longList) list.append(`and ${beads.length - longList} more`);
    return list;
  }

  residues(beads) {
    const { names } = this.data;
    if (!names) return null;
    const residues = beads.map((bead) => residueOf(names[bead])).filter(Boolean);
    return [...new Set(residues.map(({ chain, residue }) => `${chain}/${residue}`))].join(", ") || null;
  }

  // Returns the sentence of an event, as event_sentence.js has it. The last one is kept, because each picture asks for it.
  sentenceOf(s, e) {
    if (this.lastSentence?.s === s && this.lastSentence.e === e) return this.lastSentence.sentence;
    const { state, names, meta } = this.data;
    const { name, events, nodes } = state.structures[s];
    const sentence = eventSentence({
      structure: name, kind: events.kindOf(e).name, roles: events.rolesOf(e), changes: state.changesOf(s, e), nodes, names,
      dimension: meta.dimension, several: this.several,
    });
    this.lastSentence = { s, e, sentence };
    return sentence;
  }

  // The sentence of an event as one text.
  sentenceText(s, e) {
    return textOf(this.sentenceOf(s, e).parts, this.data.names, this.several);
  }

  nodeText([first, last]) {
    const text = rangeText(first, last, this.data.names, this.several);
    return text.startsWith("bead") ? text : `${text} (beads ${first} to ${last})`;
  }

  get several() {
    return this.data.meta.necklaces.length > 1;
  }

  // The sentence of the chosen event, or null.
  get present() {
    const { chosen } = this.data.state;
    return chosen ? this.sentenceOf(...chosen) : null;
  }

  showEvent() {
    const { state, filter, meta } = this.data;
    const place = byId("event");
    byId("event-now").replaceChildren(...this.sentence());
    if (!state.chosen) {
      const way = ["None chosen. Press Next event (", make("kbd", {}, "n"), "), or click a mark on the timeline."];
      place.replaceChildren(make("p", {}, ...(filter.countedInAll ? way : ["This run has no events."])));
      return;
    }
    const [s, e] = state.chosen;
    const { name, events } = state.structures[s];
    const kind = events.kindOf(e);
    const beads = events.beadsOf(e);
    const rows = [
      ["time", this.timeText(events.step[e], events.u[e])],
      ["bracket", this.bracketText(events, e)],
    ];
    const stage = events.stages[events.stage[e]];
    if (stage) rows.push(["decided by", stage]);
    const { enters, leaves } = this.present;
    if (enters.length) rows.push([make("span", { class: "comes" }, "◆ enters"), this.beadButtons(enters)]);
    if (leaves.length) rows.push([make("span", { class: "goes" }, "✕ leaves"), this.beadButtons(leaves)]);
    rows.push(...this.changeRows(s, e));
    for (const role of events.rolesOf(e)) {
      if (role.of === "node") rows.push([role.name, this.nodeText(role.ids)]);
      else if (kind.name === "rebuild" && role.name === "time") rows.push(["built anew at", `u = ${trim(dyadic(role.ids), 10)}`]);
      else if (role.name === "side") rows.push([role.name, sideText(role.ids[0], meta.dimension)]);
      else if (role.of === "number") rows.push([role.name, role.ids.join(" ")]);
      else rows.push([role.name, this.beadButtons(role.ids)]);
    }
    const residues = this.residues(beads);
    if (residues) rows.push(["residues", residues]);
    const [nth, all] = [filter.placeOf(s, e), filter.counted(s)].map((number) => number.toLocaleString("en"));
    const ordinal = kind.external ? `Event ${nth} of ${all} of ${name}.` : "An internal event, which is not counted.";
    place.replaceChildren(
      make("h3", {}, make("span", { class: `chip c${colourOfKind(name, kind.name, events.kind[e])}` }, `${name}: ${kind.name}`)),
      make("p", {}, explainKind(name, kind.name)),
      table(rows),
      make("p", { class: "soft" }, ordinal),
    );
  }

  // Says what the chosen event is, in parts of text. Before the first one is chosen it says how to get there.
  sentence() {
    const { state, names, meta, filter } = this.data;
    if (!state.chosen && filter.countedInAll === 0) return [noEvents(meta)];
    if (!state.chosen) return this.hasChosen ? [] : ["Press Next event to see a structure change."];
    this.hasChosen = true;
    const { parts } = this.present;
    const signs = { enters: ["comes", "◆ "], leaves: ["goes", "✕ "] };
    return parts.map((part, k) => {
      const text = textOf(k === 0 ? [part] : ["", part], names, this.several);
      if (typeof part === "string") return text;
      const [name, sign] = signs[part.mark] ?? ["", ""];
      return make("span", { class: name }, sign + text);
    });
  }

  bracketText(events, e) {
    const { frames } = this.data;
    const step = events.step[e];
    const [lower, upper] = events.bracketOf(e);
    const between = step + 1 < frames.length ? `frames ${frames[step]} and ${frames[step + 1]}` : `frame ${frames[step]}`;
    const lines = lower === upper ? [`u = ${exactText(lower)}`] : [`u ≥ ${lowerText(lower)}`, `u ≤ ${upperText(upper)}`];
    return make("span", {}, ...lines.map((line) => make("div", { class: "bounds" }, line)), `between ${between}`);
  }

  changeRows(s, e) {
    const rows = [];
    for (const { name, arity, removed, added } of this.data.state.changesOf(s, e)) {
      if (arity !== 2 || name === "order" || name === "ends") continue;
      const pairs = (words) => {
        const list = Array.from({ length: words.length / 2 }, (_, k) => `${words[2 * k]}–${words[2 * k + 1]}`);
        return `${list.length === 1 ? name.replace(/s$/, "") : name} ${list.join(", ")}`;
      };
      if (removed.length) rows.push([make("span", { class: "goes" }, "goes"), pairs(removed)]);
      if (added.length) rows.push([make("span", { class: "comes" }, "comes"), pairs(added)]);
    }
    return rows;
  }

  // Shows a bead: {number, events (indices by structure), follow}. While the run plays, only values that have changed are
  // replaced, so that buttons keep the focus.
  showBead(bead) {
    if (this.shownBead !== bead) {
      this.shownBead = bead;
      this.beadValues = new Map();
      if (bead.number >= 0) this.layOutBead(bead);
      else byId("bead").replaceChildren(make("p", {}, "None chosen. Click a bead."));
    }
    if (bead.number < 0) return;
    for (const [name, value, element] of this.beadRows(bead)) {
      const known = this.beadValues.get(name);
      const text = String(value);
      if (known.text === text) continue;
      known.text = text;
      known.place.replaceChildren(element ? element(value) : text);
    }
    byId("follow").checked = bead.follow;
  }

  layOutBead(bead) {
    const rows = this.beadRows(bead).map(([name]) => {
      const place = make("span");
      this.beadValues.set(name, { place, text: null });
      return [name, place];
    });
    const none = bead.events.every((list) => list.length === 0);
    const { actions } = this;
    const follow = make("input", { type: "checkbox", id: "follow", onchange: () => actions.follow(follow.checked) });
    byId("bead").replaceChildren(
      make("h3", {}, this.data.names ? `${bead.number} ${this.nameOf(bead.number)}` : `bead ${bead.number}`),
      table(rows),
      make(
        "p",
        { class: "buttons" },
        make("button", { disabled: none, onclick: () => actions.beadEvent(-1) }, "Its previous event"),
        make("button", { disabled: none, onclick: () => actions.beadEvent(1) }, "Its next event"),
      ),
      make(
        "p",
        { class: "buttons" },
        make("label", {}, follow, " follow it"),
        make("button", { onclick: () => actions.bead(-1) }, "Release it"),
      ),
    );
  }

  // Returns what is known of a bead at the present: [name, value, function that shows the value].
  beadRows(bead) {
    const { state, radii, positions, meta } = this.data;
    const b = bead.number;
    const has = (layer) => state.layersNamed(layer).length > 0;
    const buttons = (beads) => (beads.length ? this.beadButtons(beads) : "none now");
    const digits = decimals(meta.quantum);
    const at = Array.from(positions().subarray(3 * b, 3 * b + meta.dimension), (value) => value.toFixed(digits));
    const rows = [
      ["place", `${at.join(", ")} ${meta.length_unit}`],
      ["radius", radii(b) ? `${trim(radii(b), Math.min(100, digits + 1))} ${meta.length_unit}` : "none, a point"],
    ];
    if (has("hidden")) {
      const hidden = state.elements("hidden").some(([other]) => other === b);
      rows.push(["power cell", hidden ? "none, the bead is hidden" : "yes"]);
    }
    if (has("edges")) rows.push(["neighbours", state.partnersOf("edges", b), buttons]);
    if (has("links")) rows.push(["links", state.partnersOf("links", b), buttons]);
    if (has("contacts")) rows.push(["contacts", state.partnersOf("contacts", b), buttons]);
    if (has("cages")) {
      const held = state.elements("cages").filter(([, ...basis]) => basis.includes(b)).length;
      rows.push(["holds", count(held, "cage")]);
    }
    const { filter } = this.data;
    const counted = bead.events.map((list, s) => list.filter((e) => filter.takesKind(s, state.structures[s].events.kind[e])));
    const total = counted.reduce((sum, list) => sum + list.length, 0);
    const before = counted.reduce((sum, list, s) => sum + list.filter((e) => e < state.applied[s]).length, 0);
    const [all, past] = [total, before].map((number) => number.toLocaleString("en"));
    rows.push(["events", total ? `${all}, ${past} of them so far; marked at the foot of the timeline` : "none"]);
    return rows;
  }
}

// Says why a page shows no event: a lone frame, structures without events, or beads that never change them.
function noEvents({ frames, structures }) {
  if (frames === 1) return "One frame: the beads do not move.";
  const still = structures.filter(({ spheres }) => spheres);
  return still.length === structures.length
    ? "The spheres follow their beads between frames without events."
    : "No structure changes in this run.";
}

const table = (rows) =>
  make("dl", {}, ...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
