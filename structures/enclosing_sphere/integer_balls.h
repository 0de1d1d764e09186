#pragma once
// All balls of a motion at one dyadic time, in whole numbers. Exact: for audits, and what is written at
// frames.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "motions/base/bead_range.h"
#include "motions/curves/elevated_motion.h"
#include "motions/views/integer_view.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/enclosing_sphere/exact_sphere.h"

namespace kds {

template <int Dimension>
struct IntegerBalls {
  int unit = 0;  ///< lengths are times 2^unit
  std::vector<IntegerBall<Dimension>> balls;

  [[nodiscard]] std::vector<IntegerBall<Dimension>> of(std::span<const BeadId> beads) const {
    std::vector<IntegerBall<Dimension>> some;
    for (const BeadId b : beads) some.push_back(balls[b]);
    return some;
  }
};

/// The basis, without beads that are to spare.
template <int Dimension>
[[nodiscard]] Basis proper_part(const Basis& basis, const IntegerBalls<Dimension>& whole) {
  const auto balls = whole.of(std::span(basis.begin(), basis.end()));
  const auto sphere = ExactSphere<Dimension>::touching(balls);
  if (sphere && sphere->is_proper()) return basis;
  Basis part;
  for (const std::size_t place : exact_basis_among<Dimension>(balls))
    part.beads[part.size++] = basis.beads[place];
  return part;
}

/// The first bead of a range that is not inside the sphere of a proper basis.
template <int Dimension>
[[nodiscard]] std::optional<BeadId> bead_outside(const Basis& basis, const BeadRange& range,
                                                 const IntegerBalls<Dimension>& whole) {
  const auto sphere = ExactSphere<Dimension>::touching(whole.of(std::span(basis.begin(), basis.end())));
  for (BeadId b = range.first; b <= range.last; ++b) {
    if (!basis.contains(b) && !sphere->holds(whole.balls[b])) return b;
  }
  return std::nullopt;
}

template <Motion M>
[[nodiscard]] IntegerBalls<M::dimension> integer_balls_at(const M& motion, const Dyadic& time) {
  int lowest = std::numeric_limits<int>::max();
  const auto each_number = [&](auto&& visit) {
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      for (int k = 0; k <= M::degree; ++k) {
        for (int axis = 0; axis < M::dimension; ++axis) visit(motion.coordinate(b, k, axis));
        visit(motion.radius(b, k));
      }
    }
  };
  each_number([&](double x) {
    if (x != 0) lowest = std::min(lowest, split(x).exponent);
  });
  if (lowest == std::numeric_limits<int>::max()) lowest = 0;
  const int degree = own_degree(motion);
  const Integer later = time.numerator();
  const Integer earlier = (Integer(1) << time.exponent()) - later;
  // de Casteljau, each round with one more factor 2^exponent of the time.
  const auto at_time = [&](auto&& control) {
    std::vector<Integer> p;
    for (int k = 0; k <= degree; ++k) {
      const SplitDouble parts = split(control(k));
      p.push_back(parts.mantissa == 0
                      ? Integer(0)
                      : Integer(Integer(parts.mantissa) << static_cast<unsigned>(parts.exponent - lowest)));
    }
    for (std::size_t round = p.size() - 1; round > 0; --round) {
      for (std::size_t i = 0; i < round; ++i) p[i] = p[i] * earlier + p[i + 1] * later;
    }
    return p[0];
  };
  IntegerBalls<M::dimension> whole;
  whole.unit = lowest - degree * static_cast<int>(time.exponent());
  whole.balls.resize(motion.bead_count());
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    for (int axis = 0; axis < M::dimension; ++axis)
      whole.balls[b].center[static_cast<std::size_t>(axis)] =
          at_time([&](int k) { return motion.coordinate(b, k, axis); });
    whole.balls[b].radius = at_time([&](int k) { return motion.radius(b, k); });
  }
  return whole;
}

}  // namespace kds
