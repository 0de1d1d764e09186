#pragma once
// The float filter: finds which power tests of a cell are positive on a whole step, by their Bernstein
// coefficients in float. A cell is tested against the beads beyond its facets. Eight cells are processed at
// once (four if the processor has no AVX2), and the part that the tests of a cell share is computed once.
// That part includes the cell's orientation, so the filter also says whether the orientation is positive at
// the end of the step and on the whole step. Tests not proved positive are undecided. No allocation.
//
// Error bound. Let m be the largest difference in a row of the determinant, rounded to float, and M the
// largest m of all rows. The differences of weights in a row must be at most m^2. Every intermediate number
// takes one factor each from some of the rows. The factor is a difference, at most m, or, at most once, a
// lift, which is a small multiple of m^2 <= m M.
//
// The number's size is Q, the product of the m of its rows and, if it contains a lift, of M. Sums add only
// numbers of the same size. The magnitudes (motions/numbers/rounding_error.h, 24 digits), each times its Q,
// therefore bound all numbers, and coefficient k has an error of at most coefficient[k] times M times the
// product of all m.
//
// Range. The bound is claimed if M <= 2^10 and M times the product of all m is at least 2^-40, in the
// caller's unit of length. Then nothing overflows, and Q >= 2^-40 / M^4 >= 2^-80. An operation that
// underflows adds an error of at most 2^-126, even if the result is flushed to zero. That is less than 2^-21
// of the roundoff 2^-24 Q already charged for the operation. The constants are inflated by 2^-8 to cover it
// and the comparison. The orientation contains no lift: its Q is the product of its own three (two) m, and
// its bound is claimed if Q is at least 2^-60.
//
// Parts of a step. The coefficients are unscaled by a product with a rounded constant, then halved repeatedly
// by de Casteljau's means, each rounded once. Let e be the largest error and s the largest size of an
// unscaled coefficient. A mean of numbers has neither a larger error nor a larger size. After j successive
// roundings every error is thus at most e + 2^-24 j s.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "certificates/base/determinant.h"
#include "certificates/filters/cell_filter.h"
#include "certificates/types/power_test.h"
#include "motions/views/lanes_view.h"
#include "motions/views/motion_view.h"

namespace kds {

/// A row of the determinant: the differences of one bead from another.
template <class View>
struct PowerRow {
  static constexpr int lift_degree = LiftedView<View> ? 1 : 2 * View::degree;

  BernsteinVector<typename View::Number, View::degree, View::dimension> centre;
  Bernstein<typename View::Number, lift_degree> lift;

  [[gnu::always_inline]] PowerRow(const View& view, BeadId x, BeadId p) : centre(view.difference(x, p)) {
    lift = power_lift(view, x, p, centre);
  }
};

/// The cofactors of the last row's entries, including signs. The power tests (power_test.h) of one cell's
/// beads against one more bead each share all rows of their determinant except the last, so the cofactors are
/// computed once. Works over any number type.
template <class View>
struct PowerCofactors {
  static constexpr int dimension = View::dimension;
  using Number = typename View::Number;
  using Row = PowerRow<View>;
  static constexpr int of_centre = (dimension - 1) * View::degree + Row::lift_degree;

  std::array<Bernstein<Number, of_centre>, dimension> centre;
  Bernstein<Number, dimension * View::degree> lift;

  /// Takes the rows of a triangle's second and third bead relative to its first.
  [[gnu::always_inline]] PowerCofactors(const Row& a, const Row& b) requires(dimension == 2) {
    centre[0] = minor(a.centre[1], a.lift, b.centre[1], b.lift);
    centre[1] = minor(b.centre[0], b.lift, a.centre[0], a.lift);
    lift = minor(a.centre[0], a.centre[1], b.centre[0], b.centre[1]);
  }
  /// Takes the rows of a tetrahedron's other beads relative to its first.
  [[gnu::always_inline]] PowerCofactors(const Row& a, const Row& b, const Row& c) requires(dimension == 3) {
    const auto xy = minor(a.centre[0], a.centre[1], b.centre[0], b.centre[1]);
    const auto xz = minor(a.centre[0], a.centre[2], b.centre[0], b.centre[2]);
    const auto yz = minor(a.centre[1], a.centre[2], b.centre[1], b.centre[2]);
    const auto xl = minor(a.centre[0], a.lift, b.centre[0], b.lift);
    const auto yl = minor(a.centre[1], a.lift, b.centre[1], b.lift);
    const auto zl = minor(a.centre[2], a.lift, b.centre[2], b.lift);
    centre[0] = yl * c.centre[2] - yz * c.lift - zl * c.centre[1];
    centre[1] = xz * c.lift - xl * c.centre[2] + zl * c.centre[0];
    centre[2] = xl * c.centre[1] - xy * c.lift - yl * c.centre[0];
    lift = xy * c.centre[2] - xz * c.centre[1] + yz * c.centre[0];
  }

  /// Returns the power test of the cell's beads, in their order, with the bead of this row.
  [[nodiscard, gnu::always_inline]] auto with(const Row& row) const {
    auto sum = lift * row.lift;
    for (std::size_t axis = 0; axis < dimension; ++axis) sum += centre[axis] * row.centre[axis];
    return sum;
  }
};

namespace detail {

template <class View, class RowOf>
[[gnu::always_inline]] inline PowerCofactors<View> power_cofactors(const RowOf& row_of) {
  const PowerRow<View> a = row_of(1), b = row_of(2);
  if constexpr (View::dimension == 2) {
    return {a, b};
  } else {
    return {a, b, row_of(3)};
  }
}

template <std::size_t Coefficients, std::size_t OfOrientation>
struct FloatPowerBound {
  std::array<float, Coefficients> coefficient;
  std::array<float, OfOrientation> orientation;  ///< the last one: at the end of the step
  float of_part, orientation_of_part;            ///< bound of each unscaled coefficient
};

inline constexpr double float_bound_inflation = 1 + 0x1p-8;

template <class Polynomial>
float float_bound_of_part(const Polynomial& magnitudes) {
  const auto degree = static_cast<int>(magnitudes.scaled.size()) - 1;
  double error = 0, size = 0;
  for (int k = 0; k <= degree; ++k) {
    const auto& magnitude = magnitudes.scaled[static_cast<std::size_t>(k)];
    const auto scale = static_cast<double>(binomial(degree, k));
    error = std::max(error, magnitude.error / scale);
    size = std::max(size, (magnitude.bound + magnitude.error) / scale);
  }
  const int roundings = 2 + positive_parts * degree;
  return static_cast<float>((error + 0x1p-24 * roundings * size) * float_bound_inflation);
}

/// Derives the bound for the curves `C`: Curves or LiftedCurves.
template <class C, std::size_t Coefficients, std::size_t OfOrientation>
void derive_float_power_bound(int degree, FloatPowerBound<Coefficients, OfOrientation>& bound) {
  using View = MagnitudeViewOf<C, MagnitudeIn<24>>;
  const PowerRow<View> row(View(degree), 1, 0);
  const auto cofactors = power_cofactors<View>([&](std::size_t) { return row; });
  const auto magnitudes = cofactors.with(row);
  for (std::size_t k = 0; k < Coefficients; ++k)
    bound.coefficient[k] = static_cast<float>(magnitudes.scaled[k].error * float_bound_inflation);
  for (std::size_t k = 0; k < OfOrientation; ++k)
    bound.orientation[k] = static_cast<float>(cofactors.lift.scaled[k].error * float_bound_inflation);
  bound.of_part = float_bound_of_part(magnitudes);
  bound.orientation_of_part = float_bound_of_part(cofactors.lift);
}

template <Motion M>
[[nodiscard]] auto float_power_bound() {
  constexpr std::size_t lift_degree = lifted<M> ? 1 : 2 * M::degree;
  constexpr std::size_t centre_degree = M::dimension * M::degree;
  FloatPowerBound<centre_degree + lift_degree + 1, centre_degree + 1> bound{};
  if constexpr (M::degree == 0) {  // beads at rest: only the orientation
    derive_float_power_bound<Curves<M::dimension>>(0, bound);
  } else {
    derive_float_power_bound<CurvesOf<M>>(M::degree, bound);
  }
  return bound;
}
template <Motion M>
using FloatPowerBoundOf = decltype(float_power_bound<M>());

/// The rounding bounds for a motion's power tests, and for orientations of beads at rest.
template <Motion M>
struct FloatFilterBounds {
  FloatPowerBoundOf<M> of_step = float_power_bound<M>();
  FloatPowerBoundOf<FixedCurves<M::dimension, 0>> at_end = float_power_bound<FixedCurves<M::dimension, 0>>();
  bool tells_parts = false;  ///< FilterOf::parts
};

template <class FloatLanes>
class RowSizes {
 public:
  /// Takes a row computed from this view.
  template <Motion M>
  [[gnu::always_inline]] void take(const FloatLanesView<M, FloatLanes>& view) {
    const FloatLanes& length = view.largest_length();
    product_ = product_ * length;
    largest_ = FloatLanes::max(largest_, length);
    weights_small_ &= view.largest_weight() <= length * length;
  }
  /// Returns M times the product of all rows' m, or a NaN, which fails every comparison, if the bound is not
  /// proved.
  [[nodiscard, gnu::always_inline]] FloatLanes error_scale() const {
    const FloatLanes scale = product_ * largest_;
    const typename FloatLanes::Mask proved =
        weights_small_ & (largest_ <= FloatLanes(0x1p10F)) & (scale >= FloatLanes(0x1p-40F));
    return proved ? scale.v : FloatLanes(__builtin_nanf("")).v;
  }
  /// Like error_scale, but without the factor M: for a function without a lift.
  [[nodiscard, gnu::always_inline]] FloatLanes error_scale_without_lift() const {
    const typename FloatLanes::Mask proved =
        (largest_ <= FloatLanes(0x1p10F)) & (product_ >= FloatLanes(0x1p-60F));
    return proved ? product_.v : FloatLanes(__builtin_nanf("")).v;
  }

 private:
  FloatLanes product_{1.0F}, largest_{0.0F};
  typename FloatLanes::Mask weights_small_ = product_ > largest_;  // starts as true in all lanes
};

}  // namespace detail

namespace detail {

/// Returns a determinant's two bits: positive at the end of the motion, and positive on all of it.
template <int Dimension, class FloatLanes, class Polynomial, std::size_t Coefficients>
[[gnu::always_inline]] inline typename FloatLanes::Mask orientation_bits(
    const Polynomial& orientation, const std::array<float, Coefficients>& bound, const FloatLanes& scale) {
  typename FloatLanes::Mask at_end{}, all = scale >= scale;
  for (std::size_t k = 0; k < Coefficients; ++k) {
    at_end = orientation.scaled[k] > FloatLanes(bound[k]) * scale;
    all &= at_end;
  }
  return (at_end & static_cast<int>(positive_at_end<Dimension>)) |
         (all & static_cast<int>(positive_throughout<Dimension>));
}

template <Motion M>
inline constexpr bool has_parts = M::degree == 1 && !lifted<M>;

/// Sets the bits of the parts on which the polynomial is certainly positive, one byte further on for each
/// part.
template <class FloatLanes, class Polynomial>
[[gnu::always_inline]] inline void add_parts(const Polynomial& polynomial, const FloatLanes& error, int bit,
                                             typename FloatLanes::Mask& bits) {
  constexpr std::size_t count = std::tuple_size_v<std::remove_cvref_t<decltype(polynomial.scaled)>>;
  constexpr int degree = static_cast<int>(count) - 1;
  std::array<FloatLanes, count> c;
  for (std::size_t k = 0; k < count; ++k) {
    const auto scale = static_cast<float>(binomial(degree, static_cast<int>(k)));
    c[k] = polynomial.scaled[k] * FloatLanes(1 / scale);
  }
  for (int part = 1; part <= positive_parts; ++part) {
    bit <<= bits_of_part;
    typename FloatLanes::Mask all = c[0] > error;
    // Add without halving. A coefficient after k additions is 2^k times too large; dividing by 2^k below is
    // exact.
    for (std::size_t round = 1; round < count; ++round)
      for (std::size_t k = count - 1; k >= round; --k) c[k] += c[k - 1];
    for (std::size_t k = 1; k < count; ++k) {
      c[k] = c[k] * FloatLanes(1 / static_cast<float>(1U << k));
      all &= c[k] > error;
    }
    bits |= all & bit;
  }
}

/// Finds the orientations of cells without beads beyond them. For a motion of degree 0, only at its end.
template <class FloatLanes, Motion M>
[[gnu::always_inline]] inline void find_positive_orientations(const M& motion,
                                                              const CellsInLanes<M::dimension>& all_cells,
                                                              std::size_t first, const LengthUnit& unit,
                                                              const FloatPowerBoundOf<M>& bound,
                                                              PositiveBits& positive) {
  using View = FloatLanesView<M, FloatLanes>;
  RowSizes<FloatLanes> sizes;
  const auto cofactors = power_cofactors<View>([&](std::size_t vertex) __attribute__((always_inline)) {
    const View view(motion, &all_cells[first], vertex, unit);
    const PowerRow<View> row(view, 1, 0);
    sizes.take(view);
    return row;
  });
  const FloatLanes scale = sizes.error_scale_without_lift();
  auto bits = orientation_bits<M::dimension>(cofactors.lift, bound.orientation, scale);
  if constexpr (has_parts<M>)
    add_parts(cofactors.lift, FloatLanes(bound.orientation_of_part) * scale,
              static_cast<int>(positive_throughout<M::dimension>), bits);
  constexpr unsigned told = M::degree == 0 ? positive_at_end<M::dimension> : ~0U;
  for (std::size_t lane = 0; lane < FloatLanes::width; ++lane)
    positive[first + lane] = static_cast<std::uint32_t>(bits[lane]) & told;
}

/// Tests as many cells as there are lanes, starting at `first`, each with `beyond` beads beyond it.
template <class FloatLanes, Motion M>
[[gnu::always_inline]] inline void find_positive_cells(
    const M& motion, const CellsInLanes<M::dimension>& all_cells, std::size_t first, std::size_t beyond,
    const LengthUnit& unit, const FloatFilterBounds<M>& bounds, PositiveBits& positive) {
  if (beyond == 0) {
    if constexpr (has_parts<M>) {
      if (bounds.tells_parts)
        return find_positive_orientations<FloatLanes>(motion, all_cells, first, unit, bounds.of_step,
                                                      positive);
    }
    const FixedCurves<M::dimension, 0> end(motion.at_end());
    return find_positive_orientations<FloatLanes>(end, all_cells, first, unit, bounds.at_end, positive);
  }
  using View = FloatLanesView<M, FloatLanes>;
  constexpr std::size_t vertices = M::dimension + 1;
  const auto& bound = bounds.of_step;
  const auto* cells = &all_cells[first];
  RowSizes<FloatLanes> cell_sizes;
  const auto row_of = [&](std::size_t vertex) __attribute__((always_inline)) {
    const View view(motion, cells, vertex, unit);
    const PowerRow<View> row(view, 1, 0);
    cell_sizes.take(view);
    return row;
  };
  const auto cofactors = power_cofactors<View>(row_of);
  const FloatLanes cell_scale = cell_sizes.error_scale_without_lift();
  typename FloatLanes::Mask bits =
      orientation_bits<M::dimension>(cofactors.lift, bound.orientation, cell_scale);
  if constexpr (has_parts<M>) {
    if (bounds.tells_parts)
      add_parts(cofactors.lift, FloatLanes(bound.orientation_of_part) * cell_scale,
                static_cast<int>(positive_throughout<M::dimension>), bits);
  }
  int bit = 1;
  for (std::size_t vertex = vertices; vertex < vertices + beyond; ++vertex, bit += bit) {
    const View view(motion, cells, vertex, unit);
    const PowerRow<View> row(view, 1, 0);
    const auto function = cofactors.with(row);
    RowSizes<FloatLanes> sizes = cell_sizes;
    sizes.take(view);
    const FloatLanes scale = sizes.error_scale();
    typename FloatLanes::Mask all = scale >= scale;
    for (std::size_t k = 0; k < function.scaled.size(); ++k)
      all &= function.scaled[k] > FloatLanes(bound.coefficient[k]) * scale;
    bits |= all & bit;
    if constexpr (has_parts<M>) {
      if (bounds.tells_parts) add_parts(function, FloatLanes(bound.of_part) * scale, bit, bits);
    }
  }
  for (std::size_t lane = 0; lane < FloatLanes::width; ++lane)
    positive[first + lane] = static_cast<std::uint32_t>(bits[lane]);
}

}  // namespace detail

/// Tests four cells, starting at `first`.
template <Motion M>
void find_in_four(const M& motion, const CellsInLanes<M::dimension>& cells, std::size_t first,
                  std::size_t beyond, const LengthUnit& unit, const detail::FloatFilterBounds<M>& bounds,
                  PositiveBits& positive) {
  detail::find_positive_cells<FloatLanesIn<4>>(motion, cells, first, beyond, unit, bounds, positive);
}

/// Tests eight cells at once, on processors with long enough vectors.
template <Motion M>
[[KDS_EIGHT_FLOATS_AVX2]] void find_in_eight_avx2(const M& motion, const CellsInLanes<M::dimension>& cells,
                                                  std::size_t beyond, const LengthUnit& unit,
                                                  const detail::FloatFilterBounds<M>& bounds,
                                                  PositiveBits& positive) {
  detail::find_positive_cells<FloatLanes>(motion, cells, 0, beyond, unit, bounds, positive);
}
template <Motion M>
[[KDS_EIGHT_FLOATS_AVX512]] void find_in_eight_avx512(const M& motion,
                                                      const CellsInLanes<M::dimension>& cells,
                                                      std::size_t beyond, const LengthUnit& unit,
                                                      const detail::FloatFilterBounds<M>& bounds,
                                                      PositiveBits& positive) {
  detail::find_positive_cells<FloatLanes>(motion, cells, 0, beyond, unit, bounds, positive);
}

}  // namespace kds
