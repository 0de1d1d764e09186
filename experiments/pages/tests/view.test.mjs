import assert from "node:assert/strict";
import test from "node:test";
import { decimals, dyadic, exactText, lowerText, residueOf, timeText, upperText } from "../src/replay/explain.js";
import { readLink, writeLink } from "../src/replay/link.js";
import { beadAt } from "../src/replay/picking.js";
import { Player } from "../src/replay/player.js";
import { random } from "./sample_run.mjs";

test("a link says again what it was written from", () => {
  const view = {
    step: 12, u: 0.40432302819102027, event: [1, 153], bead: 7, follow: true, layers: ["beads", "edges"], level: "3",
    camera: [1, 2, 3, 4.5, -5, 6, 1.25], speed: 0.05, window: [1.5, 2.25], loop: [1, 2], theme: "dark",
    off: ["1", "2.0"], internal: true,
    colour: "life", lines: "30", size: 0.35, map: "changes", residue: 0, pair: [0, 12], distance: [3, 4],
  };
  assert.deepEqual(readLink(writeLink(view)), view);
});

test("parts of a link that make no sense are left out", () => {
  assert.deepEqual(readLink("#s=-1&u=7&e=1&b=x&level=9z&cam=1,2&win=a,b&speed=99&theme=pink&size=2&res=-1&pair=1&dist=1.x&off=&colour=a+b"), {});
  assert.deepEqual(readLink("#cam=0,0,1,0,0,0,0"), {});
  assert.deepEqual(readLink("#cam=1,2,3,1,2,3,1&speed=0.03"), {});
  assert.deepEqual(readLink(""), {});
});

test("decimals of a bracket enclose it", () => {
  const next = random(2);
  const scaled = (text) => BigInt(text.replace(".", "").padEnd(33, "0"));
  for (const u of [0, 1, 0.5, 2 ** -32, 1 - 2 ** -32,
      ...Array.from({ length: 500 }, () => Math.floor(next() * 2 ** 32) / 2 ** 32)]) {
    const exact = (BigInt(u * 2 ** 32) * 10n ** 32n) / 2n ** 32n;  // 2^32 divides 10^32
    const [lower, upper] = [scaled(lowerText(u)), scaled(upperText(u))];
    assert.ok(lower <= exact && exact - lower < 10n ** 22n, `${lowerText(u)} below ${u}`);
    assert.ok(upper >= exact && upper - exact < 10n ** 22n, `${upperText(u)} above ${u}`);
    const text = exactText(u);
    assert.equal(scaled(text.includes(".") ? text : `${text}.`), exact);
  }
});

test("the time of a rebuild is a numerator over a power of two", () => {
  assert.equal(dyadic([8, 211]), 211 / 256);
  assert.equal(dyadic([64, 0, 2 ** 31]), 0.5);
});

test("the picked bead is the first that a ray meets", () => {
  const next = random(6);
  const camera = { eye: [0, 0, 50], right: [0.8, 0, -0.6], up: [0, 1, 0], back: [0.6, 0, 0.8] };
  let hits = 0;
  for (let round = 0; round < 200; ++round) {
    const positions = Array.from({ length: 3 * 30 }, () => 8 * next() - 4);
    const [x, y] = [30 + 8 * next() - 4, 8 * next() - 4];  // the scene lies about 30 to the right of this eye
    const size = (b) => 0.4 + 0.02 * b;
    // Walks along the ray in small steps until it is inside a ball.
    let met = -1;
    for (let depth = 0; met < 0 && depth > -80; depth -= 0.005) {
      const point = camera.eye.map((v, k) => v + x * camera.right[k] + y * camera.up[k] + depth * camera.back[k]);
      let least = Infinity;
      for (let b = 0; b < 30; ++b) {
        const gap = Math.hypot(...point.map((v, k) => v - positions[3 * b + k])) - size(b);
        if (gap <= 0 && gap < least) [least, met] = [gap, b];
      }
      if (least === Infinity) {
        // Nothing is nearer than the least gap, which shortens the walk.
        let gap = Infinity;
        for (let b = 0; b < 30; ++b) gap = Math.min(gap, Math.hypot(...point.map((v, k) => v - positions[3 * b + k])) - size(b));
        depth -= Math.max(0, gap - 0.01);
      }
    }
    const picked = beadAt(positions, 30, camera, x, y, size);
    hits += met >= 0;
    if (picked !== met) {
      // Only balls that the ray grazes may differ.
      const grazes = (b) => {
        if (b < 0) return false;
        const d = [0, 1, 2].map((k) => positions[3 * b + k] - camera.eye[k]);
        const along = (axis) => d.reduce((sum, v, k) => sum + v * axis[k], 0);
        return Math.abs(Math.hypot(along(camera.right) - x, along(camera.up) - y) - size(b)) < 0.01;
      };
      assert.ok(grazes(picked) || grazes(met), `${picked} and ${met}`);
    }
  }
  assert.ok(hits > 30, `${hits} hits`);
});

test("the clock plays, loops and stops at the end", () => {
  const player = new Player(1000);
  player.playing = true;
  assert.equal(player.advance(5, 0.1), 6);
  player.speed = 0.01;
  assert.ok(Math.abs(player.advance(5, 1) - 5.1) < 1e-12);
  player.setLoop(0, 10);
  player.setLoop(1, 12);
  assert.deepEqual(player.loop, [10, 12]);
  player.speed = 8;
  assert.equal(player.advance(11.9, 0.1), 10);
  player.setLoop(0, 20);
  assert.deepEqual(player.loop, [20, 1000]);
  player.loop = null;
  assert.equal(player.advance(999.9, 1), 1000);
  assert.equal(player.playing, false);
  assert.equal(player.startTime(1000), 0);
});

test("a short run is played in 20 seconds", () => {
  assert.equal(new Player(1).rate * 20, 1);
});

test("positions are told as finely as they are rounded", () => {
  assert.deepEqual([0.02, 0.005, 1e-9, 1, 1e9].map(decimals), [2, 3, 9, 0, 0]);
});

test("times are told in ps or fs if they are known, and in frames", () => {
  assert.equal(timeText(1, 0.5, [100, 105, 110], [0, 2, 4]), "3 ps, frame 107.5");
  assert.equal(timeText(1, 0.5, [100, 105, 110], [0, 0.02, 0.04]), "30 fs, frame 107.5");
  assert.equal(timeText(2, 0, [100, 105, 110], null), "frame 110");
  assert.deepEqual(residueOf("A/LEU42/CA"), { chain: "A", residue: "LEU42", atom: "CA" });
  assert.equal(residueOf("17"), null);
});
