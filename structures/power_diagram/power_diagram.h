#pragma once
// Kinetic power diagram in the plane or in space: CGAL's regular triangulation flipped while time runs. Each
// facet has its certificate, each hidden bead some. This is the interface; behind it, each with its own
// header:
//
//   DiagramState      what all of them share
//   FacetGuards       which certificate guards a facet
//   HiddenGuards      hidden beads: how they are guarded, and housed
//   DiagramFlips      what happens when a certificate fails
//   DiagramEditor     beads that come, go and change course while time runs
//   DiagramRebuilder  where flips do not suffice
//
// Guarantee (kernels filtered and exact): just after every time at which something happens, the triangulation
// is the regular one. That holds if finite cells are positive, facets are regular, hidden beads are hidden
// and the hull winds once (hull_winding.h). In general position one function vanishes at a time, and its flip
// keeps all four. Anything else raises a doubt, and the four are checked after the last event of that time. A
// diagram that fails the check is repaired, or built anew at a time before the next event.
//
// Order of ties: failures at exactly the same time are handled by certificate type, then by bead ids
// (failure_order.h), so every kernel makes the same flips. A flip that another one blocks is left to the
// repair.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "kds/bead_edits.h"
#include "kds/kinetic_structure.h"
#include "motions/curves/motion_ref.h"
#include "structures/power_diagram/diagram_events.h"
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

  /// Of all beads of a motion, any of this dimension; both must outlive the diagram.
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
  /// Ends as CGAL builds it where cells are flat. Throws InputError if there never were any.
  void finish() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  /// Returns the beads whose cells share a facet with the cell of `bead` now, ascending. Edges of the
  /// triangulation join them to `bead`, so ties are resolved as the diagram has them. A hidden bead has no
  /// neighbors. Takes time linear in the number of neighbors and of the flips since the last call.
  /// Throws std::invalid_argument if there is no such bead or it is absent. Throws std::logic_error if the
  /// diagram is not built, or all beads lie in one plane (on one line).
  [[nodiscard]] std::vector<BeadId> neighbors(BeadId bead) const;

  /// Finite cells and hidden beads at the frame just reached, as a static build has them where cells are flat
  /// there.
  [[nodiscard]] StaticTriangulation<Dimension> at_frame(bool first) const;
  /// Its edges there, of all beads, none being absent: what closest_pair (closest_pair.h) asks for.
  [[nodiscard]] DiagramEdges edges_at_frame(bool first) const;

  // Edits (bead_edits.h). Cost: the beads around, and the way to them. Where ties decide how cells lie, and
  // where many beads jump at once, the diagram is built anew instead, and the rebuild counted. Refused
  // besides is what leaves too few beads, or only such as stay in one plane (on one line), and all edits in a
  // step in which all beads do. Where other courses make them do, InputError, and the run is over.

  void leave_out(BeadId bead) override;
  void insert(BeadId bead) override { insert(bead, no_bead); }
  /// The bead is looked for from `near`, if given: that is quicker.
  void insert(BeadId bead, BeadId near);
  void erase(BeadId bead) override;
  [[nodiscard]] bool is_absent(BeadId bead) const override;
  /// Simulator::change_motion of one bead that takes part.
  void change_motion(BeadId bead, const std::function<void()>& set_curve);

  // Steps that bring but a part of the beads to the next frame (diagram_update.h).

  /// From now on only the beads marked, one entry a bead, move in a step, and a step does not end at a frame:
  /// that is for reach_frame. Facets of beads that all rest need no certificate. Empty: all beads move.
  void move_only(std::vector<char> moving);
  /// Cells that flips made since then, some more than once, some gone again.
  [[nodiscard]] std::span<const CellId> flipped() const;
  /// Whether cells are neither missing nor flat, so that flips alone lead on.
  [[nodiscard]] bool is_solid() const;
  /// All beads are where the motion's step ends. Cells that are flat there stay: they open again on the way.
  void reach_frame();
  /// At a frame where cells are flat it is built anew, as CGAL does it, and the rebuild counted.
  void rebuild_if_flat();
  /// Built anew at the end of the motion's step, run to its end or given up, as CGAL does it; the mirror is
  /// made when a step starts.
  void build_at_end();
  [[nodiscard]] const RegularTriangulation<Dimension>& triangulation() const;
  /// Makes the mirror of the cells. After build_at_end there is none until this function or a step makes
  /// it.
  void make_mirror();
  [[nodiscard]] const HiddenBeads& hidden() const;
  /// A hidden bead's host, if it is a cell.
  void house(BeadId hidden, CellId host);
  [[nodiscard]] CellId some_finite_cell() const;

 private:
  struct Parts;

  void require_release(std::span<const BeadId> beads) const override;
  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;
  void count_certificates_per_bead();

  std::unique_ptr<Parts> parts_;
};

static_assert(EditableStructure<PowerDiagram<2>>);

extern template class PowerDiagram<2>;
extern template class PowerDiagram<3>;

}  // namespace kds
