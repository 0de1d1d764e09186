#pragma once
// The subjects that the paper measures: its own models, and proteins from the project's data.

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

#include "motions/base/bead_range.h"

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

}  // namespace kds
