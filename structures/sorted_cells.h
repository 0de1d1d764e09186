#pragma once
// Cells written one way: beads ascending, cells in lexicographic order.

#include <algorithm>
#include <array>
#include <vector>

#include "motions/bead.h"

namespace kds {

inline void sort_cells(std::vector<std::array<BeadId, 4>>& cells) {
  for (auto& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
}

}  // namespace kds
