#pragma once
// Kinetic power diagram in the plane or in space: a regular triangulation built by CGAL and updated by flips
// during the run. Each facet has a certificate, each hidden bead several. This header is the interface; its
// parts have their own headers:
//
//   DiagramState      the state shared by all parts
//   FacetCertificates       the certificates of facets
//   HiddenCertificates      the certificates and the host cells of hidden beads
//   DiagramFlips      handles failed certificates
//   DiagramEditor     inserts and erases beads, and gives them other curves
//   DiagramRebuilder  rebuilds the diagram if flips do not suffice
//
// Guarantee (kernels filtered and exact): just after every time at which an event happens, the triangulation
// is regular. The triangulation is regular if finite cells are positive, facets are regular, hidden beads are
// hidden and the hull winds once (diagram_checks.h). In general position one function vanishes at a time, and
// its flip preserves all four conditions. Any other case raises a doubt, and the four conditions are checked
// after the last event of that time. A diagram that fails the check is repaired, or rebuilt at a time before
// the next event.
//
// Order of ties: failures at exactly the same time are handled by certificate type, then by bead ids
// (failure_order.h), so every kernel makes the same flips. If one flip blocks another, the blocked one is
// left to the repair.

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kds/kinetic_structure.h"
#include "motions/curves/motion_ref.h"
#include "structures/power_diagram/diagram_events.h"
#include "structures/triangulation/cell_follower.h"
#include "structures/triangulation/cells.h"

namespace kds {

class HiddenBeads;
class Simulator;
struct DiagramEdges;
template <int Dimension>
class RegularTriangulation;

template <int Dimension>
class PowerDiagram final : public KineticStructure, public BeadEdits, public DiagramEvents<Dimension> {
  static_assert(Dimension == 2 || Dimension == 3);

 public:
  static constexpr int dimension = Dimension;

  /// The diagram contains all beads of `motion`, any motion of this dimension. The simulator and the motion
  /// must outlive the diagram.
  PowerDiagram(Simulator& simulator, const MotionRef<Dimension>& motion);
  ~PowerDiagram() override;

  [[nodiscard]] std::string_view name() const override { return "power"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override { return this->all_kinds(); }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void fetch(unsigned table, std::uint32_t place, bool next) const override;
  void after_batch() override;
  void finish_step() override;
  /// If cells are flat at the end, builds the diagram by CGAL there. Throws InputError if there were no cells
  /// at any time.
  void finish() override;
  /// Certificates of one function are told apart by the two beads opposite their facets, never by cell
  /// numbers.
  [[nodiscard]] std::uint64_t tie_of(unsigned table, std::uint32_t place) const override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// From now on, tells `follower` of all cells that change, and after each edit by `insert` or `erase`. The
  /// follower must not be destroyed before the run ends. Throws std::logic_error if there is a follower.
  void set_follower(CellFollower* follower);

  /// Returns the beads whose cells share a facet with the cell of `bead` now, ascending. Edges of the
  /// triangulation join them to `bead`, so ties are resolved as the diagram has them. A hidden bead has no
  /// neighbors. Takes time linear in the number of neighbors and of the flips since the last call.
  /// Throws std::invalid_argument if there is no such bead or it is absent. Throws std::logic_error if the
  /// diagram is not built, or all beads lie in one plane (on one line).
  [[nodiscard]] std::vector<BeadId> neighbors(BeadId bead) const;

  /// Returns the finite cells and the hidden beads at the frame just reached: the first frame of the step if
  /// `first`, otherwise its last. If cells are flat there, returns the static build.
  [[nodiscard]] StaticTriangulation<Dimension> at_frame(bool first) const;
  /// Returns the finite cells and the hidden beads at a frame just reached, which determine all later events
  /// (RunningStructure::state). Returns nothing if a cell is flat or if a hidden bead lies on the boundary of
  /// its host, because the events before have then decided the state too.
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const;
  /// Returns the edges of the diagram at that frame, as closest_pair (closest_pair.h) needs them. No bead may
  /// be absent.
  [[nodiscard]] DiagramEdges edges_at_frame(bool first) const;

  // Edits (BeadEdits). The cost of an edit depends on the beads around and on the walk to them. If ties
  // decide how cells lie, or if many beads jump at once, the diagram is rebuilt instead, and the rebuild is
  // counted. An edit also throws std::invalid_argument if too few beads would remain, or if the remaining
  // beads, or all beads before the edit, stay in one plane (on one line) in this step. If new curves keep all
  // beads in one plane (on one line), InputError is thrown and the run is over.

  void leave_out(BeadId bead) override;
  void insert(BeadId bead) override { insert(bead, no_bead); }
  /// Inserts the bead; the search for its position starts from `near`, if given, which is faster.
  void insert(BeadId bead, BeadId near);
  void erase(BeadId bead) override;
  [[nodiscard]] bool is_absent(BeadId bead) const override;
  /// Same as Simulator::change_motion, for one bead that is present.
  void change_motion(BeadId bead, const std::function<void()>& set_curve);

  // Steps that move only some of the beads to the next frame (diagram_update.h).

  /// From now on, only the marked beads move in a step (one entry for each bead), and a step does not end at
  /// a frame; call reach_frame for that. Facets whose beads are all at rest are skipped. If empty, all beads
  /// move.
  void move_only(std::vector<char> moving);
  /// Returns the cells that flips made since move_only; cells may be listed repeatedly or may be removed
  /// already.
  [[nodiscard]] std::span<const CellId> flipped() const;
  /// Returns whether cells exist and none is flat, so that flips suffice from here.
  [[nodiscard]] bool is_solid() const;
  /// Called when all beads are at the end of the motion's step. Cells that are flat there stay: they open
  /// again in the next step.
  void reach_frame();
  /// If cells are flat at the frame, rebuilds the diagram by CGAL and counts the rebuild.
  void rebuild_if_flat();
  /// Builds the diagram by CGAL at the end of the motion's step, whether this step was completed or given up.
  /// The mirror is made when the next step starts.
  void build_at_end();
  [[nodiscard]] const RegularTriangulation<Dimension>& triangulation() const;
  /// Makes the mirror of the cells. After build_at_end there is no mirror until this function or the next
  /// step makes it.
  void make_mirror();
  [[nodiscard]] const HiddenBeads& hidden() const;
  /// Sets a hidden bead's host, if `host` is a cell.
  void house(BeadId hidden, CellId host);
  [[nodiscard]] CellId some_finite_cell() const;
  /// Updates statistics.certificates.per_bead_max by the number of certificates on each of `beads`. Looks
  /// at all beads if none are given or some bead is hidden.
  void count_certificates(std::span<const BeadId> beads = {});

 private:
  struct Parts;

  void require_release(std::span<const BeadId> beads) const override;
  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;

  std::unique_ptr<Parts> parts_;
  CellFollower* follower_ = nullptr;
};

static_assert(EditableStructure<PowerDiagram<2>>);

extern template class PowerDiagram<2>;
extern template class PowerDiagram<3>;

}  // namespace kds
