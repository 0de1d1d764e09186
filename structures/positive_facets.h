#pragma once
// Facets whose power test is positive all over a step, as in most steps most are: they are looked at as they
// lie in the cells, in lanes (certificates/positive_cells.h), without a certificate made for each. What is
// not found positive here is for the certificates.

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/positive_cells.h"
#include "structures/regular_triangulation.h"

namespace kds {

/// One bit for each facet of a cell.
template <int Dimension>
inline constexpr unsigned all_facets = (2U << Dimension) - 1;

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
  explicit FacetCover(std::size_t cells) : left_out_(cells, 0) {}

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

template <Motion M>
class PositiveFacets {
 public:
  static constexpr int dimension = M::dimension;

  explicit PositiveFacets(const M& motion) : motion_(motion) {}

  /// Those facets of a cell, one bit each, that are wanted, of finite_facets. Calls `doubt` with the facets,
  /// these or earlier ones, that are not found positive.
  template <class Doubt>
  void look_at(const TriangulationCell<dimension>& cell, CellId id, unsigned wanted, Doubt doubt) {
    auto& beads = beads_[waiting_];
    for (std::size_t i = 0; i <= dimension; ++i) {
      beads[i] = cell.vertex[i];
      beads[dimension + 1 + i] = cell.apex[i] == infinite_bead ? cell.vertex[0] : cell.apex[i];
    }
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
    std::array<std::uint32_t, FloatLanes::width> positive;
    positive_cells(motion_, beads_, positive);
    for (std::size_t lane = 0; lane < waiting_; ++lane) {
      count_ += static_cast<unsigned>(std::popcount(wanted_[lane] & positive[lane]));
      for (unsigned left = wanted_[lane] & ~positive[lane]; left != 0; left &= left - 1)
        doubt(facet_id(cells_[lane], std::countr_zero(left)));
    }
    waiting_ = 0;
  }

  const M& motion_;
  CellsInLanes<M> beads_{};
  std::array<CellId, FloatLanes::width> cells_{};
  std::array<unsigned, FloatLanes::width> wanted_{};
  std::size_t waiting_ = 0;
  std::uint64_t count_ = 0;
};

}  // namespace kds
