#pragma once
// The necklaces that the paper measures: its own models, and proteins from the project's data. The paper
// gives neither formulas nor parameters of its models. Parameters that its figures determine are fitted to
// them.

#include <Eigen/Core>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "motions/base/bead.h"

namespace kds {

/// Frames of one necklace, or of two necklaces.
struct Subject {
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;  ///< one per bead; neighbours along the chain touch
  std::vector<BeadRange> necklaces;
  bool planar = false;  ///< in the plane z = 0, where measurements are two-dimensional

  [[nodiscard]] std::size_t beads() const { return radii.size(); }
};

/// Turns of the static helix, for any number of beads. Fit: the least root of the mean squared logarithm of
/// measured / printed, among multiples of 0.1 from 3 to 12, over the separating sets of centres and the
/// diagram's edges at 10 and 640 beads (table 3). The deviations at the optimum are -15%, 7%, 3% and 8%.
inline constexpr double static_helix_turns = 6.3;
/// Turns of the scaling helix divided by the root of its number of beads. Fitted likewise, among multiples of
/// 0.01 from 0.2 to 0.4. The deviations are 9%, 0%, 16% and 21%.
inline constexpr double scaling_helix_turns = 0.29;
/// Turns of the rolled spiral (caption of table 5).
inline constexpr double spiral_turns = 16;
/// Turns of the two rolled spirals of table 7 (text of section 4). Sets of 18 turns fit table 7 better than
/// those of 16.
inline constexpr double paired_spiral_turns = 18;
/// How far the chain is rolled up in the first frame. An exactly straight chain has a diagram of n - 1 edges,
/// but the paper counts 3000, so its first frame is not exactly straight.
inline constexpr double first_rolled = 0.001;

/// Return models at rest with beads of radius 1. Splines and grills are planar, because the paper counts
/// 3n - 3 edges in their diagrams.
[[nodiscard]] Subject spline_subject(std::size_t beads);
[[nodiscard]] Subject grill_subject(std::size_t beads);
[[nodiscard]] Subject helix_subject(std::size_t beads, double turns);

/// Returns `frames` (at least 2) stages of a chain that rolls up in the plane.
[[nodiscard]] Subject rolling_spiral(std::size_t beads, std::size_t frames);

/// A stage of two equal spirals in parallel planes, one above the other.
struct PairedStage {
  double rolled = first_rolled;
  double distance = 0;  ///< of the planes, in radii
};
[[nodiscard]] Subject two_spirals(std::size_t beads, std::span<const PairedStage> stages);

/// Returns the backbone of the first chain of a file in the folder `data`, with the radii of --radius auto.
/// For a DCD file `topology` names the atoms, otherwise it is empty. Throws InputError.
[[nodiscard]] Subject protein(const std::filesystem::path& data, std::string_view file,
                              std::string_view topology = {});

}  // namespace kds
