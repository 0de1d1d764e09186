#pragma once
// Separating families beside the one that a search finds (hierarchy_search.h): those of other search rules,
// the family that the proof of Theorem 3.1 writes down (Agarwal et al., section 3.1), and the smallest
// family. experiments/paper/theorems.py compares their sizes.
//
// Explicit family. The nodes of depth d of the balanced tree over n beads have at most m = ceil(n / 2^d)
// beads. Consecutive beads meet and have radii of at most r, so m beads have a cage of radius at most
// R = r m. The family has each pair of disjoint cages of one depth of which one lies within 8 R of the other:
// |c - c'| + s' <= s + 8 R for centres c, c' and radii s, s' in either order. The family covers all disjoint
// pairs of nonadjacent beads:
//
// Let d be the least depth at which the cages of two beads are disjoint, with radii s and s'. Their parents'
// cages meet. A parent's radius is at most R + s, since its other half has radius at most R and the two
// halves have a common point. The centre of a wrapped cage lies in the convex hull of its beads' centres, on
// the near side of at least one touching bead, so its distance from the parent's centre is at most the root
// of (R + s)^2 - s^2. The centres c and c' are therefore at most
//
//     sqrt(R^2 + 2 R s) + (R + s) + (R + s') + sqrt(R^2 + 2 R s') <= (2 sqrt(3) + 2) R + s + s'
//
// apart. The farthest point of the second cage is s' farther, at most s + (2 sqrt(3) + 4) R < s + 7.47 R
// away. So 8 R suffices although children of the wrapped hierarchy stick out of their parents. Children of
// the layered hierarchy do not, so their centres are within R of their parent's centre.
//
// On a complete tree (n a power of two) the family that the search finds is no larger. The search compares
// nodes x and y of one depth, or x one level below y, after it has split two nodes above them that are of one
// depth and not disjoint. If x and y are disjoint, follow the cages of the first bead of x and of the last
// bead of y, from the depth of the deeper node on, to the first depth at which the two cages are disjoint.
// Their parents meet, so the explicit family has these two cages, which hold beads of x and y only. Pairs
// that the search finds share no pair of beads, so different pairs lead to different cages.
//
// The proof of Theorem 3.1 needs no more of a cage than that it holds its beads and has radius at most r m.
// The layered hierarchy has both properties: two spheres that meet have an enclosing sphere whose radius is
// at most the sum of theirs. So its explicit family has O(n log n) pairs in the plane and O(n^(4/3)) in space
// too. The paper leaves open whether a subquadratic family exists (remark after Corollary 3.3).
//
// Smallest family. A family that covers no pair of beads twice is a partition into products u x v of nodes.
// If a product u' x v' of it spans the whole of u and another the whole of v, they share a pair of beads. So
// no product crosses the halves of u, or none crosses the halves of v, and the partition arises from
// splittings. The smallest family of u x v thus has one pair if the spheres are disjoint, and otherwise as
// many as the better of the two splittings: dynamic programming over pairs of nodes. A family that covers
// some pairs twice, which the paper allows, may be smaller: experiments/paper/families.py bounds all of them.

#include <cstdint>

#include "structures/collision/sphere_tree.h"
#include "structures/necklace/bead_pairs.h"

namespace kds::python {

struct FamilySize {
  std::uint64_t pairs = 0;
  std::uint64_t tests = 0;  ///< pairs of nodes, beads included, that were compared
};

/// SPLIT of the paper's figure 6: which of two nodes is split if their spheres are not disjoint.
enum class Split : std::uint8_t {
  more_beads,     ///< the node with more beads, the paper's rule, which alone has the bound of Theorem 3.1
  larger_sphere,  ///< the node with the larger sphere
  first_node      ///< the node that comes first along the chain, down to its beads
};

/// Returns the size of the family that a search by this rule finds. Nodes with at most `leaf` beads are not
/// split into nodes: if two of them are not disjoint, all pairs of their beads are compared, and each
/// disjoint pair is a pair of the family.
template <int Dimension>
[[nodiscard]] FamilySize ruled_family(const SphereTree<Dimension>& tree, const PairsAsked& asked, Split split,
                                      BeadId leaf);

/// Returns the size of the explicit family, which covers most pairs of beads several times. Takes O(n log n)
/// time, and constant time for each two cages of one depth whose centres are within 9 R. Throws InputError
/// unless the tree has one necklace, whose consecutive beads meet, and `asked` asks about its pairs at least
/// 2 apart.
template <int Dimension>
[[nodiscard]] std::uint64_t explicit_family(const SphereTree<Dimension>& tree, const PairsAsked& asked);

/// Returns the size of the smallest family that covers no pair of beads twice. Takes time and memory (about
/// 50 bytes) for each pair of nodes that any sequence of splittings reaches: on packed grids O(n^(3/2)) in
/// the plane and O(n^(5/3)) in space.
template <int Dimension>
[[nodiscard]] FamilySize smallest_family(const SphereTree<Dimension>& tree, const PairsAsked& asked);

}  // namespace kds::python
