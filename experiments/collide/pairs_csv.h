#pragma once
// The colliding pairs of each frame, for other programs, written as frames go by.

#include <ostream>
#include <span>

#include "experiments/collide/collide_frames.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

/// Header `frame,i,j,distance,name_i,name_j`, then a line a pair: the frame by its number in the file, beads
/// by their place in the scene and, in quotes, as the file names them (empty where it does not), the distance
/// between their surfaces, rounded, so that it reads back exactly; below zero where they overlap.
class PairsCsv {
 public:
  /// Writes the header. Both must outlive this.
  PairsCsv(std::ostream& stream, const CollideFrames& scene);
  void add(const FrameRead& frame, std::span<const BeadPair> pairs);

 private:
  std::ostream& stream_;
  const CollideFrames& scene_;
};

}  // namespace kds
