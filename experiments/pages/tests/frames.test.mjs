import assert from "node:assert/strict";
import test from "node:test";
import { Frames, bernstein } from "../src/replay/frames.js";
import { encodeReplay, quantised } from "./encode_replay.mjs";
import { blocksOf } from "./load_run.mjs";
import { random } from "./sample_run.mjs";
import { casteljau } from "./slow_twin.mjs";

function randomRun({ beads, frames, dimension, degree, seed }) {
  const next = random(seed);
  const point = () => Array.from({ length: dimension }, () => 40 * next() - 20);
  const cloud = () => Array.from({ length: beads }, point);
  return {
    dimension, degree, quantum: 0.02, block_frames: 3, radius: 1, structures: [],
    frames: Array.from({ length: frames }, cloud),
    controls: Array.from({ length: frames - 1 }, () => Array.from({ length: degree - 1 }, cloud)),
  };
}

// The control points of a bead in a step, quantised.
function pointsOf(run, meta, s, b) {
  const points = [run.frames[s][b], ...run.controls[s].map((cloud) => cloud[b]), run.frames[s + 1][b]];
  return points.map((p) => p.map((v, axis) => meta.origin[axis] + meta.quantum * quantised(v, meta.origin[axis], meta.quantum)));
}

for (const [dimension, degree] of [[2, 1], [3, 1], [3, 2], [2, 3], [3, 3]]) {
  test(`positions in dimension ${dimension} at degree ${degree} are those of the curves`, async () => {
    const run = randomRun({ beads: 7, frames: 11, dimension, degree, seed: 10 * dimension + degree });
    const encoded = encodeReplay(run);
    const frames = new Frames(encoded.meta, blocksOf(encoded), 500);  // so that blocks are dropped and read again
    const next = random(5);
    const out = new Float64Array(21);
    for (let round = 0; round < 60; ++round) {
      const s = Math.floor(10 * next());
      const u = round % 5 === 0 ? 0 : round % 7 === 0 ? 1 : next();
      await frames.prepare(s);
      assert.ok(frames.isReady(s));
      frames.positions(s, u, out);
      for (let b = 0; b < 7; ++b) {
        const expected = casteljau(pointsOf(run, encoded.meta, s, b), u);
        for (let axis = 0; axis < 3; ++axis) assert.ok(Math.abs(out[3 * b + axis] - (expected[axis] ?? 0)) < 1e-9);
      }
    }
    await frames.prepare(10);
    frames.positions(10, 0, out);
    const last = pointsOf(run, encoded.meta, 9, 3).at(-1);
    for (let axis = 0; axis < dimension; ++axis) assert.ok(Math.abs(out[9 + axis] - last[axis]) < 1e-9);
  });
}

test("several requests at once unpack a block once", async () => {
  const encoded = encodeReplay(randomRun({ beads: 5, frames: 6, dimension: 3, degree: 1, seed: 3 }));
  const blocks = blocksOf(encoded);
  let unpacked = 0;
  const frames = new Frames(encoded.meta, { bytes: (name) => (++unpacked, blocks.bytes(name)) });
  await Promise.all([0, 1, 0, 1].map((s) => frames.prepare(s)));
  assert.equal(unpacked, 1);
});

test("a block of another length is refused", async () => {
  const encoded = encodeReplay(randomRun({ beads: 5, frames: 4, dimension: 3, degree: 1, seed: 3 }));
  const blocks = blocksOf(encoded);
  const cut = new Frames(encoded.meta, { bytes: async (name) => (await blocks.bytes(name)).slice(0, -1) });
  await assert.rejects(cut.prepare(0), /ends inside a number/);
  const long = new Frames(encoded.meta, { bytes: async (name) => Buffer.concat([await blocks.bytes(name), Buffer.of(0)]) });
  await assert.rejects(long.prepare(0), /is too long/);
});

test("weights of control points are Bernstein polynomials", () => {
  assert.deepEqual(bernstein(3, 0.5), [0.125, 0.375, 0.375, 0.125]);
});
