#pragma once
// A cell list, the usual method for near pairs. Beads are sorted into the cells of a uniform grid. A cell is
// as wide as the greatest reach of two balls, so balls that meet lie in one cell or in adjacent cells. The
// other detectors are compared with this baseline.
//
// The number of cells in the scene's box decides between two forms. Dense grids have at most a few cells per
// bead: beads are placed by counting sort, with an array of the start of each cell. Sparse grids have more
// cells (a helix in a cube has n^3 / 10^4): only occupied cells are stored, sorted by key, and pointers into
// the rows of adjacent cells advance along the sorted list together with the cell.
//
// The result is exact for all finite input: the cells and a filter in doubles only rule pairs out. Takes n
// time (n log n for the radix sort) plus the number of pairs in adjacent cells. One ball that is much larger
// than the others makes all cells as large as itself. A scene more than 2^20 balls long makes its cells as
// long as 2^-20 of the scene. In the worst case all pairs are tested.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "structures/blocks/float_conversion.h"
#include "structures/collision/balls_meet.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

template <int Dimension>
class CellList {
 public:
  explicit CellList(PairsAsked asked);

  /// Returns all pairs asked about that meet, in order. The result is valid until the next call.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls) { return pairs_within(balls, 0); }
  /// Returns all pairs asked about that are at most `distance` apart (finite, not negative), in order. The
  /// result is valid until the next call.
  const std::vector<BeadPair>& pairs_within(const Balls<Dimension>& balls, double distance);
  /// Returns all pairs asked about that are at most `gap` apart (finite, not negative), and some pairs
  /// slightly farther apart, in no particular order.
  std::span<const BeadPair> near_pairs(const Balls<Dimension>& balls, double gap);

 private:
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  /// A bead in its cell, with scaled coordinates.
  struct BeadInCell {
    std::array<double, dimension> center;
    BeadId bead;
  };
  struct Grid {
    FloatConversion<Dimension> conversion;
    std::array<double, dimension> low;
    std::array<std::uint64_t, dimension> stride;  // key differences of adjacent cells
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
  [[nodiscard]] BeadInCell entry_of(const Balls<Dimension>& balls, const Grid& grid, BeadId bead) const;

  PairsAsked asked_;
  bool one_necklace_;
  std::int64_t least_along_ = 0;                     // least distance in sequence within a necklace
  std::vector<std::uint64_t> keys_of_beads_, keys_;  // keys_: keys of entries, then a sentinel
  std::vector<std::uint32_t> starts_;                // where each cell starts
  std::vector<std::array<std::uint64_t, 2>> keyed_, more_keyed_;
  std::vector<BeadInCell> entries_;
  std::vector<std::uint32_t> around_;  // entries to compare with a cell's; its own come first
  std::size_t listed_ = 0;
  std::vector<BeadPair> candidates_, pairs_;
  PairSorter sorter_;
};

/// A Verlet list, the method by which molecular dynamics finds near pairs from frame to frame. A cell list
/// finds all pairs that are at most the skin apart. These pairs are tested at every frame until some bead has
/// moved by more than half the skin. This method is the baseline for slow motion.
///
/// The result is exact: two balls that meet before the list is made again were at most the skin apart when it
/// was made. The displacement test runs in doubles with room for rounding: squares have relative errors below
/// 2^-50, and the limit is smaller by 2^-40. If the squared limit is near underflow or overflow (below 2^-900
/// or above 2^900), the list is made anew at every frame.
template <int Dimension>
class VerletList {
 public:
  /// A skin of one radius is usual.
  VerletList(PairsAsked asked, double skin) : cells_(std::move(asked)), skin_(skin) {}

  /// Returns all pairs asked about that meet, in order. The result is valid until the next call. Successive
  /// calls are frames of the same beads with unchanged radii.
  const std::vector<BeadPair>& pairs(const Balls<Dimension>& balls);

  [[nodiscard]] std::uint64_t rebuilds() const { return rebuilds_; }
  [[nodiscard]] std::size_t size() const { return others_.size(); }

 private:
  static constexpr auto dimension = static_cast<std::size_t>(Dimension);
  [[nodiscard]] bool holds(const Balls<Dimension>& balls) const;
  void rebuild(const Balls<Dimension>& balls);

  CellList<Dimension> cells_;
  double skin_;
  std::array<std::vector<double>, dimension> made_at_;
  // The later beads near bead b: others_[starts_[b]] .. others_[starts_[b + 1]], ascending.
  std::vector<std::uint32_t> starts_;
  std::vector<BeadId> others_;
  std::vector<BeadPair> near_, pairs_;
  PairSorter sorter_;
  std::uint64_t rebuilds_ = 0;
};

}  // namespace kds
