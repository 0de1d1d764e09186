#pragma once
// Defines CellFilter. Included by the files that instantiate it, one for each dimension.

#include <cstdint>
#include <type_traits>

#include "certificates/filters/cell_filter.h"
#include "certificates/filters/float_filter.h"
#include "motions/numbers/lanes.h"

namespace kds {

namespace detail {

/// The number of floats in a processor's vectors, and whether it has twice as many vector registers.
enum class FloatVectors : std::uint8_t { four, eight, many_of_eight };

inline FloatVectors vectors_of_processor() {
#if defined(__x86_64__)
  if (processor_has_avx512()) return FloatVectors::many_of_eight;
  if (__builtin_cpu_supports("avx2")) return FloatVectors::eight;
#endif
  return FloatVectors::four;
}

template <class C>
class FilterOver final : public CellFilter<C::dimension> {
  static constexpr int dimension = C::dimension;

 public:
  FilterOver(const MotionRef<dimension>& motion, FloatVectors vectors, FilterOf told)
      : motion_(motion), vectors_(vectors) {
    bounds_.tells_parts = told == FilterOf::parts;
  }

  void positive_cells(const CellsInLanes<dimension>& cells, std::size_t beyond, const LengthUnit& unit,
                      PositiveBits& positive) const override {
    const C now = curves();
    switch (vectors_) {
      case FloatVectors::many_of_eight:
        return find_in_eight_avx512(now, cells, beyond, unit, bounds_, positive);
      case FloatVectors::eight:
        return find_in_eight_avx2(now, cells, beyond, unit, bounds_, positive);
      case FloatVectors::four:
        for (std::size_t first = 0; first < cells_in_batch; first += 4)
          in_long_lanes<&find_in_four<C>>(now, cells, first, beyond, unit, bounds_, positive);
    }
  }
  void four_positive_cells(const CellsInLanes<dimension>& cells, const LengthUnit& unit,
                           PositiveBits& positive) const override {
    in_long_lanes<&find_in_four<C>>(curves(), cells, 0, dimension + 1, unit, bounds_, positive);
  }

 private:
  [[nodiscard]] C curves() const {
    if constexpr (lifted<C>) {
      return motion_.lifted_curves();
    } else {
      return C(motion_.curves());
    }
  }

  MotionRef<dimension> motion_;
  detail::FloatFilterBounds<C> bounds_;
  FloatVectors vectors_;
};

template <int Dimension>
class FindsNothing final : public CellFilter<Dimension> {
 public:
  void positive_cells(const CellsInLanes<Dimension>&, std::size_t, const LengthUnit&,
                      PositiveBits& positive) const override {
    positive.fill(0);
  }
  void four_positive_cells(const CellsInLanes<Dimension>&, const LengthUnit&,
                           PositiveBits& positive) const override {
    positive.fill(0);
  }
};

template <int Dimension>
std::unique_ptr<CellFilter<Dimension>> make_filter(const MotionRef<Dimension>& motion, FloatVectors vectors,
                                                   FilterOf told) {
  const auto over = [&]<class C>(std::type_identity<C>) -> std::unique_ptr<CellFilter<Dimension>> {
    return std::make_unique<FilterOver<C>>(motion, vectors, told);
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
std::unique_ptr<CellFilter<Dimension>> cell_filter_over(const MotionRef<Dimension>& motion, FilterOf told) {
  return detail::make_filter(motion, detail::vectors_of_processor(), told);
}

template <int Dimension>
std::unique_ptr<CellFilter<Dimension>> cell_filter_for_any_processor(const MotionRef<Dimension>& motion) {
  return detail::make_filter(motion, detail::FloatVectors::four, FilterOf::step);
}

}  // namespace kds
