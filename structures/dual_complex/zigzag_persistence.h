#pragma once
// Persistence of a complex whose simplices are inserted and deleted: how long each component, tunnel and void
// lasts, and which simplices begin and end it.
//
// The intervals are those of zigzag persistence over the field of two elements. The zigzag is turned into a
// filtration without deletions: each insertion adds a new cell, and each deletion, in reverse order, adds the
// cone of the cell from one more vertex. The pairs of this filtration correspond to the intervals (T. Dey, T.
// Hou, "Fast computation of zigzag persistence", 2022). Pairs are found by the reduction of the boundary
// matrix, from high dimensions to low ones, with clearing.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>
#include <vector>

#include "structures/dual_complex/triangulation_faces.h"

namespace kds {

class ZigzagPersistence {
 public:
  /// A class of homology that exists from one insertion or deletion to another.
  struct Interval {
    int dimension = 0;  ///< 0: component, 1: tunnel, 2: void
    /// Index of the insertion or deletion that begins it, and of the one that ends it; both are counted
    /// together from 0.
    std::size_t begin = 0, end = 0;
  };

  /// Inserts or deletes the next simplex: one to four beads, ascending; unused entries hold no_bead. Throws
  /// std::invalid_argument, and changes nothing, if a simplex is inserted twice or before its facets, or is
  /// deleted while it is missing or has cofaces.
  void add(bool inserts, const SimplexBeads& beads) { inserts ? insert(beads) : erase(beads); }
  /// Returns the number of insertions and deletions so far.
  [[nodiscard]] std::size_t count() const { return count_; }

  /// Returns all intervals of a dimension, in any order. An interval that lasts until now ends at count() or
  /// later. Takes time cubic in the number of insertions at worst, and nearly linear time in practice.
  [[nodiscard]] std::vector<Interval> intervals(int dimension) const {
    ZigzagPersistence ended = *this;
    std::vector<std::pair<std::size_t, SimplexBeads>> left;  // with their dimension
    for (const auto& [beads, cell] : live_) left.emplace_back(cells_[cell].dimension, beads);
    std::sort(left.rbegin(), left.rend());
    for (const auto& [of, beads] : left) ended.erase(beads);
    std::vector<Interval> found = ended.find_pairs();
    std::erase_if(found, [&](const Interval& interval) {
      return interval.dimension != dimension || interval.begin >= count_;
    });
    return found;
  }

 private:
  using Column = std::vector<std::uint32_t>;  // ascending
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  struct Cell {
    std::size_t dimension = 0;
    std::size_t inserted = 0, deleted = 0;
    std::vector<std::uint32_t> facets{};
    std::uint32_t cofaces = 0;
  };

  void insert(const SimplexBeads& beads) {
    const auto size =
        static_cast<std::size_t>(std::find(beads.begin(), beads.end(), no_bead) - beads.begin());
    Cell cell{size - 1, count_, 0};
    for (std::size_t off = 0; off < size && size > 1; ++off) {
      SimplexBeads facet = beads;
      std::copy(facet.begin() + static_cast<std::ptrdiff_t>(off) + 1, facet.end(),
                facet.begin() + static_cast<std::ptrdiff_t>(off));
      facet.back() = no_bead;
      const auto found = live_.find(facet);
      if (found == live_.end()) throw std::invalid_argument("a simplex is inserted before its facets");
      cell.facets.push_back(found->second);
    }
    if (size == 0) throw std::invalid_argument("a simplex without beads");
    if (!live_.emplace(beads, static_cast<std::uint32_t>(cells_.size())).second)
      throw std::invalid_argument("a simplex is inserted twice");
    for (const std::uint32_t facet : cell.facets) ++cells_[facet].cofaces;
    cells_.push_back(std::move(cell));
    ++count_;
  }
  void erase(const SimplexBeads& beads) {
    const auto found = live_.find(beads);
    if (found == live_.end() || cells_[found->second].cofaces > 0)
      throw std::invalid_argument("a simplex is deleted that is missing or has cofaces");
    for (const std::uint32_t facet : cells_[found->second].facets) --cells_[facet].cofaces;
    cells_[found->second].deleted = count_++;
    deleted_.push_back(found->second);
    live_.erase(found);
  }

  /// Finds the pairs of the filtration: the cells, then the cones of the deleted cells, last one first. Its
  /// index 0 is the vertex of the cones.
  [[nodiscard]] std::vector<Interval> find_pairs() const {
    const std::size_t count = cells_.size();
    std::vector<std::uint32_t> cone_of(count);  // index of each cell's cone
    for (std::size_t i = 0; i < count; ++i)
      cone_of[deleted_[count - 1 - i]] = static_cast<std::uint32_t>(1 + count + i);
    std::vector<std::uint32_t> cell_at(2 * count + 1, none);
    std::vector<std::vector<std::uint32_t>> by_dimension(5);  // indices, ascending
    for (std::uint32_t cell = 0; cell < count; ++cell) {
      cell_at[1 + cell] = cell_at[cone_of[cell]] = cell;
      by_dimension[cells_[cell].dimension].push_back(1 + cell);
    }
    for (std::uint32_t index = static_cast<std::uint32_t>(1 + count); index < cell_at.size(); ++index)
      by_dimension[cells_[cell_at[index]].dimension + 1].push_back(index);

    std::vector<Column> reduced(2 * count + 1);
    std::vector<std::uint32_t> paired_with(2 * count + 1, none);  // of a pivot: the column that has it
    std::vector<Interval> intervals;
    for (std::size_t dimension = 5; dimension-- > 1;)
      for (const std::uint32_t index : by_dimension[dimension]) {
        if (paired_with[index] != none) continue;  // cleared: the column would become zero
        Column column = boundary_of(index, cell_at[index], cone_of);
        while (!column.empty() && paired_with[column.back()] != none) {
          const Column& other = reduced[paired_with[column.back()]];
          Column sum;
          std::set_symmetric_difference(column.begin(), column.end(), other.begin(), other.end(),
                                        std::back_inserter(sum));
          column = std::move(sum);
        }
        if (column.empty()) continue;
        const std::uint32_t pivot = column.back();
        paired_with[pivot] = index;
        if (pivot > 0) add_interval(pivot, index, cell_at, intervals);
        reduced[index] = std::move(column);
      }
    return intervals;
  }

  [[nodiscard]] Column boundary_of(std::uint32_t index, std::uint32_t cell,
                                   const std::vector<std::uint32_t>& cone_of) const {
    Column column;
    const bool is_cone = index > cells_.size();
    for (const std::uint32_t facet : cells_[cell].facets)
      column.push_back(is_cone ? cone_of[facet] : 1 + facet);
    if (is_cone) {
      column.push_back(1 + cell);
      if (cells_[cell].dimension == 0) column.push_back(0);
    }
    std::sort(column.begin(), column.end());
    return column;
  }

  /// Adds the interval of a pair of the filtration.
  void add_interval(std::uint32_t first, std::uint32_t second, const std::vector<std::uint32_t>& cell_at,
                    std::vector<Interval>& intervals) const {
    const std::size_t count = cells_.size();
    const Cell &a = cells_[cell_at[first]], &b = cells_[cell_at[second]];
    const int dimension = static_cast<int>(a.dimension);
    if (second <= count) {  // two insertions
      intervals.push_back({dimension, a.inserted, b.inserted});
    } else if (first > count) {  // two deletions, which the filtration has in reverse order
      intervals.push_back({dimension, b.deleted, a.deleted});
    } else if (a.inserted < b.deleted) {
      intervals.push_back({dimension, a.inserted, b.deleted});
    } else {
      intervals.push_back({dimension - 1, b.deleted, a.inserted});
    }
  }

  std::vector<Cell> cells_;
  std::vector<std::uint32_t> deleted_;  // cells in the order of their deletions
  std::map<SimplexBeads, std::uint32_t> live_;
  std::size_t count_ = 0;
};

}  // namespace kds
