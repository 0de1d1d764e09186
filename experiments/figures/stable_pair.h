#pragma once
// A search for the paper's figure 3: two conformations of a planar necklace between which only the basis of
// the root changes.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace kds {

struct StablePair {
  std::vector<Eigen::Matrix3Xd> frames;  ///< centres of beads of radius 1, from one conformation to the other
  double deformation = 0;        ///< root mean square change of the distances of beads / greatest distance
  std::size_t root_changes = 0;  ///< basis changes of the root during the motion
  std::size_t candidate = 0;     ///< number of the candidate, from 0
};

struct StablePairSearch {
  std::size_t beads = 32;  ///< at least 4
  std::size_t candidates = 2000;
  std::uint64_t seed = 1;
};

/// Draws candidates at random: chains in the plane whose curvature changes linearly in time between two
/// random sums of four cosines, in 21 frames. Returns the candidate of greatest deformation that is a proper
/// necklace in every frame and keeps all bases except the root's, or none. A kinetic run over the frames,
/// with linear motion between them, proves that no other basis changes at any time.
[[nodiscard]] std::optional<StablePair> find_stable_pair(const StablePairSearch& search);

}  // namespace kds
