#pragma once
// Separating family (Agarwal et al., section 3.1): pairs of disjoint spheres, of nodes of a hierarchy, that
// together prove that no beads collide:
//
//   (S1) the spheres of each pair are disjoint;
//   (S2) each pair of beads asked for, but those that do collide, is within a pair: one bead in either node.
//
// The paper asks for one pair at least; ours are found with exactly one.

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "structures/collision/pairs_asked.h"
#include "structures/necklace/balls.h"

namespace kds {

struct FamilySphere {
  BeadRange beads;
  Eigen::Vector3d center;  ///< in the plane its third coordinate is 0
  double radius;
};

struct SeparatingFamily {
  /// Places of two spheres.
  struct Pair {
    std::uint32_t first, second;
  };
  std::vector<FamilySphere> spheres;
  std::vector<Pair> pairs;
};

/// What is wrong with a family, or nothing: whether every sphere of a pair holds its beads, (S1), and (S2)
/// with each pair of beads in one pair of the family only, and none of those that collide. Exact, from the
/// definitions: it shares nothing with what finds families. `colliding`: ascending. Time linear in the beads
/// of all spheres and pairs, times log n.
template <int Dimension>
[[nodiscard]] std::optional<std::string> family_fault(const SeparatingFamily& family,
                                                      std::span<const BeadPair> colliding,
                                                      const Balls<Dimension>& balls, const PairsAsked& asked);

}  // namespace kds
