#pragma once
// The figures of the paper's tables for one frame of a subject, or for the step between two frames. Times are
// given as ratios of works that run in turn, round by round.

#include <cstddef>
#include <cstdint>

#include "experiments/program/timing.h"
#include "experiments/reproduce/subjects.h"
#include "structures/hierarchy/layered_hierarchy.h"

namespace kds {

/// Table 1: times to build each structure.
struct Construction {
  Spread layered_per_wrapped, power_per_wrapped;
  Tightness tightness;
};
[[nodiscard]] Construction construction_of(const Subject& subject, std::size_t frame, std::size_t rounds);

/// Tables 3 and 4: collisions within the necklace between beads that are not neighbours along it. The times
/// cover only the searches; the hierarchies are built beforehand.
struct SelfCollision {
  Spread quadratic_per_wrapped, layered_per_wrapped;
  std::uint64_t wrapped_pairs = 0, layered_pairs = 0;  ///< of the separating sets
  std::uint64_t edges = 0;                             ///< of the power diagram
};
[[nodiscard]] SelfCollision self_collision_of(const Subject& subject, std::size_t frame, std::size_t rounds);

/// Tables 2, 5 and 6: the step from one frame to another, or to itself. The times are those of updating the
/// wrapped hierarchy.
struct Step {
  Spread lazy_per_naive, cascade_per_naive;
  double cascade_tests = 0, naive_tests = 0;  ///< tests of beads and cages against spheres
  double frontier = 0;                        ///< average over all nodes
  std::uint64_t bases_changed = 0;
  std::uint64_t cells_changed = 0;  ///< cells of the later diagram that the earlier one does not have
};
[[nodiscard]] Step step_of(const Subject& subject, std::size_t from, std::size_t to, std::size_t rounds);

/// Table 7: collisions between two necklaces from one frame to the next. The times cover updating and
/// searching the hierarchy.
struct CollisionBetween {
  Spread layered_per_full, lazy_per_full;
  std::uint64_t layered_pairs = 0, wrapped_pairs = 0;
  double frontier = 0;  ///< average over all nodes
};
[[nodiscard]] CollisionBetween collision_between(const Subject& subject, std::size_t from, std::size_t to,
                                                 std::size_t rounds);

}  // namespace kds
