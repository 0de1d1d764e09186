// Events of one structure, column by column.
import { float64, uint32, uint8 } from "./codec.js";

export const noBead = 0xffffffff;

// Returns the number of leading k in 0..count-1 for which `holds(k)` is true. It is true up to some k and false after.
export function countWhile(count, holds) {
  let [low, high] = [0, count];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(middle)) low = middle + 1;
    else high = middle;
  }
  return low;
}

export class Events {
  constructor(structure, bytes) {
    const n = structure.events;
    this.count = n;
    this.kinds = structure.kinds;
    this.stages = structure.stages;
    let at = 0;
    const next = (read, size) => {
      const values = read(bytes, at, n);
      at += n * size;
      return values;
    };
    this.order = next(uint32, 4);
    this.step = next(uint32, 4);
    this.lower = next(float64, 8);
    this.upper = next(float64, 8);
    this.kind = next(uint8, 1);
    this.stage = next(uint8, 1);
    const size = next(uint8, 1);
    this.ids = uint32(bytes, at);
    this.firstId = new Uint32Array(n + 1);
    for (let e = 0; e < n; ++e) this.firstId[e + 1] = this.firstId[e] + size[e];
    if (this.firstId[n] !== this.ids.length)
      throw new Error(`events of '${structure.name}' have ${this.ids.length} ids, expected ${this.firstId[n]}`);
    // Brackets may overlap, so their middles need not ascend. The times that the page uses do.
    this.u = new Float64Array(n);
    this.time = new Float64Array(n);
    for (let e = 0; e < n; ++e) {
      const middle = (this.lower[e] + this.upper[e]) / 2;
      this.u[e] = e > 0 && this.step[e - 1] === this.step[e] ? Math.max(this.u[e - 1], middle) : middle;
      this.time[e] = this.step[e] + this.u[e];
    }
  }

  // Number of events at or before u in the step.
  countAt(step, u) {
    return countWhile(this.count, (e) => this.step[e] < step || (this.step[e] === step && this.u[e] <= u));
  }

  countBefore(time) {
    return countWhile(this.count, (e) => this.time[e] < time);
  }

  // Number of events up to a place in the run's order over all structures.
  countInOrder(order) {
    return countWhile(this.count, (e) => this.order[e] <= order);
  }

  idsOf(e) {
    return this.ids.subarray(this.firstId[e], this.firstId[e + 1]);
  }

  kindOf(e) {
    return this.kinds[this.kind[e]];
  }

  // Returns the ids by role: [{name, of, ids}].
  rolesOf(e) {
    const ids = [...this.idsOf(e)];
    const roles = [];
    for (const role of this.kindOf(e).roles) {
      const own = ids.splice(0, role.count || ids.length);
      if (own.length) roles.push({ name: role.name, of: role.of, ids: own });
    }
    if (ids.length) roles.push({ name: "ids", of: "number", ids });
    return roles;
  }

  // Returns the beads of an event, each once.
  beadsOf(e) {
    const beads = this.rolesOf(e)
      .filter((role) => role.of === "beads")
      .flatMap((role) => role.ids);
    return [...new Set(beads)].filter((bead) => bead !== noBead);
  }

  // Returns all events that name a bead, in order.
  withBead(bead) {
    const found = [];
    for (let e = 0; e < this.count; ++e) {
      const first = this.firstId[e];
      const last = this.firstId[e + 1];
      for (let k = first; k < last; ++k) {
        if (this.ids[k] !== bead) continue;
        if (this.beadsOf(e).includes(bead)) found.push(e);
        break;
      }
    }
    return found;
  }
}
