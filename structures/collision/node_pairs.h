#pragma once
// Pairs of nodes of a tree: where searches over them start, and whether two spheres are disjoint.
// Private to the searches of this folder and of python/separating_families.cpp.

#include <cstdint>
#include <span>

#include "structures/collision/balls_meet.h"
#include "structures/collision/hierarchy_search.h"
#include "structures/collision/sphere_tree.h"
#include "structures/necklace/bead_pairs.h"

namespace kds::detail {

struct NodePair {
  std::uint32_t first, second;  ///< the beads of `first` come first, or both are the same node
};

/// Calls search(pair, apart) for the trees and pairs of trees asked about. `apart` is the least distance in
/// sequence of two beads asked about.
template <class Search>
void for_each_root(std::span<const std::uint32_t> roots, const PairsAsked& asked, const Search& search) {
  refuse_groups(asked, "a hierarchy of spheres");
  for (std::size_t n = 0; n < roots.size(); ++n) {
    if (asked.asks_of(n, n)) search(NodePair{roots[n], roots[n]}, asked.apart);
    for (std::size_t m = n + 1; asked.between && m < roots.size(); ++m)
      if (asked.asks_of(n, m)) search(NodePair{roots[n], roots[m]}, BeadId{0});
  }
}

/// Returns a family without pairs over all spheres of the tree.
template <int Dimension>
[[nodiscard]] SeparatingFamily family_over(const SphereTree<Dimension>& tree) {
  SeparatingFamily family;
  for (const TreeSphere<Dimension>& sphere : tree.spheres())
    family.spheres.push_back(
        {{sphere.first, sphere.last}, in_space<Dimension>(sphere.center), sphere.radius});
  return family;
}

/// The distance between the surfaces of two spheres, compared with a bound.
enum class Separation : std::uint8_t {
  apart,     ///< above the bound: certainly for nodes, exactly for beads
  near,      ///< two beads, exactly at most the bound apart
  undecided  ///< at least one node, not certainly apart
};

template <int Dimension>
[[nodiscard]] inline Separation separation(const TreeSphere<Dimension>& a, const TreeSphere<Dimension>& b,
                                           double bound) {
  const Point<Dimension> d = minus(a.center, b.center);
  const double square = dot(d, d), reach = a.radius + b.radius + bound;
  if (surely_apart(square, reach)) return Separation::apart;
  if (!a.is_bead() || !b.is_bead()) return Separation::undecided;
  const bool is_near = surely_within(square, reach) ||
                       compare_separation(in_space<Dimension>(a.center), in_space<Dimension>(b.center),
                                          a.radius, b.radius, bound) <= 0;
  return is_near ? Separation::near : Separation::apart;
}

}  // namespace kds::detail
