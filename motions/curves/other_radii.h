#pragma once
// A motion with the centres and weights of another motion, and radii of its own.

#include <cstddef>
#include <span>
#include <vector>

#include "motions/curves/motion_ref.h"

namespace kds {

/// Follows the other motion through all its steps. Each bead has one radius at all times. Copies no curves.
/// The other motion must outlive it and must not be lifted.
template <int DimensionValue>
class OtherRadii {
 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = any_degree;

  /// Takes one radius for each bead.
  OtherRadii(const MotionRef<DimensionValue>& motion, std::span<const double> radii) : motion_(motion) {
    const auto row = static_cast<std::size_t>(motion.degree()) + 1;
    radii_.reserve(radii.size() * row);
    for (const double radius : radii) radii_.insert(radii_.end(), row, radius);
  }

  [[nodiscard]] int own_degree() const { return motion_.degree(); }
  [[nodiscard]] std::size_t bead_count() const { return motion_.bead_count(); }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return motion_.curves().control_point(bead, k);
  }
  [[nodiscard]] const double* radii(BeadId bead) const {
    return radii_.data() + static_cast<std::size_t>(bead) * (static_cast<std::size_t>(own_degree()) + 1);
  }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }
  [[nodiscard]] const double* cell() const { return motion_.curves().cell(); }

 private:
  MotionRef<DimensionValue> motion_;
  std::vector<double> radii_;
};

static_assert(Motion<OtherRadii<3>>);

}  // namespace kds
