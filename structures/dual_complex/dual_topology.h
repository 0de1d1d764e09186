#pragma once
// Topology of a kinetic dual complex, and so of the union of its balls: connected components, tunnels (in
// space), and voids (in the plane: holes), with exact times. Components and voids keep a number from event
// to event (followed_components.h).
//
// A void is a bounded component of the complement of the union. In the triangulation, it is a set of cells
// outside the complex that are joined by facets outside the complex and are not joined to the infinite cells.
// The Betti number b0 is the number of components. In space, b2 is the number of voids and
// b1 = b0 + b2 - (Euler characteristic) the number of tunnels (Delfinado and Edelsbrunner, "An incremental
// algorithm for Betti numbers of simplicial complexes on the 3-sphere", 1995). In the plane, b1 is the number
// of voids. Tunnels have no numbers. While the first frame has no cells, all Betti numbers are 0.
//
// A simplex that begins or ends alone is critical: it changes one Betti number. Simplices that begin or end
// together with a face (collapses) and flips change no topology. If several critical simplices change at one
// time, only the result of all has events, and an event may name any simplex of its dimension that changes
// then.
//
// A time at which the complex changes takes time linear in the cells of all voids, besides the searches.

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "kds/structure_base.h"
#include "structures/dual_complex/complex_follower.h"
#include "structures/dual_complex/dual_complex.h"
#include "structures/dual_complex/followed_components.h"
#include "structures/dual_complex/union_measures.h"

namespace kds {

template <int Dimension>
class DualTopology final : public StructureBase, public BeadEdits, private ComplexFollower {
 public:
  using Number = FollowedComponents::Number;

  /// Kinds of events. The ids are the numbers of components or voids, then the beads of the simplex,
  /// ascending.
  enum Kind : std::uint8_t {
    component_begin,  ///< number; the vertex
    component_end,    ///< number; the vertex
    component_merge,  ///< the number that stays, the one that goes; the edge that begins
    component_split,  ///< the old number, the new one; the edge that ends
    void_begin,       ///< number; the cell that ends
    void_end,         ///< number; the cell that begins
    void_merge,       ///< the number that stays, the one that goes; the facet that ends
    void_split,       ///< the old number, the new one; the facet that begins
    void_open,        ///< number of a void that is joined to the outside; the facet that ends
    void_close,       ///< number of a new void that was part of the outside; the facet that begins
    cell_begin,       ///< internal. A void's number; a cell of the triangulation that is part of a void now
    cell_end,         ///< internal. 0; a cell that is part of a void no longer
    tunnel_begin,     ///< the edge that begins or the triangle that ends; in space only
    tunnel_end        ///< the triangle that begins or the edge that ends; in space only
  };

  /// `complex` is a structure of the same run, added before this one. It must outlive the topology.
  DualTopology(Simulator& simulator, std::size_t bead_count, DualComplex<Dimension>& complex);

  /// Returns the Betti numbers b0, b1, b2. In the plane, b2 is 0.
  [[nodiscard]] std::array<std::int64_t, 3> betti() const;
  /// Returns the cells of each void, each with its beads ascending, in ascending order. Empty during a
  /// replay, which does not know the numbers.
  [[nodiscard]] std::map<Number, std::vector<SimplexBeads>> voids() const;
  /// Returns the cells of each void with the faces that belong to the complex, for measure_complement. Empty
  /// during a replay.
  [[nodiscard]] std::map<Number, std::vector<ComplementCell>> complement_cells() const
      requires(Dimension == 3);
  /// Returns the beads of each component, ascending. Empty during a replay.
  [[nodiscard]] std::map<Number, std::vector<BeadId>> components() const;
  /// Returns the cells of all voids, ascending.
  [[nodiscard]] std::vector<SimplexBeads> void_cells() const;

  void build() override;
  void start_step() override {}
  void fail(unsigned, std::uint32_t) override {}  // there are no certificates
  void apply(const Change& change) override;
  /// Compares components, voids and Euler's characteristic with those found by searching the whole complex.
  /// Takes linear time.
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  // Edits: the beads are those of the complex, which follows them and reports what changes.
  void leave_out(BeadId bead) override { complex_.leave_out(bead); }
  void insert(BeadId bead) override { complex_.insert(bead); }
  void erase(BeadId bead) override { complex_.erase(bead); }
  [[nodiscard]] bool is_absent(BeadId bead) const override { return complex_.is_absent(bead); }

 private:
  class ComponentGraph;
  class VoidGraph;
  /// The result of a replay, which has no complex.
  struct Replayed {
    std::array<std::int64_t, 3> betti{};
    std::set<SimplexBeads> void_cells;
  };

  void release(std::span<const BeadId>) override {}
  void take_up(std::span<const BeadId>) override {}
  void exchanged(std::span<const CellId> gone, std::span<const CellId> made) override;
  void replaced_all() override;
  void settled(const ComplexChange& change) override;

  void follow_components(const ComplexChange& change);
  void follow_voids(const ComplexChange& change);
  void follow_void_cells(std::span<const CellId> added);
  [[nodiscard]] std::int64_t euler_of_complex() const;
  [[nodiscard]] std::int64_t tunnels() const;
  void cut_around(CellId cell);
  using BeadsOfVoids = std::map<Number, std::set<BeadId>>;
  /// Takes up new cells. A cell is an heir of the first void that has had all of its beads.
  void name_heirs(std::span<const CellId> made, const BeadsOfVoids& beads_of);
  /// Returns the void of a cell or of the cells that it has replaced at the present time.
  [[nodiscard]] Number void_or_heir(CellId cell) const;
  void report(Kind kind, std::initializer_list<Number> numbers, const DimensionAndBeads* simplex);
  void report_tunnels(const ComplexChange& change, std::int64_t more);

  DualComplex<Dimension>& complex_;
  FollowedComponents components_{false};  // of the beads in the complex
  FollowedComponents voids_{true};        // of the cells outside the complex
  std::int64_t euler_ = 0;
  std::map<CellId, SimplexBeads> void_cells_;
  std::optional<Replayed> replayed_;
  // The members below collect changes of cells until the complex is up to date.
  std::vector<CellId> made_, cut_;
  std::vector<Number> heir_of_;  // for each cell in made_: the void that it may continue, or none
  std::vector<const DimensionAndBeads*> reported_;  // simplices that have events
};

extern template class DualTopology<2>;
extern template class DualTopology<3>;

}  // namespace kds
