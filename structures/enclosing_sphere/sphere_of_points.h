#pragma once
// Minimum enclosing spheres of points (the centres of balls of equal radii) in double, with proved errors:
// the sphere of a basis, and the basis after a point has escaped. Allocates no memory. A result that is not
// proved is marked as such.
//
// The centre z~ may be any doubles near the true centre z = c_0 + Q y, where Q = [d_1 .. d_m], d_i = c_i -
// c_0. The residuals of z~ bound its error. Let t_i = |c_i - z~|^2, each rounded to within 6u of its size,
// and S the spread of the t_i including that rounding. |c_i - z| is equal for all i, so 2 d_i.(z - z~) =
// t_i - t_0. The part of z - z~ in the span of Q is therefore at most E' = sqrt(m) S / (2 sigma), where
// sigma is the least singular value of Q. This value satisfies sigma^2 >= det G / (tr G / (m-1))^(m-1) for G
// = Q^T Q.
//
// If the basis spans all of space, this is the whole error. Otherwise z~ was computed from weights in [0,1]
// and leaves the span by no more than its rounding, O = 2u max|z~_k| + 64u R. A midpoint has the error O
// alone. With E = E' + O:
//
//   |p - z~| <= R~ - 2E   implies   |p - z| <= |p - z~| + E <= |c_i - z~| - E <= |c_i - z|:   p is inside,
//
// and likewise for outside. R~ is the greatest of the computed |c_i - z~|. R~ equals R to within the spread
// and (E/R)^2: the squared radius of any sphere that holds the basis is at least the weighted mean of the
// t_i less the squared distance of the weighted mean of the points from z~. The weights have errors of at
// most 2 (E + O) / sigma. The basis has no superfluous bead if all weights are greater.
//
// Determinants of rounded differences have errors of 16u (tr G)^2 for m = 2; the root of the determinant for
// m = 3 has an error of 16u (tr G)^(3/2). The code requires values 200 times as large as these errors. All
// bounds hold for 2^-300 <= tr G <= 2^300, so that nothing overflows and underflow is far below the bounds.

#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>

#include "motions/numbers/lanes.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/necklace/balls.h"

namespace kds {

template <class N>
concept LanesOrDouble = std::same_as<N, double> || std::same_as<N, Lanes>;

/// Operations beyond arithmetic that formulas need, for a single double and for four in lanes.
template <LanesOrDouble N>
struct NumberTraits;

template <>
struct NumberTraits<double> {
  using Flag = bool;
  [[gnu::always_inline]] static double choose(bool flag, double a, double b) { return flag ? a : b; }
  [[gnu::always_inline]] static double max(double a, double b) { return a < b ? b : a; }
  [[gnu::always_inline]] static double min(double a, double b) { return b < a ? b : a; }
  [[gnu::always_inline]] static double abs(double a) { return std::abs(a); }
  [[gnu::always_inline]] static double sqrt(double a) { return std::sqrt(a); }
};

template <>
struct NumberTraits<Lanes> {
  using Flag = Lanes::Mask;
  [[gnu::always_inline]] static Lanes choose(const Flag& flag, const Lanes& a, const Lanes& b) {
    return Lanes::choose(flag, a, b);
  }
  [[gnu::always_inline]] static Lanes max(const Lanes& a, const Lanes& b) { return Lanes::max(a, b); }
  [[gnu::always_inline]] static Lanes min(const Lanes& a, const Lanes& b) { return Lanes::min(a, b); }
  [[gnu::always_inline]] static Lanes abs(const Lanes& a) { return Lanes::abs(a); }
  [[gnu::always_inline]] static Lanes sqrt(const Lanes& a) {
    // Built from all lanes at once, which compiles to a single instruction if the target allows it.
    return Lanes::Vector{std::sqrt(a.v[0]), std::sqrt(a.v[1]), std::sqrt(a.v[2]), std::sqrt(a.v[3])};
  }
};

template <int Dimension>
using Point = std::array<double, static_cast<std::size_t>(Dimension)>;

namespace detail {

inline constexpr double unit_roundoff = 0x1p-53;
inline constexpr std::array<double, 4> root_of{0, 1, 1.4143, 1.7321};

// The dot product of numbers; for polynomials see motions/.
template <LanesOrDouble N, std::size_t Size>
[[gnu::always_inline]] inline N dot(const std::array<N, Size>& a, const std::array<N, Size>& b) {
  N sum = a[0] * b[0];
  for (std::size_t i = 1; i < Size; ++i) sum = sum + a[i] * b[i];
  return sum;
}
template <LanesOrDouble N>
[[gnu::always_inline]] inline std::array<N, 3> cross(const std::array<N, 3>& a, const std::array<N, 3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
template <LanesOrDouble N, std::size_t Size>
[[gnu::always_inline]] inline std::array<N, Size> minus(const std::array<N, Size>& a,
                                                        const std::array<N, Size>& b) {
  std::array<N, Size> d;
  for (std::size_t i = 0; i < Size; ++i) d[i] = a[i] - b[i];
  return d;
}
template <int Dimension>
[[gnu::always_inline]] inline Point<Dimension> center_of(const Balls<Dimension>& balls, BeadId bead) {
  Point<Dimension> p;
  for (std::size_t axis = 0; axis < Dimension; ++axis) p[axis] = balls.coordinates(axis)[bead];
  return p;
}

/// The balls of a basis of M + 1, for one node or for four nodes in lanes.
template <class N, int Dimension, std::size_t M>
struct BasisBalls {
  std::array<std::array<N, static_cast<std::size_t>(Dimension)>, M + 1> center;
  std::array<N, M + 1> radius;  // unused for points
};

template <std::size_t M, int Dimension>
[[gnu::always_inline]] inline BasisBalls<double, Dimension, M> basis_balls(const Balls<Dimension>& balls,
                                                                           const Basis& basis) {
  BasisBalls<double, Dimension, M> b;
  for (std::size_t i = 0; i <= M; ++i) {
    b.center[i] = center_of(balls, basis.beads[i]);
    b.radius[i] = balls.radii()[basis.beads[i]];
  }
  return b;
}

/// Orders three balls so that the base is at the widest angle of their triangle. That angle is at least 60
/// degrees, so the linear system is well conditioned even if a side is short.
template <class N, int Dimension, std::size_t M>
[[gnu::always_inline]] inline BasisBalls<N, Dimension, M> from_widest(
    const BasisBalls<N, Dimension, M>& balls) {
  if constexpr (M != 2) return balls;
  using Is = NumberTraits<N>;
  BasisBalls<N, Dimension, M> turned = balls;
  const auto square = [&balls](std::size_t i, std::size_t j) __attribute__((always_inline)) {
    const auto d = minus(balls.center[i], balls.center[j]);
    return dot(d, d);
  };
  const auto exchange = [](const typename Is::Flag& flag, N& a, N& b) __attribute__((always_inline)) {
    const N kept = a;
    a = Is::choose(flag, b, a);
    b = Is::choose(flag, kept, b);
  };
  const N opposite0 = square(1, 2), opposite1 = square(0, 2), opposite2 = square(0, 1);
  const auto at1 = (opposite1 > opposite0) & (opposite1 >= opposite2);
  const auto at2 = (opposite2 > opposite0) & (opposite2 > opposite1);
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    exchange(at1, turned.center[0][axis], turned.center[1][axis]);
    exchange(at2, turned.center[0][axis], turned.center[2][axis]);
  }
  exchange(at1, turned.radius[0], turned.radius[1]);
  exchange(at2, turned.radius[0], turned.radius[2]);
  return turned;
}

/// The matrix Q of M points relative to a base, M = 1 to Dimension, with the solver of G y = Q^T v.
template <class N, int Dimension, std::size_t M>
struct Span {
  using Vector = std::array<N, static_cast<std::size_t>(Dimension)>;
  using Weights = std::array<N, M>;
  static constexpr bool by_normals = M == 3;

  std::array<Vector, M> d;
  std::array<N, M> square;        // |d_i|^2
  N trace;                        // the sum of squares
  N cosine;                       // M = 2: d_1.d_2
  N determinant;                  // M = 1, 2: of G; M = 3: of Q
  std::array<Vector, M> normals;  // M = 3: determinant times the rows of Q^-1
  N over;                         // 1 / determinant

  [[gnu::always_inline]] explicit Span(const BasisBalls<N, Dimension, M>& balls) {
    trace = N(0.0);
    for (std::size_t i = 0; i < M; ++i) {
      d[i] = minus(balls.center[i + 1], balls.center[0]);
      square[i] = dot(d[i], d[i]);
      trace = trace + square[i];
    }
    if constexpr (M == 1) {
      determinant = square[0];
    } else if constexpr (M == 2) {
      cosine = dot(d[0], d[1]);
      determinant = square[0] * square[1] - cosine * cosine;
    } else {
      normals = {cross(d[1], d[2]), cross(d[2], d[0]), cross(d[0], d[1])};
      determinant = dot(d[0], normals[0]);
    }
    over = N(1.0) / determinant;
  }
  /// Returns whether the determinant is accurate enough for the bounds. NaN is not.
  [[gnu::always_inline]] typename NumberTraits<N>::Flag sound() const {
    constexpr double error = 16 * unit_roundoff * 200;
    if constexpr (M == 1) return square[0] > N(0.0);
    if constexpr (M == 2) return determinant > N(error) * (square[0] * square[1]);
    return determinant * determinant > N(error * error) * (square[0] * square[1] * square[2]);
  }
  /// Returns an upper bound of 1 / sigma, valid if sound().
  [[gnu::always_inline]] N most_by_singular_value() const {
    using Is = NumberTraits<N>;
    if constexpr (M == 1) {
      return Is::sqrt(over) * N(1.01);
    } else if constexpr (M == 2) {
      return Is::sqrt(trace * over) * N(1.01);
    } else {
      return N(0.505) * trace * Is::abs(over);
    }
  }
  /// Returns the weights of the point p, relative to the base, or of its projection on the span.
  [[gnu::always_inline]] Weights weights_of(const Vector& p) const {
    if constexpr (by_normals) {
      return {dot(p, normals[0]) * over, dot(p, normals[1]) * over, dot(p, normals[2]) * over};
    } else if constexpr (M == 2) {
      return weights({dot(d[0], p), dot(d[1], p)});
    } else {
      return weights({dot(d[0], p)});
    }
  }
  /// Returns the weights of the point of the span whose dot products with the d_i are `h`, M <= 2.
  [[gnu::always_inline]] Weights weights(const std::array<N, M>& h) const {
    if constexpr (M == 1) {
      return {h[0] * over};
    } else {
      return {(square[1] * h[0] - cosine * h[1]) * over, (square[0] * h[1] - cosine * h[0]) * over};
    }
  }
  [[gnu::always_inline]] Vector combination(const Weights& y) const {
    Vector v;
    for (std::size_t axis = 0; axis < Dimension; ++axis) {
      v[axis] = y[0] * d[0][axis];
      for (std::size_t i = 1; i < M; ++i) v[axis] = v[axis] + y[i] * d[i][axis];
    }
    return v;
  }
  /// Returns the point of the span whose dot products with the d_i are `h`, and its weights.
  [[gnu::always_inline]] Vector point_of(const std::array<N, M>& h, Weights& y) const {
    if constexpr (by_normals) {
      Vector z;
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        z[axis] = (h[0] * normals[0][axis] + h[1] * normals[1][axis] + h[2] * normals[2][axis]) * over;
      y = weights_of(z);
      return z;
    } else {
      y = weights(h);
      return combination(y);
    }
  }
  /// Returns the centre of the sphere through all points, relative to the base, and all weights except the
  /// base's.
  [[gnu::always_inline]] Vector circumcenter(Weights& y) const {
    if constexpr (M == 1) {
      y[0] = N(0.5);
      return combination(y);
    }
    std::array<N, M> half;
    for (std::size_t i = 0; i < M; ++i) half[i] = N(0.5) * square[i];
    return point_of(half, y);
  }
};

}  // namespace detail

/// A sphere computed from a basis, or four of them in lanes.
template <class N, int Dimension>
struct BasisSphere {
  std::array<N, static_cast<std::size_t>(Dimension)> center;
  N radius;                                ///< the greatest computed from a basis bead
  N inner;                                 ///< beads within it are inside, if `certain` (see the scans)
  N outer;                                 ///< beads beyond it are outside; only likely unless `certain`
  N least;                                 ///< least weight: unless positive, a bead is likely superfluous
  typename NumberTraits<N>::Flag certain;  ///< the bounds are proved and no bead is superfluous
};

namespace detail {

/// Without `bounds`, computes only centre, radius and least weight.
template <bool bounds = true, class N, int Dimension, std::size_t M>
[[gnu::always_inline]] inline BasisSphere<N, Dimension> sphere_of_points(
    const BasisBalls<N, Dimension, M>& members) {
  using Is = NumberTraits<N>;
  constexpr double u = unit_roundoff;
  const auto balls = from_widest(members);
  const Span<N, Dimension, M> span(balls);
  typename Span<N, Dimension, M>::Weights y;
  const auto z = span.circumcenter(y);
  BasisSphere<N, Dimension> sphere;
  N rest(1.0);
  for (std::size_t i = 0; i < M; ++i) rest = rest - y[i];
  sphere.least = rest;
  for (std::size_t i = 0; i < M; ++i) sphere.least = Is::min(sphere.least, y[i]);
  N size(0.0);
  for (std::size_t axis = 0; axis < Dimension; ++axis) {
    sphere.center[axis] = balls.center[0][axis] + z[axis];
    size = Is::max(size, Is::abs(sphere.center[axis]));
  }
  N most(0.0), fewest(HUGE_VAL);
  for (std::size_t i = 0; i <= M; ++i) {
    const auto d = minus(balls.center[i], sphere.center);
    const N t = dot(d, d);
    most = Is::max(most, t);
    fewest = Is::min(fewest, t);
  }
  sphere.radius = Is::sqrt(most);
  if constexpr (!bounds) return sphere;
  const N rounding = N(u) * (N(2.0) * size + N(64.0) * sphere.radius);
  N error = rounding;
  auto proper = sphere.least > N(0.0);  // a midpoint has equal weights and needs no solver
  if constexpr (M > 1) {
    const N over_sigma = span.most_by_singular_value();
    const N spread = most - fewest + N(12 * u) * most;
    error = N(root_of[M] / 2) * spread * over_sigma;
    if (M < Dimension) error = error + rounding;
    error = N(1.01) * error;
    proper = sphere.least > N(2.02) * (error + rounding) * over_sigma + N(16 * u);
  }
  const N reach = N(4.04) * sphere.radius * error;
  sphere.certain = span.sound() & (span.trace >= N(0x1p-300)) & (span.trace <= N(0x1p300)) &
                   (error <= N(0x1p-28) * sphere.radius) & proper;
  sphere.inner = most * N(1 - 16 * u) - reach;
  sphere.outer = Is::choose(sphere.certain, most * N(1 + 16 * u) + reach, most * N(1 + 1e-9));
  return sphere;
}

/// The sphere of one bead is its centre, without error. Whether another bead coincides with it is a test of
/// exact equality.
template <bool bounds = true, int Dimension>
[[gnu::always_inline]] inline BasisSphere<double, Dimension> sphere_of_points(
    const BasisBalls<double, Dimension, 0>& balls) {
  return {balls.center[0], 0, 0, 0, 1, false};
}

/// One round of the pivot: returns the index of the bead that leaves, or the basis' size if none does.
template <std::size_t M, int Dimension>
[[gnu::always_inline]] inline std::size_t left_behind(const Balls<Dimension>& balls, const Basis& basis,
                                                      const Point<Dimension>& p) {
  if constexpr (M == 0) return 1;
  const auto members = basis_balls<M>(balls, basis);
  const Point<Dimension> dp = minus(p, members.center[0]);
  if constexpr (M == 1) {  // the triangle is acute, or not acute at one of the two beads
    const Point<Dimension> d = minus(members.center[1], members.center[0]);
    const double along = dot(d, dp);
    return along <= 0 ? 0 : along >= dot(d, d) ? 1 : 2;
  } else if constexpr (M > 1) {
    const Span<double, Dimension, M> span(members);
    // Weights of the centre and of the point's projection, and how far the centre has to move.
    typename Span<double, Dimension, M>::Weights y;
    const Point<Dimension> z = span.circumcenter(y);
    const auto w = span.weights_of(dp);
    double stop = HUGE_VAL;
    if constexpr (M < Dimension) {
      const Point<Dimension> normal = minus(dp, span.combination(w));
      const double square = dot(dp, dp);
      const double height = dot(normal, normal);
      if (height > 1e-24 * square) stop = (square - 2 * dot(dp, z)) / (2 * height);
    }
    double y0 = 1, w0 = 1;
    for (std::size_t i = 0; i < M; ++i) {
      y0 -= y[i];
      w0 -= w[i];
    }
    std::size_t left = M + 1;
    const auto look = [&](std::size_t index, double weight, double pull) {
      const bool sooner = (pull > 0) & (weight < stop * pull);
      stop = sooner ? weight / pull : stop;
      left = sooner ? index : left;
    };
    look(0, y0, w0);
    for (std::size_t i = 0; i < M; ++i) look(i + 1, y[i], w[i]);
    return left;
  }
}

/// Returns the index of the bead of least weight.
template <std::size_t M, int Dimension>
[[nodiscard]] std::size_t lightest(const Balls<Dimension>& balls, const Basis& basis) {
  const Span<double, Dimension, M> span(basis_balls<M>(balls, basis));
  typename Span<double, Dimension, M>::Weights y;
  (void)span.circumcenter(y);
  double least = 1;
  for (const double weight : y) least -= weight;
  std::size_t index = 0;
  for (std::size_t i = 0; i < M; ++i) {
    if (!(y[i] < least)) continue;
    least = y[i];
    index = i + 1;
  }
  return index;
}

}  // namespace detail

/// Calls `visit` with size - 1 as a compile-time constant.
template <int Dimension, class Visit>
[[gnu::always_inline]] inline decltype(auto) visit_size(std::size_t size, Visit&& visit) {
  if (size == 1) return visit(std::integral_constant<std::size_t, 0>{});
  if (size == 2) return visit(std::integral_constant<std::size_t, 1>{});
  if (Dimension == 2 || size == 3) return visit(std::integral_constant<std::size_t, 2>{});
  return visit(std::integral_constant < std::size_t, Dimension == 3 ? 3 : 2 > {});
}

/// Replaces `basis` by the basis of its points and `escaped`, which is outside their sphere. The centre moves
/// from the old one, whose weights are all positive, towards the escaped point until this point is on the
/// sphere. Points whose weight becomes zero on the way leave the basis (Goldfarb & Idnani's dual method for
/// convex quadratic programs). The result is likely right but must be verified. Returns false if doubles are
/// inconsistent.
template <int Dimension>
[[gnu::always_inline]] inline bool pivot_points(const Balls<Dimension>& balls, Basis& basis, BeadId escaped) {
  const Point<Dimension> p = detail::center_of(balls, escaped);
  while (true) {
    std::size_t left = 0;
    visit_size<Dimension>(
        basis.size, [&](auto m)
                        __attribute__((always_inline)) { left = detail::left_behind<m>(balls, basis, p); });
    if (left == basis.size) break;
    erase_bead_at(basis, left);
  }
  if (basis.size == Dimension + 1) return false;
  insert_bead(basis, escaped);
  return true;
}

}  // namespace kds
