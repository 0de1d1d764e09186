// Slow, obvious twins of what the page computes.

const distance = (a, b) => Math.hypot(a[0] - b[0], a[1] - b[1], (a[2] ?? 0) - (b[2] ?? 0));

// Returns the least ball {centre, radius} around some balls: from the middle, ever smaller steps towards the ball that sticks
// out most.
export function smallestBall(centres, radii) {
  const centre = [0, 1, 2].map((axis) => centres.reduce((sum, c) => sum + (c[axis] ?? 0), 0) / centres.length);
  const worst = () => {
    let far = 0;
    centres.forEach((c, k) => {
      if (distance(c, centre) + radii[k] > distance(centres[far], centre) + radii[far]) far = k;
    });
    return far;
  };
  for (let round = 1; round <= 200000; ++round) {
    const far = centres[worst()];
    for (let axis = 0; axis < 3; ++axis) centre[axis] += ((far[axis] ?? 0) - centre[axis]) / (round + 1);
  }
  const far = worst();
  return { centre, radius: distance(centres[far], centre) + radii[far] };
}

// Returns the point of a Bezier curve by de Casteljau's scheme.
export function casteljau(points, u) {
  let row = points;
  while (row.length > 1) row = row.slice(1).map((p, k) => p.map((value, axis) => (1 - u) * row[k][axis] + u * value));
  return row[0];
}

// Returns the elements of a layer after the first events, as a set of texts.
export function elementsAfter(structure, layerName, events) {
  const layer = structure.layers.find(({ name }) => name === layerName);
  const set = new Set(layer.initial.map(String));
  for (const event of structure.events.slice(0, events)) {
    for (const change of (event.changes ?? []).filter((c) => c.layer === layerName)) {
      change.removed.forEach((element) => set.delete(String(element)));
      change.added.forEach((element) => set.add(String(element)));
    }
  }
  return set;
}
