#pragma once
// The regular (weighted Delaunay) triangulation in the plane or in space, dual of the power diagram. CGAL's
// Regular_triangulation_2 and _3 are the structures of record; beside them stands an index mirror of the
// cells, flat and fast to scan. The infinite vertex takes part like any other, as `infinite_bead`.
//
// A cell is a triangle or tetrahedron of positive orientation; in an infinite one the infinite vertex counts
// as a point far outside the hull. Flips are combinatorial and look at no coordinates. They change the mirror
// at once, and CGAL's structure follows when it is asked for, each cell that has changed once; so do points
// that are set to where a motion has its control points.
// Centres have three rows; in the plane the third is not looked at.

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

#include "kds/seconds.h"
#include "motions/base/bead.h"
#include "motions/curves/snapshot.h"
#include "structures/triangulation/cells.h"

namespace kds {

/// Built by CGAL from doubles with exact predicates; finite cells only, beads ascending, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_triangulation(const Eigen::Matrix3Xd& centers,
                                                                  std::span<const double> weights);

/// What CGAL takes for the same from doubles, which is what a user would do at every frame instead.
template <int Dimension>
[[nodiscard]] Seconds seconds_to_triangulate(const Eigen::Matrix3Xd& centers,
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

  /// By CGAL from doubles; returns the hidden beads and the dimension, no cells.
  StaticTriangulation<Dimension> build(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  /// The same, with no mirror of the cells until it is asked for.
  StaticTriangulation<Dimension> build_bare(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  void make_mirror();
  [[nodiscard]] bool has_mirror() const { return mirrored_; }
  /// From oriented cells, infinite ones included, of some of the beads. The points are those last set.
  void assign(std::size_t beads, std::span<const Beads> oriented_cells);
  void set_points(const Eigen::Matrix3Xd& centers, std::span<const double> weights);
  /// To a motion's k-th control points. CGAL's vertices get them when they are asked for.
  template <Motion M>
  const Snapshot<Dimension>& set_points(const M& motion, int k) {
    points_.set(motion, k);
    points_wait_ = true;
    return points_;
  }

  /// Live cells and, among them, free slots: see is_live.
  [[nodiscard]] std::span<const Cell> cells() const { return cells_; }
  [[nodiscard]] bool is_live(CellId cell) const { return live_[cell] != 0; }
  [[nodiscard]] std::size_t live_count() const { return cells_.size() - free_.size(); }
  /// Facet i of `cell` as its neighbour there has it.
  [[nodiscard]] FacetId beyond(CellId cell, int i) const {
    return cells_[cell].beyond[static_cast<std::size_t>(i)];
  }
  /// The bead opposite to a facet.
  [[nodiscard]] BeadId apex(FacetId facet) const { return cells_[cell_of(facet)].vertex[facet % 4]; }
  /// The same of facet i as the cell beyond has it.
  [[nodiscard]] BeadId apex_beyond(CellId cell, int i) const {
    return cells_[cell].apex[static_cast<std::size_t>(i)];
  }
  /// How many cells each bead is a vertex of, infinite ones included.
  [[nodiscard]] std::span<const std::uint32_t> cells_at() const { return cells_at_; }

  [[nodiscard]] std::uint32_t& note(CellId cell, int i) {
    return cells_[cell].note[static_cast<std::size_t>(i)];
  }
  /// Notes the same of all facets of a cell.
  void note_all(CellId cell, std::uint32_t value) {
    auto& note = cells_[cell].note;
    // Most say so already: lines that are not written need not be written back.
    if (std::any_of(note.begin(), note.end(), [value](std::uint32_t n) { return n != value; }))
      note.fill(value);
  }

  /// A flip there comes near: fetches the cell, then its neighbours, lying anywhere in memory.
  void fetch(CellId cell, bool neighbors) const;
  /// The same of the neighbours of two.
  void fetch_around(CellId cell, int i) const;
  /// Replaces `cell` and its neighbour across facet i by the cells around the edge of their apices: three in
  /// space, two in the plane.
  std::array<CellId, static_cast<std::size_t>(Dimension)> flip_facet(CellId cell, int i);
  /// In space: replaces the three cells around the edge of vertices i and j of `cell` by two.
  std::array<CellId, 2> flip_edge(CellId cell, int i, int j) requires(Dimension == 3);
  /// Puts a bead that is no vertex into a cell: one cell around it for each of the cell's vertices.
  Star flip_in(CellId cell, BeadId bead);
  /// The cells around a vertex of `cell` that has as many as flip_in makes, that one first.
  [[nodiscard]] Star star(CellId cell, int i) const;
  /// Takes vertex i of `cell` and the cells around it, which must be a star and not border on one cell
  /// everywhere; returns the cell in their place.
  CellId flip_out(CellId cell, int i);
  /// All cells around a vertex. Time linear in them.
  [[nodiscard]] std::vector<CellId> cells_around(BeadId bead) const;
  /// Whether one of the cells around `bead`, a vertex of `cell`, has all these beads. Time linear in those
  /// cells; the mirror alone is looked at.
  [[nodiscard]] bool stand_together(BeadId bead, CellId cell, std::span<const BeadId> beads) const;
  /// Whether these cells, positively oriented, fill the place of the old ones: their facets meet in pairs or
  /// meet those that the old cells leave open, each from its side, and their beads are among those of the old
  /// cells or no vertices.
  [[nodiscard]] bool fits(std::span<const CellId> old, std::span<const Beads> oriented_cells) const;
  /// Puts them there; beads that have no cell any more are no vertices. Returns them in the order given. Time
  /// n log n in both numbers of cells. Throws std::logic_error, and nothing is changed, if they do not fit.
  std::vector<CellId> replace(std::span<const CellId> old, std::span<const Beads> oriented_cells);
  /// Whether the beads, infinity among them, are joined by an edge or, in space, a triangle.
  [[nodiscard]] bool is_edge(BeadId a, BeadId b) const;
  [[nodiscard]] bool is_facet(BeadId a, BeadId b, BeadId c) const requires(Dimension == 3);
  [[nodiscard]] bool is_vertex(BeadId bead) const;
  /// The cell with these vertices in any order.
  [[nodiscard]] std::optional<CellId> find_cell(const Beads& beads) const;

  /// By CGAL: takes vertices away, other cells fill the holes; what stays must span the space. Only
  /// mirror_changes, put_in and is_solid may follow.
  void take_out(std::span<const BeadId> beads);
  /// By CGAL: puts beads in at these positions; the points of all others are set already. Others may lose
  /// their vertices, and some of these get none: hidden beads are those that are no vertex.
  void put_in(std::span<const BeadId> beads, const Eigen::Matrix3Xd& centers,
              std::span<const double> weights);
  /// Whether there are cells, as there are not where all vertices lie in one plane (on one line).
  [[nodiscard]] bool is_solid() const;
  /// Brings the mirror up to date after these; returns the cells that are new.
  std::vector<CellId> mirror_changes();

  /// How many of some facets, of one cell for `stride` beads, would fail their test at other positions:
  /// others at each `turn`. Needs no mirror, and where there is one CGAL's structure need not follow it.
  struct Sample {
    std::uint64_t tested = 0, failed = 0;
  };
  [[nodiscard]] Sample sample(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                              std::size_t stride, std::uint64_t turn) const;

  /// CGAL's own check of combinatorics, orientation and power tests at the points set.
  [[nodiscard]] bool is_valid() const;
  /// Finite cells, beads ascending, sorted.
  [[nodiscard]] std::vector<Beads> finite_cells() const;
  /// The two beads of each finite edge; also where the beads span less than the space.
  [[nodiscard]] std::vector<std::pair<BeadId, BeadId>> finite_edges() const;

 private:
  struct Cgal;
  /// Facets that meet, as two cells have them: of the new ones by number, or of those that stay.
  struct Meeting {
    FacetId first, second;
    bool second_stays;
  };
  [[nodiscard]] std::optional<std::vector<Meeting>> meetings(std::span<const CellId> old,
                                                             std::span<const Beads> made) const;
  void mirror_all();
  void forget_hidden_points();
  void count_cells();
  /// CGAL's side, once what flips did is done there too, and the points are set.
  [[nodiscard]] Cgal& up_to_date() const;
  [[nodiscard]] Sample sample_mirror(const Eigen::Matrix3Xd& centers, std::span<const double> weights,
                                     std::size_t stride, std::uint64_t turn) const;
  // Flips.
  [[nodiscard]] CellId new_cell();
  void free_cell(CellId id);
  /// `cell` gets the vertices of an old one, with another bead in place i.
  void exchange(CellId cell, const Cell& old, int i, BeadId bead);
  /// Beyond facet i lies what lay beyond facet k of an old cell.
  void border(CellId cell, int i, const Cell& old, int k);
  /// Two new cells meet.
  void join(CellId a, int i, CellId b, int k);
  void add_cells(BeadId bead, int more) {
    if (bead != infinite_bead) cells_at_[bead] += static_cast<std::uint32_t>(more);
  }

  std::unique_ptr<Cgal> cgal_;
  std::vector<Cell> cells_;
  std::vector<char> live_;
  std::vector<CellId> free_;             // slots that are not live
  std::vector<std::uint32_t> cells_at_;  // of each bead
  bool mirrored_ = false;
  Snapshot<Dimension> points_;  // where CGAL's vertices are to be put
  mutable bool points_wait_ = false;
  mutable std::vector<char> seen_;      // of each cell, on a walk; 0 afterwards
  mutable std::vector<CellId> around_;  // a bead, on a walk
};

}  // namespace kds
