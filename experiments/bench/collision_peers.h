#pragma once
// Collision detection libraries with which kds_bench compares kds, if it was built with them: FCL
// (libfcl-dev) and Bullet (libbullet-dev).

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string_view>

#include "structures/impacts/feature_pair.h"
#include "structures/necklace/balls.h"

namespace kds::bench {

/// A tree over one scene.
class PeerTree {
 public:
  virtual ~PeerTree() = default;
  /// Returns the number of meeting pairs of balls that are not neighbours along the chain.
  [[nodiscard]] virtual std::size_t pairs() = 0;
};

struct CollisionPeer {
  std::string_view name;
  /// Builds a tree over the balls, which must outlive the tree.
  std::unique_ptr<PeerTree> (*build)(const Balls<3>& balls);
};

[[nodiscard]] std::span<const CollisionPeer> collision_peers();

/// Returns whether FCL finds a collision of a point and a triangle, or of two edges, on straight paths
/// (approximate), or nothing without FCL. Takes points as ImpactSearch does.
[[nodiscard]] std::optional<bool> fcl_collides(ImpactKind kind, std::span<const double> points);

}  // namespace kds::bench
