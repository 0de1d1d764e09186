#pragma once
// Separating family (Agarwal et al., section 3.1): pairs of disjoint spheres of a hierarchy's nodes that
// together prove that no beads collide:
//
//   (S1) the spheres of each pair are disjoint;
//   (S2) each pair of beads asked for that does not collide is covered: its beads lie one in each node of
//   some pair of the family.
//
// The paper requires at least one covering pair. Our families have exactly one.

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

/// Returns a fault of a family, or none. Checks that each sphere of a pair holds its beads, (S1), and (S2),
/// where each pair of beads is covered once only and no colliding pair is covered. The check is exact and
/// follows the definitions; it shares no code with the search for families. `colliding` is ascending. Takes
/// time linear in the number of beads of all spheres and pairs, times log n.
template <int Dimension>
[[nodiscard]] std::optional<std::string> family_fault(const SeparatingFamily& family,
                                                      std::span<const BeadPair> colliding,
                                                      const Balls<Dimension>& balls, const PairsAsked& asked);

}  // namespace kds
