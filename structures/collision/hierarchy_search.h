#pragma once
// Collision by a hierarchy of spheres (Agarwal et al., figure 6), within necklaces and between them. The
// search starts at the roots. If the spheres of two nodes are not disjoint, the node with more beads is
// split. Pairs of single beads are decided exactly. The pairs of disjoint spheres form the separating family.
// For the wrapped hierarchy of a proper necklace, it has O(n log n) pairs in the plane and O(n^(4/3)) in
// space (Theorem 3.1).
//
// Splitting a node against itself pairs each child with itself, and the two children with each other once.
// Pairs of nodes without pairs asked for are left out. So each pair of beads asked for either lies in exactly
// one pair of the family or collides.

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
  std::uint64_t family = 0;     ///< size of the separating family
};

/// Returns all pairs asked for whose closed balls are at most `distance` apart. At distance 0 these are the
/// collisions.
template <int Dimension>
[[nodiscard]] PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                                    double distance = 0);

/// Returns the collisions and writes the separating family. The family takes 8 bytes per pair, plus the
/// spheres.
template <int Dimension>
[[nodiscard]] PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                                    SeparatingFamily& family);

/// Returns some pair asked for that is at most `distance` apart, or none. The search stops at the first such
/// pair.
template <int Dimension>
[[nodiscard]] std::optional<BeadPair> find_any_pair(const SphereTree<Dimension>& tree,
                                                    const PairsAsked& asked, double distance = 0);

/// Returns the closest of the pairs asked for, or none if no pairs are asked for. If several are equally
/// close, returns the first. Searches by branch and bound.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> find_closest_pair(const SphereTree<Dimension>& tree,
                                                           const Balls<Dimension>& balls,
                                                           const PairsAsked& asked);

}  // namespace kds
