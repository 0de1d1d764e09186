#pragma once
// Four spheres at once, in lanes: parts of a step, the chords as they are computed (sphere_chord.h), and, in
// double, the tangent spheres of four bases with the ingredients of their error bounds.

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "certificates/base/determinant.h"
#include "certificates/filters/lanes_descent.h"
#include "motions/numbers/bernstein.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/sphere_of_balls.h"
#include "structures/enclosing_sphere/sphere_of_points.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

/// Bounds of polynomials and curves on [0,1] by their Bernstein coefficients, four at once. The bounds are
/// computed in double and rounded as written; the caller allows for the rounding.
template <int N>
using PolynomialLanes = Bernstein<Lanes, N>;
template <int N, int Dimension>
using CurveLanes = BernsteinVector<Lanes, N, Dimension>;

[[gnu::always_inline]] inline Lanes root(const Lanes& square) { return NumberTraits<Lanes>::sqrt(square); }

template <int N>
[[gnu::always_inline]] inline Lanes coefficient(const PolynomialLanes<N>& p, std::size_t k) {
  const double by = 1.0 / static_cast<double>(binomial(N, static_cast<int>(k)));
  return p.scaled[k] * Lanes(by);
}
template <int N>
[[gnu::always_inline]] inline Lanes least(const PolynomialLanes<N>& p) {
  Lanes lowest = p.scaled[0];
  for (std::size_t k = 1; k <= N; ++k) lowest = Lanes::min(lowest, coefficient(p, k));
  return lowest;
}
template <int N>
[[gnu::always_inline]] inline Lanes most(const PolynomialLanes<N>& p) {
  Lanes highest = abs(p.scaled[0]);
  for (std::size_t k = 1; k <= N; ++k) highest = Lanes::max(highest, abs(coefficient(p, k)));
  return highest;
}

template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes square(const std::array<PolynomialLanes<N>, Size>& v, std::size_t k) {
  Lanes sum = coefficient(v[0], k) * coefficient(v[0], k);
  for (std::size_t i = 1; i < Size; ++i) sum += coefficient(v[i], k) * coefficient(v[i], k);
  return sum;
}
/// Returns an upper bound of the length of a vector of polynomials on [0,1].
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes most(const std::array<PolynomialLanes<N>, Size>& v) {
  Lanes highest = square(v, 0);
  for (std::size_t k = 1; k <= N; ++k) highest = Lanes::max(highest, square(v, k));
  return root(highest);
}

/// A polynomial that vanishes at both ends is at most this share of its largest coefficient: 1 - u^N -
/// (1-u)^N <= 1 - 2^(1-N).
template <int N>
inline constexpr double share_between = [] {
  double share = 1;
  for (int k = 1; k < N; ++k) share /= 2;
  return 1 - share;
}();
/// Returns an upper bound like `most`, which is sharper if the polynomial nearly vanishes at both ends.
template <int N>
[[gnu::always_inline]] inline Lanes most_between(const PolynomialLanes<N>& p) {
  Lanes inner(0.0);
  for (std::size_t k = 1; k < N; ++k) inner = Lanes::max(inner, abs(coefficient(p, k)));
  return Lanes(share_between<N>) * inner + Lanes::max(abs(p.scaled[0]), abs(p.scaled[N]));
}
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes most_between(const std::array<PolynomialLanes<N>, Size>& v) {
  Lanes inner(0.0);
  for (std::size_t k = 1; k < N; ++k) inner = Lanes::max(inner, square(v, k));
  return Lanes(share_between<N>) * root(inner) + root(Lanes::max(square(v, 0), square(v, N)));
}

/// Returns a lower bound of the absolute value.
template <int N>
[[gnu::always_inline]] inline Lanes least_magnitude(const PolynomialLanes<N>& p) {
  const Lanes::Mask falls = p.scaled[0] < Lanes(0.0);
  Lanes lowest = abs(p.scaled[0]);
  for (std::size_t k = 1; k <= N; ++k) {
    const Lanes value = coefficient(p, k);
    lowest = Lanes::min(lowest, Lanes::choose(falls, -value, value));
  }
  return lowest;
}
/// Returns a lower bound of the length: the length of the projection on the sum of both ends.
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes least_length(const std::array<PolynomialLanes<N>, Size>& v) {
  std::array<Lanes, Size> along;
  for (std::size_t i = 0; i < Size; ++i) along[i] = v[i].scaled[0] + v[i].scaled[N];
  Lanes square(0.0), lowest(HUGE_VAL);
  for (const Lanes& x : along) square += x * x;
  for (std::size_t k = 0; k <= N; ++k) {
    Lanes projection(0.0);
    for (std::size_t i = 0; i < Size; ++i) projection += coefficient(v[i], k) * along[i];
    lowest = Lanes::min(lowest, projection);
  }
  return lowest / root(square);
}

/// The shares of the step to cut off: first those before the period, then those after it.
struct PeriodLanes {
  Lanes from, to;
  Lanes sure;  // as a share of the period
  bool whole;  // nothing is cut off

  /// Takes up to four periods; the last one fills the remaining lanes.
  explicit PeriodLanes(std::span<const Period> periods) {
    const std::size_t last = periods.size() - 1;
    const Period &a = periods[0], &b = periods[std::min<std::size_t>(1, last)],
                 &c = periods[std::min<std::size_t>(2, last)], &d = periods[std::min<std::size_t>(3, last)];
    from = Lanes::Vector{a.from, b.from, c.from, d.from};
    const Lanes until = Lanes::Vector{a.to, b.to, c.to, d.to};
    const Lanes until_sure = Lanes::Vector{a.sure, b.sure, c.sure, d.sure};
    to = (until - from) / (Lanes(1.0) - from);
    sure = Lanes::max(until_sure - from, Lanes(0.0)) / (until - from);
    whole = Lanes::all((from <= Lanes(0.0)) & (until >= Lanes(1.0)));
  }
};

/// Computes the control points of the part from those of the step.
template <std::size_t N>
[[gnu::always_inline]] inline void cut(std::array<Lanes, N>& control, const PeriodLanes& period) {
  if (period.whole) return;
  casteljau(control, period.from);
  casteljau_left(control, period.to);
}

/// Returns the lanes where all distances, given by their squares, are within the available room.
template <std::size_t N>
[[gnu::always_inline]] inline Lanes::Mask are_within(const std::array<Lanes, N>& square,
                                                     const std::array<Lanes, N>& room) {
  Lanes::Mask within = (room[0] >= Lanes(0.0)) & (square[0] <= room[0] * room[0]);
  for (std::size_t k = 1; k < N; ++k) within &= (room[k] >= Lanes(0.0)) & (square[k] <= room[k] * room[k]);
  return within;
}

template <int Dimension>
struct ChordLanes {
  using Vector = std::array<Lanes, static_cast<std::size_t>(Dimension)>;

  std::array<Vector, 2> center;
  std::array<Lanes, 2> limit;
  Lanes dip = Lanes(0.0);
  Lanes::Mask proved, stays, rises{};

  /// Writes a lane in place, because copying a chord built elsewhere is slow.
  [[gnu::always_inline]] void give(std::size_t lane, SphereChord<Dimension>& chord) const {
    chord.proved = proved[lane] != 0;
    chord.stays = static_cast<std::uint8_t>(stays[lane]);
    chord.rises = static_cast<std::uint8_t>(rises[lane]);
    chord.dip = dip.v[lane];
    for (std::size_t e = 0; e < 2; ++e) {
      chord.limit[e] = limit[e].v[lane];
      for (std::size_t axis = 0; axis < Dimension; ++axis) chord.center[e][axis] = center[e][axis].v[lane];
    }
  }
};

/// Finds the chords of up to four bases of one size.
template <int Dimension>
void find_chords(const BeadPaths<Dimension>& paths, std::span<const Basis> bases, const PeriodLanes& period,
                 ChordLanes<Dimension>& chords);

namespace detail {

// Relative to the input lengths. The worst case is four balls in cubic motion in a part of the step: a
// control point is rounded by up to 37 units of 2^-53, a product of three by 130, a residual with its sphere
// by 220, which is below 2^-45.
inline constexpr double margin = 0x1p-42;
inline constexpr double up = 1 + 0x1p-30;

template <int D>
using Vec = std::array<Lanes, static_cast<std::size_t>(D)>;

template <std::size_t Size>
[[gnu::always_inline]] inline Lanes length(const std::array<Lanes, Size>& v) {
  return root(dot(v, v));
}

/// The beads of four bases, bead by bead.
template <std::size_t Size>
using BeadLanes = std::array<std::array<BeadId, Lanes::width>, Size>;

template <std::size_t Size>
BeadLanes<Size> beads_of(std::span<const Basis> bases) {
  BeadLanes<Size> beads;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
    const Basis& basis = bases[std::min(lane, bases.size() - 1)];
    for (std::size_t i = 0; i < Size; ++i) beads[i][lane] = basis.beads[i];
  }
  return beads;
}
[[gnu::always_inline]] inline Lanes gather(const double* column, const std::array<BeadId, Lanes::width>& at) {
  return Lanes::Vector{column[at[0]], column[at[1]], column[at[2]], column[at[3]]};
}

/// The tangent sphere at one time, relative to the first ball.
template <int D, std::size_t M>
struct End {
  Vec<D> z;
  Lanes rho;
  std::array<Lanes, M + 1> weight;  // barycentric coordinates of z
  Vec<D> q;                         // unequal radii: derivative of z with respect to rho
};

template <bool equal, int D, std::size_t M>
[[gnu::always_inline]] inline End<D, M> end_of(const std::array<Vec<D>, M>& d,
                                               const std::array<Lanes, M>& s) {
  BasisBalls<Lanes, D, M> balls;
  balls.center[0].fill(Lanes(0.0));
  for (std::size_t i = 0; i < M; ++i) balls.center[i + 1] = d[i];
  const Span<Lanes, D, M> span(balls);
  if constexpr (equal) {
    End<D, M> end;
    std::array<Lanes, M> weight;
    end.z = span.circumcenter(weight);
    end.rho = root(dot(end.z, end.z));
    end.weight[0] = Lanes(1.0);
    for (std::size_t i = 0; i < M; ++i) {
      end.weight[i + 1] = weight[i];
      end.weight[0] -= weight[i];
    }
    return end;
  } else {
    const TangentSphere<Lanes, D, M> sphere = tangent_sphere(span, s);
    return {sphere.center, sphere.rho, sphere.weight, sphere.q};
  }
}

/// The condition of solving for a point by its dot products with the c_i: with residuals r_i, the point's
/// error is at most sum gain_i |r_i| / volume. For i > 0, the inverse height of ball i is gain_i / volume
/// too.
template <std::size_t M>
struct Simplex {
  std::array<Lanes, M> gain;
  Lanes gain_of_first;
  Lanes volume;    // the least volume
  Lanes off_hull;  // how far z' leaves the affine hull, times the volume
};

template <int D, std::size_t M, int K>
[[gnu::always_inline]] inline Simplex<M> simplex_of(const std::array<CurveLanes<K, D>, M>& d,
                                                    const CurveLanes<1, D>& z) {
  Simplex<M> simplex;
  simplex.off_hull = Lanes(0.0);
  if constexpr (M == 1) {
    simplex.gain[0] = simplex.gain_of_first = Lanes(1.0);
    simplex.volume = least_length(d[0]);
    if constexpr (D == 2) {
      simplex.off_hull = most_between(d[0][0] * z[1] - d[0][1] * z[0]);
    } else {
      simplex.off_hull = most_between(std::array{
          d[0][1] * z[2] - d[0][2] * z[1], d[0][2] * z[0] - d[0][0] * z[2], d[0][0] * z[1] - d[0][1] * z[0]});
    }
  } else if constexpr (M == 2) {
    simplex.gain = {most(d[1]), most(d[0])};
    auto edge = d[1];
    for (std::size_t axis = 0; axis < D; ++axis) edge[axis] -= d[0][axis];
    simplex.gain_of_first = most(edge);
    if constexpr (D == 2) {
      simplex.volume = least_magnitude(minor(d[0][0], d[0][1], d[1][0], d[1][1]));
    } else {
      const auto normal = kds::cross(d[0], d[1]);
      simplex.volume = least_length(normal);
      simplex.off_hull = most_between(dot(normal, z));
    }
  } else {
    std::array<CurveLanes<2 * K, 3>, 3> normals{kds::cross(d[1], d[2]), kds::cross(d[2], d[0]),
                                                kds::cross(d[0], d[1])};
    simplex.volume = least_magnitude(dot(normals[0], d[0]));
    for (std::size_t i = 0; i < 3; ++i) simplex.gain[i] = most(normals[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) normals[0][axis] += normals[1][axis] + normals[2][axis];
    simplex.gain_of_first = most(normals[0]);
  }
  return simplex;
}

/// Bounds of the slope q (sphere_chord.h): its length at any time and at the start, and its distance from the
/// component in the hull of the slope at the start.
struct SlopeBound {
  Lanes most, at_start, wander;
};

/// Returns L of sphere_chord.h: 1 - n.q >= L wherever |rho - rho'| <= (sag + stray) / L. If the result is not
/// positive, nothing is known. `ahead` is an upper bound of z'.q for the q at the start; `nearest` and
/// `longest` bound |z'|.
[[gnu::always_inline]] inline Lanes least_lead(const SlopeBound& slope, const Lanes& ahead,
                                               const Lanes& nearest, const Lanes& longest, const Lanes& stray,
                                               const Lanes& sag) {
  const Lanes along = ahead / Lanes::choose(ahead > Lanes(0.0), nearest, longest);
  const Lanes lead =
      (Lanes(1.0) - along) - slope.wander * Lanes(up) - Lanes(margin) * (Lanes(1.0) + slope.at_start);
  // The bound so far is for z'/|z'|. The unit vector n, in the hull, differs from it by at most 2 |x - z'| /
  // |z'|. If that costs at most a quarter, three quarters may stand for L in the bound of how far x strays.
  // The margin then suffices too: sag is below nearest, so longest is not much more than nearest.
  const Lanes reach = stray + slope.most * (sag + stray) / (Lanes(0.75) * lead);
  const Lanes turned = Lanes(2 * up) * slope.at_start * reach / nearest;
  const Lanes::Mask known = (nearest > Lanes(0.0)) & (lead > Lanes(0.0)) & (turned < Lanes(0.25 / up) * lead);
  const Lanes in_any_direction = Lanes(1.0) - slope.most;
  return Lanes::max(in_any_direction, Lanes::choose(known, lead - turned, in_any_direction));
}

/// Least lead for which results count as proved.
inline constexpr double little_lead = 0.02;

}  // namespace detail

}  // namespace kds
