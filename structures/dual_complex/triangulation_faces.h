#pragma once
// The simplices of a regular triangulation: its vertices, edges and triangles keep their ids while cells
// around them are exchanged. Simplices at infinity have no id.

#include <array>
#include <bit>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// A simplex of a triangulation, named by its dimension and its number: a bead, the id of an edge or
/// triangle, or a cell.
struct SimplexName {
  int dimension = 0;
  std::uint32_t number = 0;

  friend auto operator<=>(const SimplexName&, const SimplexName&) = default;
};

/// The beads of a simplex, ascending; unused entries hold no_bead.
using SimplexBeads = std::array<BeadId, 4>;

template <int Dimension>
class TriangulationFaces {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  static constexpr std::uint32_t no_face = ~std::uint32_t{0};
  /// Edges, then triangles (in space), of one cell.
  static constexpr std::size_t faces_of_cell = Dimension == 3 ? 10 : 3;

  explicit TriangulationFaces(const RegularTriangulation<Dimension>& triangulation)
      : triangulation_(triangulation) {}

  /// The finite simplices that an exchange removed and added. Numbers of removed ones may be reused by added
  /// ones. All cells count as removed and added, even if the same beads have a cell again.
  struct Exchange {
    std::vector<std::pair<SimplexName, SimplexBeads>> removed;
    std::vector<SimplexName> added;
    std::vector<SimplexName> kept;  ///< simplices that bound the region of the cells
  };
  /// Follows an exchange of cells, in time linear in their number.
  const Exchange& exchange(std::span<const CellId> gone, std::span<const CellId> made);
  /// Reads all cells again after all of them were replaced. Faces whose beads are the same keep their ids.
  const Exchange& read_all();

  /// Returns a number above the numbers of all simplices of this dimension.
  [[nodiscard]] std::size_t count(int dimension) const {
    return simplices_[static_cast<std::size_t>(dimension)].size();
  }
  [[nodiscard]] bool is_live(SimplexName simplex) const { return at(simplex).cell != no_cell; }
  [[nodiscard]] const SimplexBeads& beads_of(SimplexName simplex) const { return at(simplex).beads; }
  /// Returns the name of the facet opposite to vertex i of a cell, or nothing if the facet is at infinity.
  [[nodiscard]] std::optional<SimplexName> facet(CellId cell, int i) const {
    const int slot = Dimension == 3 ? 6 + i : 2 - i;
    const std::uint32_t number = of_cell_[cell][static_cast<std::size_t>(slot)];
    if (number == no_face) return std::nullopt;
    return SimplexName{Dimension - 1, number};
  }
  /// Returns the name of an edge of a finite cell in space; `e` counts as in tetrahedron_edges.
  [[nodiscard]] SimplexName edge(CellId cell, std::size_t e) const requires(Dimension == 3) {
    return {1, of_cell_[cell][e]};
  }
  /// Returns the two cells of a facet. One of them may be infinite.
  [[nodiscard]] std::array<CellId, 2> cells_of(SimplexName facet) const {
    const Simplex& simplex = at(facet);
    return {simplex.cell, cell_of(triangulation_.beyond(simplex.cell, std::countr_one(simplex.mask)))};
  }
  /// Calls `visit` with each simplex of one dimension less in the given one.
  template <class Visit>
  void for_facets(SimplexName simplex, Visit visit) const;
  /// Calls `visit` with each finite simplex of one dimension more that contains the given one, possibly more
  /// than once, and with its bead beyond the given one, until `visit` returns true. Returns whether it did.
  template <class Visit>
  bool any_coface(SimplexName simplex, Visit visit) const;

 private:
  struct Simplex {
    SimplexBeads beads{};
    CellId cell =
        no_cell;  // one that contains the simplex; no_cell if the id is free or the cell is infinite
    std::uint8_t mask = 0;  // the vertices of the simplex in this cell, as bits; not kept for beads
  };
  using CellVertices = CellBeads<Dimension>;
  /// A face of cells that are exchanged.
  struct Entry {
    SimplexName name;
    SimplexBeads beads;  // only in a hash table
    bool is_old;         // whether a cell that is gone has the face
    bool stays;          // whether a cell that is made has it
  };

  /// The vertices of each face of a cell, as bits.
  static constexpr std::array<unsigned, faces_of_cell> masks = [] {
    if constexpr (Dimension == 3) {
      return std::array<unsigned, 10>{0b0011, 0b0101, 0b1001, 0b0110, 0b1010,
                                      0b1100, 0b1110, 0b1101, 0b1011, 0b0111};
    } else {
      return std::array<unsigned, 3>{0b011, 0b101, 0b110};
    }
  }();
  /// Lists the vertices of each face of a cell; an edge repeats its last vertex.
  static constexpr auto vertices_of_slot = [] {
    std::array<std::array<unsigned, static_cast<std::size_t>(Dimension)>, faces_of_cell> lists{};
    for (std::size_t slot = 0; slot < faces_of_cell; ++slot) {
      std::size_t count = 0;
      for (unsigned i = 0; i <= Dimension; ++i)
        if ((masks[slot] >> i & 1U) != 0) lists[slot][count++] = i;
      for (; count < Dimension; ++count) lists[slot][count] = lists[slot][count - 1];
    }
    return lists;
  }();
  [[nodiscard]] static constexpr int dimension_of(std::size_t slot) { return slot < 6 ? 1 : 2; }
  [[nodiscard]] const Simplex& at(SimplexName s) const {
    return simplices_[static_cast<std::size_t>(s.dimension)][s.number];
  }
  [[nodiscard]] Simplex& at(SimplexName s) {
    return simplices_[static_cast<std::size_t>(s.dimension)][s.number];
  }
  /// Returns which of the cell's vertices belong to a simplex in the cell.
  [[nodiscard]] unsigned mask_in(CellId cell, SimplexName simplex) const;
  void make_room();
  void remove(CellId cell);
  void add(CellId cell);
  /// Calls `visit` with the slot and the entry of each finite face of a cell with these vertices.
  template <class Visit>
  void for_entries(const CellVertices& vertices, Visit visit);
  /// Returns the beads of some of the vertices, given as bits.
  [[nodiscard]] static SimplexBeads beads_at(const CellVertices& vertices, unsigned mask);
  /// Returns the index of the face's entry in the hash table, whose value is 0 if there is none.
  [[nodiscard]] std::size_t hashed(const SimplexBeads& beads) const;
  /// Notes which beads of the exchanged cells are vertices now.
  void match_vertices(std::span<const CellId> made);
  [[nodiscard]] SimplexName new_face(int dimension, const SimplexBeads& beads);

  const RegularTriangulation<Dimension>& triangulation_;
  std::array<std::vector<Simplex>, static_cast<std::size_t>(Dimension) + 1> simplices_;  // by dimension
  std::array<std::vector<std::uint32_t>, static_cast<std::size_t>(Dimension)> free_;     // ids, by dimension
  std::vector<std::array<std::uint32_t, faces_of_cell>> of_cell_;
  std::vector<CellVertices> vertices_of_;  // of each cell, as it was read last
  // During an exchange: the beads of the cells, which are repeated if they are many; the faces of the cells;
  // and a table with their indices plus one. If the cells have few beads, as in flips, a face's place in the
  // table has the bits of its beads' places in `beads_`; otherwise the table is a hash table.
  static constexpr std::size_t few = 6;
  std::vector<BeadId> beads_;
  std::vector<Entry> entries_;
  std::vector<std::uint32_t> table_;
  std::size_t table_size_ = 0;  // a power of two
  Exchange exchange_;
  mutable std::vector<CellId> around_;  // the cells around a simplex, during any_coface
  mutable std::vector<char> seen_;      // for each cell: whether it is in `around_`; 0 afterwards
};

template <int Dimension>
template <class Visit>
void TriangulationFaces<Dimension>::for_facets(SimplexName simplex, Visit visit) const {
  if (simplex.dimension == 1) {
    for (std::size_t i = 0; i < 2; ++i) visit(SimplexName{0, at(simplex).beads[i]});
    return;
  }
  const CellId cell = at(simplex).cell;
  const unsigned whole = at(simplex).mask;
  for (std::size_t slot = 0; slot < faces_of_cell; ++slot)
    if (dimension_of(slot) == simplex.dimension - 1 && (masks[slot] & ~whole) == 0)
      visit(SimplexName{dimension_of(slot), of_cell_[cell][slot]});
}

template <int Dimension>
template <class Visit>
bool TriangulationFaces<Dimension>::any_coface(SimplexName simplex, Visit visit) const {
  if (simplex.dimension == Dimension) return false;
  const auto visit_in = [&](CellId cell, unsigned own) {
    const auto& vertex = triangulation_.cells()[cell].vertex;
    for (unsigned i = 0; i <= Dimension; ++i) {
      if ((own >> i & 1U) != 0 || vertex[i] == infinite_bead) continue;
      if (simplex.dimension + 1 == Dimension) {
        if (visit(SimplexName{Dimension, cell}, vertex[i])) return true;
        continue;
      }
      const unsigned wanted = own | 1U << i;
      for (std::size_t slot = 0; slot < faces_of_cell; ++slot)
        if (masks[slot] == wanted && visit(SimplexName{dimension_of(slot), of_cell_[cell][slot]}, vertex[i]))
          return true;
    }
    return false;
  };
  if (simplex.dimension + 1 == Dimension) {  // a facet has two cells
    const CellId cell = at(simplex).cell;
    const unsigned own = at(simplex).mask;
    if (visit_in(cell, own)) return true;
    const FacetId beyond = triangulation_.beyond(cell, std::countr_one(own));
    constexpr unsigned all = (1U << (Dimension + 1U)) - 1;
    return visit_in(cell_of(beyond), all & ~(1U << static_cast<unsigned>(index_of(beyond))));
  }
  // Walk around the simplex, from cell to cell across the facets that contain it.
  bool found = false;
  const auto reach = [this](CellId cell) {
    if (seen_[cell] != 0) return;
    seen_[cell] = 1;
    around_.push_back(cell);
  };
  reach(at(simplex).cell);
  for (std::size_t next = 0; next < around_.size() && !found; ++next) {
    const CellId cell = around_[next];
    const unsigned own = mask_in(cell, simplex);
    found = visit_in(cell, own);
    for (int i = 0; i <= Dimension; ++i)
      if ((own >> static_cast<unsigned>(i) & 1U) == 0) reach(cell_of(triangulation_.beyond(cell, i)));
  }
  for (const CellId cell : around_) seen_[cell] = 0;
  around_.clear();
  return found;
}

extern template class TriangulationFaces<2>;
extern template class TriangulationFaces<3>;

}  // namespace kds
