// Events of one structure, column by column.
import { ColumnReader } from "../shared/codec.js";

export const noBead = 0xffffffff;
export const timeScale = 2 ** 32;  // times of events are whole multiples of 1 / timeScale of a step

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
    const reader = new ColumnReader(bytes);
    this.order = reader.words(n);
    this.step = reader.words(n);
    // Middles of brackets need not ascend. The times that the page uses do.
    this.middle = new Float64Array(n);
    this.u = new Float64Array(n);
    this.time = new Float64Array(n);
    for (let e = 0, middle = 0; e < n; ++e) {
      const continues = e > 0 && this.step[e - 1] === this.step[e];
      middle = reader.nextLong() + (continues ? middle : 0);
      this.middle[e] = middle;
      this.u[e] = continues ? Math.max(this.u[e - 1], middle / timeScale) : middle / timeScale;
      this.time[e] = this.step[e] + this.u[e];
    }
    this.reach = reader.byteColumn(n);
    this.kind = reader.byteColumn(n);
    this.stage = reader.byteColumn(n);
    this.size = reader.byteColumn(n);
    this.readIds(reader);
    if (!reader.ended) throw new Error(`events of '${structure.name}' are followed by other bytes`);
  }

  // The first ids of all events come first, then the second ones, and so on.
  readIds(reader) {
    this.firstId = new Uint32Array(this.count + 1);
    let most = 0;
    for (let e = 0; e < this.count; ++e) {
      this.firstId[e + 1] = this.firstId[e] + this.size[e];
      most = Math.max(most, this.size[e]);
    }
    this.ids = new Uint32Array(this.firstId[this.count]);
    for (let k = 0; k < most; ++k) {
      for (let e = 0; e < this.count; ++e) {
        if (k >= this.size[e]) continue;
        const at = this.firstId[e] + k;
        this.ids[at] = (k ? this.ids[at - 1] : 0) + reader.next();
      }
    }
  }

  // Returns the bracket of u: the time lies strictly between both numbers or, if they are equal, is that number.
  bracketOf(e) {
    if (this.reach[e] === 0) return [this.middle[e] / timeScale, this.middle[e] / timeScale];
    const away = 2 ** (this.reach[e] - 1);
    return [Math.max(0, this.middle[e] - away) / timeScale, Math.min(timeScale, this.middle[e] + away) / timeScale];
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
