#include "structures/collision/hierarchy_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "motions/base/floating_point_guard.h"
#include "structures/collision/separation.h"

namespace kds {

namespace {

struct NodePair {
  std::uint32_t first, second;  // the beads of `first` come first, or both are the same node
};

// A stack in a fixed array, without heap memory. A tree over 2^32 beads has 32 levels. Splitting a node
// against itself leaves two more entries per level; splitting two nodes leaves one entry per level of either
// tree.
template <class Item>
class Stack {
 public:
  [[nodiscard]] bool empty() const { return size_ == 0; }
  void push(const Item& entry) { entries_[size_++] = entry; }
  Item pop() { return entries_[--size_]; }

 private:
  std::array<Item, 160> entries_;
  std::size_t size_ = 0;
};

template <int Dimension>
bool splits_first(const TreeSphere<Dimension>& a, const TreeSphere<Dimension>& b) {
  return a.bead_count() >= b.bead_count();
}

// Calls search(root, root, apart) for the trees and pairs of trees asked about.
template <int Dimension, class Search>
void for_each_root(const SphereTree<Dimension>& tree, const PairsAsked& asked, const Search& search) {
  const auto roots = tree.roots();
  for (std::size_t n = 0; n < roots.size(); ++n) {
    if (asked.within && !search(NodePair{roots[n], roots[n]}, asked.apart)) return;
    for (std::size_t m = n + 1; asked.between && m < roots.size(); ++m)
      if (!search(NodePair{roots[n], roots[m]}, 0)) return;
  }
}

// Calls apart(pair) for pairs of nodes that are farther apart, and near(pair) for pairs of beads that are
// not, until near returns false.
template <int Dimension, class Apart, class Near>
void search_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked, double distance,
                  const Apart& apart, const Near& near) {
  const FloatingPointGuard to_nearest;
  const TreeSphere<Dimension>* const spheres = tree.spheres().data();
  for_each_root(tree, asked, [&](const NodePair& roots, BeadId least_apart) {
    Stack<NodePair> stack;
    stack.push(roots);
    while (!stack.empty()) {
      const NodePair pair = stack.pop();
      const TreeSphere<Dimension>&a = spheres[pair.first], &b = spheres[pair.second];
      if (b.last - a.first < least_apart) continue;
      if (pair.first == pair.second) {
        stack.push({a.left, a.right});
        stack.push({a.right, a.right});
        stack.push({a.left, a.left});
        continue;
      }
      const Point<Dimension> d = detail::minus(a.center, b.center);
      const double square = detail::dot(d, d), reach = a.radius + b.radius + distance;
      if (surely_apart(square, reach)) {
        apart(pair);
      } else if (a.is_bead() && b.is_bead()) {
        const bool is_near = surely_within(square, reach) ||
                             compare_separation(in_space<Dimension>(a.center), in_space<Dimension>(b.center),
                                                a.radius, b.radius, distance) <= 0;
        if (!is_near) {
          apart(pair);
        } else if (!near(BeadPair{a.first, b.first})) {
          return false;
        }
      } else if (splits_first(a, b)) {
        stack.push({a.right, pair.second});
        stack.push({a.left, pair.second});
      } else {
        stack.push({pair.first, b.right});
        stack.push({pair.first, b.left});
      }
    }
    return true;
  });
}

template <int Dimension, class Apart>
PairsFound search(const SphereTree<Dimension>& tree, const PairsAsked& asked, double distance,
                  const Apart& apart) {
  PairsFound found;
  search_pairs(
      tree, asked, distance,
      [&](const NodePair& pair) {
        ++found.family;
        apart(pair);
      },
      [&](const BeadPair& pair) {
        found.pairs.push_back(pair);
        return true;
      });
  std::sort(found.pairs.begin(), found.pairs.end());
  return found;
}

// A pair of nodes and a lower bound of the distance of their beads.
struct BoundedPair {
  NodePair nodes;
  double at_least;
};

template <int Dimension>
BoundedPair bounded(const SphereTree<Dimension>& tree, std::uint32_t first, std::uint32_t second) {
  if (first == second) return {{first, second}, -HUGE_VAL};
  const TreeSphere<Dimension>&a = tree.spheres()[first], &b = tree.spheres()[second];
  const Point<Dimension> d = detail::minus(a.center, b.center);
  const double distance = std::sqrt(detail::dot(d, d)), reach = a.radius + b.radius;
  const double at_least = distance - reach - error_of_gap(distance, reach);
  return {{first, second}, at_least == at_least ? at_least : -HUGE_VAL};
}

}  // namespace

template <int Dimension>
PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked, double distance) {
  return search(tree, asked, distance, [](const NodePair&) {});
}

template <int Dimension>
PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked, SeparatingFamily& family) {
  family = {};
  for (const TreeSphere<Dimension>& sphere : tree.spheres())
    family.spheres.push_back(
        {{sphere.first, sphere.last}, in_space<Dimension>(sphere.center), sphere.radius});
  return search(tree, asked, 0, [&](const NodePair& pair) {
    family.pairs.push_back({pair.first, pair.second});
  });
}

template <int Dimension>
std::optional<BeadPair> find_any_pair(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                                      double distance) {
  std::optional<BeadPair> any;
  search_pairs(
      tree, asked, distance, [](const NodePair&) {},
      [&](const BeadPair& pair) {
        any = pair;
        return false;
      });
  return any;
}

template <int Dimension>
std::optional<ClosestPair> find_closest_pair(const SphereTree<Dimension>& tree, const Balls<Dimension>& balls,
                                             const PairsAsked& asked) {
  const FloatingPointGuard to_nearest;
  ClosestSoFar<Dimension> closest(balls);
  if (asked.within)  // pairs near along the chain are close, which gives a good bound from the start
    for (const auto& [first, last] : asked.necklaces)
      for (BeadId b = first; last - b >= asked.apart && b <= last; ++b) closest.offer(b, b + asked.apart);
  const auto spheres = tree.spheres();
  for_each_root(tree, asked, [&](const NodePair& roots, BeadId least_apart) {
    Stack<BoundedPair> stack;
    stack.push(bounded(tree, roots.first, roots.second));
    while (!stack.empty()) {
      const auto [nodes, at_least] = stack.pop();
      const TreeSphere<Dimension>&a = spheres[nodes.first], &b = spheres[nodes.second];
      if (b.last - a.first < least_apart || at_least > closest.at_most()) continue;
      if (nodes.first == nodes.second) {
        stack.push(bounded(tree, a.left, a.right));
        stack.push(bounded(tree, a.right, a.right));
        stack.push(bounded(tree, a.left, a.left));
      } else if (a.is_bead() && b.is_bead()) {
        closest.offer(a.first, b.first);
      } else {
        const bool first = splits_first(a, b);
        BoundedPair near = bounded(tree, first ? a.left : nodes.first, first ? nodes.second : b.left);
        BoundedPair far = bounded(tree, first ? a.right : nodes.first, first ? nodes.second : b.right);
        if (far.at_least < near.at_least) std::swap(near, far);
        stack.push(far);
        stack.push(near);
      }
    }
    return true;
  });
  return closest.result();
}

template PairsFound find_pairs(const SphereTree<2>&, const PairsAsked&, double);
template PairsFound find_pairs(const SphereTree<3>&, const PairsAsked&, double);
template PairsFound find_pairs(const SphereTree<2>&, const PairsAsked&, SeparatingFamily&);
template PairsFound find_pairs(const SphereTree<3>&, const PairsAsked&, SeparatingFamily&);
template std::optional<BeadPair> find_any_pair(const SphereTree<2>&, const PairsAsked&, double);
template std::optional<BeadPair> find_any_pair(const SphereTree<3>&, const PairsAsked&, double);
template std::optional<ClosestPair> find_closest_pair(const SphereTree<2>&, const Balls<2>&,
                                                      const PairsAsked&);
template std::optional<ClosestPair> find_closest_pair(const SphereTree<3>&, const Balls<3>&,
                                                      const PairsAsked&);

}  // namespace kds
