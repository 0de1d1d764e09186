#pragma once
// What the reader of one format hands over, before the chain is made whole and searched for breaks.

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "motions/readers/periodic.h"
#include "motions/readers/trajectory.h"

namespace kds {

struct ChainRead {
  std::string name;
  std::size_t bead_count = 0;
};

struct FramesRead {
  Trajectory trajectory;
  std::vector<ChainRead>
      chains;  ///< that the beads belong to, one after the other; empty: one without a name
  std::vector<std::optional<Cell>> cells;  ///< one a frame
  bool chain_like = true;                  ///< beads that follow each other are meant to be bonded
};

}  // namespace kds
