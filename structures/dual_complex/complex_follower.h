#pragma once
// The interface through which a dual complex tells a structure that stands on it what changes.

#include <span>
#include <utility>

#include "structures/dual_complex/triangulation_faces.h"
#include "structures/triangulation/cells.h"

namespace kds {

/// A simplex by its dimension and beads.
using DimensionAndBeads = std::pair<int, SimplexBeads>;

/// Changes of a dual complex at one time.
struct ComplexChange {
  /// The simplices that belong to the complex no longer, and those that belong to it now, as in its events.
  std::span<const DimensionAndBeads> ends, begins;
  /// Live simplices that began or ceased to belong. A simplex may be listed twice. Simplices whose cells are
  /// gone are missing.
  std::span<const SimplexName> changed;
};

class ComplexFollower {
 public:
  /// Called after cells were exchanged (CellFollower), before it is decided which new simplices belong.
  virtual void exchanged(std::span<const CellId> gone, std::span<const CellId> made) = 0;
  /// Called after all cells were replaced, before it is decided which simplices belong.
  virtual void replaced_all() = 0;
  /// Called when the complex is up to date just after the present time.
  virtual void settled(const ComplexChange& change) = 0;

 protected:
  ~ComplexFollower() = default;
};

}  // namespace kds
