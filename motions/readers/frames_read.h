#pragma once
// What the reader of one format hands over, before the chain is made whole and searched for breaks.

#include <optional>
#include <vector>

#include "motions/readers/periodic.h"
#include "motions/readers/trajectory.h"

namespace kds {

struct FramesRead {
  Trajectory trajectory;
  std::vector<std::optional<Cell>> cells;  ///< one a frame
  bool chain_like = true;                  ///< beads that follow each other are meant to be bonded
};

}  // namespace kds
