// The structures of the run at the present time, and the order of all events.
import { Events, countWhile, noBead } from "./events.js";
import { Layer } from "./layer.js";
import { changesOfColumns } from "./layer_changes.js";
import { uint32 } from "../shared/codec.js";

export async function loadStructures(meta, blocks) {
  const structures = [];
  for (const [s, structure] of meta.structures.entries()) {
    const events = new Events(structure, await blocks.bytes(`events-${s}`));
    const layers = [];
    for (const [l, layer] of structure.layers.entries()) {
      const initial = uint32(await blocks.bytes(`initial-${s}-${l}`));
      const changes = changesOfColumns(layer, await blocks.bytes(`changes-${s}-${l}`), events);
      layers.push(new Layer(layer, initial, changes));
    }
    const nodes = structure.nodes ? uint32(await blocks.bytes(`nodes-${s}`)) : new Uint32Array(0);
    structures.push({ name: structure.name, note: structure.note, events, layers, nodes });
  }
  return structures;
}

export class RunState {
  constructor(meta, structures) {
    this.structures = structures;
    this.lastStep = Math.max(0, meta.frames - 1);
    this.step = 0;
    this.u = 0;
    this.chosen = null;  // [structure, event]
    this.applied = structures.map(() => 0);  // number of events of each structure before the present
    this.seek(0, 0);
  }

  // Goes to a time; events at that time are applied.
  seek(step, u) {
    this.chosen = null;
    [this.step, this.u] = this.normal(step, u);
    this.apply((events) => events.countAt(this.step, this.u));
  }

  // Goes to just after an event of a structure.
  seekEvent(s, e) {
    const { events } = this.structures[s];
    this.step = events.step[e];
    this.u = events.u[e];
    this.chosen = [s, e];
    this.apply((others) => others.countInOrder(events.order[e]));
  }

  // Keeps u in 0..1, and the time within the run. The last frame is the only time at u = 0 without a step.
  normal(step, u) {
    let whole = Math.floor(step);
    let part = u + (step - whole);
    whole += Math.floor(part);
    part -= Math.floor(part);
    if (whole < 0) return [0, 0];
    return whole >= this.lastStep ? [this.lastStep, 0] : [whole, part];
  }

  apply(count) {
    this.structures.forEach(({ events, layers }, s) => {
      this.applied[s] = count(events);
      for (const layer of layers) layer.seek(this.applied[s]);
    });
  }

  get time() {
    return this.step + this.u;
  }

  layersNamed(name) {
    return this.structures.flatMap(({ layers }, s) =>
      layers.filter((layer) => layer.name === name).map((layer) => ({ layer, s })),
    );
  }

  elements(name) {
    return this.layersNamed(name).flatMap(({ layer }) =>
      layer.set.elements().map((element) => element.filter((word) => word !== noBead)),
    );
  }

  // Returns the beads that form a pair with a bead in the layers of a name, ascending.
  partnersOf(name, bead) {
    const partners = [];
    for (const { layer } of this.layersNamed(name)) {
      const words = layer.set.packed;
      for (let at = 0; at < words.length; at += layer.arity) {
        if (words[at] === bead) partners.push(words[at + 1]);
        else if (words[at + 1] === bead) partners.push(words[at]);
      }
    }
    return partners.sort((a, b) => a - b);
  }

  // Returns the next event in the run's order, [structure, event], or null. `within[s]` has the events of a structure that
  // count, ascending.
  next(within) {
    return this.nearest(within, 1);
  }

  previous(within) {
    return this.nearest(within, -1);
  }

  nearest(within, way) {
    let best = null;
    this.structures.forEach(({ events }, s) => {
      const list = within[s];
      let place = countWhile(list.length, (k) => list[k] < this.applied[s]);
      if (way < 0) {
        --place;
        // The chosen event, or one at exactly this time, is where we are.
        while (place >= 0 && this.isHere(s, list[place])) --place;
      }
      if (place < 0 || place >= list.length) return;
      const order = events.order[list[place]];
      if (best === null || (order - best.order) * way < 0) best = { order, event: [s, list[place]] };
    });
    return best?.event ?? null;
  }

  isHere(s, e) {
    if (this.chosen) return this.chosen[0] === s && this.chosen[1] === e;
    const { events } = this.structures[s];
    return events.step[e] === this.step && events.u[e] === this.u;
  }

  // Returns the cells that a void gains (`change` is "cell_begin") or loses ("cell_end") with its event, as words. Internal
  // events right after the event name these cells: cell_begin with the number of the void, cell_end with 0.
  cellsOfVoid(s, e, change) {
    const { events } = this.structures[s];
    const number = change === "cell_begin" ? events.idsOf(e)[0] : 0;
    const cells = [];
    for (let k = e + 1; k < events.count && events.order[k] - events.order[e] === k - e; ++k)
      if (events.kindOf(k).name === change && events.idsOf(k)[0] === number) cells.push(...events.idsOf(k).subarray(1));
    return cells;
  }

  // Returns the elements that an event removes and adds in the layers of its structure: [{name, arity, removed, added}].
  changesOf(s, e) {
    return this.structures[s].layers.flatMap((layer) =>
      layer.recordsOf(e).map((record) => {
        const [removed, added] = layer.elementsOf(record);
        return { name: layer.name, arity: layer.arity, removed, added };
      }),
    );
  }
}
