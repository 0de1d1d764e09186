#include "structures/collision/hierarchy_search.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "motions/base/interruption.h"
#include "structures/collision/balls_meet.h"
#include "structures/collision/node_pairs.h"
#include "structures/necklace/ball_distance.h"

namespace kds {

namespace {

using detail::NodePair;
using detail::Separation;
using Fault = std::optional<std::string>;

std::string name_of(const BeadRange& beads) {
  if (beads.first == beads.last) return "bead " + std::to_string(beads.first);
  return "beads " + std::to_string(beads.first) + " to " + std::to_string(beads.last);
}
std::string name_of(BeadId i, BeadId j) { return "beads " + std::to_string(i) + " and " + std::to_string(j); }

template <int Dimension>
class Check {
 public:
  Check(const SeparatingFamily& family, std::span<const BeadPair> colliding, const Balls<Dimension>& balls,
        const PairsAsked& asked)
      : family_(family), colliding_(colliding), balls_(balls), asked_(asked) {}

  Fault fault() {
    for (const auto& pair : family_.pairs) {
      const std::size_t spheres = family_.spheres.size();
      if (pair.first >= spheres || pair.second >= spheres) return "a pair names a sphere that there is not";
    }
    if (Fault fault = fault_of_spheres()) return fault;
    for (const auto& pair : family_.pairs)
      if (Fault fault = fault_of_pair(family_.spheres[pair.first], family_.spheres[pair.second]))
        return fault;
    return fault_of_cover();
  }

 private:
  Eigen::Vector3d center(BeadId bead) const {
    Eigen::Vector3d c = Eigen::Vector3d::Zero();
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      c[static_cast<Eigen::Index>(axis)] = balls_.coordinate(bead, axis);
    return c;
  }

  Fault fault_of_spheres() const {
    std::vector<char> used(family_.spheres.size(), 0);
    for (const auto& pair : family_.pairs) used[pair.first] = used[pair.second] = 1;
    for (std::size_t k = 0; k < used.size(); ++k) {
      if (used[k] == 0) continue;
      const FamilySphere& sphere = family_.spheres[k];
      const auto& [first, last] = sphere.beads;
      if (first > last || last >= balls_.size()) return "a sphere has beads that there are not";
      for (BeadId b = first; b <= last; ++b) {
        const bool inside = balls_.radius(b) <= sphere.radius &&
                            compare_distance(center(b), sphere.center, sphere.radius, -balls_.radius(b)) <= 0;
        if (!inside)
          return "bead " + std::to_string(b) + " sticks out of the sphere of " + name_of(sphere.beads);
      }
    }
    return std::nullopt;
  }

  static Fault fault_of_pair(const FamilySphere& a, const FamilySphere& b) {
    if (compare_distance(a.center, b.center, a.radius, b.radius) > 0) return std::nullopt;
    return "the spheres of " + name_of(a.beads) + " and of " + name_of(b.beads) + " are not disjoint";
  }

  // Checks row by row, for each bead: the later beads it is separated from form runs, one for each pair with
  // the bead in its earlier node. These runs and the collisions together must equal the pairs asked for.
  Fault fault_of_cover() {
    struct Rectangle {
      BeadRange rows, columns;
    };
    std::vector<Rectangle> opening;
    for (const auto& pair : family_.pairs) {
      BeadRange rows = family_.spheres[pair.first].beads, columns = family_.spheres[pair.second].beads;
      if (columns.first < rows.first) std::swap(rows, columns);
      if (columns.first <= rows.last)
        return "the nodes of " + name_of(rows) + " and of " + name_of(columns) + " share beads";
      opening.push_back({rows, columns});
    }
    std::vector<Rectangle> closing = opening;
    std::sort(opening.begin(), opening.end(),
              [](const auto& a, const auto& b) { return a.rows.first < b.rows.first; });
    std::sort(closing.begin(), closing.end(),
              [](const auto& a, const auto& b) { return a.rows.last < b.rows.last; });
    auto opens = opening.begin();
    auto closes = closing.begin();
    auto collides = colliding_.begin();
    for (BeadId row = 0; row < balls_.size(); ++row) {
      for (; closes != closing.end() && closes->rows.last < row; ++closes)
        separated_.erase(closes->columns.first);
      for (; opens != opening.end() && opens->rows.first == row; ++opens) {
        const auto [where, is_new] = separated_.emplace(opens->columns.first, opens->columns.last);
        if (!is_new) return name_of(row, opens->columns.first) + " are separated twice";
      }
      const auto first = collides;
      while (collides != colliding_.end() && collides->first == row) ++collides;
      if (Fault fault = fault_of_row(row, {first, collides})) return fault;
    }
    if (collides != colliding_.end()) return "the collisions are not of these beads in ascending order";
    return std::nullopt;
  }

  Fault fault_of_row(BeadId row, std::span<const BeadPair> colliding) const {
    BeadId next = row + 1;  // all beads before it are accounted for
    auto run = separated_.begin();
    for (auto collision = colliding.begin();;) {
      const bool have_run = run != separated_.end(), have_collision = collision != colliding.end();
      if (!have_run && !have_collision) break;
      const bool is_run = have_run && (!have_collision || run->first <= collision->second);
      const BeadId first = is_run ? run->first : collision->second;
      const BeadId last = is_run ? run->second : collision->second;
      if (first < next) return name_of(row, first) + " are named twice";
      if (last >= balls_.size()) return "the collisions are not of these beads";
      if (!is_run && !asked_.asks({row, first}))
        return name_of(row, first) + " collide, but the query does not ask for this pair";
      if (!is_run &&
          compare_distance(center(row), center(first), balls_.radius(row), balls_.radius(first)) > 0)
        return name_of(row, first) + " are disjoint, but not separated";
      if (Fault fault = fault_of_gap(row, next, first)) return fault;
      next = last + 1;
      is_run ? void(++run) : void(++collision);
    }
    return fault_of_gap(row, next, static_cast<BeadId>(balls_.size()));
  }
  Fault fault_of_gap(BeadId row, BeadId first, BeadId end) const {
    for (BeadId b = first; b < end; ++b)
      if (asked_.asks({row, b})) return name_of(row, b) + " are not separated";
    return std::nullopt;
  }

  const SeparatingFamily& family_;
  std::span<const BeadPair> colliding_;
  const Balls<Dimension>& balls_;
  const PairsAsked& asked_;
  std::map<BeadId, BeadId> separated_;  // last bead of each run, by its first bead
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

// The paper's rule.
template <class Node>
bool splits_first(const Node& a, const Node& b) {
  return a.bead_count() >= b.bead_count();
}

// Finds the pairs of beads that are near, and calls apart(pair) for the pairs of nodes that are apart.
// `judge` takes two nodes and returns how they lie.
template <class Node, class Judge, class Apart>
PairsFound search(std::span<const Node> nodes, std::span<const std::uint32_t> roots, const PairsAsked& asked,
                  const Judge& judge, const Apart& apart) {
  const FloatingPointScope to_nearest;
  PairsFound found;
  // Returns whether the two nodes have to be split.
  const auto look_at = [&](const NodePair& pair) {
    if (++found.tests % 1024 == 0) InterruptionCheck::ask();
    const Separation verdict = judge(pair);
    if (verdict == Separation::apart) {
      ++found.family;
      apart(pair);
    } else if (verdict == Separation::near) {
      found.pairs.push_back({nodes[pair.first].first, nodes[pair.second].first});
    }
    return verdict == Separation::undecided;
  };
  detail::for_each_root(roots, asked, [&](const NodePair& of_roots, BeadId least_apart) {
    Stack<NodePair> stack;
    stack.push(of_roots);
    while (!stack.empty()) {
      const NodePair pair = stack.pop();
      const Node &a = nodes[pair.first], &b = nodes[pair.second];
      if (b.last - a.first < least_apart) continue;
      if (pair.first == pair.second) {
        stack.push({a.left, a.right});
        stack.push({a.right, a.right});
        stack.push({a.left, a.left});
      } else if (!look_at(pair)) {
        continue;
      } else if (splits_first(a, b)) {
        stack.push({a.right, pair.second});
        stack.push({a.left, pair.second});
      } else {
        stack.push({pair.first, b.right});
        stack.push({pair.first, b.left});
      }
    }
  });
  std::sort(found.pairs.begin(), found.pairs.end());
  return found;
}

// Finds the pairs of beads that are at most `distance` apart.
template <int Dimension, class Apart>
PairsFound search(const SphereTree<Dimension>& tree, const PairsAsked& asked, double distance,
                  const Apart& apart) {
  const std::span<const TreeSphere<Dimension>> spheres = tree.spheres();
  const auto judge = [&](const NodePair& pair) {
    return detail::separation(spheres[pair.first], spheres[pair.second], distance);
  };
  return search(spheres, tree.roots(), asked, judge, apart);
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
std::optional<std::string> family_fault(const SeparatingFamily& family, std::span<const BeadPair> colliding,
                                        const Balls<Dimension>& balls, const PairsAsked& asked) {
  const FloatingPointScope to_nearest;
  return Check<Dimension>(family, colliding, balls, asked).fault();
}

template std::optional<std::string> family_fault(const SeparatingFamily&, std::span<const BeadPair>,
                                                 const Balls<2>&, const PairsAsked&);
template std::optional<std::string> family_fault(const SeparatingFamily&, std::span<const BeadPair>,
                                                 const Balls<3>&, const PairsAsked&);

template <int Dimension>
PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked, double distance) {
  return search(tree, asked, distance, [](const NodePair&) {});
}

template <int Dimension>
PairsFound find_pairs(const SphereTree<Dimension>& tree, const PairsAsked& asked, SeparatingFamily& family) {
  family = detail::family_over(tree);
  return search(tree, asked, 0, [&](const NodePair& pair) {
    family.pairs.push_back({pair.first, pair.second});
  });
}

template <int Dimension>
std::optional<ClosestPair> find_closest_pair(const SphereTree<Dimension>& tree, const Balls<Dimension>& balls,
                                             const PairsAsked& asked) {
  const FloatingPointScope to_nearest;
  ClosestSoFar<Dimension> closest(balls);
  // Pairs near along the chain are close, which gives a good bound from the start.
  for (std::size_t n = 0; n < asked.necklaces.size(); ++n) {
    const auto& [first, last] = asked.necklaces[n];
    if (!asked.asks_of(n, n)) continue;
    for (BeadId b = first; last - b >= asked.apart && b <= last; ++b) closest.offer(b, b + asked.apart);
  }
  const auto spheres = tree.spheres();
  detail::for_each_root(tree.roots(), asked, [&](const NodePair& roots, BeadId least_apart) {
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
  });
  return closest.result();
}

template PairsFound find_pairs(const SphereTree<2>&, const PairsAsked&, double);
template PairsFound find_pairs(const SphereTree<3>&, const PairsAsked&, double);
template PairsFound find_pairs(const SphereTree<2>&, const PairsAsked&, SeparatingFamily&);
template PairsFound find_pairs(const SphereTree<3>&, const PairsAsked&, SeparatingFamily&);
template std::optional<ClosestPair> find_closest_pair(const SphereTree<2>&, const Balls<2>&,
                                                      const PairsAsked&);
template std::optional<ClosestPair> find_closest_pair(const SphereTree<3>&, const Balls<3>&,
                                                      const PairsAsked&);

}  // namespace kds
