#pragma once
// A canonical form of lists of cells: each cell's beads ascending, cells in lexicographic order.

#include <algorithm>
#include <vector>

namespace kds {

template <class CellOfBeads>
void sort_cells(std::vector<CellOfBeads>& cells) {
  for (auto& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
}

}  // namespace kds
