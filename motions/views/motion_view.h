#pragma once
// The concept of a view: a motion seen in one number type. A certificate's function is written once, over any
// view:
//
//   DoubleView     rounded; records the largest length returned, which scales the error bound
//   TrackedView    rounded, with a running error bound (rounding_error.h). Numbers are scaled to the middle
//                  of double's range: all lengths by one power of two, weights by its square
//   MagnitudeView  the constants of the error bound (rounding_error.h); independent of any motion
//   IntegerView, ResidueView, MomentView   exact (integer_view.h)
//   RecordingView  records the formula, which can be played over any of these views
//
// Functions of certificates are homogeneous in lengths, so a common factor changes no sign. Every view
// returns differences of beads. Certificates are independent of the origin, or have the origin as a bead, and
// differences make the filter much sharper. Views that must prepare channels are told which ones will be
// used.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <span>

#include "motions/base/bead.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/curves.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/bernstein.h"
#include "motions/numbers/recorded_formula.h"
#include "motions/numbers/rounding_error.h"

namespace kds {

/// The channels that a function uses besides the centres of beads.
struct Channels {
  bool weights = false;
  bool radii = false;
};
inline constexpr Channels all_channels{true, true};

/// Besides difference(i, j), a view has weight(i), weight_difference(i, j), radius_difference(i, j) and
/// radius_sum(i, j), polynomials of the same degree, if the channels were requested. Over a lifted motion it
/// has lift_difference(i, j), the difference of |x|^2 minus the weight (lifted_motion.h); weights and their
/// differences are available only at the ends of the step there.
template <class V>
concept MotionView = requires(const V& view, BeadId i, BeadId j) {
  typename V::Number;
  { V::dimension } -> std::convertible_to<int>;
  { V::degree } -> std::convertible_to<int>;
  { view.difference(i, j) } -> std::same_as<BernsteinVector<typename V::Number, V::degree, V::dimension>>;
};

template <class V>
concept LiftedView = requires(const V& view, BeadId i, BeadId j) {
  view.lift_difference(i, j);
};

template <Motion M>
class DoubleView {
 public:
  using Number = double;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;

  explicit DoubleView(const M& motion) : motion_(motion) {}

  /// Returns the centre of i minus the centre of j.
  [[nodiscard]] BernsteinVector<double, degree, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<double, degree, dimension> result;
    const int own = degree_of(motion_);
    for (int axis = 0; axis < dimension; ++axis) {
      auto& coordinate = result[static_cast<std::size_t>(axis)];
      coordinate.set_degree(own);
      for (int k = 0; k <= own; ++k) {
        const double d = motion_.coordinate(i, k, axis) - motion_.coordinate(j, k, axis);
        length_ = std::max(length_, std::abs(d));
        coordinate.scaled[static_cast<std::size_t>(k)] = static_cast<double>(binomial(own, k)) * d;
      }
    }
    return result;
  }
  [[nodiscard]] Bernstein<double, degree> weight(BeadId i) const {
    return polynomial(weight_, [&](int k) { return motion_.weight(i, k); });
  }
  /// Returns the weight of i minus the weight of j.
  [[nodiscard]] Bernstein<double, degree> weight_difference(BeadId i, BeadId j) const {
    return polynomial(weight_, [&](int k) { return motion_.weight(i, k) - motion_.weight(j, k); });
  }

  /// Returns the radius of i minus the radius of j.
  [[nodiscard]] Bernstein<double, degree> radius_difference(BeadId i, BeadId j) const {
    return polynomial(length_, [&](int k) { return motion_.radius(i, k) - motion_.radius(j, k); });
  }
  [[nodiscard]] Bernstein<double, degree> radius_sum(BeadId i, BeadId j) const {
    return polynomial(length_, [&](int k) { return motion_.radius(i, k) + motion_.radius(j, k); });
  }

  [[nodiscard]] Bernstein<double, 1> lift_difference(BeadId i, BeadId j) const requires(lifted<M>) {
    return lift_of(*this, i, j);
  }
  /// Returns a bead's displacement in the step, without the drift.
  [[nodiscard]] std::array<double, dimension> displacement(BeadId bead) const requires(lifted<M>) {
    std::array<double, dimension> result;
    for (int axis = 0; axis < dimension; ++axis) {
      const double moved = motion_.coordinate(bead, 1, axis) - motion_.coordinate(bead, 0, axis);
      length_ = std::max({length_, std::abs(moved), std::abs(motion_.drift(axis))});
      result[static_cast<std::size_t>(axis)] = moved - motion_.drift(axis);
    }
    return result;
  }

  /// Returns the M of the error bound: no difference or sum returned so far is larger, and no weight or
  /// weight difference is larger than its square.
  [[nodiscard]] double largest_length() const {
    return weight_ <= length_ * length_ ? length_ : std::max(length_, std::sqrt(weight_));
  }

 private:
  template <std::invocable<int> Value>
  [[nodiscard]] Bernstein<double, degree> polynomial(double& largest, Value value) const {
    Bernstein<double, degree> result;
    const int own = degree_of(motion_);
    result.set_degree(own);
    for (int k = 0; k <= own; ++k) {
      const double x = value(k);
      largest = std::max(largest, std::abs(x));
      result.scaled[static_cast<std::size_t>(k)] = static_cast<double>(binomial(own, k)) * x;
    }
    return result;
  }

  const M& motion_;
  mutable double length_ = 0;
  mutable double weight_ = 0;
};

/// Returns a power of two that scales the largest difference of some beads to about 1, as far as a double
/// allows. Returns 1 if differences overflow or are zero. Channels not selected are ignored.
template <Motion M>
[[nodiscard]] double scale_to_unit(const M& motion, std::span<const BeadId> beads,
                                   Channels channels = all_channels) {
  double length = 0;
  double weight = 0;
  for (const BeadId bead : beads) {
    for (int k = 0; k <= degree_of(motion); ++k) {
      for (int axis = 0; axis < M::dimension; ++axis)
        length = std::max(length,
                          std::abs(motion.coordinate(bead, k, axis) - motion.coordinate(beads[0], k, axis)));
      if (channels.radii) length = std::max(length, std::abs(motion.radius(bead, k)));
      if (channels.weights)
        weight = std::max(weight, std::abs(motion.weight(bead, k) - motion.weight(beads[0], k)));
    }
  }
  const double largest = std::max(length, std::sqrt(weight));
  if (!(largest > 0 && std::isfinite(largest))) return 1;
  return std::ldexp(1.0, std::min(-std::ilogb(largest), 1023));
}

template <Motion M>
class TrackedView {
 public:
  using Number = TrackedDouble;
  static constexpr int dimension = M::dimension;
  static constexpr int degree = M::degree;

  /// Views only these beads and channels.
  TrackedView(const M& motion, std::span<const BeadId> beads, Channels channels = all_channels)
      : motion_(motion), scale_(scale_to_unit(motion, beads, channels)) {}

  [[nodiscard]] BernsteinVector<TrackedDouble, degree, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<TrackedDouble, degree, dimension> result;
    for (int axis = 0; axis < dimension; ++axis) {
      result[static_cast<std::size_t>(axis)] = polynomial(
          [&](int k) { return scaled(motion_.coordinate(i, k, axis) - motion_.coordinate(j, k, axis)); });
    }
    return result;
  }
  [[nodiscard]] Bernstein<TrackedDouble, degree> weight(BeadId i) const {
    return polynomial([&](int k) { return scaled_twice(motion_.weight(i, k)); });
  }
  [[nodiscard]] Bernstein<TrackedDouble, degree> weight_difference(BeadId i, BeadId j) const {
    return polynomial([&](int k) { return scaled_twice(motion_.weight(i, k) - motion_.weight(j, k)); });
  }
  [[nodiscard]] Bernstein<TrackedDouble, degree> radius_difference(BeadId i, BeadId j) const {
    return polynomial([&](int k) { return scaled(motion_.radius(i, k) - motion_.radius(j, k)); });
  }
  [[nodiscard]] Bernstein<TrackedDouble, degree> radius_sum(BeadId i, BeadId j) const {
    return polynomial([&](int k) { return scaled(motion_.radius(i, k) + motion_.radius(j, k)); });
  }
  [[nodiscard]] Bernstein<TrackedDouble, 1> lift_difference(BeadId i, BeadId j) const requires(lifted<M>) {
    return lift_of(*this, i, j);
  }
  [[nodiscard]] std::array<TrackedDouble, dimension> displacement(BeadId bead) const requires(lifted<M>) {
    std::array<TrackedDouble, dimension> result;
    for (int axis = 0; axis < dimension; ++axis) {
      result[static_cast<std::size_t>(axis)] =
          scaled(motion_.coordinate(bead, 1, axis) - motion_.coordinate(bead, 0, axis)) -
          scaled(motion_.drift(axis));
    }
    return result;
  }

 private:
  template <std::invocable<int> Value>
  [[nodiscard]] Bernstein<TrackedDouble, degree> polynomial(Value value) const {
    Bernstein<TrackedDouble, degree> result;
    const int own = degree_of(motion_);
    result.set_degree(own);
    for (int k = 0; k <= own; ++k) {
      TrackedDouble& scaled = result.scaled[static_cast<std::size_t>(k)];
      scaled = value(k);
      if (0 < k && k < own) scaled = TrackedDouble{static_cast<double>(binomial(own, k)), 0} * scaled;
    }
    return result;
  }

  /// Returns an input, or a rounded difference or sum of two, times the scale. Sums are exact if they are
  /// subnormal, and scaling is exact except for underflow.
  [[nodiscard]] TrackedDouble scaled(double rounded) const { return from_rounded(rounded * scale_); }
  /// Like `scaled`, but times the square of the scale. This square may not be representable as a double.
  [[nodiscard]] TrackedDouble scaled_twice(double rounded) const {
    return from_rounded(rounded * scale_ * scale_);
  }
  static TrackedDouble from_rounded(double x) {
    return {x, TrackedDouble::unit_roundoff * std::abs(x) + TrackedDouble::lost_to_underflow};
  }

  const M& motion_;
  double scale_;
};

template <int DimensionValue, int DegreeValue, bool Lifted = false, class NumberType = Magnitude>
class MagnitudeView {
 public:
  using Number = NumberType;
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = DegreeValue;

  MagnitudeView() requires(DegreeValue >= 0) : own_degree_(DegreeValue) {}
  /// For motions of this degree. If the view's degree is a constant, the argument must equal it.
  explicit MagnitudeView(int own_degree) : own_degree_(own_degree) {}

  [[nodiscard]] BernsteinVector<Number, degree, dimension> difference(BeadId, BeadId) const {
    BernsteinVector<Number, degree, dimension> result;
    for (auto& coordinate : result) coordinate = polynomial(1);
    return result;
  }
  [[nodiscard]] Bernstein<Number, degree> weight(BeadId) const { return polynomial(2); }
  [[nodiscard]] Bernstein<Number, degree> weight_difference(BeadId, BeadId) const { return polynomial(2); }
  [[nodiscard]] Bernstein<Number, degree> radius_difference(BeadId, BeadId) const { return polynomial(1); }
  [[nodiscard]] Bernstein<Number, degree> radius_sum(BeadId, BeadId) const { return polynomial(1); }
  [[nodiscard]] Bernstein<Number, 1> lift_difference(BeadId i, BeadId j) const requires(Lifted) {
    return lift_of(*this, i, j);
  }
  [[nodiscard]] std::array<Number, dimension> displacement(BeadId) const requires(Lifted) {
    std::array<Number, dimension> result;
    result.fill(Number::input_difference(1) - Number::input_difference(1));
    return result;
  }

 private:
  [[nodiscard]] Bernstein<Number, degree> polynomial(int power) const {
    Bernstein<Number, degree> result;
    result.set_degree(own_degree_);
    for (int k = 0; k <= own_degree_; ++k) {
      result.scaled[static_cast<std::size_t>(k)] =
          Number::constant(static_cast<double>(binomial(own_degree_, k))) * Number::input_difference(power);
    }
    return result;
  }

  int own_degree_;
};

template <Motion M, class Number = Magnitude>
using MagnitudeViewOf = MagnitudeView<M::dimension, M::degree, lifted<M>, Number>;

static_assert(MotionView<DoubleView<BezierMotion<3, 1>>>);
static_assert(MotionView<TrackedView<BezierMotion<3, 1>>> && MotionView<TrackedView<Curves<3>>>);
static_assert(MotionView<MagnitudeView<3, 1>>);

/// A view without a motion: it records a formula, which can be played later (recorded_formula.h). The formula
/// names beads by their indices among its own beads.
template <int DimensionValue, bool Lifted, Channels channels>
class RecordingView {
  using Kind = FormulaStep::Kind;

 public:
  using Number = Recorded;
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = Lifted ? 1 : any_degree;

  explicit RecordingView(RecordedFormula& formula) : formula_(formula) {}

  [[nodiscard]] BernsteinVector<Recorded, degree, dimension> difference(BeadId i, BeadId j) const {
    BernsteinVector<Recorded, degree, dimension> result;
    Kind kind = Kind::centre_difference;
    for (auto& coordinate : result) {
      coordinate = of_beads<degree>(kind, i, j);
      kind = Kind::next_coordinate;
    }
    return result;
  }
  [[nodiscard]] Bernstein<Recorded, degree> weight(BeadId i) const requires(channels.weights) {
    return of_beads<degree>(Kind::weight, i, i);
  }
  [[nodiscard]] Bernstein<Recorded, degree> weight_difference(BeadId i, BeadId j) const
      requires(channels.weights) {
    return of_beads<degree>(Kind::weight_difference, i, j);
  }
  [[nodiscard]] Bernstein<Recorded, degree> radius_difference(BeadId i, BeadId j) const
      requires(channels.radii) {
    return of_beads<degree>(Kind::radius_difference, i, j);
  }
  [[nodiscard]] Bernstein<Recorded, degree> radius_sum(BeadId i, BeadId j) const requires(channels.radii) {
    return of_beads<degree>(Kind::radius_sum, i, j);
  }
  [[nodiscard]] Bernstein<Recorded, 1> lift_difference(BeadId i, BeadId j) const
      requires(channels.weights&& Lifted) {
    return of_beads<1>(Kind::lift_difference, i, j);
  }

 private:
  template <int Degree>
  [[nodiscard]] Bernstein<Recorded, Degree> of_beads(Kind kind, BeadId i, BeadId j) const {
    return {&formula_, formula_.add(kind, static_cast<std::uint16_t>(i), static_cast<std::uint16_t>(j))};
  }

  RecordedFormula& formula_;
};

}  // namespace kds
