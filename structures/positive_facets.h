#pragma once
// Facets whose power test is positive all over a step, as in most steps most are: they are looked at as they
// lie in the cells, in lanes (certificates/positive_cells.h), without a certificate made for each. What is
// not found positive here is for the certificates.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/positive_cells.h"
#include "structures/regular_triangulation.h"

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
  bool finite = true;
  for (std::size_t i = 0; i <= Dimension; ++i) {
    finite &= cell.vertex[i] != infinite_bead;
    facets |= (cell.apex[i] != infinite_bead ? 1U : 0U) << i;
  }
  return finite ? facets : 0;
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
    const bool leave = may_be_left && left_before == 0;
    left_out_[id] = leave ? 1 : 0;
    return leave ? 0 : facets;
  }

 private:
  std::vector<std::uint8_t> left_out_;
};

/// The binary exponent of a length that cells have in the motion's step: of the longest side at its start, by
/// a median over some cells. 0 where there is nothing to be measured.
template <Motion M>
[[nodiscard]] int exponent_of_length(const M& motion,
                                     std::span<const TriangulationCell<M::dimension>> cells) {
  constexpr std::size_t looked_at = 15;
  std::array<double, looked_at> longest;
  std::size_t count = 0;
  for (std::size_t n = 0; n < looked_at && n < cells.size(); ++n) {
    const auto& v = cells[n * cells.size() / looked_at].vertex;
    double most = 0;
    for (const BeadId b : v) {
      if (b == infinite_bead || v[0] == infinite_bead) continue;
      for (int axis = 0; axis < M::dimension; ++axis)
        most = std::max(most, std::abs(motion.coordinate(b, 0, axis) - motion.coordinate(v[0], 0, axis)));
    }
    if (most > 0 && std::isfinite(most)) longest[count++] = most;
  }
  if (count == 0) return 0;
  const auto middle = longest.begin() + static_cast<std::ptrdiff_t>(count / 2);
  std::nth_element(longest.begin(), middle, longest.begin() + static_cast<std::ptrdiff_t>(count));
  constexpr int most = 500;  // so that its square is a double
  return std::clamp(std::ilogb(*middle), -most, most);
}

/// Processors to look for: the best there is, or what any has.
enum class Processor : std::uint8_t { best, any };

/// As the certificates want them: the beads of a cell, then those beyond its facets. Where there is none a
/// bead of the cell serves.
template <int Dimension>
void put_in_lane(const TriangulationCell<Dimension>& cell,
                 std::array<BeadId, 2 * (static_cast<std::size_t>(Dimension) + 1)>& beads) {
  for (std::size_t i = 0; i <= Dimension; ++i) {
    beads[i] = cell.vertex[i];
    beads[Dimension + 1 + i] = cell.apex[i] == infinite_bead ? cell.vertex[0] : cell.apex[i];
  }
}

/// The cells that an event made, up to four: of each the facets that are found positive, one bit each.
inline constexpr std::size_t few_cells = 4;
template <Motion M>
[[nodiscard]] std::array<unsigned, few_cells> positive_facets_of_few(
    const M& motion, const LengthUnit& unit, std::span<const TriangulationCell<M::dimension>> cells,
    std::span<const CellId> few) {
  std::array<unsigned, few_cells> facets{};
  CellsInLanes<M> beads;
  std::size_t finite = 0;
  for (std::size_t n = 0; n < few.size(); ++n) {
    facets[n] = finite_facets(cells[few[n]]);
    if (facets[n] != 0) put_in_lane(cells[few[n]], beads[finite++]);
  }
  if (finite == 0) return facets;
  for (std::size_t lane = finite; lane < few_cells; ++lane) beads[lane] = beads[0];
  PositiveBits positive;
  four_positive_cells(motion, beads, unit, positive);
  for (std::size_t n = 0, lane = 0; n < few.size(); ++n) {
    if (facets[n] != 0) facets[n] &= positive[lane++];
  }
  return facets;
}

template <Motion M, Processor processor = Processor::best>
class PositiveFacets {
 public:
  static constexpr int dimension = M::dimension;

  /// Where lengths are a thousand times as long as the unit or as short, nothing is found.
  PositiveFacets(const M& motion, const LengthUnit& unit) : motion_(motion), unit_(unit) {}

  /// Those facets of a cell, one bit each, that are wanted, of finite_facets. Calls `doubt` with the facets,
  /// these or earlier ones, that are not found positive.
  template <class Doubt>
  void look_at(const TriangulationCell<dimension>& cell, CellId id, unsigned wanted, Doubt doubt) {
    put_in_lane(cell, beads_[waiting_]);
    cells_[waiting_] = id;
    wanted_[waiting_] = wanted;
    waiting_ += wanted != 0 ? 1 : 0;  // no branch: no one foretells which cells are wanted
    if (waiting_ == FloatLanes::width) flush(doubt);
  }
  template <class Doubt>
  void finish(Doubt doubt) {
    if (waiting_ == 0) return;
    for (std::size_t lane = waiting_; lane < FloatLanes::width; ++lane) beads_[lane] = beads_[0];
    flush(doubt);
  }
  /// How many were found positive.
  [[nodiscard]] std::uint64_t count() const { return count_; }

 private:
  template <class Doubt>
  void flush(Doubt doubt) {
    PositiveBits positive;
    if constexpr (processor == Processor::best) {
      positive_cells(motion_, beads_, unit_, positive);
    } else {
      positive_cells_anywhere(motion_, beads_, unit_, positive);
    }
    for (std::size_t lane = 0; lane < waiting_; ++lane) {
      count_ += count_of<dimension>(wanted_[lane] & positive[lane]);
      for (unsigned left = wanted_[lane] & ~positive[lane]; left != 0; left &= left - 1)
        doubt(facet_id(cells_[lane], std::countr_zero(left)));
    }
    waiting_ = 0;
  }

  const M& motion_;
  LengthUnit unit_;
  CellsInLanes<M> beads_{};
  std::array<CellId, FloatLanes::width> cells_{};
  std::array<unsigned, FloatLanes::width> wanted_{};
  std::size_t waiting_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace kds
