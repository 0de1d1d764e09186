#pragma once
// A motion whose degree is known only at run time, for users' polynomials of degrees for which no filters are
// compiled. Control points are kept as given.

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/base/finite.h"
#include "motions/curves/motion.h"
#include "motions/numbers/bernstein.h"

namespace kds {

template <int DimensionValue>
class AnyDegreeMotion {
  static_assert(DimensionValue >= 1 && DimensionValue <= 3);

 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = any_degree;

  /// Throws std::invalid_argument if the degree is negative.
  AnyDegreeMotion(std::size_t beads, int own_degree)
      : own_degree_(accepted(own_degree)),
        beads_(beads),
        control_(beads * row() * (dimension + 1)),
        radii_(beads * row()) {}

  [[nodiscard]] int own_degree() const { return own_degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const {
    return &control_[(bead * row() + static_cast<std::size_t>(k)) * (dimension + 1)];
  }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] const double* radii(BeadId bead) const { return &radii_[bead * row()]; }
  [[nodiscard]] double radius(BeadId bead, int k) const { return radii(bead)[k]; }
  void set_coordinate(BeadId bead, int k, int axis, double value) { number(bead, k, axis) = finite(value); }
  void set_weight(BeadId bead, int k, double value) { number(bead, k, dimension) = finite(value); }
  void set_radius(BeadId bead, int k, double value) {
    radii_[bead * row() + static_cast<std::size_t>(k)] = finite(value);
  }

 private:
  [[nodiscard]] static int accepted(int wanted) {
    if (wanted < 0)
      throw std::invalid_argument("a motion of degree " + std::to_string(wanted) + ": expected 0 or more");
    return wanted;
  }
  [[nodiscard]] std::size_t row() const { return static_cast<std::size_t>(own_degree_) + 1; }
  [[nodiscard]] double& number(BeadId bead, int k, int place) {
    return control_[(bead * row() + static_cast<std::size_t>(k)) * (dimension + 1) +
                    static_cast<std::size_t>(place)];
  }

  int own_degree_;
  std::size_t beads_;
  std::vector<double> control_, radii_;
};

static_assert(Motion<AnyDegreeMotion<3>>);

}  // namespace kds
