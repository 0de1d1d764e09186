#pragma once
// A motion as structures hold it: any motion of the dimension, whatever its type and degree. The motion
// behind it may be set to another step at any time, and must outlive the structures.

#include <array>
#include <cstddef>

#include "motions/curves/curves.h"

namespace kds {

template <int DimensionValue>
class MotionRef {
 public:
  static constexpr int dimension = DimensionValue;
  using Vector = std::array<double, static_cast<std::size_t>(DimensionValue)>;

  template <Motion M>
  requires(M::dimension == DimensionValue) MotionRef(const M& motion)  // NOLINT: every motion is one
      : motion_(&motion),
        curves_([](const void* of) { return Curves<DimensionValue>(*static_cast<const M*>(of)); }) {
    if constexpr (lifted<M>) {
      drift_ = [](const void* of) {
        Vector drift;
        for (int axis = 0; axis < DimensionValue; ++axis)
          drift[static_cast<std::size_t>(axis)] = static_cast<const M*>(of)->drift(axis);
        return drift;
      };
    }
  }

  [[nodiscard]] Curves<DimensionValue> curves() const { return curves_(motion_); }
  [[nodiscard]] int degree() const { return curves().own_degree(); }
  [[nodiscard]] std::size_t bead_count() const { return curves().bead_count(); }
  [[nodiscard]] bool is_lifted() const { return drift_ != nullptr; }
  /// The curves with their drift; the motion must be lifted.
  [[nodiscard]] LiftedCurves<DimensionValue> lifted_curves() const { return {curves(), drift_(motion_)}; }

  /// Calls `use` with the curves in their own type: LiftedCurves where the motion is lifted, else Curves.
  template <class Use>
  decltype(auto) visit(Use use) const {
    if constexpr (DimensionValue > 1) {
      if (is_lifted()) return use(lifted_curves());
    }
    return use(curves());
  }

 private:
  const void* motion_;
  Curves<DimensionValue> (*curves_)(const void*);
  Vector (*drift_)(const void*) = nullptr;
};

}  // namespace kds
