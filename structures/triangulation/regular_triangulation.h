#pragma once
// The regular (weighted Delaunay) triangulation in the plane or in space, the dual of the power diagram.
// CGAL's Regular_triangulation_2 and _3 hold the triangulation. A mirror of its cells, a flat array of
// indices, is fast to scan. The infinite vertex is treated like any other, as `infinite_bead`.
//
// A cell is a triangle or tetrahedron of positive orientation. In an infinite cell, the infinite vertex
// counts as a point far outside the hull. Flips are combinatorial and use no coordinates. A flip changes the
// mirror at once. CGAL's structure is updated only when it is used, and each changed cell is then copied
// once; points set to a motion's control points are handled in the same way. Centres have three rows; the
// third is ignored in the plane.

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motions/base/bead.h"
#include "motions/curves/snapshot.h"
#include "structures/triangulation/cell_follower.h"
#include "structures/triangulation/cells.h"

namespace kds {

/// Returns the triangulation built by CGAL from doubles with exact predicates. Finite cells only; each cell's
/// beads are ascending, and the cells are sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_triangulation(const Eigen::Matrix3Xd& centers,
                                                                  std::span<const double> weights);

template <int Dimension>
class RegularTriangulation {
 public:
  using Cell = TriangulationCell<Dimension>;
  using Beads = CellBeads<Dimension>;
  using Star = std::array<CellId, static_cast<std::size_t>(Dimension) + 1>;

  RegularTriangulation();
  ~RegularTriangulation();
  RegularTriangulation(const RegularTriangulation&) = delete;
  RegularTriangulation& operator=(const RegularTriangulation&) = delete;

  /// From now on, tells `follower` of all cells that change. It must live until the last change.
  void set_follower(CellFollower* follower) { follower_ = follower; }

  /// Builds the triangulation by CGAL from doubles. Returns the hidden beads and the dimension, but no cells.
  StaticTriangulation<Dimension> build(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  /// Same, but makes no mirror of the cells until make_mirror is called.
  StaticTriangulation<Dimension> build_bare(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void make_mirror();
  [[nodiscard]] bool has_mirror() const { return mirrored_; }
  /// Builds the triangulation from oriented cells of some of the beads, including infinite cells. Keeps the
  /// points last set.
  void assign(std::size_t beads, std::span<const Beads> oriented_cells);
  void set_points(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  /// Sets the points to a motion's k-th control points. CGAL's vertices are updated when they are next used.
  template <Motion M>
  const Snapshot<Dimension>& set_points(const M& motion, int k) {
    points_.set(motion, k);
    points_wait_ = true;
    return points_;
  }

  /// Returns the live cells with free slots among them; see is_live.
  [[nodiscard]] std::span<const Cell> cells() const { return cells_; }
  [[nodiscard]] bool is_live(CellId cell) const { return live_[cell] != 0; }
  [[nodiscard]] std::size_t live_count() const { return cells_.size() - free_.size(); }
  /// Returns facet i of `cell`, named as a facet of the neighbour across it.
  [[nodiscard]] FacetId beyond(CellId cell, int i) const {
    return cells_[cell].beyond[static_cast<std::size_t>(i)];
  }
  /// Returns the bead opposite to a facet.
  [[nodiscard]] BeadId apex(FacetId facet) const { return cells_[cell_of(facet)].vertex[facet % 4]; }
  /// Returns the bead opposite to facet i in the cell beyond it.
  [[nodiscard]] BeadId apex_beyond(CellId cell, int i) const {
    return cells_[cell].apex[static_cast<std::size_t>(i)];
  }
  /// Returns for each bead the number of its cells, including infinite ones.
  [[nodiscard]] std::span<const std::uint32_t> cells_at() const { return cells_at_; }

  [[nodiscard]] std::uint32_t& note(CellId cell, int i) {
    return cells_[cell].note[static_cast<std::size_t>(i)];
  }
  /// Sets the notes of all facets of a cell to `value`.
  void note_all(CellId cell, std::uint32_t value) {
    auto& note = cells_[cell].note;
    // Most notes have this value already: cache lines that are not written need not be written back.
    if (std::any_of(note.begin(), note.end(), [value](std::uint32_t n) { return n != value; }))
      note.fill(value);
  }

  /// Prefetches data for a flip that comes near: the cell, or its neighbours, which are scattered in memory.
  void fetch(CellId cell, bool neighbors) const;
  /// Prefetches the neighbours of `cell` and of the cell across facet i.
  void fetch_around(CellId cell, int i) const;
  /// Replaces `cell` and its neighbour across facet i by the cells around the edge that joins their apices:
  /// three cells in space, two in the plane.
  std::array<CellId, static_cast<std::size_t>(Dimension)> flip_facet(CellId cell, int i);
  /// Space only: replaces the three cells around the edge of vertices i and j of `cell` by two.
  std::array<CellId, 2> flip_edge(CellId cell, int i, int j) requires(Dimension == 3);
  /// Inserts a bead that is not a vertex into a cell, which is replaced by one cell for each of its facets.
  Star flip_in(CellId cell, BeadId bead);
  /// Returns the cells around vertex i of `cell`, beginning with `cell`. The vertex must have exactly as many
  /// cells as flip_in makes.
  [[nodiscard]] Star star(CellId cell, int i) const;
  /// Removes vertex i of `cell` and the cells around it, and returns the cell that takes their place. The
  /// cells around the vertex must be a star and must not all border on the same cell.
  CellId flip_out(CellId cell, int i);
  /// Returns all cells around a vertex, in time linear in their number.
  [[nodiscard]] std::vector<CellId> cells_around(BeadId bead) const;
  /// Returns whether one of the cells around `bead`, a vertex of `cell`, has all of `beads`. Takes time
  /// linear in the number of these cells and reads only the mirror.
  [[nodiscard]] bool stand_together(BeadId bead, CellId cell, std::span<const BeadId> beads) const;
  /// Returns whether the given cells, positively oriented, fill the same region as the cells `old`. The
  /// facets of the given cells must match each other in pairs, or match the facets around the old cells, from
  /// opposite sides. The beads of the given cells must be beads of the old cells or beads that are not
  /// vertices.
  [[nodiscard]] bool fits(std::span<const CellId> old, std::span<const Beads> oriented_cells) const;
  /// Replaces the old cells by the given cells. Beads that lose all their cells stop being vertices. Returns
  /// the new cells in the given order. Takes time n log n in both numbers of cells. Throws std::logic_error,
  /// and changes nothing, if the cells do not fit.
  std::vector<CellId> replace(std::span<const CellId> old, std::span<const Beads> oriented_cells);
  /// Return whether the beads, possibly including the infinite one, are joined by an edge or, in space, by a
  /// triangle.
  [[nodiscard]] bool is_edge(BeadId a, BeadId b) const;
  [[nodiscard]] bool is_facet(BeadId a, BeadId b, BeadId c) const requires(Dimension == 3);
  [[nodiscard]] bool is_vertex(BeadId bead) const;
  /// Returns the cell that has these vertices in any order.
  [[nodiscard]] std::optional<CellId> find_cell(const Beads& beads) const;

  /// Removes vertices by CGAL, which fills the holes with other cells. The remaining vertices must span the
  /// space. Only mirror_changes, put_in and is_solid may be called next.
  void take_out(std::span<const BeadId> beads);
  /// Inserts beads by CGAL at these positions. The points of all other beads must be set already. Other beads
  /// may stop being vertices, and some of the inserted ones may not become vertices: the hidden beads
  /// are those that are not vertices.
  void put_in(std::span<const BeadId> beads, const Eigen::Matrix3Xd& centers,
              std::span<const double> weights);
  /// Returns whether there are cells. There are none if all vertices lie in one plane (on one line).
  [[nodiscard]] bool is_solid() const;
  /// Updates the mirror after take_out and put_in. Returns the new cells.
  std::vector<CellId> mirror_changes();

  /// Counts of a sample. The function `sample` tests the facets of one cell for every `stride` beads and
  /// counts how many would fail at other positions. Each `turn` samples other cells. Needs no mirror; if
  /// there is a mirror, CGAL's structure need not be up to date with it.
  struct Sample {
    std::uint64_t tested = 0, failed = 0;
  };
  [[nodiscard]] Sample sample(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                              std::size_t stride, std::uint64_t turn) const;

  /// Returns the result of CGAL's own check of combinatorics, orientations and power tests, at the points
  /// set.
  [[nodiscard]] bool is_valid() const;
  /// Returns the finite cells, sorted; each cell's beads are ascending.
  [[nodiscard]] std::vector<Beads> finite_cells() const;
  /// Returns the two beads of each finite edge. The beads may span less than the space.
  [[nodiscard]] std::vector<std::pair<BeadId, BeadId>> finite_edges() const;

 private:
  struct Cgal;
  /// A facet shared by two cells, named by both. A new cell is named by its number among the new ones, a
  /// remaining cell by its id.
  struct Meeting {
    FacetId first, second;
    bool second_stays;
  };
  [[nodiscard]] std::optional<std::vector<Meeting>> meetings(std::span<const CellId> old,
                                                             std::span<const Beads> made) const;
  void mirror_all();
  void forget_hidden_points();
  void count_cells();
  /// Returns CGAL's structure after copying all flips and points into it.
  [[nodiscard]] Cgal& up_to_date() const;
  [[nodiscard]] Sample sample_mirror(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                     std::size_t stride, std::uint64_t turn) const;
  void tell(std::span<const CellId> gone, std::span<const CellId> made, bool is_flip = true) {
    if (follower_ != nullptr) follower_->exchanged(gone, made, is_flip);
  }
  void tell_of_all() {
    if (follower_ != nullptr) follower_->replaced_all();
  }
  // Flips.
  [[nodiscard]] CellId new_cell();
  void free_cell(CellId id);
  /// Gives `cell` the vertices of an old cell, with another bead as vertex i.
  void exchange(CellId cell, const Cell& old, int i, BeadId bead);
  /// Makes facet i of `cell` border on the cell that was beyond facet k of an old cell.
  void border(CellId cell, int i, const Cell& old, int k);
  /// Makes two new cells neighbours.
  void join(CellId a, int i, CellId b, int k);
  void add_cells(BeadId bead, int more) {
    if (bead != infinite_bead) cells_at_[bead] += static_cast<std::uint32_t>(more);
  }

  std::unique_ptr<Cgal> cgal_;
  CellFollower* follower_ = nullptr;
  std::vector<Cell> cells_;
  std::vector<char> live_;
  std::vector<CellId> free_;             // slots that are not live
  std::vector<std::uint32_t> cells_at_;  // for each bead
  bool mirrored_ = false;
  Snapshot<Dimension> points_;  // the points that CGAL's vertices will get
  mutable bool points_wait_ = false;
  mutable std::vector<char> seen_;      // for each cell, during a walk; 0 afterwards
  mutable std::vector<CellId> around_;  // the cells around a bead, during a walk
};

}  // namespace kds
