#pragma once
// Kinetic convex hull of the beads' centres in the plane: its corners counterclockwise. Made of an upper and
// a lower half, each with certificates of its own (half_hull.h), which meet in the first and the last bead.
//
// Only strict corners: a bead that lies on an edge for the rest of a step is none, and of beads that stay
// together the least is the corner. One corner where all beads are together, two where all are on one line.
// A corner that comes or goes is recorded when all that happens at that time has happened.

#include <cstdint>
#include <vector>

#include "kds/kinetic_structure.h"
#include "motions/curves/motion_ref.h"
#include "structures/hull/half_hull.h"
#include "structures/hull/hull_guards.h"

namespace kds {

class ConvexHull final : public KineticStructure {
 public:
  /// Ids where a corner comes or goes: itself, then the corners before and after it, counterclockwise; itself
  /// where it is alone. Where two beads trade places along an axis, of which a half of the hull knows: first
  /// the one that was first.
  enum Kind : std::uint8_t { enter, leave, interchange };

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

 private:
  void change_corners(const Change& change);

  Simulator& simulator_;
  MotionRef<2> motion_;
  std::size_t index_;
  HullGuards guards_;
  HalfHull lower_{guards_, false}, upper_{guards_, true};
  std::vector<BeadId> corners_;
};

}  // namespace kds
