#pragma once
// The state shared by the parts of a power diagram: the triangulation and its hidden beads, the motion, the
// event being handled, and whether the diagram is in doubt.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "certificates/search/certificate_search.h"
#include "certificates/search/predicate_searches.h"
#include "kds/certificate_table.h"
#include "kds/simulator.h"
#include "kds/structure_base.h"
#include "motions/curves/motion_ref.h"
#include "structures/power_diagram/diagram_events.h"
#include "structures/triangulation/cells.h"
#include "structures/triangulation/diagram_edges.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

class Dyadic;

/// In general position, an event changes the beads of one flip and nothing else. If several events coincide,
/// or a certificate touches zero, the diagram is checked afterwards and rebuilt if it is wrong. Cells can
/// turn over without an event only at such moments.
enum class Doubt : std::uint8_t { none, unclear, wrong };

template <int Dimension>
struct DiagramState {
  static_assert(Dimension == 2 || Dimension == 3);
  using Beads = CellBeads<Dimension>;
  using Events = DiagramEvents<Dimension>;

  /// `structure` is the owner's number in the simulator.
  DiagramState(Simulator& in, const MotionRef<Dimension>& of, KineticStructure& diagram,
               std::size_t structure)
      : simulator(in),
        motion(of),
        owner(diagram),
        index(structure),
        present_beads(diagram.name(), of.bead_count()),
        searches_(search_over<PowerTest<Dimension>>(of), search_over<Orientation<Dimension>>(of),
                  same_turn_search(of), centroid_search(of)) {}

  Simulator& simulator;
  MotionRef<Dimension> motion;
  KineticStructure& owner;
  std::size_t index;

  Curves<Dimension> curves;  ///< the motion's; loaded by build and at the start of each step
  RegularTriangulation<Dimension> triangulation;
  HiddenBeads hidden;
  PresentBeads present_beads;
  int affine_dimension = Dimension;  ///< for the set of beads; there are no cells if it is below Dimension
  bool has_had_cells = false;
  bool flat = false;         ///< some cell is flat at the frame just reached
  bool within_step = false;  ///< a step that moves all beads is under way

  /// The certificate that fails now; a default value outside events.
  Identity present;
  Doubt doubt = Doubt::none;
  /// Cells, some of them already removed, that changed at this moment. If `known_cells` is true, functions
  /// can have turned negative only at these cells.
  std::vector<CellId> touched;
  std::uint64_t touched_moment = 0;
  bool known_cells = true;
  /// No certificate vanished in this step after this time, and no cell was flat after it. -1: none did in the
  /// whole step.
  double vanished_until = -1;

  /// Marks the diagram as doubtful. If `more` is `wrong`, the faulty cells are unknown; if it is `unclear`,
  /// they are among the touched cells.
  void suspect(Doubt more) {
    if (more == Doubt::wrong) known_cells = false;
    suspect_touched(more);
  }
  void suspect_touched(Doubt more) {
    doubt = std::max(doubt, more);
    owner.needs_after_batch = true;
  }
  void suspect_at(CellId cell, CellId other) {
    touch(std::array{cell, other});
    suspect_touched(Doubt::wrong);
  }
  void clear_doubt() {
    doubt = Doubt::none;
    owner.needs_after_batch = false;
    known_cells = true;
    touched.clear();
  }
  /// Notes that these cells change, or are made, at the present moment.
  void touch(std::span<const CellId> cells) {
    if (touched_moment != simulator.moment()) touched.clear();
    touched_moment = simulator.moment();
    touched.insert(touched.end(), cells.begin(), cells.end());
  }

  /// Returns whether all certificates are known to be positive at the present time.
  [[nodiscard]] bool is_generic_now() const { return simulator.now().lower() > vanished_until; }

  [[nodiscard]] BeadId bead_count() const { return static_cast<BeadId>(motion.bead_count()); }
  /// Returns whether the bead is absent. The infinite bead never is.
  [[nodiscard]] bool is_absent(BeadId bead) const {
    const std::span<const char> absent = present_beads.absent();
    return bead < absent.size() && absent[bead] != 0;
  }
  [[nodiscard]] bool has_cells() const { return affine_dimension == Dimension; }
  void record(const Change& change) { simulator.record(index, change); }

  // Cells.

  [[nodiscard]] const Beads& beads_of(CellId cell) const { return triangulation.cells()[cell].vertex; }
  [[nodiscard]] BeadId vertex(CellId cell, int i) const {
    return beads_of(cell)[static_cast<std::size_t>(i)];
  }
  /// Returns the index of `bead` among the vertices of the cell, or Dimension + 1 if the bead is not a
  /// vertex.
  [[nodiscard]] int vertex_index(CellId cell, BeadId bead) const {
    const Beads& v = beads_of(cell);
    return static_cast<int>(std::find(v.begin(), v.end(), bead) - v.begin());
  }
  [[nodiscard]] bool is_infinite(CellId cell) const { return vertex_index(cell, infinite_bead) <= Dimension; }
  [[nodiscard]] CellId neighbor(CellId cell, int i) const { return cell_of(triangulation.beyond(cell, i)); }
  /// Returns facet i of the cell as a facet of the cell beyond it.
  [[nodiscard]] std::pair<CellId, int> across(CellId cell, int i) const {
    const FacetId beyond = triangulation.beyond(cell, i);
    return {cell_of(beyond), index_of(beyond)};
  }
  /// Returns the bead beyond facet i.
  [[nodiscard]] BeadId apex(CellId cell, int i) const { return triangulation.apex_beyond(cell, i); }
  [[nodiscard]] CellId some_finite_cell() const {
    CellId cell = 0;
    while (!triangulation.is_live(cell) || is_infinite(cell)) ++cell;
    return cell;
  }
  /// Returns the cell with `bead` in place i. The new cell has the same orientation if `bead` is on the same
  /// side of facet i.
  [[nodiscard]] static Beads with(Beads cell, int i, BeadId bead) {
    cell[static_cast<std::size_t>(i)] = bead;
    return cell;
  }

  // Signs.

  template <class Function>
  [[nodiscard]] const CertificateSearch<Function>& search() const {
    return *std::get<std::unique_ptr<CertificateSearch<Function>>>(searches_);
  }
  template <class Function>
  [[nodiscard]] int sign_now(const Function& function) {
    return search<Function>().sign_now(simulator.kernel(), function, simulator.now(),
                                       owner.statistics.stages);
  }
  template <class Function>
  [[nodiscard]] int sign_just_after(const Function& function) {
    return search<Function>().sign_just_after(simulator.kernel(), function, simulator.now(),
                                              owner.statistics.stages);
  }
  /// Returns whether a facet of `cell` is regular, given the cell beyond it and that cell's bead off the
  /// facet. A facet is regular if its certificate is not negative and if faces of the hull in one plane do
  /// not fold over each other.
  [[nodiscard]] bool is_regular_just_after(const Beads& cell, const Beads& beyond, BeadId apex) {
    // If both cells of a finite facet are infinite, the hull folds flat there.
    if (apex == infinite_bead && std::find(cell.begin(), cell.end(), infinite_bead) != cell.end())
      return false;
    const int sign = with_facet_certificate(
        cell, apex, [this](const auto& certificate) { return this->sign_just_after(certificate); });
    if (sign != 0) return sign > 0;
    const auto face = hull_face<Dimension>(cell), other = hull_face<Dimension>(beyond);
    return !face || !other || sign_just_after(same_turn<Dimension>(*face, *other)) > 0;
  }
  [[nodiscard]] bool all_positive_now(std::span<const Orientation<Dimension>> cells) {
    return search<Orientation<Dimension>>().all_positive_now(simulator.kernel(), cells, simulator.now(),
                                                             owner.statistics.stages);
  }

  // Certificates of the present event.

  template <class Certificate>
  [[nodiscard]] KnownAtStart known_of(const Certificate& certificate) const {
    return certificate.identity() == present ? KnownAtStart::at_own_root : KnownAtStart::unknown;
  }
  /// Drops a certificate. Returns whether it also fails right now, but names other beads than the present
  /// event's certificate; in this case another event happens at this moment too.
  template <class Table>
  bool give_up(Table& table, CertificateHandle handle) {
    const bool vanishes = has_slot(handle) && table.time(slot_of(handle)).lower <= simulator.now().upper() &&
                          table.identity(slot_of(handle)) != present && vanishes_now(table, slot_of(handle));
    if (vanishes) suspect(Doubt::unclear);
    table.drop(handle);
    return vanishes;
  }

 private:
  /// Returns whether a failure, whose bracket overlaps the present one, is at exactly the present time.
  template <class Table>
  [[nodiscard]] bool vanishes_now(const Table& table, std::uint32_t slot) const {
    ExactTime failure = exact_time(*table.exact_function(slot), table.time(slot));
    return ExactTime::compare(failure, simulator.now().exact()) == 0;
  }

  std::tuple<std::unique_ptr<CertificateSearch<PowerTest<Dimension>>>,
             std::unique_ptr<CertificateSearch<Orientation<Dimension>>>,
             std::unique_ptr<CertificateSearch<SameTurn<Dimension>>>,
             std::unique_ptr<CertificateSearch<CentroidInside<Dimension>>>>
      searches_;
};

// Static diagrams of the beads present, built by CGAL from exact positions at a time of the step, or from
// doubles at its ends. The kinetic diagram is built from them and compared with them.

/// Returns the diagram of the given beads, which must be ascending. If `oriented`, infinite cells are
/// included and cells keep their orientation; otherwise the finite cells are returned, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_diagram(const DiagramState<Dimension>& state,
                                                            std::span<const BeadId> beads, const Dyadic& time,
                                                            bool oriented);

/// Returns the diagram of all beads present, from the k-th control points, at an end of the step. Finite
/// cells only, sorted.
template <int Dimension>
[[nodiscard]] StaticTriangulation<Dimension> static_diagram_at_end(const DiagramState<Dimension>& state,
                                                                   int k);
/// Returns the edges of this diagram. No bead may be absent.
template <int Dimension>
[[nodiscard]] DiagramEdges static_edges_at_end(const DiagramState<Dimension>& state, int k);

}  // namespace kds
