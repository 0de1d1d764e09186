#pragma once
// The smallest axis-aligned box around the beads' centres: of each axis the first and the last bead along it.
// A kinetic tournament for each end. Where all radii are equal, the box of the balls is larger by the radius
// on every side; where they are not, it may be of other beads.
//
// Of beads that tie at an end for the rest of a step the least is there. At a time when several beads meet
// the end changes hands once, if at all: changes are recorded when all that happens at that time has
// happened.
//
// A bead that comes, goes or changes course costs, for each end, at most the contests on one way to the root
// of its tournament.

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
  /// Ids of an overtaking further down in a tournament: the bead that was ahead, the bead that is. Of a
  /// change of an end, of the first axis low and high, then of the next: the bead that was there, the bead
  /// that is, no_bead where there is none. Of an edit: the bead; the ends that it changes follow.
  enum Kind : std::uint8_t { overtake, first_end, inserts = first_end + 2 * Dimension, erases, changes };

  EnclosingBox(Simulator& simulator, const MotionRef<Dimension>& motion);
  ~EnclosingBox() override;

  [[nodiscard]] std::string_view name() const override { return "box"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  /// First and last bead along the first axis, then the next: each no_bead where all are absent, and nothing
  /// over a motion of no beads.
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
