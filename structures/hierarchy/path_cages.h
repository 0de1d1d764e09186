#pragma once
// The cascade verification of a wrapped hierarchy with path cages (Agarwal et al., remark in section 2.3), to
// count how many tests they save. The beads of a node lie in each cage on the path from the node up to the
// verified node. So a cage that is not inside a sphere is settled nevertheless if its intersection with a
// cage above it is inside. The intersection of more than two cages is not tested.
//
// This cascade counts and compares; it repairs nothing. It decides in doubles with a relative tolerance of
// 1e-9. The cascade of StaticWrappedHierarchy decides exactly.

#include <cstdint>
#include <vector>

#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds {

struct CascadeCost {
  std::uint64_t tests = 0;       ///< cages and beads compared with a sphere, except the beads of its basis
  std::uint64_t path_tests = 0;  ///< intersections of two cages compared with a sphere
  std::vector<NodeId> escaped;   ///< nodes with a bead outside the sphere of their old basis, descending
};

/// Verifies the old bases of all nodes from the bottom up. `trusted` has the spheres of the old bases
/// (Update::trust), and `now` has the cages of the present time. Both are over `balls`, in the same
/// necklaces. Takes constant time per test. If `with_paths` is false, no intersections are tested.
template <int Dimension>
[[nodiscard]] CascadeCost cascade_cost(const StaticWrappedHierarchy<Dimension>& trusted,
                                       const StaticWrappedHierarchy<Dimension>& now,
                                       const Balls<Dimension>& balls, bool with_paths);

/// Returns the greatest distance from `from` to a point that lies in both balls, rounded. The distance is
/// attained at the farthest point of one sphere if that point lies in the other, and otherwise on the circle
/// where the spheres meet (two points in the plane). The balls must have a common point. In the plane all
/// third coordinates are 0.
[[nodiscard]] double farthest_in_both(const Sphere& a, const Sphere& b, const Eigen::Vector3d& from);

}  // namespace kds
