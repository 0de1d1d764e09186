#pragma once
// Definition of CellFilter: included by the files that instantiate it, one a dimension.

#include <type_traits>

#include "certificates/filters/cell_filter.h"
#include "certificates/filters/float_filter.h"

namespace kds {

namespace detail {

inline bool has_long_vectors() {
#if defined(__x86_64__)
  return __builtin_cpu_supports("avx2") != 0;
#else
  return false;
#endif
}

template <class C>
class FilterOver final : public CellFilter<C::dimension> {
  static constexpr int dimension = C::dimension;

 public:
  FilterOver(const MotionRef<dimension>& motion, bool long_vectors)
      : motion_(motion), long_vectors_(long_vectors) {}

  void positive_cells(const CellsInLanes<dimension>& cells, std::size_t beyond, const LengthUnit& unit,
                      Rounding rounding, PositiveBits& positive) const override {
    const C now = curves();
    const float charge = charge_of(rounding);
    if (long_vectors_) return find_in_eight(now, cells, beyond, unit, bounds_, charge, positive);
    for (std::size_t first = 0; first < cells_in_batch; first += 4)
      find_in_four(now, cells, first, beyond, unit, bounds_, charge, positive);
  }
  void four_positive_cells(const CellsInLanes<dimension>& cells, const LengthUnit& unit, Rounding rounding,
                           PositiveBits& positive) const override {
    find_in_four(curves(), cells, 0, dimension + 1, unit, bounds_, charge_of(rounding), positive);
  }

 private:
  static float charge_of(Rounding rounding) { return rounding == Rounding::charged ? 1.0F : 0.0F; }
  [[nodiscard]] C curves() const {
    if constexpr (lifted<C>) {
      return motion_.lifted_curves();
    } else {
      return C(motion_.curves());
    }
  }

  MotionRef<dimension> motion_;
  detail::FloatFilterBounds<C> bounds_;
  bool long_vectors_;
};

template <int Dimension>
class FindsNothing final : public CellFilter<Dimension> {
 public:
  void positive_cells(const CellsInLanes<Dimension>&, std::size_t, const LengthUnit&, Rounding,
                      PositiveBits& positive) const override {
    positive.fill(0);
  }
  void four_positive_cells(const CellsInLanes<Dimension>&, const LengthUnit&, Rounding,
                           PositiveBits& positive) const override {
    positive.fill(0);
  }
};

template <int Dimension>
std::unique_ptr<CellFilter<Dimension>> make_filter(const MotionRef<Dimension>& motion, bool long_vectors) {
  const auto over = [&]<class C>(std::type_identity<C>) -> std::unique_ptr<CellFilter<Dimension>> {
    return std::make_unique<FilterOver<C>>(motion, long_vectors);
  };
  if (motion.is_lifted()) return over(std::type_identity<LiftedCurves<Dimension>>{});
  switch (motion.degree()) {
    case 1:
      return over(std::type_identity<FixedCurves<Dimension, 1>>{});
    case 3:
      return over(std::type_identity<FixedCurves<Dimension, 3>>{});
    default:
      return std::make_unique<FindsNothing<Dimension>>();
  }
}

}  // namespace detail

template <int Dimension>
std::unique_ptr<CellFilter<Dimension>> cell_filter_over(const MotionRef<Dimension>& motion) {
  return detail::make_filter(motion, detail::has_long_vectors());
}

template <int Dimension>
std::unique_ptr<CellFilter<Dimension>> cell_filter_for_any_processor(const MotionRef<Dimension>& motion) {
  return detail::make_filter(motion, false);
}

}  // namespace kds
