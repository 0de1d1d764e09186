#pragma once
// The subjects that the paper measures, its own models and proteins from the project's data, and the figures
// of its tables for one frame of a subject, or for the step between two frames. Times are given as ratios of
// works that run in turn, round by round.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>
#include <vector>

#include "experiments/program/timing.h"
#include "motions/base/bead.h"
#include "structures/hierarchy/layered_hierarchy.h"

namespace kds {

/// Frames of one necklace, or of two necklaces side by side.
struct Subject {
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;  ///< one per bead
  std::vector<BeadRange> necklaces;
  bool planar = false;  ///< in the plane z = 0, where measurements are two-dimensional

  [[nodiscard]] std::size_t beads() const { return radii.size(); }
};

/// Returns a model at rest with beads of radius 1: spline, helix, scaling-helix or grill.
[[nodiscard]] Subject model_subject(std::string_view model, std::size_t beads);

/// rolling_spiral returns `frames` (at least 2) stages of a straight chain that rolls up in the plane.
/// two_rolling_spirals returns such stages for two chains, one above the other. The distance of their planes
/// decreases from 1.5 chain lengths to a twentieth of a diameter more than touching.
[[nodiscard]] Subject rolling_spiral(std::size_t beads, std::size_t frames);
[[nodiscard]] Subject two_rolling_spirals(std::size_t beads, std::size_t frames);

/// Returns the backbone of the first chain of a file in the folder `data`, with the radii of --radius auto.
/// For a DCD file `topology` names the atoms, otherwise it is empty. Throws InputError.
[[nodiscard]] Subject protein(const std::filesystem::path& data, std::string_view file,
                              std::string_view topology = {});

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
  std::uint64_t wrapped_pairs = 0, layered_pairs = 0;  ///< sizes of the separating sets
  std::uint64_t edges = 0;                             ///< edges in the power diagram
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
