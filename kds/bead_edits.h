#pragma once
// What a structure offers whose beads come, go and change course while time runs. All of it is exact, at any
// time at which the simulator stands still, the irrational time of an event too: from then on the structure
// is the one of the beads then present, on the curves that they then have, just after that time.

#include <concepts>
#include <span>

#include "kds/kinetic_structure.h"
#include "motions/base/bead.h"

namespace kds {

/// A structure whose beads can change course: Simulator::change_motion alone asks it, for each of some beads
/// once. All structures are asked before any releases.
class CourseFollower {
 public:
  virtual ~CourseFollower() = default;

 protected:
  /// Throws std::invalid_argument where there is no such bead, or where the structure cannot follow these,
  /// whatever their curves will be.
  virtual void require_release(std::span<const BeadId> beads) const = 0;

 private:
  friend class Simulator;
  /// The motion is about to have other curves for these beads: whatever was derived from them is given up.
  virtual void release(std::span<const BeadId> beads) = 0;
  /// It has them.
  virtual void take_up(std::span<const BeadId> beads) = 0;
};

/// One whose beads can come and go, too; those that change course may be absent. Bad calls are refused by
/// std::invalid_argument, and nothing is changed: beads that there are not, or are there already, and any
/// time but one at which a step is under way and nothing happens (Simulator::require_standing_still).
class BeadEdits : public CourseFollower {
 public:
  /// Before the structure is built: the bead does not take part until it is inserted.
  virtual void leave_out(BeadId bead) = 0;
  /// The bead takes part from now on, on the curve that the motion has.
  virtual void insert(BeadId bead) = 0;
  /// It does not any more.
  virtual void erase(BeadId bead) = 0;
  /// Throws std::invalid_argument where there is no such bead.
  [[nodiscard]] virtual bool is_absent(BeadId bead) const = 0;

 protected:
  void require_release(std::span<const BeadId> beads) const override {
    for (const BeadId bead : beads) static_cast<void>(is_absent(bead));  // there is one
  }
};

/// A structure whose beads can come, go and change course.
template <class S>
concept EditableStructure = std::derived_from<S, KineticStructure> && std::derived_from<S, BeadEdits>;

/// Null where its beads cannot come and go.
[[nodiscard]] inline BeadEdits* edits_of(KineticStructure& structure) {
  return dynamic_cast<BeadEdits*>(&structure);
}

}  // namespace kds
