// The sphere of a cage: the smallest ball that encloses the balls of its basis and touches each of them. With c and R for
// centre and radius, |c - p_i| = R - r_i for every ball. Differences of these equations are linear in c and R, which
// leaves one quadratic equation for R. The centre lies in the affine hull of the balls' centres.

const flat = 1e-10;  // share of the largest squared distance below which a ball adds no direction

// Writes x, y, z and radius of the sphere to out[at..at+3]. `positions` has x, y, z of each bead. Returns false if the balls
// have no such sphere.
export function sphereOfBasis(basis, positions, radius, out, at) {
  const [p0x, p0y, p0z] = [positions[3 * basis[0]], positions[3 * basis[0] + 1], positions[3 * basis[0] + 2]];
  const r0 = radius(basis[0]);
  // Rows of an orthogonal system (Gram and Schmidt): direction e_k, and the coordinate of the centre along e_k,
  // constant[k] + slope[k] * (R - r0).
  const directions = [];
  const constant = [];
  const slope = [];
  let least = 0;
  let scale = 0;
  for (let i = 1; i < basis.length; ++i) {
    const b = basis[i];
    let x = positions[3 * b] - p0x;
    let y = positions[3 * b + 1] - p0y;
    let z = positions[3 * b + 2] - p0z;
    const s = radius(b) - r0;
    const square = x * x + y * y + z * z;
    least = Math.max(least, s);
    scale = Math.max(scale, square);
    let rest = (square - s * s) / 2;
    let rise = s;
    for (let k = 0; k < directions.length; ++k) {
      const [ex, ey, ez] = directions[k];
      const share = x * ex + y * ey + z * ez;
      x -= share * ex;
      y -= share * ey;
      z -= share * ez;
      rest -= share * constant[k];
      rise -= share * slope[k];
    }
    const length = Math.sqrt(x * x + y * y + z * z);
    if (length * length <= flat * scale) continue;
    directions.push([x / length, y / length, z / length]);
    constant.push(rest / length);
    slope.push(rise / length);
  }
  // (sum slope^2 - 1) t^2 + 2 (sum constant slope) t + sum constant^2 = 0 for t = R - r0 >= least
  let a = -1;
  let half = 0;
  let c = 0;
  for (let k = 0; k < directions.length; ++k) {
    a += slope[k] * slope[k];
    half += constant[k] * slope[k];
    c += constant[k] * constant[k];
  }
  const t = leastRoot(a, half, c, least - 1e-9 * Math.sqrt(scale));
  if (Number.isNaN(t)) return false;
  out[at] = p0x;
  out[at + 1] = p0y;
  out[at + 2] = p0z;
  out[at + 3] = r0 + t;
  for (let k = 0; k < directions.length; ++k) {
    const along = constant[k] + slope[k] * t;
    for (let axis = 0; axis < 3; ++axis) out[at + axis] += along * directions[k][axis];
  }
  return true;
}

// Returns the least root of a t^2 + 2 half t + c that is at least `least`, or NaN.
function leastRoot(a, half, c, least) {
  if (Math.abs(a) < 1e-14) return half === 0 ? NaN : atLeast(-c / (2 * half), NaN, least);
  const square = half * half - a * c;
  if (square < -1e-12 * (half * half + Math.abs(a * c))) return NaN;  // a ball lies inside another
  const root = Math.sqrt(Math.max(0, square));
  const q = -(half + (half < 0 ? -root : root));  // avoids cancellation
  return q === 0 ? atLeast(0, NaN, least) : atLeast(q / a, c / q, least);
}

function atLeast(first, second, least) {
  const [low, high] = first < second || Number.isNaN(second) ? [first, second] : [second, first];
  if (low >= least) return low;
  return high >= least ? high : NaN;
}
