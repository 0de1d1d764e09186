#pragma once
// Computes axes along a chain's bonds. If a chain is packed on a lattice or stretched along few directions,
// the boxes of its pieces are small only if their sides lie along these directions. On a rotated lattice,
// axis-aligned boxes of its rows are several times as large and meet many others.

#include <optional>

#include "structures/blocks/float_frame.h"
#include "structures/necklace/balls.h"

namespace kds {

/// Returns axes that most steps from bead to bead lie along, estimated from a sample of the bonds. Returns
/// none if the coordinate axes are about as good. `scale` is a power of two; coordinates times `scale` are of
/// moderate size.
template <int Dimension>
[[nodiscard]] std::optional<Axes<Dimension>> bond_axes(const Balls<Dimension>& balls, double scale);

}  // namespace kds
