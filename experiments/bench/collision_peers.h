#pragma once
// Libraries for collision detection that `kds bench collision` measures beside ours, where this program was
// built with them: FCL (libfcl-dev) and Bullet (libbullet-dev).

#include <cstddef>
#include <memory>
#include <span>
#include <string_view>

#include "structures/necklace/balls.h"

namespace kds {

/// A tree over one scene.
class PeerTree {
 public:
  virtual ~PeerTree() = default;
  /// How many pairs of balls meet that are not neighbours along the chain.
  [[nodiscard]] virtual std::size_t pairs() = 0;
};

struct CollisionPeer {
  std::string_view name;
  /// The balls must outlive the tree.
  std::unique_ptr<PeerTree> (*build)(const Balls<3>& balls);
};

[[nodiscard]] std::span<const CollisionPeer> collision_peers();

/// A line naming those that are missing; empty where none are.
[[nodiscard]] std::string_view missing_collision_peers();

}  // namespace kds
