#pragma once
// What the parts of a power diagram share: the triangulation and its hidden beads, the motion, the event that
// is being handled, and whether the diagram is in doubt.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "certificates/search/certificate_search.h"
#include "certificates/searches/hull_search.h"
#include "kds/certificate_table.h"
#include "kds/present_beads.h"
#include "kds/simulator.h"
#include "motions/curves/motion_ref.h"
#include "structures/power_diagram/diagram_events.h"
#include "structures/triangulation/facet_certificate.h"
#include "structures/triangulation/hidden_beads.h"
#include "structures/triangulation/hull_faces.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// In general position an event changes one flip's beads and nothing else. Where more happens at once, or a
/// certificate touches zero, the diagram is checked after it, and rebuilt if it is wrong: cells can turn over
/// unseen only at such moments.
enum class Doubt : std::uint8_t { none, unclear, wrong };

template <int Dimension>
struct DiagramState {
  static_assert(Dimension == 2 || Dimension == 3);
  using Beads = CellBeads<Dimension>;
  using Events = DiagramEvents<Dimension>;

  /// `structure`: the owner's number in the simulator.
  DiagramState(Simulator& in, const MotionRef<Dimension>& of, KineticStructure& diagram,
               std::size_t structure)
      : simulator(in),
        motion(of),
        owner(diagram),
        index(structure),
        present_beads(diagram.name(), of),
        searches_(search_over<PowerTest<Dimension>>(of), search_over<Orientation<Dimension>>(of),
                  same_turn_search(of), centroid_search(of)) {}

  Simulator& simulator;
  MotionRef<Dimension> motion;
  KineticStructure& owner;
  std::size_t index;

  Curves<Dimension> curves;  ///< of the motion: taken when it is built, and when a step starts
  RegularTriangulation<Dimension> triangulation;
  HiddenBeads hidden;
  PresentBeads<Dimension> present_beads;
  int affine_dimension = Dimension;  ///< of the beads; below, no cells
  bool has_had_cells = false;
  bool flat = false;         ///< some cell is flat at the frame just reached
  bool within_step = false;  ///< of all beads

  /// The certificate that fails now; outside events no certificate's.
  Identity present;
  Doubt doubt = Doubt::none;
  /// Cells, some gone again, to which something happened at this moment: only there a function can have
  /// turned negative unless `known_places` denies it.
  std::vector<CellId> touched;
  std::uint64_t touched_moment = 0;
  bool known_places = true;
  /// No certificate has vanished in this step after this time, and no cell has been flat. -1: not at all.
  double vanished_until = -1;

  /// Something is amiss, who knows where if it is wrong; if it is unclear, among the cells touched.
  void suspect(Doubt more) {
    if (more == Doubt::wrong) known_places = false;
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
    known_places = true;
    touched.clear();
  }
  /// Something happens to these cells, or they are made, at the present moment.
  void touch(std::span<const CellId> cells) {
    if (touched_moment != simulator.moment()) touched.clear();
    touched_moment = simulator.moment();
    touched.insert(touched.end(), cells.begin(), cells.end());
  }

  /// Returns whether all certificates are known to be positive at the present time.
  [[nodiscard]] bool is_generic_now() const { return simulator.now().lower() > vanished_until; }

  [[nodiscard]] BeadId bead_count() const { return static_cast<BeadId>(motion.bead_count()); }
  /// The infinite bead is not.
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
  /// Dimension + 1 where it is no vertex.
  [[nodiscard]] int place_of(CellId cell, BeadId bead) const {
    const Beads& v = beads_of(cell);
    return static_cast<int>(std::find(v.begin(), v.end(), bead) - v.begin());
  }
  [[nodiscard]] bool is_infinite(CellId cell) const { return place_of(cell, infinite_bead) <= Dimension; }
  [[nodiscard]] CellId neighbor(CellId cell, int i) const { return cell_of(triangulation.beyond(cell, i)); }
  /// The same facet as the cell beyond it has it.
  [[nodiscard]] std::pair<CellId, int> across(CellId cell, int i) const {
    const FacetId beyond = triangulation.beyond(cell, i);
    return {cell_of(beyond), index_of(beyond)};
  }
  /// The bead beyond facet i.
  [[nodiscard]] BeadId apex(CellId cell, int i) const { return triangulation.apex_beyond(cell, i); }
  [[nodiscard]] CellId some_finite_cell() const {
    CellId cell = 0;
    while (!triangulation.is_live(cell) || is_infinite(cell)) ++cell;
    return cell;
  }
  /// The cell with `bead` in place i instead: its orientation is that of the cell if it is on the same side.
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
  /// Whether a cell's facet is, beyond which is that cell with that bead off the facet: its certificate is
  /// not negative, and faces of the hull in one plane do not fold over each other.
  [[nodiscard]] bool is_regular_just_after(const Beads& cell, const Beads& beyond, BeadId apex) {
    // Infinite cells on both sides of a finite facet: the hull folds flat there.
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
  /// Gives up a guard. Returns whether it fails right now as well with other beads than the present event's:
  /// then more happens at this moment than that event.
  template <class Table>
  bool give_up(Table& table, CertificateHandle guard) {
    const bool vanishes = has_slot(guard) && table.time(slot_of(guard)).lower <= simulator.now().upper() &&
                          table.identity(slot_of(guard)) != present;
    if (vanishes) suspect(Doubt::unclear);
    table.drop(guard);
    return vanishes;
  }

 private:
  std::tuple<std::unique_ptr<CertificateSearch<PowerTest<Dimension>>>,
             std::unique_ptr<CertificateSearch<Orientation<Dimension>>>,
             std::unique_ptr<CertificateSearch<SameTurn<Dimension>>>,
             std::unique_ptr<CertificateSearch<CentroidInside<Dimension>>>>
      searches_;
};

}  // namespace kds
