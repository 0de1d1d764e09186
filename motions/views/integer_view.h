#pragma once
// A motion in whole numbers: all coordinates and radii are multiplied by one power of two, weights by its
// square. Functions of certificates are homogeneous in lengths, so the common factor changes no sign. Exact.
//
//   FixedView      integers of fixed width (fixed_integer.h)
//   ResidueView    integers modulo a prime (modular.h)
//   IntegerView    integers of unlimited length
//   MomentView     integers, at one dyadic time: polynomials of degree 0
//   KeptMoment     a MomentView that computes each bead's position once, for many functions of the same time

#include <algorithm>
#include <bit>
#include <concepts>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <span>
#include <type_traits>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/bernstein.h"
#include "motions/numbers/exact_number.h"
#include "motions/numbers/fixed_integer.h"
#include "motions/numbers/modular.h"
#include "motions/views/motion_view.h"

namespace kds {

/// Calls `visit` with each number of the beads' control points in these channels, and with its power of
/// length, 1 or 2.
template <Motion M, std::invocable<double, int> Visit>
void each_control(const M& motion, std::span<const BeadId> beads, Channels channels, Visit visit) {
  for (const BeadId bead : beads) {
    for (int k = 0; k <= degree_of(motion); ++k) {
      for (int axis = 0; axis < M::dimension; ++axis) visit(motion.coordinate(bead, k, axis), 1);
      if (channels.weights) visit(motion.weight(bead, k), 2);
      if (channels.radii) visit(motion.radius(bead, k), 1);
    }
  }
  if constexpr (lifted<M>) {
    for (int axis = 0; axis < M::dimension; ++axis) visit(motion.drift(axis), 1);
  }
}

/// The power of two that makes all control points of some beads whole numbers.
struct WholeScale {
  int exponent = -4096;  ///< lengths are multiplied by 2^exponent, squares by 2^(2 exponent)
  int bits = 0;          ///< scaled lengths are below 2^bits in size, scaled squares below 2^(2 bits)
};
template <Motion M>
[[nodiscard]] WholeScale whole_scale(const M& motion, std::span<const BeadId> beads,
                                     Channels channels = all_channels) {
  WholeScale scale;  // its exponent is below those of all doubles
  int top = -4096;
  each_control(motion, beads, channels, [&](double value, int power) {
    const SplitDouble parts = split(value);
    if (parts.mantissa == 0) return;
    const auto bits = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(std::abs(parts.mantissa))));
    scale.exponent = std::max(scale.exponent, -(parts.exponent >> (power - 1)));
    top = std::max(top, (parts.exponent + bits + power - 1) >> (power - 1));
  });
  scale.bits = std::max(0, top + scale.exponent);
  return scale;
}

/// The ring of integers.
struct Integers {
  using Number = Integer;
  [[nodiscard]] static Integer of(std::int64_t x) { return static_cast<long>(x); }  // GMP takes no long long
};

/// Integers of fixed width.
struct FixedIntegers {
  using Number = FixedInteger;
  [[nodiscard]] static FixedInteger of(long long x) { return FixedInteger(x); }
};

/// Integers modulo the prime 2^61 - fold.
struct Residues {
  using Number = Residue;
  std::uint64_t fold;
  [[nodiscard]] Residue of(long long x) const { return Residue::of(x, fold); }
};

/// A view in any ring into which integers are mapped.
template <Motion M, class Ring>
class ExactView {
 public:
  using Number = typename Ring::Number;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;

  /// Views only the beads and channels for which `scale` was made.
  ExactView(const M& motion, const WholeScale& scale, Ring ring = {})
      : motion_(motion), exponent_(scale.exponent), ring_(ring) {}
  ExactView(const M& motion, std::span<const BeadId> beads, Channels channels = all_channels)
      : ExactView(motion, whole_scale(motion, beads, channels)) {}

  [[nodiscard]] BernsteinVector<Number, degree, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<Number, degree, dimension> result;
    for (int axis = 0; axis < dimension; ++axis) {
      result[static_cast<std::size_t>(axis)] = polynomial([&](int k) -> Number {
        return length(motion_.coordinate(i, k, axis)) - length(motion_.coordinate(j, k, axis));
      });
    }
    return result;
  }
  [[nodiscard]] Bernstein<Number, degree> weight(BeadId i) const {
    return polynomial([&](int k) -> Number { return square(motion_.weight(i, k)); });
  }
  [[nodiscard]] Bernstein<Number, degree> weight_difference(BeadId i, BeadId j) const {
    return polynomial(
        [&](int k) -> Number { return square(motion_.weight(i, k)) - square(motion_.weight(j, k)); });
  }
  [[nodiscard]] Bernstein<Number, degree> radius_difference(BeadId i, BeadId j) const {
    return polynomial(
        [&](int k) -> Number { return length(motion_.radius(i, k)) - length(motion_.radius(j, k)); });
  }
  [[nodiscard]] Bernstein<Number, degree> radius_sum(BeadId i, BeadId j) const {
    return polynomial(
        [&](int k) -> Number { return length(motion_.radius(i, k)) + length(motion_.radius(j, k)); });
  }
  [[nodiscard]] Bernstein<Number, 1> lift_difference(BeadId i, BeadId j) const requires(lifted<M>) {
    return lift_of(*this, i, j);
  }
  [[nodiscard]] std::array<Number, dimension> displacement(BeadId bead) const requires(lifted<M>) {
    std::array<Number, dimension> result;
    for (int axis = 0; axis < dimension; ++axis) {
      result[static_cast<std::size_t>(axis)] = length(motion_.coordinate(bead, 1, axis)) -
                                               length(motion_.coordinate(bead, 0, axis)) -
                                               length(motion_.drift(axis));
    }
    return result;
  }

 private:
  template <std::invocable<int> Value>
  [[nodiscard]] Bernstein<Number, degree> polynomial(Value value) const {
    static_assert(std::same_as<std::invoke_result_t<Value, int>, Number>,
                  "an expression outlives its operands");
    Bernstein<Number, degree> result;
    const int own = degree_of(motion_);
    result.set_degree(own);
    for (int k = 0; k <= own; ++k) {
      Number& scaled = result.scaled[static_cast<std::size_t>(k)];
      scaled = value(k);
      if (0 < k && k < own) detail::multiply_by(scaled, binomial(own, k));
    }
    return result;
  }
  [[nodiscard]] Number length(double value) const { return whole(value, exponent_); }
  [[nodiscard]] Number square(double value) const { return whole(value, 2 * exponent_); }
  [[nodiscard]] Number whole(double value, int exponent) const {
    const SplitDouble parts = split(value);
    if (parts.mantissa == 0) return ring_.of(0);
    const int shift = parts.exponent + exponent;
    if (shift < 60 && std::abs(parts.mantissa) >> (60 - shift) == 0)
      return ring_.of(parts.mantissa * (1LL << shift));
    Number result = ring_.of(parts.mantissa);
    result <<= static_cast<unsigned>(shift);
    return result;
  }

  const M& motion_;
  int exponent_;
  Ring ring_;
};

template <Motion M>
using IntegerView = ExactView<M, Integers>;
template <Motion M>
using FixedView = ExactView<M, FixedIntegers>;
template <Motion M>
using ResidueView = ExactView<M, Residues>;

template <Motion M>
class MomentView {
 public:
  using Number = Integer;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;

  /// Views the motion at `time` in [0,1], only for these beads and channels.
  MomentView(const M& motion, std::span<const BeadId> beads, const Dyadic& time,
             Channels channels = all_channels)
      : moving_(motion, beads, channels),
        degree_(degree_of(motion)),
        later_(time.numerator()),
        time_exponent_(time.exponent()) {
    earlier_ = (Integer(1) << time_exponent_) - later_;
  }

  [[nodiscard]] BernsteinVector<Integer, 0, dimension> difference(BeadId i, BeadId j) const {
    const auto moving = moving_.difference(i, j);
    BernsteinVector<Integer, 0, dimension> result;
    for (std::size_t axis = 0; axis < result.size(); ++axis) result[axis].scaled[0] = at_moment(moving[axis]);
    return result;
  }
  [[nodiscard]] Bernstein<Integer, 0> weight(BeadId i) const { return squares(moving_.weight(i)); }
  [[nodiscard]] Bernstein<Integer, 0> weight_difference(BeadId i, BeadId j) const {
    return squares(moving_.weight_difference(i, j));
  }
  [[nodiscard]] Bernstein<Integer, 0> lift_difference(BeadId i, BeadId j) const requires(lifted<M>) {
    return squares(moving_.lift_difference(i, j));
  }
  [[nodiscard]] Bernstein<Integer, 0> radius_difference(BeadId i, BeadId j) const {
    return {{at_moment(moving_.radius_difference(i, j))}};
  }
  [[nodiscard]] Bernstein<Integer, 0> radius_sum(BeadId i, BeadId j) const {
    return {{at_moment(moving_.radius_sum(i, j))}};
  }

 private:
  /// Coordinates contain the time's denominator to the power of the degree. Squares must contain the
  /// square of that.
  [[nodiscard]] Bernstein<Integer, 0> squares(const Bernstein<Integer, M::degree>& p) const {
    return {{at_moment(p) << (time_exponent_ * static_cast<unsigned>(degree_))}};
  }
  [[nodiscard]] Integer at_moment(const Bernstein<Integer, M::degree>& p) const {
    Integer value = p.scaled[static_cast<std::size_t>(degree_)];
    Integer power = 1;
    for (int k = degree_ - 1; k >= 0; --k) {  // Horner's scheme in u, with one more factor (1-u) per step
      power *= earlier_;
      value = value * later_ + p.scaled[static_cast<std::size_t>(k)] * power;
    }
    return value;
  }

  IntegerView<M> moving_;
  int degree_;
  Integer later_;    // u * 2^time_exponent
  Integer earlier_;  // (1-u) * 2^time_exponent
  unsigned time_exponent_;
};

/// Positions relative to bead 0, which does not matter for functions of differences. Exact.
template <Motion M>
class KeptMoment {
 public:
  using Number = Integer;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;

  /// Views the coordinates and weights of all beads at `time` in [0,1]. The motion must outlive this object.
  KeptMoment(const M& motion, const Dyadic& time)
      : rows_(motion.bead_count()), view_(motion, all(rows_.size()), time, {.weights = true}) {}

  [[nodiscard]] BernsteinVector<Integer, 0, dimension> difference(BeadId i, BeadId j) const {
    const auto &a = row(i).position, &b = row(j).position;
    BernsteinVector<Integer, 0, dimension> result;
    for (std::size_t axis = 0; axis < result.size(); ++axis) result[axis] = a[axis] - b[axis];
    return result;
  }
  [[nodiscard]] Bernstein<Integer, 0> weight_difference(BeadId i, BeadId j) const requires(!lifted<M>) {
    return row(i).square - row(j).square;
  }
  [[nodiscard]] Bernstein<Integer, 0> lift_difference(BeadId i, BeadId j) const requires(lifted<M>) {
    return row(i).square - row(j).square;
  }

 private:
  struct Row {
    bool is_known = false;
    BernsteinVector<Integer, 0, dimension> position;
    Bernstein<Integer, 0> square;  // the weight, or the lift
  };
  static std::vector<BeadId> all(std::size_t count) {
    std::vector<BeadId> beads(count);
    std::iota(beads.begin(), beads.end(), BeadId{0});
    return beads;
  }
  [[nodiscard]] const Row& row(BeadId bead) const {
    Row& row = rows_[bead];
    if (!row.is_known) {
      row.position = view_.difference(bead, 0);
      if constexpr (lifted<M>) {
        row.square = view_.lift_difference(bead, 0);
      } else {
        row.square = view_.weight_difference(bead, 0);
      }
      row.is_known = true;
    }
    return row;
  }

  mutable std::vector<Row> rows_;
  MomentView<M> view_;
};

static_assert(MotionView<IntegerView<Curves<3>>>);
static_assert(MotionView<FixedView<Curves<3>>>);
static_assert(MotionView<ResidueView<Curves<3>>>);
static_assert(MotionView<MomentView<Curves<3>>>);
static_assert(MotionView<KeptMoment<Curves<3>>>);

}  // namespace kds
