#pragma once
// The subjects of `kds stability`: certificate types, structures, and changes of their motion. Each subject
// has motions of one dimension and degree.

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
  bool structure = false;         ///< a structure or a change of its motion rather than a certificate type
  int dimension = 0, degree = 0;  ///< for the motion
  int function_degree = 0;        ///< for a certificate
  bool weighted = false;  ///< uses weights or radii; other subjects skip the extremes of unequal radii
  std::function<StabilityRow(const Extreme&, const StabilityCases&)> run;

  [[nodiscard]] bool meets(const Extreme& extreme) const {
    return extreme.applies(dimension, degree) && (weighted || !extreme.unequal_radii);
  }
};

/// Returns certificate types, then structures. Subjects with one name are adjacent.
[[nodiscard]] std::vector<StabilitySubject> all_subjects();

/// The parts of all_subjects(): certificate types of beads and of balls under motions of a degree,
/// structures, and tolerances and strides.
[[nodiscard]] std::vector<StabilitySubject> bead_certificates(int degree);
[[nodiscard]] std::vector<StabilitySubject> ball_certificates(int degree);
[[nodiscard]] std::vector<StabilitySubject> kinetic_structures();
[[nodiscard]] std::vector<StabilitySubject> motion_levers();

}  // namespace kds
