// A set of elements of a layer, each a few 32-bit words, in one typed array. A hash table (open addressing, linear
// probing) finds an element. Elements can be added and removed in constant expected time.

function hash(words, at, arity) {
  let h = 0x9e3779b9;
  for (let k = 0; k < arity; ++k) {
    h = Math.imul(h ^ words[at + k], 0x85ebca6b);
    h ^= h >>> 15;
  }
  return h >>> 0;
}

export class ElementSet {
  constructor(arity) {
    this.arity = arity;
    this.assign(new Uint32Array(0));
  }

  // Replaces all elements.
  assign(words) {
    this.size = words.length / this.arity;
    this.words = new Uint32Array(Math.max(16 * this.arity, 2 * words.length));
    this.words.set(words);
    this.rehash();
  }

  rehash() {
    let slots = 64;
    while (slots < 4 * (this.words.length / this.arity)) slots *= 2;
    this.slots = new Int32Array(slots).fill(-1);
    for (let place = 0; place < this.size; ++place) this.slots[this.freeSlot(place * this.arity)] = place;
  }

  freeSlot(at) {
    const mask = this.slots.length - 1;
    let slot = hash(this.words, at, this.arity) & mask;
    while (this.slots[slot] >= 0) slot = (slot + 1) & mask;
    return slot;
  }

  // Returns the slot of an element, or -1.
  find(source, at) {
    const { words, slots, arity } = this;
    const mask = slots.length - 1;
    for (let slot = hash(source, at, arity) & mask; slots[slot] >= 0; slot = (slot + 1) & mask) {
      const start = slots[slot] * arity;
      let k = 0;
      while (k < arity && words[start + k] === source[at + k]) ++k;
      if (k === arity) return slot;
    }
    return -1;
  }

  add(source, at) {
    if (this.find(source, at) >= 0) throw new Error("the replay adds an element that is there");
    if ((this.size + 1) * this.arity > this.words.length) {
      const words = new Uint32Array(2 * this.words.length);
      words.set(this.words);
      this.words = words;
      this.rehash();
    }
    const start = this.size * this.arity;
    for (let k = 0; k < this.arity; ++k) this.words[start + k] = source[at + k];
    this.slots[this.freeSlot(start)] = this.size++;
  }

  // Moves the last element to the place of the one removed.
  remove(source, at) {
    const slot = this.find(source, at);
    if (slot < 0) throw new Error("the replay removes an element that is not there");
    const place = this.slots[slot];
    const last = --this.size;
    if (place !== last) {
      const from = last * this.arity;
      this.slots[this.find(this.words, from)] = place;
      this.words.copyWithin(place * this.arity, from, from + this.arity);
    }
    this.closeGap(slot);
  }

  // Moves back the elements that linear probing put behind a slot that is now free.
  closeGap(gap) {
    const { slots, words, arity } = this;
    const mask = slots.length - 1;
    for (let slot = (gap + 1) & mask; slots[slot] >= 0; slot = (slot + 1) & mask) {
      const home = hash(words, slots[slot] * arity, arity) & mask;
      if (((slot - home) & mask) < ((slot - gap) & mask)) continue;
      slots[gap] = slots[slot];
      gap = slot;
    }
    slots[gap] = -1;
  }

  // The words of all elements, in no particular order.
  get packed() {
    return this.words.subarray(0, this.size * this.arity);
  }

  elements() {
    return Array.from({ length: this.size }, (_, k) =>
      Array.from(this.words.subarray(k * this.arity, (k + 1) * this.arity)),
    );
  }
}
