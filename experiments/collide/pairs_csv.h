#pragma once
// Writes the colliding pairs of each frame for other programs, frame by frame during the run.

#include <ostream>
#include <span>

#include "experiments/collide/collide_frames.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// The header is `frame,i,j,distance,name_i,name_j`, followed by one line per pair. `frame` is the frame's
/// number in the file. `i` and `j` are the beads' numbers in the scene. `name_i` and `name_j` are the names
/// in the file, in quotes, or empty if it has none. `distance` is the rounded distance between the surfaces,
/// printed so that it reads back exactly. It is negative if the balls overlap.
class PairsCsv {
 public:
  /// Writes the header. Stream and scene must outlive this object.
  PairsCsv(std::ostream& stream, const CollideFrames& scene);
  void add(const FrameRead& frame, std::span<const BeadPair> pairs);

 private:
  std::ostream& stream_;
  const CollideFrames& scene_;
};

}  // namespace kds
