// Spheres that follow curves between frames without events: chords of wrapped hierarchies, and layered ones.
import { uint32 } from "../shared/codec.js";
import { Frames } from "./frames.js";

// Loads the spheres of all structures that have them: [{s, nodes, frames, spheres}]. `nodes` are those with spheres.
export async function loadChords(meta, blocks) {
  const chords = [];
  for (const [s, { spheres }] of meta.structures.entries()) {
    if (!spheres) continue;
    const own = { bytes: (name) => blocks.bytes(`spheres-${s}-${name}`) };
    // Centre and radius are four coordinates.
    const shape = { ...meta, beads: spheres, dimension: 4, origin: [...meta.origin, 0] };
    const nodes = uint32(await blocks.bytes(`sphere-nodes-${s}`));
    chords.push({ s, nodes, frames: new Frames(shape, own), spheres: new Float32Array(4 * spheres) });
  }
  return chords;
}

// The frames of the beads together with those of the spheres.
export class FramesWithChords {
  constructor(frames, chords) {
    this.own = frames;
    this.all = [frames, ...chords.map((one) => one.frames)];
    this.chords = chords;
    this.perBlock = frames.perBlock;
  }

  isReady(step) {
    return this.all.every((frames) => frames.isReady(step));
  }

  async prepare(step) {
    for (const frames of this.all) await frames.prepare(step);
  }

  positions(step, u, out) {
    for (const { frames, spheres } of this.chords) frames.positions(step, u, spheres);
    return this.own.positions(step, u, out);
  }
}
