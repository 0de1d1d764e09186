import assert from "node:assert/strict";
import test from "node:test";
import { facesOf, pairsOf } from "../src/replay/faces.js";
import { random } from "./sample_run.mjs";

const subsets = (list, size) =>
  size === 0 ? [[]] : list.flatMap((bead, k) => subsets(list.slice(k + 1), size - 1).map((rest) => [bead, ...rest]));
const set = (arity, simplices) => ({ packed: Uint32Array.from(simplices.flat()), arity });
const beads = [0, 2, 3, 7, 8, 11, 40];

test("each face is drawn once, and knows how many tetrahedra it bounds", () => {
  const next = random(5);
  for (let round = 0; round < 50; ++round) {
    const [triangles, tetrahedra] = [3, 4].map((size) => subsets(beads, size).filter(() => next() < 0.3));
    const expected = subsets(beads, 3).flatMap((face) => {
      const bounded = tetrahedra.filter((solid) => face.every((bead) => solid.includes(bead))).length;
      return bounded || triangles.some((other) => String(other) === String(face)) ? [`${face}: ${bounded}`] : [];
    });
    const { words, tetrahedra: counts } = facesOf([set(3, triangles), set(4, tetrahedra), set(2, [[0, 2]])]);
    const found = counts.map((count, k) => `${[...words.slice(3 * k, 3 * k + 3)]}: ${count}`);
    assert.deepEqual(found.sort(), expected.sort());
    assert.equal(words.length, 3 * counts.length);
  }
});

test("a simplex has the pairs of its beads", () => {
  for (const size of [1, 2, 4]) assert.deepEqual(pairsOf(Uint32Array.from(beads.slice(0, size))), subsets(beads.slice(0, size), 2));
});
