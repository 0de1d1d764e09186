#pragma once
// A method of collision detection behind one interface.

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "structures/collision/closest_pair.h"
#include "structures/collision/pairs_asked.h"
#include "structures/necklace/balls.h"

namespace kds {

struct CollisionQuery {
  PairsAsked asked;
  double distance = 0;  ///< pairs at most so far apart collide, as it is called in what follows
};

/// What a method tells of one frame: all methods the same, where they tell it.
struct Detection {
  bool collide = false;
  std::optional<std::vector<BeadPair>> pairs;  ///< all that collide, ascending
  std::optional<ClosestPair> closest;          ///< of all pairs asked for
  std::optional<std::uint64_t> family;  ///< the pairs of what it groups beads in that prove the others apart
};

template <int Dimension>
class Detector {
 public:
  virtual ~Detector() = default;
  /// Why it cannot answer about these balls, in a sentence.
  [[nodiscard]] virtual std::optional<std::string> refusal(const Balls<Dimension>&) const {
    return std::nullopt;
  }
  /// Collisions of the next frame; what is kept from one frame to the next is the method's own affair.
  virtual void detect(const Balls<Dimension>& balls, Detection& found) = 0;
  /// The closest pair, where that is another search; `detect` has been called with these balls.
  virtual void find_closest(const Balls<Dimension>&, Detection&) {}
};

}  // namespace kds
