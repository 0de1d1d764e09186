// The boxes of nodes from the beads that hold their sides.

// Returns the boxes of nodes, [{node, low, high}] with three coordinates each, from the words node, side, bead of `supports`.
// The beads hold sides along the axes; other sides of a k-DOP are left out. `takes(node)` says which nodes count.
export function boxesOf(words, dimension, positions, radii, takes) {
  const boxes = new Map();
  for (let at = 0; at < words.length; at += 3) {
    const [node, side, bead] = [words[at], words[at + 1], words[at + 2]];
    const axis = side >> 1;
    if (axis >= dimension || !takes(node)) continue;
    if (!boxes.has(node)) boxes.set(node, { node, low: [0, 0, 0], high: [0, 0, 0] });
    const end = positions[3 * bead + axis];
    if (side % 2) boxes.get(node).high[axis] = end + radii(bead);
    else boxes.get(node).low[axis] = end - radii(bead);
  }
  return [...boxes.values()];
}
