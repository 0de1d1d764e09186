#include "python/separating_families.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <vector>

#include "motions/base/floating_point_scope.h"
#include "motions/base/input_error.h"
#include "structures/collision/node_pairs.h"

namespace kds::python {

namespace {

using detail::NodePair;
using detail::Separation;

// Counts the pairs of a search whose nodes of at most `leaf` beads are not split into nodes.
template <int Dimension>
class RuledSearch {
 public:
  RuledSearch(const SphereTree<Dimension>& tree, Split split, BeadId leaf)
      : spheres_(tree.spheres()), split_(split), leaf_(leaf) {
    if (!spheres_.empty())
      first_bead_ = static_cast<std::uint32_t>(spheres_.size() - 1 - spheres_.back().last);
  }

  void visit(const NodePair& pair, BeadId least_apart) {
    const Node &a = spheres_[pair.first], &b = spheres_[pair.second];
    if (b.last - a.first < least_apart) return;
    const bool is_one = pair.first == pair.second;
    if (!is_one && !look_at(pair)) return;
    if (is_leaf(a) && is_leaf(b)) {
      for (BeadId i = a.first; i <= a.last; ++i)
        for (BeadId j = std::max(i + 1, b.first); j <= b.last; ++j)
          if (j - i >= least_apart) static_cast<void>(look_at({first_bead_ + i, first_bead_ + j}));
    } else if (is_one) {
      visit({a.left, a.left}, least_apart);
      visit({a.right, a.right}, least_apart);
      visit({a.left, a.right}, least_apart);
    } else if (splits_first(a, b)) {
      visit({a.left, pair.second}, least_apart);
      visit({a.right, pair.second}, least_apart);
    } else {
      visit({pair.first, b.left}, least_apart);
      visit({pair.first, b.right}, least_apart);
    }
  }
  [[nodiscard]] const FamilySize& found() const { return found_; }

 private:
  using Node = TreeSphere<Dimension>;

  [[nodiscard]] bool is_leaf(const Node& node) const { return node.bead_count() <= leaf_; }
  [[nodiscard]] bool splits_first(const Node& a, const Node& b) const {
    if (is_leaf(a) || is_leaf(b)) return is_leaf(b);
    if (split_ == Split::larger_sphere) return a.radius >= b.radius;
    return split_ == Split::first_node || a.bead_count() >= b.bead_count();
  }
  // Returns whether the two nodes have to be split.
  [[nodiscard]] bool look_at(const NodePair& pair) {
    ++found_.tests;
    const Separation gap = detail::separation(spheres_[pair.first], spheres_[pair.second], 0);
    if (gap == Separation::apart) ++found_.pairs;
    return gap == Separation::undecided;
  }

  std::span<const Node> spheres_;
  Split split_;
  BeadId leaf_;
  std::uint32_t first_bead_ = 0;
  FamilySize found_;
};

// Counts the explicit family by a descent through all pairs of nodes of one depth. A bead without children
// stands for itself at all depths below.
template <int Dimension>
class ExplicitFamily {
 public:
  ExplicitFamily(const SphereTree<Dimension>& tree, BeadId least_apart)
      : spheres_(tree.spheres()), least_apart_(least_apart) {
    const TreeSphere<Dimension>& root = spheres_[tree.roots().front()];
    double largest = 0;
    for (const TreeSphere<Dimension>& sphere : spheres_.last(root.bead_count()))
      largest = std::max(largest, sphere.radius);
    for (std::size_t most = root.bead_count();; most = (most + 1) / 2) {
      radius_.push_back(largest * static_cast<double>(most));
      if (most == 1) break;
    }
    // Two cages of a depth whose centres are within reach have parents whose centres are within reach: each
    // centre lies in its parent's cage.
    reach_.resize(radius_.size());
    reach_.back() = 9 * radius_.back() * margin;
    for (std::size_t d = radius_.size() - 1; d-- > 0;)
      reach_[d] = std::max(9 * radius_[d] * margin, reach_[d + 1] + 2 * radius_[d] * margin);
  }

  std::uint64_t count_from(std::uint32_t root) {
    visit({root, root}, 0);
    return size_;
  }

 private:
  static constexpr double margin = 1 + 1e-9;  // more than all roundings

  void visit(const NodePair& pair, std::size_t depth) {
    const TreeSphere<Dimension>&a = spheres_[pair.first], &b = spheres_[pair.second];
    if (b.last - a.first < least_apart_) return;
    if (pair.first == pair.second) {
      visit({a.left, a.left}, depth + 1);
      visit({a.left, a.right}, depth + 1);
      visit({a.right, a.right}, depth + 1);
      return;
    }
    const Point<Dimension> d = detail::minus(a.center, b.center);
    const double distance = std::sqrt(detail::dot(d, d));
    if (distance > reach_[depth]) return;
    if (distance <= (8 * radius_[depth] + std::abs(a.radius - b.radius)) * margin &&
        detail::separation(a, b, 0) == Separation::apart)
      ++size_;
    if (a.is_bead() && b.is_bead()) return;
    visit({a.left, b.left}, depth + 1);
    if (!b.is_bead()) visit({a.left, b.right}, depth + 1);
    if (!a.is_bead()) visit({a.right, b.left}, depth + 1);
    if (!a.is_bead() && !b.is_bead()) visit({a.right, b.right}, depth + 1);
  }

  std::span<const TreeSphere<Dimension>> spheres_;
  BeadId least_apart_;
  std::vector<double> radius_;  // R of each depth
  std::vector<double> reach_;   // for each depth: no pair lies below nodes whose centres are farther apart
  std::uint64_t size_ = 0;
};

// Counts the smallest family by dynamic programming over pairs of nodes.
template <int Dimension>
class Smallest {
 public:
  explicit Smallest(const SphereTree<Dimension>& tree) : spheres_(tree.spheres()) {}

  void add(const NodePair& roots, BeadId least_apart) {
    least_apart_ = least_apart;
    sizes_.clear();
    found_.pairs += size_of(roots);
  }
  [[nodiscard]] const FamilySize& found() const { return found_; }

 private:
  static std::uint64_t key(const NodePair& pair) { return std::uint64_t{pair.first} << 32U | pair.second; }

  std::uint64_t size_of(const NodePair& pair) {
    const TreeSphere<Dimension>&a = spheres_[pair.first], &b = spheres_[pair.second];
    if (b.last - a.first < least_apart_) return 0;
    if (pair.first == pair.second)
      return size_of({a.left, a.left}) + size_of({a.left, a.right}) + size_of({a.right, a.right});
    if (const auto known = sizes_.find(key(pair)); known != sizes_.end()) return known->second;
    ++found_.tests;
    std::uint64_t size = 0;
    const Separation gap = detail::separation(a, b, 0);
    if (gap == Separation::apart) size = 1;
    if (gap == Separation::undecided) {
      constexpr std::uint64_t impossible = ~std::uint64_t{0};
      const std::uint64_t by_first =
          a.is_bead() ? impossible : size_of({a.left, pair.second}) + size_of({a.right, pair.second});
      const std::uint64_t by_second =
          b.is_bead() ? impossible : size_of({pair.first, b.left}) + size_of({pair.first, b.right});
      size = std::min(by_first, by_second);
    }
    sizes_.emplace(key(pair), size);
    return size;
  }

  std::span<const TreeSphere<Dimension>> spheres_;
  BeadId least_apart_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> sizes_;
  FamilySize found_;
};

template <int Dimension>
void require_connected_chain(const SphereTree<Dimension>& tree, const PairsAsked& asked) {
  if (tree.roots().size() != 1 || !asked.within || asked.apart < 2)
    throw InputError("rule: explicit is for the pairs of one necklace that are at least 2 apart");
  const auto spheres = tree.spheres();
  const auto beads = spheres.last(std::size_t{spheres.back().last} + 1);
  for (std::size_t b = 0; b + 1 < beads.size(); ++b)
    if (detail::separation(beads[b], beads[b + 1], 0) != Separation::near)
      throw InputError(fmt::format(
          "rule: explicit needs a connected necklace, but beads {} and {} do not meet", b, b + 1));
}

}  // namespace

template <int Dimension>
FamilySize ruled_family(const SphereTree<Dimension>& tree, const PairsAsked& asked, Split split,
                        BeadId leaf) {
  const FloatingPointScope to_nearest;
  RuledSearch<Dimension> search(tree, split, leaf);
  detail::for_each_root(tree.roots(), asked,
                        [&](const NodePair& roots, BeadId least_apart) { search.visit(roots, least_apart); });
  return search.found();
}

template <int Dimension>
std::uint64_t explicit_family(const SphereTree<Dimension>& tree, const PairsAsked& asked) {
  const FloatingPointScope to_nearest;
  require_connected_chain(tree, asked);
  return ExplicitFamily<Dimension>(tree, asked.apart).count_from(tree.roots().front());
}

template <int Dimension>
FamilySize smallest_family(const SphereTree<Dimension>& tree, const PairsAsked& asked) {
  const FloatingPointScope to_nearest;
  Smallest<Dimension> smallest(tree);
  detail::for_each_root(tree.roots(), asked,
                        [&](const NodePair& roots, BeadId least_apart) { smallest.add(roots, least_apart); });
  return smallest.found();
}

template FamilySize ruled_family(const SphereTree<2>&, const PairsAsked&, Split, BeadId);
template FamilySize ruled_family(const SphereTree<3>&, const PairsAsked&, Split, BeadId);
template std::uint64_t explicit_family(const SphereTree<2>&, const PairsAsked&);
template std::uint64_t explicit_family(const SphereTree<3>&, const PairsAsked&);
template FamilySize smallest_family(const SphereTree<2>&, const PairsAsked&);
template FamilySize smallest_family(const SphereTree<3>&, const PairsAsked&);

}  // namespace kds::python
