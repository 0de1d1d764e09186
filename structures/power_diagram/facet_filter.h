#pragma once
// Finds facets whose power test is positive over the whole step, as most are in most steps. The filter reads
// facets directly from the cells and evaluates them in lanes (certificates/filters/cell_filter.h), without
// making a certificate for each. Facets not found positive are left to certificates. The filter also reports
// cells that are found positive at the end of the step, so that they need no check there.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "certificates/base/kernel.h"
#include "certificates/filters/cell_filter.h"
#include "motions/curves/curves.h"
#include "motions/views/lanes_view.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// Bit set of all facets of a cell.
template <int Dimension>
inline constexpr unsigned all_facets = (2U << Dimension) - 1;

/// Returns the number of facets in the set. Avoids std::popcount, which is a call unless the compiler may
/// assume an instruction for it.
template <int Dimension>
[[nodiscard]] constexpr unsigned count_of(unsigned facets) {
  constexpr std::uint64_t counts = 0x4332322132212110;  // hexadecimal digit k counts the bits of k
  return static_cast<unsigned>(counts >> (4 * (facets & all_facets<Dimension>)) & 0xfU);
}

/// Returns the set of facets between a finite cell and finite neighbours, one bit each. Empty for an infinite
/// cell.
template <int Dimension>
[[nodiscard]] unsigned finite_facets(const TriangulationCell<Dimension>& cell) {
  unsigned facets = 0;
  unsigned finite = 1;
  for (std::size_t i = 0; i <= Dimension; ++i) {
    finite &= cell.vertex[i] != infinite_bead ? 1U : 0U;
    facets |= (cell.apex[i] != infinite_bead ? 1U : 0U) << i;
  }
  return facets & (0U - finite);
}

/// Chooses one of the two cells of each facet, so that few cells are visited, because a cell costs more than
/// a facet. A cell is left out if none of its neighbours is; in space this leaves out a third of all cells.
class FacetCover {
 public:
  void start(std::size_t cells) { left_out_.assign(cells, 0); }

  /// Returns the set of facets to examine from this cell, one bit each. Must be called for all relevant cells
  /// in ascending order.
  template <int Dimension>
  [[nodiscard]] unsigned facets_of(const TriangulationCell<Dimension>& cell, CellId id, bool may_be_left) {
    unsigned facets = 0, left_before = 0;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      const CellId other = cell_of(cell.beyond[i]);
      const unsigned left = left_out_[other];
      left_before |= left;
      facets |= (left | (id < other ? 1U : 0U)) << i;
    }
    const unsigned leave = (may_be_left ? 1U : 0U) & (left_before == 0 ? 1U : 0U);  // branch-free
    left_out_[id] = static_cast<std::uint8_t>(leave);
    return facets & (leave - 1);
  }

 private:
  std::vector<std::uint8_t> left_out_;
};

/// Returns the binary exponent of a typical cell length in the step: the median of the longest side at its
/// start, over some cells. Returns 0 if no cell can be measured.
template <int Dimension>
[[nodiscard]] int exponent_of_length(
    const Curves<Dimension>& curves,
    std::type_identity_t<std::span<const TriangulationCell<Dimension>>> cells) {
  constexpr std::size_t looked_at = 15;
  std::array<double, looked_at> longest;
  std::size_t count = 0;
  for (std::size_t n = 0; n < looked_at && n < cells.size(); ++n) {
    const auto& v = cells[n * cells.size() / looked_at].vertex;
    double most = 0;
    for (const BeadId b : v) {
      if (b == infinite_bead || v[0] == infinite_bead) continue;
      for (int axis = 0; axis < Dimension; ++axis)
        most = std::max(most, std::abs(curves.coordinate(b, 0, axis) - curves.coordinate(v[0], 0, axis)));
    }
    if (most > 0 && std::isfinite(most)) longest[count++] = most;
  }
  if (count == 0) return 0;
  const auto middle = longest.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(longest.begin(), middle, longest.begin() + static_cast<std::ptrdiff_t>(count));
  constexpr int most = 500;  // keeps the square within the range of doubles
  return std::clamp(std::ilogb(*middle), -most, most);
}

/// Maps a set of facets of a cell, one bit each, to these facets in ascending order, two bits each.
inline constexpr auto facet_orders = [] {
  std::array<std::uint8_t, 16> orders{};
  for (unsigned facets = 0; facets < orders.size(); ++facets) {
    unsigned index = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if ((facets >> i & 1U) == 0) continue;
      orders[facets] = static_cast<std::uint8_t>(orders[facets] | i << (2 * index));
      ++index;
    }
  }
  return orders;
}();
[[nodiscard]] inline int facet_at(unsigned facets, int index) {
  return static_cast<int>(facet_orders[facets] >> (2 * index) & 3U);
}

/// The inverse: maps a set of facets and a set of indices in their order to the set of facets at these
/// indices.
inline constexpr auto facets_at_indices = [] {
  std::array<std::array<std::uint8_t, 16>, 16> facets{};
  for (unsigned wanted = 0; wanted < facets.size(); ++wanted) {
    for (unsigned indices = 0; indices < facets.size(); ++indices) {
      unsigned index = 0;
      for (unsigned i = 0; i < 4; ++i) {
        if ((wanted >> i & 1U) == 0) continue;
        facets[wanted][indices] =
            static_cast<std::uint8_t>(facets[wanted][indices] | (indices >> index & 1U) << i);
        ++index;
      }
    }
  }
  return facets;
}();

/// Converts what is found at indices of wanted facets into bits of the facets themselves, and keeps the bits
/// that concern the cell.
template <int Dimension>
[[nodiscard]] unsigned with_facets_at_indices(unsigned wanted, unsigned found) {
  constexpr unsigned of_each_part = 0x01010101U;
  unsigned facets = 0;
  const int parts = found >> bits_of_part == 0 ? 0 : positive_parts;
  for (int part = 0; part <= parts; ++part) {
    const int shift = part * bits_of_part;
    facets |= unsigned{facets_at_indices[wanted][found >> shift & all_facets<Dimension>]} << shift;
  }
  return facets | (found & ~(all_facets<Dimension> * of_each_part));
}

/// Returns the bits that are set for the step or for some part of it.
[[nodiscard]] constexpr unsigned in_some_part(unsigned found) {
  found |= found >> (2 * bits_of_part);
  found |= found >> bits_of_part;
  return found & ((1U << bits_of_part) - 1);
}

/// Lists the beads that certificates name: the beads of the cell, then the beads beyond its wanted facets, in
/// order.
template <int Dimension>
void put_in_lane(const TriangulationCell<Dimension>& cell, unsigned wanted,
                 std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>& beads) {
  for (std::size_t i = 0; i <= Dimension; ++i) {
    beads[i] = cell.vertex[i];
    // Branch-free, because the set of wanted facets is unpredictable. The indices after the wanted facets are
    // ignored.
    beads[Dimension + 1 + i] = cell.apex[static_cast<std::size_t>(facet_at(wanted, static_cast<int>(i)))];
  }
}

/// Like the function above, for all facets in their order. If a facet has no finite bead beyond it, a bead of
/// the cell takes its place.
template <int Dimension>
void put_in_lane(const TriangulationCell<Dimension>& cell,
                 std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>& beads) {
  for (std::size_t i = 0; i <= Dimension; ++i) {
    beads[i] = cell.vertex[i];
    beads[Dimension + 1 + i] = cell.apex[i] == infinite_bead ? cell.vertex[0] : cell.apex[i];
  }
}

/// Filters up to four cells made by an event. Returns for each cell the bits found for all its facets and for
/// the cell itself. Infinite cells, and facets to them, have no bits set.
inline constexpr std::size_t few_cells = 4;
template <int Dimension>
[[nodiscard]] std::array<unsigned, few_cells> filter_few_cells(
    const CellFilter<Dimension>& filter, const LengthUnit& unit,
    std::type_identity_t<std::span<const TriangulationCell<Dimension>>> cells, std::span<const CellId> few) {
  std::array<unsigned, few_cells> found{};
  CellsInLanes<Dimension> beads;
  std::size_t finite = 0;
  for (std::size_t n = 0; n < few.size(); ++n) {
    found[n] = finite_facets(cells[few[n]]);
    if (found[n] != 0) put_in_lane(cells[few[n]], beads[finite++]);
  }
  if (finite == 0) return found;
  for (std::size_t lane = finite; lane < few_cells; ++lane) beads[lane] = beads[0];
  PositiveBits positive;
  filter.four_positive_cells(beads, unit, positive);
  constexpr unsigned of_each_part = 0x01010101U;
  for (std::size_t n = 0, lane = 0; n < few.size(); ++n) {
    if (found[n] == 0) continue;
    found[n] |= positive_at_end<Dimension> | positive_throughout<Dimension>;
    found[n] = found[n] * of_each_part & positive[lane++];
  }
  return found;
}

template <int Dimension>
class FacetFilter {
 public:
  /// Finds nothing if lengths differ from the unit by a factor above one thousand.
  FacetFilter(const CellFilter<Dimension>& filter, const LengthUnit& unit) : filter_(filter), unit_(unit) {}

  /// Adds the wanted facets of a finite cell, one bit each, a possibly empty subset of finite_facets. Reports
  /// results for this cell or earlier ones by calling `found(cell, wanted, positive)`, where `positive` says
  /// what the filter finds for the wanted facets and for the cell (PositiveBits).
  template <class Found>
  void look_at(const TriangulationCell<Dimension>& cell, CellId id, unsigned wanted, Found& found) {
    const unsigned count = count_of<Dimension>(wanted);
    Batch& batch = batches_[count];  // cells with equally many wanted facets: no lane is idle
    put_in_lane(cell, wanted, batch.beads[batch.waiting]);
    batch.cells[batch.waiting] = id;
    batch.wanted[batch.waiting] = wanted;
    ++batch.waiting;
    if (batch.waiting == width) flush(count, found);
  }
  template <class Found>
  void finish(Found& found) {
    for (unsigned count = 0; count < batches_.size(); ++count) {
      Batch& batch = batches_[count];
      if (batch.waiting == 0) continue;
      for (std::size_t lane = batch.waiting; lane < width; ++lane) batch.beads[lane] = batch.beads[0];
      flush(count, found);
    }
  }
  /// Returns the number of facets found positive.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  static constexpr std::size_t width = std::tuple_size_v<CellsInLanes<Dimension>>;
  struct Batch {
    CellsInLanes<Dimension> beads{};
    std::array<CellId, width> cells{};
    std::array<unsigned, width> wanted{};
    std::size_t waiting = 0;
  };

  template <class Found>
  void flush(unsigned facets, Found& found) {
    Batch& batch = batches_[facets];
    PositiveBits positive;
    filter_.positive_cells(batch.beads, facets, unit_, positive);
    const unsigned all = (1U << facets) - 1;
    for (std::size_t lane = 0; lane < batch.waiting; ++lane) {
      count_ += count_of<Dimension>(positive[lane] & all);
      found(batch.cells[lane], batch.wanted[lane],
            with_facets_at_indices<Dimension>(batch.wanted[lane], positive[lane]));
    }
    batch.waiting = 0;
  }

  const CellFilter<Dimension>& filter_;
  LengthUnit unit_;
  std::array<Batch, Dimension + 2> batches_;  // by the number of wanted facets in a cell
  std::uint64_t count_ = 0;
};

}  // namespace kds
