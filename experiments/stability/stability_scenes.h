#pragma once
// The extremes of `kds stability`: motions of a few beads over one step, random within each extreme. A seed
// gives the same motions on every machine.

#include <cstddef>
#include <cstdint>
#include <random>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "motions/curves/bezier_motion.h"
#include "motions/readers/instance.h"

namespace kds {

class BeadCurves {
 public:
  BeadCurves(int dimension, int degree, std::size_t beads)
      : dimension_(dimension),
        degree_(degree),
        beads_(beads),
        numbers_(beads * static_cast<std::size_t>((degree + 1) * (dimension + 2)), 0) {}

  [[nodiscard]] int dimension() const { return dimension_; }
  [[nodiscard]] int degree() const { return degree_; }
  [[nodiscard]] std::size_t bead_count() const { return beads_; }

  /// Returns a coordinate of the bead's k-th control point.
  [[nodiscard]] double& coordinate(std::size_t bead, int k, int axis) { return numbers_[at(bead, k, axis)]; }
  [[nodiscard]] double coordinate(std::size_t bead, int k, int axis) const {
    return numbers_[at(bead, k, axis)];
  }
  [[nodiscard]] double& weight(std::size_t bead, int k) { return numbers_[at(bead, k, dimension_)]; }
  [[nodiscard]] double weight(std::size_t bead, int k) const { return numbers_[at(bead, k, dimension_)]; }

  [[nodiscard]] double& radius(std::size_t bead, int k) { return numbers_[at(bead, k, dimension_ + 1)]; }
  [[nodiscard]] double radius(std::size_t bead, int k) const { return numbers_[at(bead, k, dimension_ + 1)]; }

  /// Returns an instance without radii. Weights are omitted if all are zero. Weights are also omitted in the
  /// plane and on the line, where an instance has no weights.
  [[nodiscard]] Instance instance(std::string name) const;

  /// Returns the motion. `Dimension` must equal the dimension of these curves.
  template <int Dimension>
  [[nodiscard]] AnyDegreeMotion<Dimension> motion() const {
    AnyDegreeMotion<Dimension> motion(beads_, degree_);
    for (BeadId b = 0; b < beads_; ++b) {
      for (int k = 0; k <= degree_; ++k) {
        for (int axis = 0; axis < Dimension; ++axis)
          motion.set_coordinate(b, k, axis, coordinate(b, k, axis));
        motion.set_weight(b, k, weight(b, k));
        motion.set_radius(b, k, radius(b, k));
      }
    }
    return motion;
  }

 private:
  [[nodiscard]] std::size_t at(std::size_t bead, int k, int column) const {
    return (bead * static_cast<std::size_t>(degree_ + 1) + static_cast<std::size_t>(k)) *
               static_cast<std::size_t>(dimension_ + 2) +
           static_cast<std::size_t>(column);
  }

  int dimension_, degree_;
  std::size_t beads_;
  std::vector<double> numbers_;
};

/// Returns the text of an instance file that reads back exactly.
[[nodiscard]] std::string instance_text(const Instance& instance);

using SceneRandom = std::mt19937_64;

/// The requirements for a scene.
struct SceneShape {
  int dimension = 3;
  int degree = 1;  ///< the motion's degree
  std::size_t beads = 0;
};

struct Extreme {
  std::string_view name;   ///< FAMILY or FAMILY:MEMBER
  std::string_view about;  ///< short description
  BeadCurves (*make)(const SceneShape&, SceneRandom&);
  int least_dimension = 1;
  int least_degree = 1;
  bool unequal_radii = false;
  bool refused = false;  ///< its numbers have no exact value, so every subject must refuse it

  [[nodiscard]] bool applies(int dimension, int degree) const {
    return dimension >= least_dimension && degree >= least_degree;
  }
};

[[nodiscard]] std::span<const Extreme> all_extremes();

/// Returns the random generator for one case of an extreme. The result depends neither on the other extremes
/// nor on the other cases.
[[nodiscard]] SceneRandom scene_random(std::uint64_t seed, std::string_view extreme, std::size_t number);

/// Sets radii unless there are any. The radii are equal or unequal, constant or changing, and no larger than
/// the distance between beads. Mostly they take few different values, so that balls touch and radii tie.
void give_radii(BeadCurves& beads, SceneRandom& random);

}  // namespace kds
