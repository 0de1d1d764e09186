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

#include "kds/bead_edits.h"
#include "kds/kinetic_structure.h"
#include "kds/present_beads.h"
#include "motions/curves/motion_ref.h"

namespace kds {

class Simulator;

template <int Dimension>
class EnclosingBox final : public KineticStructure, public BeadEdits {
 public:
  /// Ids of an overtaking inside a tournament: the bead that was ahead, then the bead that is ahead now.
  /// Ids of a change of an end: the previous bead and the new bead, no_bead if there is none; the kinds of
  /// these changes are ordered low, high for the first axis, then for the next. Ids of an edit: the bead; the
  /// changes of ends follow as separate changes.
  enum Kind : std::uint8_t { overtake, first_end, inserts = first_end + 2 * Dimension, erases, changes };

  EnclosingBox(Simulator& simulator, const MotionRef<Dimension>& motion);
  ~EnclosingBox() override;

  [[nodiscard]] std::string_view name() const override { return "box"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  /// Returns the first and the last bead along the first axis, then along the next. All are no_bead if all
  /// beads are absent. Empty for a motion without beads.
  [[nodiscard]] const std::vector<BeadId>& ends() const { return ends_; }

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
  class Ends;
  template <int Axis>
  class EndsAlong;

  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;
  void edit(Kind kind, BeadId bead);
  void hold_again();

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  std::size_t index_;
  PresentBeads<Dimension> present_;
  std::vector<std::unique_ptr<Ends>> axes_;
  std::vector<BeadId> ends_;
};

static_assert(EditableStructure<EnclosingBox<1>>);

extern template class EnclosingBox<1>;
extern template class EnclosingBox<2>;
extern template class EnclosingBox<3>;

}  // namespace kds
