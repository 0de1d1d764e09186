// The faces of simplices, as the picture draws them.
import { ElementSet } from "./element_set.js";

// Returns the triangles and the sides of tetrahedra, each once, {words, tetrahedra}: three beads of each face, and how many
// of the tetrahedra it bounds. `sets` have the beads of simplices, {packed, arity}; those of a simplex must ascend.
export function facesOf(sets) {
  const faces = new ElementSet(3);
  const counts = [];
  const placeOf = (words, at) => {
    if (faces.find(words, at) < 0) {
      faces.add(words, at);
      counts.push(0);
    }
    return faces.slots[faces.find(words, at)];
  };
  const side = new Uint32Array(3);
  for (const { packed, arity } of sets) {
    for (let at = 0; at < packed.length; at += arity) {
      if (arity === 3) placeOf(packed, at);
      for (let opposite = 0; arity === 4 && opposite < 4; ++opposite) {
        for (let k = 0; k < 3; ++k) side[k] = packed[at + k + (k >= opposite)];
        ++counts[placeOf(side, 0)];
      }
    }
  }
  return { words: faces.packed, tetrahedra: counts };
}

// Returns the pairs of the beads of a simplex.
export const pairsOf = (beads) => [...beads].flatMap((a, k) => [...beads.slice(k + 1)].map((b) => [a, b]));
