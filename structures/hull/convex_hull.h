#pragma once
// Kinetic convex hull of the beads' centres in the plane: its corners in counterclockwise order. The hull
// consists of an upper and a lower half, each with its own certificates (half_hull.h). The halves meet in the
// first and the last bead.
//
// Corners are strict: a bead that lies on an edge for the rest of a step is not a corner, and if several
// beads stay together, the least of them is the corner. The hull has one corner if all beads are together,
// and two if all beads lie on one line. A corner that enters or leaves is recorded after all events at that
// time.
//
// A bead that is inserted or jumps walks along both halves to where it belongs, with a few certificates for
// each corner on the way. A bead that is erased or changes course costs its own certificates. If the bead is
// in a half, it also costs the certificates of its neighbours there and of the beads under its edges.

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "kds/structure_base.h"
#include "motions/base/bead.h"
#include "motions/curves/motion_ref.h"
#include "structures/hull/half_hull.h"

namespace kds {

class ConvexHull final : public EditableBase {
 public:
  /// Ids of `enter` and `leave`: the corner, then the corners before and after it, counterclockwise; the
  /// corner itself in their place if it is alone. Ids of `interchange`, two beads of a half of the hull that
  /// swap along an axis: the bead that was first, then the other. Ids of an edit: the bead; the changes of
  /// corners follow as separate changes.
  enum Kind : std::uint8_t { enter, leave, interchange, inserts, erases, changes };

  ConvexHull(Simulator& simulator, const MotionRef<2>& motion);

  /// Returns the corners counterclockwise, starting with the least one.
  [[nodiscard]] const std::vector<BeadId>& corners() const { return corners_; }

  /// Returns the corners and both chains, which determine all later events (RunningStructure::state).
  [[nodiscard]] std::vector<BeadId> state() const;

  void build() override;
  void start_step() override;
  /// Updates statistics.certificates.per_bead_max, the largest number of certificates on one bead.
  void count_certificates();
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override;
  void edit(std::uint8_t kind, BeadId bead) override;
  void change_corners(const Change& change);

  MotionRef<2> motion_;
  HullCertificates certificates_;
  HalfHull lower_{certificates_, false}, upper_{certificates_, true};
  std::vector<BeadId> corners_;
};

static_assert(EditableStructure<ConvexHull>);

}  // namespace kds
