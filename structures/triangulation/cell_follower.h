#pragma once
// The interface through which a triangulation tells a structure that stands on it which cells change.

#include <span>

#include "structures/triangulation/cells.h"

namespace kds {

class CellFollower {
 public:
  /// Called after live cells were replaced by others that fill the same region. Ids may occur in both lists.
  /// A flip replaces all cells of Dimension + 2 vertices by the others of these vertices.
  virtual void exchanged(std::span<const CellId> gone, std::span<const CellId> made, bool is_flip) = 0;
  /// Called after all cells were replaced, or when they are about to be. The mirror may not be made yet.
  virtual void replaced_all() = 0;
  /// Called after an edit of beads, when the cells are those of the beads present.
  virtual void edited() = 0;

 protected:
  ~CellFollower() = default;
};

}  // namespace kds
