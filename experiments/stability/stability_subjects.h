#pragma once
// What `kds stability` puts to the test: certificate types, structures and what changes their motion, each
// for motions of one dimension and degree.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/stability/stability_row.h"
#include "experiments/stability/stability_scenes.h"

namespace kds {

struct StabilityCases {
  std::uint64_t seed = 1;
  std::size_t cases = 0;
};

struct StabilitySubject {
  std::string name;
  bool structure = false;         ///< or what changes the motion of one; else a certificate type
  int dimension = 0, degree = 0;  ///< of the motion
  int function_degree = 0;        ///< of a certificate
  bool weighted = false;  ///< asks for weights or radii; others are spared the extremes of unequal ones
  std::function<StabilityRow(const Extreme&, const StabilityCases&)> run;

  [[nodiscard]] bool meets(const Extreme& extreme) const {
    return extreme.applies(dimension, degree) && (weighted || !extreme.unequal_radii);
  }
};

/// Certificate types first, then structures; those of one name stand together.
[[nodiscard]] std::vector<StabilitySubject> all_subjects();

/// Parts of it: certificate types of beads and of balls under motions of a degree, structures, tolerances and
/// strides.
[[nodiscard]] std::vector<StabilitySubject> bead_certificates(int degree);
[[nodiscard]] std::vector<StabilitySubject> ball_certificates(int degree);
[[nodiscard]] std::vector<StabilitySubject> kinetic_structures();
[[nodiscard]] std::vector<StabilitySubject> motion_levers();

}  // namespace kds
