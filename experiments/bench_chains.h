#pragma once
// Chains that benchmarks of hierarchies run on, beads of radius 1: models (motions/models/model.h) at rest,
// and how their beads are moved.

#include <Eigen/Core>
#include <cstddef>
#include <string_view>
#include <vector>

namespace kds {

/// Centres of the model with its defaults, moved by up to `jitter` radii where it takes that. Throws
/// InputError where there are too few beads for it.
[[nodiscard]] Eigen::Matrix3Xd model_at_rest(std::string_view model, std::size_t beads, double jitter = 0.05);

/// Frame after frame every bead moves `distance` in a direction of its own.
[[nodiscard]] std::vector<Eigen::Matrix3Xd> jostled_frames(const Eigen::Matrix3Xd& start, double distance,
                                                           std::size_t frames);

}  // namespace kds
