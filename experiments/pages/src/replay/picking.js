// The bead under the pointer, in parallel projection.

// Returns the nearest bead whose ball covers the point, or -1. `right`, `up` and `back` are the camera's axes, (x, y) is the
// point in the camera's plane relative to `eye`, `size(b)` the drawn radius.
export function beadAt(positions, beads, camera, x, y, size) {
  const { eye, right, up, back } = camera;
  let best = -1;
  let nearest = -Infinity;
  for (let b = 0; b < beads; ++b) {
    const px = positions[3 * b] - eye[0];
    const py = positions[3 * b + 1] - eye[1];
    const pz = positions[3 * b + 2] - eye[2];
    const dx = px * right[0] + py * right[1] + pz * right[2] - x;
    const dy = px * up[0] + py * up[1] + pz * up[2] - y;
    const r = size(b);
    const inside = r * r - dx * dx - dy * dy;
    if (inside < 0) continue;
    const depth = px * back[0] + py * back[1] + pz * back[2] + Math.sqrt(inside);
    if (depth > nearest) [nearest, best] = [depth, b];
  }
  return best;
}
