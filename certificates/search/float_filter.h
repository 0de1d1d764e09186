#pragma once
// Which power tests of a cell's beads and the beads beyond its facets are positive all over a step, by their
// Bernstein coefficients in float: eight cells at once (four where the processor has no AVX2), and what the
// tests of a cell share is worked out once. Part of that is the cell's orientation: whether it is positive
// where the step ends comes with it. What is not found positive is not known. No allocation.
//
// The bound of the errors. Let m be the largest difference in a row of the determinant, rounded to float, M
// the largest of all rows, and weights differ by no more than m^2. Any number computed on the way has from
// some rows one factor each, a difference, at most m, or, at most once, a lift, a small multiple of m^2 <= m
// M. Its size is Q, the product of those m and, with a lift, of M; sums are of numbers of one size. So the
// magnitudes (motions/numbers/magnitude.h, 24 digits), each times its Q, bound them all, and coefficient k
// errs by at most coefficient[k] times M times the product of all m. Claimed where M <= 2^10 and that product
// is at least 2^-60, in the unit of length that the caller chose: then nothing overflows, and Q >= 2^-60 /
// M^4 >= 2^-100, so that what an operation that underflows errs more, 2^-150, is less than 2^-25 of the
// roundoff 2^-24 Q it is charged with anyway. The constants are inflated by 2^-8, for that and for the
// comparison. The orientation knows no lifts: the product of its own three (two) m is its Q, and claimed
// likewise.

#include <array>
#include <cstddef>
#include <cstdint>

#include "certificates/search/power_cofactors.h"
#include "motions/views/float_lanes_view.h"
#include "motions/views/motion_view.h"

namespace kds {

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

template <std::size_t Coefficients>
struct FloatPowerBound {
  std::array<float, Coefficients> coefficient;
  float orientation_at_end;
};

template <Motion M>
auto derive_float_power_bound() {
  constexpr double inflation = 1 + 0x1p-8;
  using View = MagnitudeViewOf<M, MagnitudeIn<24>>;
  const PowerRow<View> row(View(), 1, 0);
  const auto cofactors = power_cofactors<View>([&](std::size_t) { return row; });
  const auto magnitudes = cofactors.with(row);
  FloatPowerBound<decltype(magnitudes)::degree + 1> bound{};
  for (std::size_t k = 0; k < bound.coefficient.size(); ++k)
    bound.coefficient[k] = static_cast<float>(magnitudes.scaled[k].error * inflation);
  bound.orientation_at_end = static_cast<float>(cofactors.lift.scaled.back().error * inflation);
  return bound;
}

template <Motion M>
inline const auto float_power_bound = derive_float_power_bound<M>();

template <class FloatLanes>
class RowSizes {
 public:
  /// A row that was made of this view.
  template <Motion M>
  [[gnu::always_inline]] void take(const FloatLanesView<M, FloatLanes>& view) {
    const FloatLanes& length = view.largest_length();
    product_ = product_ * length;
    largest_ = FloatLanes::max(largest_, length);
    weights_small_ &= view.largest_weight() <= length * length;
  }
  /// M times the product of all rows' m, or a NaN that fails every comparison where the bound is not proved.
  [[nodiscard, gnu::always_inline]] FloatLanes error_scale() const {
    const FloatLanes scale = product_ * largest_;
    const typename FloatLanes::Mask proved =
        weights_small_ & (largest_ <= FloatLanes(0x1p10F)) & (scale >= FloatLanes(0x1p-60F));
    return proved ? scale.v : FloatLanes(__builtin_nanf("")).v;
  }
  /// The same of what no lift enters: the product alone.
  [[nodiscard, gnu::always_inline]] FloatLanes error_scale_without_lift() const {
    const typename FloatLanes::Mask proved =
        (largest_ <= FloatLanes(0x1p10F)) & (product_ >= FloatLanes(0x1p-60F));
    return proved ? product_.v : FloatLanes(__builtin_nanf("")).v;
  }

 private:
  FloatLanes product_{1.0F}, largest_{0.0F};
  typename FloatLanes::Mask weights_small_ = product_ > largest_;  // so far
};

}  // namespace detail

/// Eight cells: the beads of each, then beads beyond facets of it.
template <Motion M>
using CellsInLanes = std::array<std::array<BeadId, 2 * (M::dimension + 1)>, FloatLanes::width>;

/// Of each cell one bit for each bead beyond, in that order: whether the power test of the cell and that bead
/// is certainly positive. And one more, whether the cell certainly is where the step ends.
using PositiveBits = std::array<std::uint32_t, FloatLanes::width>;
template <Motion M>
inline constexpr unsigned positive_at_end = 2U << M::dimension;

namespace detail {

/// A motion's end, as one that stands still.
template <Motion M>
class AtEnd {
 public:
  static constexpr int dimension = M::dimension;
  static constexpr int degree = 0;
  explicit AtEnd(const M& motion) : motion_(motion) {}
  [[nodiscard]] std::size_t bead_count() const { return motion_.bead_count(); }
  [[nodiscard]] double coordinate(BeadId bead, int, int axis) const {
    return motion_.coordinate(bead, M::degree, axis);
  }
  [[nodiscard]] double weight(BeadId bead, int) const { return motion_.weight(bead, M::degree); }
  [[nodiscard]] const double* control_point(BeadId bead, int) const {
    return motion_.control_point(bead, M::degree);
  }
  [[nodiscard]] double radius(BeadId bead, int) const { return motion_.radius(bead, M::degree); }

 private:
  const M& motion_;
};

/// The same of no beads beyond.
template <class FloatLanes, Motion M>
[[gnu::always_inline]] inline void find_positive_at_end(const M& motion, const CellsInLanes<M>& all_cells,
                                                        std::size_t first, const LengthUnit& unit,
                                                        PositiveBits& positive) {
  using View = FloatLanesView<AtEnd<M>, FloatLanes>;
  const AtEnd<M> end(motion);
  RowSizes<FloatLanes> sizes;
  const auto cofactors = power_cofactors<View>([&](std::size_t place) __attribute__((always_inline)) {
    const View view(end, &all_cells[first], place, unit);
    const PowerRow<View> row(view, 1, 0);
    sizes.take(view);
    return row;
  });
  const typename FloatLanes::Mask bits =
      cofactors.lift.scaled.back() >
      FloatLanes(float_power_bound<AtEnd<M>>.orientation_at_end) * sizes.error_scale_without_lift();
  for (std::size_t lane = 0; lane < FloatLanes::width; ++lane)
    positive[first + lane] = bits[lane] != 0 ? positive_at_end<M> : 0;
}

/// As many cells from the first on as there are lanes; of each as many beads beyond it.
template <class FloatLanes, Motion M>
[[gnu::always_inline]] inline void find_positive_cells(const M& motion, const CellsInLanes<M>& all_cells,
                                                       std::size_t first, std::size_t beyond,
                                                       const LengthUnit& unit, PositiveBits& positive) {
  if (beyond == 0) return find_positive_at_end<FloatLanes>(motion, all_cells, first, unit, positive);
  using View = FloatLanesView<M, FloatLanes>;
  constexpr std::size_t vertices = M::dimension + 1;
  const auto& bound = float_power_bound<M>;
  const auto* cells = &all_cells[first];
  RowSizes<FloatLanes> cell_sizes;
  const auto row_of = [&](std::size_t place) __attribute__((always_inline)) {
    const View view(motion, cells, place, unit);
    const PowerRow<View> row(view, 1, 0);
    cell_sizes.take(view);
    return row;
  };
  const auto cofactors = power_cofactors<View>(row_of);
  typename FloatLanes::Mask bits =
      (cofactors.lift.scaled.back() >
       FloatLanes(bound.orientation_at_end) * cell_sizes.error_scale_without_lift()) &
      static_cast<int>(positive_at_end<M>);
  int bit = 1;
  for (std::size_t place = vertices; place < vertices + beyond; ++place, bit += bit) {
    const View view(motion, cells, place, unit);
    const PowerRow<View> row(view, 1, 0);
    const auto function = cofactors.with(row);
    RowSizes<FloatLanes> sizes = cell_sizes;
    sizes.take(view);
    const FloatLanes scale = sizes.error_scale();
    typename FloatLanes::Mask all = scale >= scale;
    for (std::size_t k = 0; k < function.scaled.size(); ++k)
      all &= function.scaled[k] > FloatLanes(bound.coefficient[k]) * scale;
    bits |= all & bit;
  }
  for (std::size_t lane = 0; lane < FloatLanes::width; ++lane)
    positive[first + lane] = static_cast<std::uint32_t>(bits[lane]);
}

}  // namespace detail

/// On any processor: four at a time.
template <Motion M>
[[gnu::flatten, gnu::noinline]] void positive_cells_anywhere(const M& motion, const CellsInLanes<M>& cells,
                                                             std::size_t beyond, const LengthUnit& unit,
                                                             PositiveBits& positive) {
  for (std::size_t first = 0; first < FloatLanes::width; first += 4)
    detail::find_positive_cells<FloatLanesIn<4>>(motion, cells, first, beyond, unit, positive);
}

/// The first four alone, with all beads beyond them.
template <Motion M>
[[KDS_FLOAT_LANES_TARGETS]] void four_positive_cells(const M& motion, const CellsInLanes<M>& cells,
                                                     const LengthUnit& unit, PositiveBits& positive) {
  detail::find_positive_cells<FloatLanesIn<4>>(motion, cells, 0, M::dimension + 1, unit, positive);
}

/// Eight at once: for processors with vectors as long as that, on others slower than four.
template <Motion M>
[[KDS_FLOAT_LANES_TARGETS]] void positive_cells_at_once(const M& motion, const CellsInLanes<M>& cells,
                                                        std::size_t beyond, const LengthUnit& unit,
                                                        PositiveBits& positive) {
  detail::find_positive_cells<FloatLanes>(motion, cells, 0, beyond, unit, positive);
}

/// Of each cell the first `beyond` beads beyond it.
template <Motion M>
void positive_cells(const M& motion, const CellsInLanes<M>& cells, std::size_t beyond, const LengthUnit& unit,
                    PositiveBits& positive) {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") != 0)
    return positive_cells_at_once(motion, cells, beyond, unit, positive);
#endif
  positive_cells_anywhere(motion, cells, beyond, unit, positive);
}

}  // namespace kds
