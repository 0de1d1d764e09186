#pragma once
// The chords of four spheres in lanes (sphere_chord.h) in linear motion. Here all terms between both ends are
// u (1-u) times known factors.
//
// Let D denote the difference between both ends. The residual of ball i is linear between its ends'
// roundings, less u (1-u) ((|D c_i|^2 - (D s_i)^2) / 2 + D s_i D rho' - D c_i.D z'). The point sum w_i c_i,
// in the hull, differs from z' by u (1-u) b, b = sum D w_i D c_i, so z' leaves the hull by the component of
// this along its normal. And |z'| sags by at most u (1-u) |D z'|^2 / (2 min |z'|). So every bound here has
// the form R + 4 u (1-u) Q, where R is the rounding and Q is the most at u = 1/2.
//
// Consider a quantity that equals a linear function from a to b up to such a bound, with a' = a - R and b' =
// b - R. The quantity is positive if a' and b' are positive and a' + b' + 2 sqrt(a' b') > 4 Q. The quantity
// is positive from u = d on if a' + d (b' - a') > 4 d Q and b' - a' > 4 Q, since it then rises there.
//
// Normals and volumes are bounded by their Bernstein coefficients. In a bilinear product, the middle
// coefficient is half of the sum of both ends' products less the product of the two D. The slope q, the least
// solution of c_i.q = s_i, has another bound besides the one by heights. With q' the slope at the start, the
// residuals s_i - c_i.q', linear in u, bound the distance of q from the component of q' in the hull, which is
// no longer than q'.

#include <array>

#include "structures/moving_sphere/chord_lanes.h"

namespace kds::detail {

/// Replaces `margin` in linear motion: a control point is rounded by up to 9 units of 2^-53 of the input
/// lengths, a volume or a residual by 60, which is below 2^-47.
inline constexpr double linear_margin = 0x1p-45;

/// The parts R and Q of a bound.
struct Stray {
  Lanes rounded, between;

  [[gnu::always_inline]] Stray operator+(const Stray& o) const {
    return {rounded + o.rounded, between + o.between};
  }
  [[gnu::always_inline]] Stray operator*(const Lanes& by) const { return {rounded * by, between * by}; }
  [[gnu::always_inline]] Lanes most() const { return rounded + between; }
};

/// Quantities of the balls that all spheres of one size need, in the notation of chord_lanes.h. `off_hull`
/// refers to b.
template <std::size_t M>
struct LinearSimplex {
  std::array<Lanes, M> gain;
  Lanes gain_of_first, volume;
  Lanes off_hull;  // the part Q of the distance of z' from the hull, times the volume
};

template <int D, std::size_t M>
[[gnu::always_inline]] inline LinearSimplex<M> linear_simplex_of(const std::array<Vec<D>, M>& a,
                                                                 const std::array<Vec<D>, M>& b,
                                                                 const std::array<Vec<D>, M>& step,
                                                                 const Vec<D>& bend) {
  LinearSimplex<M> simplex;
  simplex.off_hull = Lanes(0.0);
  const Lanes half(0.5);
  const auto square = [](const Vec<D>& v) __attribute__((always_inline)) { return dot(v, v); };
  const auto longer = [&](const Vec<D>& v, const Vec<D>& w) __attribute__((always_inline)) {
    return root(Lanes::max(dot(v, v), dot(w, w)));
  };
  if constexpr (M == 1) {
    simplex.gain[0] = simplex.gain_of_first = Lanes(1.0);
    simplex.volume = half * (root(square(a[0])) + root(square(b[0])) - root(square(step[0])));
    simplex.off_hull = Lanes(0.25) * root(square(bend)) * simplex.volume;
  } else if constexpr (M == 2) {
    simplex.gain = {longer(a[1], b[1]), longer(a[0], b[0])};
    simplex.gain_of_first = longer(minus(a[1], a[0]), minus(b[1], b[0]));
    if constexpr (D == 2) {
      const auto area = [](const std::array<Vec<D>, M>& v) __attribute__((always_inline)) {
        return v[0][0] * v[1][1] - v[0][1] * v[1][0];
      };
      const Lanes first = area(a), last = area(b), middle = half * (first + last - area(step));
      const Lanes::Mask falls = first < Lanes(0.0);
      const auto upright = [&](const Lanes& x) __attribute__((always_inline)) {
        return Lanes::choose(falls, -x, x);
      };
      simplex.volume = Lanes::min(upright(first), Lanes::min(upright(middle), upright(last)));
    } else {
      const Vec<3> first = cross(a[0], a[1]), last = cross(b[0], b[1]), both = cross(step[0], step[1]);
      Vec<3> along, middle;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        along[axis] = first[axis] + last[axis];
        middle[axis] = half * (along[axis] - both[axis]);
      }
      simplex.volume = Lanes::min(dot(first, along), Lanes::min(dot(middle, along), dot(last, along))) /
                       root(square(along));
      simplex.off_hull = Lanes(0.25) * Lanes::max(abs(dot(first, bend)),
                                                  Lanes::max(abs(dot(middle, bend)), abs(dot(last, bend))));
    }
  } else {
    const std::array<Vec<3>, 3> first{cross(a[1], a[2]), cross(a[2], a[0]), cross(a[0], a[1])};
    const std::array<Vec<3>, 3> last{cross(b[1], b[2]), cross(b[2], b[0]), cross(b[0], b[1])};
    const std::array<Lanes, 4> volume{
        dot(a[0], first[0]),
        Lanes(1.0 / 3) * (dot(b[0], first[0]) + dot(b[1], first[1]) + dot(b[2], first[2])),
        Lanes(1.0 / 3) * (dot(a[0], last[0]) + dot(a[1], last[1]) + dot(a[2], last[2])), dot(b[0], last[0])};
    const Lanes::Mask falls = volume[0] < Lanes(0.0);
    simplex.volume = abs(volume[0]);
    for (std::size_t k = 1; k < 4; ++k)
      simplex.volume = Lanes::min(simplex.volume, Lanes::choose(falls, -volume[k], volume[k]));
    // The middle term of a product of two steps is below half the sum of their squares.
    const std::array<Lanes, 3> steps{square(step[0]), square(step[1]), square(step[2])};
    const Lanes sum = steps[0] + steps[1] + steps[2];
    Vec<3> first_sum, last_sum;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      first_sum[axis] = first[0][axis] + first[1][axis] + first[2][axis];
      last_sum[axis] = last[0][axis] + last[1][axis] + last[2][axis];
    }
    for (std::size_t i = 0; i < 3; ++i)
      simplex.gain[i] = longer(first[i], last[i]) + Lanes(0.125) * (sum - steps[i]);
    simplex.gain_of_first = longer(first_sum, last_sum) + Lanes(0.25) * (sum + steps[0]);
  }
  return simplex;
}

template <int D, std::size_t M, bool equal>
void find_linear_chords(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads, const PeriodLanes& period,
                        ChordLanes<D>& chords) {
  const Lanes half(0.5);
  std::array<Vec<D>, M> a, b, c;  // curves relative to the first ball: their ends, and the steps between
  std::array<Lanes, M> sa, sb, sc;
  Lanes size(0.0);
  for (int axis = 0; axis < D + (equal ? 0 : 1); ++axis) {
    const auto row = static_cast<std::size_t>(axis);
    const double *from = paths.column(0, axis), *to = paths.column(1, axis);
    const Lanes base_from = gather(from, beads[0]), base_to = gather(to, beads[0]);
    for (std::size_t i = 0; i < M; ++i) {
      std::array<Lanes, 2> control{gather(from, beads[i + 1]) - base_from,
                                   gather(to, beads[i + 1]) - base_to};
      size = Lanes::max(size, Lanes::max(abs(control[0]), abs(control[1])));
      cut(control, period);
      (axis < D ? a[i][row] : sa[i]) = control[0];
      (axis < D ? b[i][row] : sb[i]) = control[1];
      (axis < D ? c[i][row] : sc[i]) = control[1] - control[0];
    }
  }
  size = size * Lanes(root_of[3]);  // no coordinate curve is longer
  // Within these limits, products neither overflow nor become subnormal.
  Lanes::Mask proved = (size > Lanes(0x1p-150)) & (Lanes(paths.extent()) < Lanes(0x1p150));
  const std::array<End<D, M>, 2> end{end_of<equal, D, M>(a, sa), end_of<equal, D, M>(b, sb)};
  const Vec<D> turn = minus(end[1].z, end[0].z);
  std::array<Lanes, 2> length{end[0].rho, end[1].rho};
  Lanes mismatch(0.0);  // difference of |z'| and rho' at the ends
  if constexpr (!equal) {
    for (std::size_t e = 0; e < 2; ++e) {
      length[e] = root(dot(end[e].z, end[e].z));
      mismatch = Lanes::max(mismatch, abs(length[e] - end[e].rho));
    }
  }
  const Lanes l = Lanes::max(size, Lanes::max(length[0], length[1]));
  const Lanes rounding = Lanes(linear_margin) * l;

  // Bounds the distance of z' from the point sum w_i c_i, at the ends and between.
  Lanes heaviest(1.0), apart_at_ends(0.0);
  for (const End<D, M>& e : end)
    for (const Lanes& w : e.weight) heaviest = Lanes::max(heaviest, abs(w));
  const Lanes weight_rounding = heaviest * rounding;
  Vec<D> bend;
  for (std::size_t axis = 0; axis < D; ++axis) {
    Lanes first = end[0].z[axis], last = end[1].z[axis];
    bend[axis] = (end[1].weight[1] - end[0].weight[1]) * c[0][axis];
    for (std::size_t i = 0; i < M; ++i) {
      if (i > 0) bend[axis] += (end[1].weight[i + 1] - end[0].weight[i + 1]) * c[i][axis];
      first -= end[0].weight[i + 1] * a[i][axis];
      last -= end[1].weight[i + 1] * b[i][axis];
    }
    apart_at_ends += Lanes::max(abs(first), abs(last));
  }
  const Stray combined{apart_at_ends + weight_rounding, Lanes(0.25) * root(dot(bend, bend))};

  const LinearSimplex<M> simplex = linear_simplex_of<D, M>(a, b, c, bend);
  Lanes power(1.0);  // size to the power M - 1
  for (std::size_t i = 1; i < M; ++i) power = power * size;
  const Lanes volume = simplex.volume * Lanes(1 - 0x1p-30) - Lanes(linear_margin) * power * size;
  proved &= volume > Lanes(0.0);
  const Lanes over = Lanes(up) / volume;

  // Uses x = z' + (term from the residuals) + (slope of the radii) * (rho - rho').
  Stray stray{power * size * rounding * over, Lanes(0.0)};
  if constexpr (M < D) {
    stray.rounded += power * size * combined.rounded * over;
    stray.between = simplex.off_hull * over;
  }
  SlopeBound slope{Lanes(0.0), equal ? Lanes(0.0) : root(dot(end[0].q, end[0].q)), Lanes(0.0)};
  for (std::size_t i = 0; i < M; ++i) {
    Lanes first = half * dot(a[i], a[i]) - dot(a[i], end[0].z);
    Lanes last = half * dot(b[i], b[i]) - dot(b[i], end[1].z);
    Lanes between = half * dot(c[i], c[i]) - dot(c[i], turn);
    if constexpr (!equal) {
      first += sa[i] * (end[0].rho - half * sa[i]);
      last += sb[i] * (end[1].rho - half * sb[i]);
      between += sc[i] * ((end[1].rho - end[0].rho) - half * sc[i]);
    }
    const Lanes gain = (simplex.gain[i] + Lanes(linear_margin) * power) * over;
    stray.rounded += gain * (Lanes::max(abs(first), abs(last)) + l * rounding);
    stray.between += gain * (Lanes(0.25) * abs(between));
    if constexpr (!equal) {
      slope.most += gain * (Lanes::max(abs(sa[i]), abs(sb[i])) + Lanes(linear_margin) * size);
      const Lanes off = Lanes::max(abs(sa[i] - dot(a[i], end[0].q)), abs(sb[i] - dot(b[i], end[0].q)));
      slope.wander += gain * (off + Lanes(linear_margin) * size * (Lanes(1.0) + slope.at_start));
    }
  }
  slope.most = Lanes::min(slope.most, (slope.at_start + slope.wander) * Lanes(up));
  const Lanes change = dot(turn, turn);
  const Lanes nearest = half * (length[0] + length[1] - root(change)) - rounding;
  proved &= nearest > Lanes(0.0);
  const Stray sag{mismatch + rounding, change / (Lanes(8.0) * nearest) * Lanes(up)};
  Stray radius_strays = (sag + stray) * Lanes(up);
  Stray strays = stray * Lanes(up);
  if constexpr (!equal) {
    const Lanes ahead = Lanes::max(dot(end[0].z, end[0].q), dot(end[1].z, end[0].q));
    const Lanes lead = least_lead(slope, ahead, nearest, Lanes::max(length[0], length[1]) + rounding,
                                  stray.most(), sag.most());
    proved &= lead > Lanes(little_lead);
    radius_strays = radius_strays * (Lanes(up) / lead);
    strays = (stray + radius_strays * slope.most) * Lanes(up);
  }

  // Distance of x from the combination, by the heights.
  const Stray apart = (strays + combined) * (over * Lanes(up));
  chords.stays = chords.rises = Lanes::Mask{};
  for (std::size_t i = 0; i <= M; ++i) {
    const Lanes gain = (i == 0 ? simplex.gain_of_first : simplex.gain[i - 1]) + Lanes(linear_margin) * power;
    const Lanes rounded = apart.rounded * gain + heaviest * Lanes(linear_margin);
    const Lanes first = end[0].weight[i] - rounded, last = end[1].weight[i] - rounded;
    const Lanes lost = Lanes(4 * up) * apart.between * gain, least = Lanes::min(first, last);
    const Lanes::Mask bit = Lanes::Mask{} + (1L << i);
    chords.stays |= (least > Lanes(0.0)) & (first + last + (least + least) > lost) & bit;
    chords.rises |= (first + period.sure * (last - first) > period.sure * lost) & (last - first > lost) & bit;
  }
  // Each ball is touched from outside.
  Lanes room = Lanes::min(end[0].rho, end[1].rho);
  if constexpr (!equal) {
    for (std::size_t i = 0; i < M; ++i)
      room = Lanes::min(room, Lanes::min(end[0].rho - sa[i], end[1].rho - sb[i]));
  }
  proved &= room > radius_strays.most() + rounding;
  chords.dip = strays.between + radius_strays.between;
  const Lanes loss = strays.rounded + radius_strays.rounded + chords.dip +
                     Lanes(linear_margin) * (Lanes(paths.extent()) + l);
  for (std::size_t e = 0; e < 2; ++e) {
    chords.center[e] = end[e].z;
    chords.limit[e] = end[e].rho - loss;
  }
  chords.proved = proved & (loss < Lanes(4.0) * l);  // false too if a bound is NaN
}

}  // namespace kds::detail
