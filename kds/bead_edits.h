#pragma once
// Interfaces of structures whose beads are inserted, erased or given other curves during a run. Every edit is
// exact and may be made at any time at which the simulator stands still, including the irrational time of an
// event. After an edit, the structure is the one of the beads now present, on their present curves, just
// after the present time.

#include <concepts>
#include <span>

#include "kds/kinetic_structure.h"
#include "motions/base/bead.h"

namespace kds {

/// A structure whose beads can change course. Only Simulator::change_motion calls these functions, and it
/// names each bead once. It calls require_release on all structures before it calls release on any.
class CourseFollower {
 public:
  virtual ~CourseFollower() = default;

 protected:
  /// Throws std::invalid_argument if a bead does not exist, or if the structure cannot follow these beads
  /// whatever their new curves are.
  virtual void require_release(std::span<const BeadId> beads) const = 0;

 private:
  friend class Simulator;
  /// Called before the motion gets other curves for these beads: discards everything derived from the old
  /// curves.
  virtual void release(std::span<const BeadId> beads) = 0;
  /// Called after the motion got the new curves of these beads.
  virtual void take_up(std::span<const BeadId> beads) = 0;
};

/// A structure whose beads can also be inserted and erased; beads that change course may be absent. The calls
/// below throw std::invalid_argument and change nothing if the bead does not exist, if it is already present
/// or already absent, or if the simulator does not stand still within a step
/// (Simulator::require_standing_still).
class BeadEdits : public CourseFollower {
 public:
  /// Called before the structure is built: the bead does not take part until it is inserted.
  virtual void leave_out(BeadId bead) = 0;
  /// Adds the bead from now on, on its present curve in the motion.
  virtual void insert(BeadId bead) = 0;
  /// Removes the bead from now on.
  virtual void erase(BeadId bead) = 0;
  /// Throws std::invalid_argument if the bead does not exist.
  [[nodiscard]] virtual bool is_absent(BeadId bead) const = 0;

 protected:
  void require_release(std::span<const BeadId> beads) const override {
    for (const BeadId bead : beads) static_cast<void>(is_absent(bead));  // throws if the bead does not exist
  }
};

/// A structure whose beads can be inserted, erased and given other curves.
template <class S>
concept EditableStructure = std::derived_from<S, KineticStructure> && std::derived_from<S, BeadEdits>;

/// Returns null if the beads of this structure cannot be inserted or erased.
[[nodiscard]] inline BeadEdits* edits_of(KineticStructure& structure) {
  return dynamic_cast<BeadEdits*>(&structure);
}

}  // namespace kds
