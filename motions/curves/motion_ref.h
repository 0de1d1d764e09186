#pragma once
// A reference to a motion, as structures hold it: any motion of the dimension, of any type and degree. The
// motion may be set to another step at any time, but its degree must not change. The motion must outlive the
// structures.

#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "motions/curves/curves.h"

namespace kds {

template <int DimensionValue>
class MotionRef {
 public:
  static constexpr int dimension = DimensionValue;
  using Vector = std::array<double, static_cast<std::size_t>(DimensionValue)>;

  template <Motion M>
  requires(M::dimension == DimensionValue) MotionRef(const M& motion)  // NOLINT: implicit by intention
      : motion_(&motion),
        degree_(degree_of(motion)),
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

  /// Deleted, because a temporary motion cannot be referred to.
  template <Motion M>
  requires(M::dimension == DimensionValue) MotionRef(const M&& motion)
  = delete;

  /// Returns the motion's curves. Throws std::logic_error if the motion's degree has changed since this
  /// reference was made. Searches and filters made for the old degree would be wrong.
  [[nodiscard]] Curves<DimensionValue> curves() const {
    const Curves<DimensionValue> now = curves_(motion_);
    if (now.own_degree() != degree_) [[unlikely]]
      throw std::logic_error("a motion of degree " + std::to_string(degree_) + " has become one of degree " +
                             std::to_string(now.own_degree()) +
                             ": structures and searches over it must be made anew");
    return now;
  }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return curves().bead_count(); }
  [[nodiscard]] bool is_lifted() const { return drift_ != nullptr; }
  /// Returns the curves with their drift. The motion must be lifted.
  [[nodiscard]] LiftedCurves<DimensionValue> lifted_curves() const { return {curves(), drift_(motion_)}; }

  /// Calls `use` with the curves in their own type: LiftedCurves if the motion is lifted, else Curves.
  template <class Use>
  decltype(auto) visit(Use use) const {
    if constexpr (DimensionValue > 1) {
      if (is_lifted()) return use(lifted_curves());
    }
    return use(curves());
  }

 private:
  const void* motion_;
  int degree_;
  Curves<DimensionValue> (*curves_)(const void*);
  Vector (*drift_)(const void*) = nullptr;
};

}  // namespace kds
