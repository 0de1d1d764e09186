#pragma once
// The extremes of `kds stability`: motions of a few beads, random within each extreme. A seed gives the same
// motions on every machine.

#include <cstdint>
#include <random>
#include <span>
#include <string_view>

#include "experiments/stability/bead_curves.h"

namespace kds {

using SceneRandom = std::mt19937_64;

/// The requirements for a scene.
struct SceneShape {
  int dimension = 3;
  int degree = 1;  ///< of the motion
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

}  // namespace kds
