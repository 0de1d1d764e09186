#pragma once
// Facets whose power test is positive all over a step, as in most steps most are: they are looked at as they
// lie in the cells, in lanes (certificates/filters/cell_filter.h), without a certificate made for each. What
// is not found positive here is for the certificates. Cells that are found positive where the step ends are
// told as well: they need not be looked at again there.

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
#include "motions/views/length_unit.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// One bit for each facet of a cell.
template <int Dimension>
inline constexpr unsigned all_facets = (2U << Dimension) - 1;

/// How many facets; without a call where the processor it is compiled for need not be able to count.
template <int Dimension>
[[nodiscard]] constexpr unsigned count_of(unsigned facets) {
  constexpr std::uint64_t counts = 0x4332322132212110;  // a digit each
  return static_cast<unsigned>(counts >> (4 * (facets & all_facets<Dimension>)) & 0xfU);
}

/// Facets of a finite cell to finite ones, one bit each; of an infinite cell none.
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

/// Each facet is looked at from one of its two cells, and from few cells, as a cell costs more than a facet:
/// one is left out where none of its neighbours is, in space a third of them.
class FacetCover {
 public:
  void start(std::size_t cells) { left_out_.assign(cells, 0); }

  /// Facets to look at from a cell, one bit each; asked of all that count, ascending.
  template <int Dimension>
  [[nodiscard]] unsigned facets_of(const TriangulationCell<Dimension>& cell, CellId id, bool may_be_left) {
    unsigned facets = 0, left_before = 0;
    for (std::size_t i = 0; i <= Dimension; ++i) {
      const CellId other = cell_of(cell.beyond[i]);
      const unsigned left = left_out_[other];
      left_before |= left;
      facets |= (left | (id < other ? 1U : 0U)) << i;
    }
    const unsigned leave = (may_be_left ? 1U : 0U) & (left_before == 0 ? 1U : 0U);  // no branch
    left_out_[id] = static_cast<std::uint8_t>(leave);
    return facets & (leave - 1);
  }

 private:
  std::vector<std::uint8_t> left_out_;
};

/// The binary exponent of a length that cells have in the motion's step: of the longest side at its start, by
/// a median over some cells. 0 where there is nothing to be measured.
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
  constexpr int most = 500;  // so that its square is a double
  return std::clamp(std::ilogb(*middle), -most, most);
}

/// Of each set of facets of a cell, one bit each, those facets in order, two bits each.
inline constexpr auto facet_orders = [] {
  std::array<std::uint8_t, 16> orders{};
  for (unsigned facets = 0; facets < orders.size(); ++facets) {
    unsigned place = 0;
    for (unsigned i = 0; i < 4; ++i) {
      if ((facets >> i & 1U) == 0) continue;
      orders[facets] = static_cast<std::uint8_t>(orders[facets] | i << (2 * place));
      ++place;
    }
  }
  return orders;
}();
[[nodiscard]] inline int facet_at(unsigned facets, int place) {
  return static_cast<int>(facet_orders[facets] >> (2 * place) & 3U);
}

/// The other way round: facets, one bit each, at those of the places in that order that have one.
inline constexpr auto facets_at_places = [] {
  std::array<std::array<std::uint8_t, 16>, 16> facets{};
  for (unsigned wanted = 0; wanted < facets.size(); ++wanted) {
    for (unsigned places = 0; places < facets.size(); ++places) {
      unsigned place = 0;
      for (unsigned i = 0; i < 4; ++i) {
        if ((wanted >> i & 1U) == 0) continue;
        facets[wanted][places] =
            static_cast<std::uint8_t>(facets[wanted][places] | (places >> place & 1U) << i);
        ++place;
      }
    }
  }
  return facets;
}();

/// What is found at places of wanted facets, and of their cell, with these facets' bits in place of those.
template <int Dimension>
[[nodiscard]] unsigned with_facets_at_places(unsigned wanted, unsigned found) {
  constexpr unsigned of_each_part = 0x01010101U;
  unsigned facets = 0;
  const int parts = found >> bits_of_part == 0 ? 0 : positive_parts;
  for (int part = 0; part <= parts; ++part) {
    const int shift = part * bits_of_part;
    facets |= unsigned{facets_at_places[wanted][found >> shift & all_facets<Dimension>]} << shift;
  }
  return facets | (found & ~(all_facets<Dimension> * of_each_part));
}

/// What is found of the step or of some part of it.
[[nodiscard]] constexpr unsigned in_some_part(unsigned found) {
  found |= found >> (2 * bits_of_part);
  found |= found >> bits_of_part;
  return found & ((1U << bits_of_part) - 1);
}

/// As the certificates want them: the beads of a cell, then those beyond its wanted facets, in order.
template <int Dimension>
void put_in_lane(const TriangulationCell<Dimension>& cell, unsigned wanted,
                 std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>& beads) {
  for (std::size_t i = 0; i <= Dimension; ++i) {
    beads[i] = cell.vertex[i];
    // No branch: no one foretells which are wanted. What comes after them is not asked for.
    beads[Dimension + 1 + i] = cell.apex[static_cast<std::size_t>(facet_at(wanted, static_cast<int>(i)))];
  }
}

/// The same of all facets, in their order. Where there is no bead beyond, one of the cell serves.
template <int Dimension>
void put_in_lane(const TriangulationCell<Dimension>& cell,
                 std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>& beads) {
  for (std::size_t i = 0; i <= Dimension; ++i) {
    beads[i] = cell.vertex[i];
    beads[Dimension + 1 + i] = cell.apex[i] == infinite_bead ? cell.vertex[0] : cell.apex[i];
  }
}

/// The cells that an event made, up to four: of each what the filter tells of all its facets and of itself.
/// Of an infinite cell, and of facets to one, that is nothing.
inline constexpr std::size_t few_cells = 4;
template <int Dimension>
[[nodiscard]] std::array<unsigned, few_cells> filter_few_cells(
    const CellFilter<Dimension>& filter, const LengthUnit& unit, Rounding rounding,
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
  filter.four_positive_cells(beads, unit, rounding, positive);
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
  /// Where lengths are a thousand times as long as the unit or as short, nothing is found.
  FacetFilter(const CellFilter<Dimension>& filter, const LengthUnit& unit, Rounding rounding)
      : filter_(filter), unit_(unit), rounding_(rounding) {}

  /// Those facets of a finite cell, one bit each, that are wanted, of finite_facets, or none. Tells of this
  /// cell or earlier ones, by `found(cell, wanted, positive)`: what the filter tells of the wanted facets
  /// and of the cell (PositiveBits).
  template <class Found>
  void look_at(const TriangulationCell<Dimension>& cell, CellId id, unsigned wanted, Found& found) {
    const unsigned count = count_of<Dimension>(wanted);
    Batch& batch = batches_[count];  // cells of as many wanted facets: none waits for another's
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
  /// How many were found positive.
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
    filter_.positive_cells(batch.beads, facets, unit_, rounding_, positive);
    const unsigned all = (1U << facets) - 1;
    for (std::size_t lane = 0; lane < batch.waiting; ++lane) {
      count_ += count_of<Dimension>(positive[lane] & all);
      found(batch.cells[lane], batch.wanted[lane],
            with_facets_at_places<Dimension>(batch.wanted[lane], positive[lane]));
    }
    batch.waiting = 0;
  }

  const CellFilter<Dimension>& filter_;
  LengthUnit unit_;
  Rounding rounding_;
  std::array<Batch, Dimension + 2> batches_;  // by how many facets are wanted of a cell
  std::uint64_t count_ = 0;
};

}  // namespace kds
