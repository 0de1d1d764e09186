#pragma once
// The smallest axis-aligned box around the beads' centres, given by the first and the last bead along each
// axis. Each end is kept by a kinetic tournament. If all radii are equal, the box of the balls is larger by
// the radius on every side; otherwise other beads may determine it.
//
// If several beads tie at an end for the rest of a step, the least of them is the end. If several beads meet
// at one time, an end changes at most once: changes are recorded after all events at that time.
//
// A bead that is inserted, erased or changes course costs, for each end, at most the contests on one path to
// the root of its tournament.

#include <cstdint>
#include <memory>
#include <vector>

#include "kds/structure_base.h"
#include "motions/curves/motion_ref.h"

namespace kds {

class Simulator;

template <int Dimension>
class EnclosingBox final : public EditableBase {
 public:
  /// Ids of an overtaking inside a tournament: the bead that was ahead, then the bead that is ahead now.
  /// Ids of a change of an end: the previous bead and the new bead, no_bead if there is none; the kinds of
  /// these changes are ordered low, high for the first axis, then for the next. Ids of an edit: the bead; the
  /// changes of ends follow as separate changes.
  enum Kind : std::uint8_t { overtake, first_end, inserts = first_end + 2 * Dimension, erases, changes };

  EnclosingBox(Simulator& simulator, const MotionRef<Dimension>& motion);
  ~EnclosingBox() override;

  /// Returns the first and the last bead along the first axis, then along the next. If all beads are absent,
  /// every end is no_bead. The list is empty for a motion without beads.
  [[nodiscard]] const std::vector<BeadId>& ends() const { return ends_; }

  void build() override;
  void start_step() override;
  /// Updates statistics.certificates.per_bead_max, the largest number of certificates on one bead.
  void count_certificates();
  void fail(unsigned table, std::uint32_t slot) override;
  void after_batch() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  class Ends;
  template <int Axis>
  class EndsAlong;

  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override;
  void edit(std::uint8_t kind, BeadId bead) override;
  void hold_again();

  MotionRef<Dimension> motion_;
  std::vector<std::unique_ptr<Ends>> axes_;
  std::vector<BeadId> ends_;
};

static_assert(EditableStructure<EnclosingBox<1>>);

extern template class EnclosingBox<1>;
extern template class EnclosingBox<2>;
extern template class EnclosingBox<3>;

}  // namespace kds
