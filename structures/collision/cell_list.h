#pragma once
// A cell list, what most programs find near pairs with: beads sorted into the cells of a uniform grid as wide
// as two balls reach, so that balls that meet are in one cell or in neighbours. The baseline that other
// detectors are measured against.
//
// Two forms, chosen by how many cells the scene's box has. Up to a few a bead: counted out, with an array
// that says where each cell starts. More (a helix in a cube has n^3 / 10^4): only cells with beads, sorted by
// their place; the rows of cells around move on along the sorted list as the cell does.
//
// Exact for all finite input: the cells and a filter in doubles only rule out. Time: n, or n log n by radix,
// plus the pairs in neighbouring cells. One ball that is much larger than the others makes all cells as large
// as itself, and a scene more than 2^20 balls long makes them as long as 2^-20 of it: at worst all pairs are
// looked at.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "structures/blocks/float_frame.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/pairs_asked.h"

namespace kds {

template <int Dimension>
class CellList {
 public:
  explicit CellList(PairsAsked asked);

  /// All pairs asked about that meet, in order. Valid until the next call.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls) { return pairs_within(balls, 0); }
  /// The same of pairs that are at most so far apart (finite, not negative).
  const std::vector<BeadPair>& pairs_within(const Balls<Dimension>& balls, double distance);
  /// All pairs asked about that are at most `gap` apart (finite, not negative), and some that are little
  /// farther, in no order.
  std::span<const BeadPair> near_pairs(const Balls<Dimension>& balls, double gap);

 private:
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  /// A bead in its cell, coordinates scaled.
  struct Entry {
    std::array<double, dimension> center;
    BeadId bead;
  };
  struct Grid {
    FloatFrame<Dimension> frame;
    std::array<double, dimension> low;
    std::array<std::uint64_t, dimension> stride;  // between cells, in keys
    double cells_a_length, gap;                   // scaled
    std::uint64_t keys;
    [[nodiscard]] bool is_dense(std::size_t beads) const { return keys <= 8 * beads + 4096; }
  };

  [[nodiscard]] Grid lay_grid(const Balls<Dimension>& balls, double gap) const;
  void find_keys(const Balls<Dimension>& balls, const Grid& grid);
  void count_out(const Balls<Dimension>& balls, const Grid& grid);
  void sort_by_radix(const Balls<Dimension>& balls, const Grid& grid);
  template <bool Equal>
  void look_around(const Balls<Dimension>& balls, const Grid& grid);
  void list_more(std::uint32_t first, std::uint32_t last);
  template <bool Equal>
  void compare_cell(const Balls<Dimension>& balls, std::uint32_t begin, std::uint32_t end, const Grid& grid);
  [[nodiscard]] Entry entry_of(const Balls<Dimension>& balls, const Grid& grid, BeadId bead) const;

  PairsAsked asked_;
  bool one_necklace_;
  std::int64_t least_along_ = 0;                     // of one necklace: beads must be so many apart
  std::vector<std::uint64_t> keys_of_beads_, keys_;  // keys_: of entries, and one behind that is above all
  std::vector<std::uint32_t> starts_;                // of cells
  std::vector<std::array<std::uint64_t, 2>> keyed_, more_keyed_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> around_;  // entries to compare a cell's with, its own first
  std::size_t listed_ = 0;
  std::vector<BeadPair> candidates_, pairs_;
  PairSorter sorter_;
};

}  // namespace kds
