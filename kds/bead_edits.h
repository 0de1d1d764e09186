#pragma once
// What a structure offers whose beads come, go and change course while time runs. All of it is exact, at any
// time at which the simulator stands still, the irrational time of an event too: from then on the structure
// is the one of the beads then present, on the curves that they then have, just after that time.

#include <concepts>
#include <span>

#include "kds/kinetic_structure.h"
#include "motions/base/bead.h"

namespace kds {

/// Bad calls are refused by std::invalid_argument, and nothing is changed: beads that there are not, or are
/// there already, and any time but one at which a step is under way and nothing happens
/// (Simulator::require_standing_still).
class BeadEdits {
 public:
  virtual ~BeadEdits() = default;

  /// Before the structure is built: the bead does not take part until it is inserted.
  virtual void leave_out(BeadId bead) = 0;
  /// The bead takes part from now on, on the curve that the motion has.
  virtual void insert(BeadId bead) = 0;
  /// It does not any more.
  virtual void erase(BeadId bead) = 0;
  /// Throws std::invalid_argument where there is no such bead.
  [[nodiscard]] virtual bool is_absent(BeadId bead) const = 0;

 private:
  // Simulator::change_motion alone asks for these, one after the other, each bead named once; absent beads
  // may be among them.
  friend class Simulator;
  /// Throws std::invalid_argument where the structure cannot follow these beads, whatever their curves will
  /// be. All structures are asked before any releases.
  virtual void require_release(std::span<const BeadId>) const {}
  /// The motion is about to have other curves for these beads: whatever was derived from them is given up.
  virtual void release(std::span<const BeadId> beads) = 0;
  /// It has them.
  virtual void take_up(std::span<const BeadId> beads) = 0;
};

/// A structure whose beads can come, go and change course. Others are as they were made until a step ends.
template <class S>
concept EditableStructure = std::derived_from<S, KineticStructure> && std::derived_from<S, BeadEdits>;

}  // namespace kds
