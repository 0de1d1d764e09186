#pragma once
// Kinetic convex hull of the beads' centres in the plane: its corners counterclockwise. Made of an upper and
// a lower half, each with certificates of its own (half_hull.h), which meet in the first and the last bead.
//
// Only strict corners: a bead that lies on an edge for the rest of a step is none, and of beads that stay
// together the least is the corner. One corner where all beads are together, two where all are on one line.
// A corner that comes or goes is recorded when all that happens at that time has happened.
//
// A bead that comes, or jumps, walks along both halves to where it belongs, a few certificates a corner. One
// that goes or changes course costs its own certificates and, where it is on a half, those of its neighbours
// there and of the beads under its edges.

#include <cstdint>
#include <span>
#include <vector>

#include "kds/bead_edits.h"
#include "kds/kinetic_structure.h"
#include "kds/present_beads.h"
#include "motions/curves/motion_ref.h"
#include "structures/hull/half_hull.h"
#include "structures/hull/hull_guards.h"

namespace kds {

class ConvexHull final : public KineticStructure, public BeadEdits {
 public:
  /// Ids where a corner comes or goes: itself, then the corners before and after it, counterclockwise; itself
  /// where it is alone. Where two beads trade places along an axis, of which a half of the hull knows: first
  /// the one that was first. Of an edit: the bead; the corners that it changes follow.
  enum Kind : std::uint8_t { enter, leave, interchange, inserts, erases, changes };

  ConvexHull(Simulator& simulator, const MotionRef<2>& motion);

  [[nodiscard]] std::string_view name() const override { return "hull"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  /// Counterclockwise, from the least corner on.
  [[nodiscard]] const std::vector<BeadId>& corners() const { return corners_; }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  void leave_out(BeadId bead) override { present_.leave_out(bead); }
  void insert(BeadId bead) override { edit(inserts, bead); }
  void erase(BeadId bead) override { edit(erases, bead); }
  [[nodiscard]] bool is_absent(BeadId bead) const override { return present_.is_absent(bead); }

 private:
  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;
  void edit(Kind kind, BeadId bead);
  void change_corners(const Change& change);

  Simulator& simulator_;
  MotionRef<2> motion_;
  std::size_t index_;
  HullGuards guards_;
  HalfHull lower_{guards_, false}, upper_{guards_, true};
  PresentBeads<2> present_;
  std::vector<BeadId> corners_;
};

static_assert(EditableStructure<ConvexHull>);

}  // namespace kds
