// Decides which events are shown, counted and stepped to. Internal events, which change only bookkeeping, are left out unless
// the reader asks for them.

export class EventFilter {
  constructor(structures) {
    this.structures = structures;
    this.muted = new Set();  // structures that are switched off
    this.off = structures.map(() => new Set());  // kinds that are switched off
    this.internal = false;
    // Numbers of events by kind.
    this.totals = structures.map(({ events }) => {
      const totals = new Uint32Array(events.kinds.length);
      for (const kind of events.kind) ++totals[kind];
      return totals;
    });
    this.changed();
  }

  // Must be called after a change of the members above. Lists the events of the kinds that are on.
  changed() {
    this.lists = this.structures.map(({ events }, s) => {
      const on = events.kinds.map((_, k) => this.takesKind(s, k));
      const list = new Uint32Array(events.count);
      let size = 0;
      for (let e = 0; e < events.count; ++e) if (on[events.kind[e]]) list[size++] = e;
      return list.subarray(0, size);
    });
  }

  takesKind(s, k) {
    return (this.internal || this.structures[s].events.kinds[k].external) && !this.off[s].has(k);
  }

  takes(s, e) {
    return !this.muted.has(s) && this.takesKind(s, this.structures[s].events.kind[e]);
  }

  // Events to step to: for each structure those that are on, ascending.
  get stops() {
    return this.lists.map((list, s) => (this.muted.has(s) ? [] : list));
  }

  // Number of events as `kds run` counts them: internal ones are left out.
  counted(s) {
    return this.totals[s].reduce((sum, total, k) => sum + (this.structures[s].events.kinds[k].external ? total : 0), 0);
  }

  get countedInAll() {
    return this.structures.reduce((sum, _, s) => sum + this.counted(s), 0);
  }

  get hasInternal() {
    return this.totals.some((totals, s) => this.counted(s) < totals.reduce((sum, total) => sum + total, 0));
  }

  // Returns the place of an event among those of its structure that are counted, from 1.
  placeOf(s, e) {
    const { kinds, kind } = this.structures[s].events;
    let place = 0;
    for (let k = 0; k <= e; ++k) place += kinds[kind[k]].external ? 1 : 0;
    return place;
  }

  // Words of a link that name what is switched off: "2" is structure 2, "2.1" its kind 1.
  get words() {
    return [...[...this.muted].map(String), ...this.off.flatMap((kinds, s) => [...kinds].map((k) => `${s}.${k}`))];
  }

  set words(words) {
    this.muted.clear();
    for (const kinds of this.off) kinds.clear();
    for (const word of words) {
      const [s, k] = word.split(".").map(Number);
      if (!this.off[s]) continue;
      if (k === undefined) this.muted.add(s);
      else this.off[s].add(k);
    }
    this.changed();
  }
}
