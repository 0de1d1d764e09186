#pragma once
// Collision by a hierarchy of spheres (Agarwal et al., figure 6), within necklaces and between them: from the
// roots down, of two nodes whose spheres are not disjoint the one with more beads is split; what comes to
// single beads is decided exactly. Pairs of disjoint spheres make the separating family: with the wrapped
// hierarchy of a proper necklace O(n log n) of them in the plane and O(n^(4/3)) in space (Theorem 3.1).
//
// Splitting a node against itself gives its children against themselves and each other once, and nodes none
// of whose pairs are asked for are left out: so each pair of beads asked for is in one pair of the family, or
// collides.

#include <cstdint>
#include <optional>
#include <vector>

#include "structures/collision/closest_so_far.h"
#include "structures/collision/pairs_asked.h"
#include "structures/collision/separating_family.h"
#include "structures/collision/sphere_tree.h"

namespace kds {

struct PairsFound {
  std::vector<BeadPair> pairs;  ///< ascending
  std::uint64_t family = 0;     ///< pairs of nodes that are farther apart: the size of the separating family
};

/// All pairs asked for whose closed balls are at most so far apart. At a distance of 0 these are the
/// collisions.
template <int Dimension>
[[nodiscard]] PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                                    double distance = 0);

/// The collisions, and the separating family: 8 bytes a pair, and the spheres.
template <int Dimension>
[[nodiscard]] PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                                    SeparatingFamily& family);

/// Some pair asked for that is at most so far apart, if there is any: the search stops there.
template <int Dimension>
[[nodiscard]] std::optional<BeadPair> find_any_pair(const SphereTree<Dimension>& tree,
                                                    const PairsAsked& asked, double distance = 0);

/// The closest of the pairs asked for, of several equally close the first, by branch and bound; none if none
/// are asked for.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> find_closest_pair(const SphereTree<Dimension>& tree,
                                                           const Balls<Dimension>& balls,
                                                           const PairsAsked& asked);

}  // namespace kds
