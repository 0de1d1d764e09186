#pragma once
// What the paper measures: its own models, and proteins from the project's data.

#include <Eigen/Core>
#include <filesystem>
#include <string_view>
#include <vector>

#include "motions/base/bead_range.h"

namespace kds {

/// Frames of one necklace, or of two side by side.
struct Subject {
  std::vector<Eigen::Matrix3Xd> frames;
  std::vector<double> radii;  ///< one a bead
  std::vector<BeadRange> necklaces;
  bool planar = false;  ///< in the plane z = 0, where it is measured in two dimensions

  [[nodiscard]] std::size_t beads() const { return radii.size(); }
};

/// At rest, with beads of radius 1: spline, helix, scaling-helix or grill.
[[nodiscard]] Subject model_subject(std::string_view model, std::size_t beads);

/// `frames` stages, 2 or more, of a straight chain that rolls up in the plane; of two such chains, one above
/// the other, whose planes come from 1.5 chain lengths to a twentieth of a diameter more than touching.
[[nodiscard]] Subject rolling_spiral(std::size_t beads, std::size_t frames);
[[nodiscard]] Subject two_rolling_spirals(std::size_t beads, std::size_t frames);

/// The backbone of the first chain of a file of the folder `data`, radii as --radius auto has them. Of a DCD
/// file `topology` names the atoms, else it is empty. Throws InputError.
[[nodiscard]] Subject protein(const std::filesystem::path& data, std::string_view file,
                              std::string_view topology = {});

}  // namespace kds
