// Positions of the beads at any time. Positions at frames are quantised integers, unpacked block by block. In a step the
// beads move on Bezier curves, as in the run.
import { ColumnReader, pause } from "../shared/codec.js";

const numbersAtOnce = 1 << 17;  // about 2 ms

const binomial = (n, k) => (k === 0 ? 1 : (binomial(n, k - 1) * (n - k + 1)) / k);

// Returns the weights of the control points of degree d at u.
export function bernstein(d, u) {
  return Array.from({ length: d + 1 }, (_, j) => binomial(d, j) * u ** j * (1 - u) ** (d - j));
}

// The inner control points are stored as differences to these points on the chord.
const onChord = (d, j, from, to) => Math.floor(((d - j) * from + j * to) / d + 0.5);

export class Frames {
  // Keeps about `limit` bytes of unpacked blocks.
  constructor(meta, blocks, limit = 160e6) {
    this.blocks = blocks;
    this.limit = limit;
    this.beads = meta.beads;
    this.axes = meta.dimension;
    this.width = Math.max(3, meta.dimension);  // coordinates that `positions` writes
    this.degree = Math.max(1, meta.degree);
    this.count = meta.frames;
    this.quantum = meta.quantum;
    this.origin = meta.origin;
    this.perBlock = meta.block_frames;
    this.cache = new Map();  // name -> Promise, then Int32Array; the least recently used first
    this.bytes = 0;
  }

  get numbersPerFrame() {
    return this.axes * this.beads;
  }

  blockOf(frame) {
    return Math.floor(frame / this.perBlock);
  }

  // Names of the blocks that hold the positions in a step.
  blocksOf(step) {
    const names = [`positions-${this.blockOf(step)}`];
    if (step + 1 < this.count) {
      if (this.blockOf(step + 1) !== this.blockOf(step)) names.push(`positions-${this.blockOf(step + 1)}`);
      if (this.degree > 1) names.push(`controls-${this.blockOf(step)}`);
    }
    return names;
  }

  isReady(step) {
    return this.blocksOf(step).every((name) => this.cache.get(name) instanceof Int32Array);
  }

  // Unpacks the blocks of a step.
  async prepare(step) {
    for (const name of this.blocksOf(step)) await this.block(name);
  }

  async block(name) {
    const known = this.cache.get(name);
    if (known) {
      this.cache.delete(name);
      this.cache.set(name, known);
      return known;
    }
    const unpacking = name.startsWith("controls") ? this.readControls(name) : this.readPositions(name);
    this.cache.set(name, unpacking);
    try {
      const numbers = await unpacking;
      this.cache.set(name, numbers);
      this.bytes += numbers.byteLength;
      this.dropOld(name);
      return numbers;
    } catch (error) {
      this.cache.delete(name);
      throw error;
    }
  }

  // A step needs three blocks at most, so the four used last stay.
  dropOld(latest) {
    for (const [name, numbers] of [...this.cache].slice(0, -4)) {
      if (this.bytes <= this.limit) return;
      if (name === latest || !(numbers instanceof Int32Array)) continue;
      this.cache.delete(name);
      this.bytes -= numbers.byteLength;
    }
  }

  async readPositions(name) {
    const first = Number(name.split("-")[1]) * this.perBlock;
    const frames = Math.min(this.perBlock, this.count - first);
    const perFrame = this.numbersPerFrame;
    const numbers = new Int32Array(frames * perFrame);
    const reader = new ColumnReader(await this.blocks.bytes(name));
    for (let k = 0; k < numbers.length; ++k) {
      const before = k >= perFrame ? numbers[k - perFrame] : k % this.beads ? numbers[k - 1] : 0;
      numbers[k] = before + reader.next();
      if (k % numbersAtOnce === numbersAtOnce - 1) await pause();
    }
    if (!reader.ended) throw new Error(`block '${name}' of the replay is too long`);
    return numbers;
  }

  async readControls(name) {
    const first = Number(name.split("-")[1]) * this.perBlock;
    const steps = Math.min(this.perBlock, this.count - 1 - first);
    const perFrame = this.numbersPerFrame;
    const inner = this.degree - 1;
    const numbers = new Int32Array(steps * inner * perFrame);
    const reader = new ColumnReader(await this.blocks.bytes(name));
    let at = 0;
    for (let s = 0; s < steps; ++s) {
      await this.prepareEnds(first + s);
      const [from, to] = [this.frame(first + s), this.frame(first + s + 1)];
      for (let j = 1; j <= inner; ++j) {
        for (let k = 0; k < perFrame; ++k, ++at)
          numbers[at] = reader.next() + onChord(this.degree, j, from[k], to[k]);
      }
      if (at % numbersAtOnce < inner * perFrame) await pause();
    }
    if (!reader.ended) throw new Error(`block '${name}' of the replay is too long`);
    return numbers;
  }

  async prepareEnds(step) {
    await this.block(`positions-${this.blockOf(step)}`);
    await this.block(`positions-${this.blockOf(step + 1)}`);
  }

  // The integers of a frame: for each axis, for each bead.
  frame(number) {
    const block = this.cache.get(`positions-${this.blockOf(number)}`);
    const at = (number % this.perBlock) * this.numbersPerFrame;
    return block.subarray(at, at + this.numbersPerFrame);
  }

  controlPoint(step, j) {
    if (j === 0) return this.frame(step);
    if (j === this.degree) return this.frame(step + 1);
    const block = this.cache.get(`controls-${this.blockOf(step)}`);
    const at = ((step % this.perBlock) * (this.degree - 1) + j - 1) * this.numbersPerFrame;
    return block.subarray(at, at + this.numbersPerFrame);
  }

  // Writes the positions at u in a step to `out`, x, y, z of each bead; z is 0 in the plane. Spheres have a fourth coordinate.
  // The step must be prepared.
  positions(step, u, out) {
    const { beads, width } = this;
    const lone = step + 1 >= this.count || u === 0;
    const weights = lone ? [1] : bernstein(this.degree, u);
    const points = weights.map((_, j) => (lone ? this.frame(step) : this.controlPoint(step, j)));
    for (let axis = 0; axis < width; ++axis) {
      const origin = axis < this.axes ? this.origin[axis] : 0;
      for (let b = 0; b < beads; ++b) out[width * b + axis] = origin;
      if (axis >= this.axes) continue;
      for (let j = 0; j < points.length; ++j) {
        const point = points[j];
        const scale = weights[j] * this.quantum;
        for (let b = 0, k = axis * beads; b < beads; ++b, ++k) out[width * b + axis] += scale * point[k];
      }
    }
    return out;
  }
}
