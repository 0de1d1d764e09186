#pragma once
// The common interface of the methods of collision detection.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "structures/collision/closest_pair.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

struct CollisionQuery {
  PairsAsked asked;
  double distance = 0;  ///< pairs with at most this distance count as colliding
};

/// The results of a method for one frame. All methods that report a result report the same one, except for
/// `family`.
struct Detection {
  bool collide = false;
  std::optional<std::vector<BeadPair>> pairs;  ///< all colliding pairs, ascending
  std::optional<ClosestPair> closest;          ///< of all pairs asked for
  std::optional<std::uint64_t> family;  ///< number of pairs of bead groups that prove the other pairs apart
};

template <int Dimension>
class Detector {
 public:
  virtual ~Detector() = default;
  /// Returns a sentence that says why the method cannot handle these balls, or nothing if it can.
  [[nodiscard]] virtual std::optional<std::string> refusal(const Balls<Dimension>&) const {
    return std::nullopt;
  }
  /// Finds the collisions of the next frame. The method may keep data from one frame to the next.
  virtual void detect(const Balls<Dimension>& balls, Detection& found) = 0;
  /// Finds the closest pair, if that needs a separate search. Call `detect` with these balls first.
  virtual void find_closest(const Balls<Dimension>&, Detection&) {}
};

}  // namespace kds
