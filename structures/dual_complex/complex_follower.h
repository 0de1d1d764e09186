#pragma once
// The interface through which a dual complex tells a structure that stands on it what changes.

#include <span>
#include <utility>

#include "structures/dual_complex/triangulation_faces.h"
#include "structures/triangulation/cells.h"

namespace kds {

/// A simplex by its dimension and beads.
using DimensionAndBeads = std::pair<int, SimplexBeads>;

/// What changed in a dual complex at one time.
struct ComplexChange {
  /// The simplices that belong to the complex no longer, and those that belong to it now, as in its events.
  std::span<const DimensionAndBeads> ends, begins;
  /// The simplices of the triangulation for which it was decided anew whether they belong, and that changed.
  /// They may be listed repeatedly. Removed simplices are missing.
  std::span<const SimplexName> changed;
};

class ComplexFollower {
 public:
  /// Same as CellFollower::exchanged. Called before it is decided which new simplices belong.
  virtual void exchanged(std::span<const CellId> gone, std::span<const CellId> made, bool is_flip) = 0;
  /// Called after all cells were replaced, before it is decided which simplices belong.
  virtual void replaced_all() = 0;
  /// Called when the complex is up to date just after the present time.
  virtual void settled(const ComplexChange& change) = 0;

 protected:
  ~ComplexFollower() = default;
};

}  // namespace kds
