// One layer of a structure: its elements at the first frame and the changes of its events. Changes are applied or undone
// one after another; snapshots shorten a long way.
import { ElementSet } from "./element_set.js";
import { countWhile } from "./events.js";

const wordsBetweenSnapshots = 1 << 16;  // about 3 ms

export class Layer {
  // `initial` has the words of all elements. `changes` has a record for each change: its event, how many elements go, how many
  // come, and these elements. `spacing` is the number of words from snapshot to snapshot.
  constructor({ name, arity, changes: count }, initial, changes, spacing = wordsBetweenSnapshots) {
    this.name = name;
    this.arity = arity;
    this.changes = changes;
    this.count = count;
    this.start = new Uint32Array(count + 1);  // where each record starts
    for (let c = 0, at = 0; c < count; ++c) {
      at += 3 + arity * (changes[at + 1] + changes[at + 2]);
      this.start[c + 1] = at;
    }
    if (this.start[count] !== changes.length)
      throw new Error(`layer '${name}' has ${changes.length} words of changes, expected ${this.start[count]}`);
    this.set = new ElementSet(arity);
    this.set.assign(initial);
    this.position = 0;  // number of records applied
    this.version = 0;   // grows whenever the elements change
    this.scout = new ElementSet(arity);  // runs ahead and leaves snapshots
    this.scout.assign(initial);
    this.scouted = 0;
    this.snapshots = [{ position: 0, words: initial }];
    this.spacing = Math.max(spacing, initial.length);
  }

  eventOf(record) {
    return this.changes[this.start[record]];
  }

  // The words of the elements that a record removes and adds: [removed, added].
  elementsOf(record) {
    const at = this.start[record] + 3;
    const middle = at + this.arity * this.changes[at - 2];
    return [this.changes.subarray(at, middle), this.changes.subarray(middle, this.start[record + 1])];
  }

  // Returns the records of an event.
  recordsOf(event) {
    const first = this.recordsBefore(event);
    const last = this.recordsBefore(event + 1);
    return Array.from({ length: last - first }, (_, k) => first + k);
  }

  // Number of records of the first `events` events.
  recordsBefore(events) {
    return countWhile(this.count, (c) => this.eventOf(c) < events);
  }

  // Brings the elements to the state after the first `events` events.
  seek(events) {
    const target = this.recordsBefore(events);
    if (target === this.position) return;
    const distance = (from) => Math.abs(this.start[target] - this.start[from]);
    if (distance(this.position) > this.spacing) {
      this.makeSnapshots(target);
      let best = this.snapshots[0];
      for (const snapshot of this.snapshots) {
        if (distance(snapshot.position) < distance(best.position)) best = snapshot;
      }
      if (distance(best.position) + best.words.length < distance(this.position)) {
        this.set.assign(best.words);
        this.position = best.position;
      }
    }
    while (this.position < target) this.apply(this.set, this.position++, false);
    while (this.position > target) this.apply(this.set, --this.position, true);
    ++this.version;
  }

  apply(set, record, undo) {
    const [removed, added] = this.elementsOf(record);
    const [goes, comes] = undo ? [added, removed] : [removed, added];
    for (let at = 0; at < goes.length; at += this.arity) set.remove(goes, at);
    for (let at = 0; at < comes.length; at += this.arity) set.add(comes, at);
  }

  // Makes the snapshots up to a record. Returns false once all are made.
  makeSnapshots(target) {
    const end = Math.min(target, this.count);
    while (this.scouted < end) {
      this.apply(this.scout, this.scouted++, false);
      const last = this.snapshots.at(-1);
      if (this.start[this.scouted] - this.start[last.position] >= this.spacing)
        this.snapshots.push({ position: this.scouted, words: this.scout.packed.slice() });
    }
    return this.scouted < this.count;
  }

  // Makes some more snapshots. Returns false once all are made.
  makeSomeSnapshots() {
    return this.makeSnapshots(this.scouted + 2048);
  }
}
