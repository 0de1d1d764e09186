#pragma once
// Collision by a hierarchy of spheres (Agarwal et al., figure 6), within necklaces and between them.
// The search starts at the roots. If the spheres of two nodes are not disjoint, the node with more beads is
// split. Pairs of single beads are decided exactly. The pairs of disjoint spheres form the separating family.
// For the wrapped hierarchy of a proper necklace, it has O(n log n) pairs in the plane and O(n^(4/3)) in
// space (Theorem 3.1).
//
// Splitting a node against itself pairs each child with itself, and the two children with each other once.
// Pairs of nodes without pairs asked for are left out. So each pair of beads asked for either lies in exactly
// one pair of the family or collides.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "structures/collision/closest_pair.h"
#include "structures/collision/sphere_tree.h"
#include "structures/necklace/balls.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// Separating family (Agarwal et al., section 3.1): pairs of disjoint spheres of a hierarchy's nodes that
/// together prove that no beads collide:
///
///   (S1) the spheres of each pair are disjoint;
///   (S2) each pair of beads asked for that does not collide is covered: its beads lie one in each node of
///   some pair of the family.
///
/// The paper requires at least one covering pair. Families that a search finds have exactly one.
struct FamilySphere {
  BeadRange beads;
  Eigen::Vector3d center;  ///< its third coordinate is 0 in the plane
  double radius;
};

struct SeparatingFamily {
  /// Indices of two spheres.
  struct Pair {
    std::uint32_t first, second;
  };
  std::vector<FamilySphere> spheres;
  std::vector<Pair> pairs;
};

/// Returns a fault of a family, or none. Checks these conditions:
/// - each sphere of a pair contains its beads;
/// - (S1) and (S2) hold;
/// - each pair of beads is covered at most once, and no colliding pair is covered.
///
/// The check is exact and follows the definitions. It shares no code with the search for families.
/// `colliding` is ascending. Takes O(m log n) time for m beads in all spheres and pairs.
template <int Dimension>
[[nodiscard]] std::optional<std::string> family_fault(const SeparatingFamily& family,
                                                      std::span<const BeadPair> colliding,
                                                      const Balls<Dimension>& balls, const PairsAsked& asked);

struct PairsFound {
  std::vector<BeadPair> pairs;  ///< ascending
  std::uint64_t family = 0;     ///< size of the separating family
  std::uint64_t tests = 0;      ///< pairs of nodes, beads included, that were compared
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

/// Returns the closest of the pairs asked for, or none if no pairs are asked for. If several are equally
/// close, returns the first. Searches by branch and bound.
template <int Dimension>
[[nodiscard]] std::optional<ClosestPair> find_closest_pair(const SphereTree<Dimension>& tree,
                                                           const Balls<Dimension>& balls,
                                                           const PairsAsked& asked);

}  // namespace kds
