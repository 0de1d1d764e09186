#pragma once
// Axes along a chain's bonds. Boxes around pieces of a chain that is packed on a lattice, or stretched along
// few directions, are small only if their sides lie along these: where a lattice is turned, the boxes of its
// rows are several times as large and meet many others.

#include <optional>

#include "structures/blocks/float_frame.h"
#include "structures/necklace/balls.h"

namespace kds {

/// Axes that the steps from bead to bead mostly lie along, told from some of them; none where the
/// coordinates' own axes are about as good. `scale`: a power of two, times which coordinates are moderate.
template <int Dimension>
[[nodiscard]] std::optional<Axes<Dimension>> bond_axes(const Balls<Dimension>& balls, double scale);

}  // namespace kds
