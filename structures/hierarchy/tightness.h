#pragma once
// Compares the wrapped hierarchy with the layered one: rho = wrapped radius / layered radius at a node, at
// most 1. Computes its mean and minimum over all internal nodes (Table 1 of Agarwal et al.).

#include <algorithm>

#include "structures/hierarchy/layered_hierarchy.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

struct Tightness {
  double average = 1, least = 1;
};

/// Both hierarchies must be built over the same necklaces and balls. Nodes of radius 0 count as 1.
template <int Dimension>
[[nodiscard]] Tightness tightness_of(const StaticWrappedHierarchy<Dimension>& wrapped,
                                     const LayeredHierarchy<Dimension>& layered) {
  const std::size_t nodes = wrapped.tree().node_count();
  if (nodes == 0) return {};
  Tightness ratios{0, 1};
  for (NodeId node = 0; node < nodes; ++node) {
    const double outer = layered.sphere(node).radius;
    const double rho = outer > 0 ? wrapped.sphere(node).radius / outer : 1;
    ratios.average += rho / static_cast<double>(nodes);
    ratios.least = std::min(ratios.least, rho);
  }
  return ratios;
}

}  // namespace kds
