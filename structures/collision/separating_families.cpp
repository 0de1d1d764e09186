#include "structures/collision/separating_families.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <unordered_map>
#include <vector>

#include "motions/base/floating_point_guard.h"
#include "structures/collision/node_pairs.h"

namespace kds {

namespace {

using detail::NodePair;
using detail::Separation;

// Writes the explicit family by a descent through all pairs of nodes of one depth. A bead without children
// stands for itself at all depths below.
template <int Dimension>
class ExplicitFamily {
 public:
  ExplicitFamily(const SphereTree<Dimension>& tree, BeadId least_apart, SeparatingFamily* family)
      : spheres_(tree.spheres()), least_apart_(least_apart), family_(family) {
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
    reach_.back() = 9 * radius_.back() * slack;
    for (std::size_t d = radius_.size() - 1; d-- > 0;)
      reach_[d] = std::max(9 * radius_[d] * slack, reach_[d + 1] + 2 * radius_[d] * slack);
  }

  std::uint64_t write_from(std::uint32_t root) {
    visit({root, root}, 0);
    return size_;
  }

 private:
  static constexpr double slack = 1 + 1e-9;  // more than all roundings

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
    if (distance <= (8 * radius_[depth] + std::abs(a.radius - b.radius)) * slack &&
        detail::separation(a, b, 0) == Separation::apart) {
      ++size_;
      if (family_ != nullptr) family_->pairs.push_back({pair.first, pair.second});
    }
    if (a.is_bead() && b.is_bead()) return;
    visit({a.left, b.left}, depth + 1);
    if (!b.is_bead()) visit({a.left, b.right}, depth + 1);
    if (!a.is_bead()) visit({a.right, b.left}, depth + 1);
    if (!a.is_bead() && !b.is_bead()) visit({a.right, b.right}, depth + 1);
  }

  std::span<const TreeSphere<Dimension>> spheres_;
  BeadId least_apart_;
  SeparatingFamily* family_;
  std::vector<double> radius_;  // R of each depth
  std::vector<double> reach_;   // of centres, at each depth
  std::uint64_t size_ = 0;
};

template <int Dimension>
class SmallestFamily {
 public:
  SmallestFamily(const SphereTree<Dimension>& tree, SeparatingFamily* family)
      : spheres_(tree.spheres()), family_(family) {}

  void add(const NodePair& roots, BeadId least_apart) {
    least_apart_ = least_apart;
    sizes_.clear();
    found_.family += size_of(roots);
    write(roots);
  }
  PairsFound result() {
    std::sort(found_.pairs.begin(), found_.pairs.end());
    return std::move(found_);
  }

 private:
  using Node = TreeSphere<Dimension>;
  static std::uint64_t key(const NodePair& pair) { return std::uint64_t{pair.first} << 32U | pair.second; }
  [[nodiscard]] bool is_asked(const NodePair& pair) const {
    return spheres_[pair.second].last - spheres_[pair.first].first >= least_apart_;
  }

  std::uint64_t size_of(const NodePair& pair) {
    if (!is_asked(pair)) return 0;
    const Node &a = spheres_[pair.first], &b = spheres_[pair.second];
    if (pair.first == pair.second)
      return size_of({a.left, a.left}) + size_of({a.left, a.right}) + size_of({a.right, a.right});
    if (const auto known = sizes_.find(key(pair)); known != sizes_.end()) return known->second;
    ++found_.tests;
    std::uint64_t size = 0;
    const Separation gap = detail::separation(a, b, 0);
    if (gap == Separation::apart) size = 1;
    if (gap == Separation::undecided) size = std::min(size_by_first(pair), size_by_second(pair));
    sizes_.emplace(key(pair), size);
    return size;
  }
  std::uint64_t size_by_first(const NodePair& pair) {
    const Node& a = spheres_[pair.first];
    if (a.is_bead()) return impossible;
    return size_of({a.left, pair.second}) + size_of({a.right, pair.second});
  }
  std::uint64_t size_by_second(const NodePair& pair) {
    const Node& b = spheres_[pair.second];
    if (b.is_bead()) return impossible;
    return size_of({pair.first, b.left}) + size_of({pair.first, b.right});
  }

  // Writes the family of a pair whose size is known, and the collisions in it.
  void write(const NodePair& pair) {
    if (!is_asked(pair)) return;
    const Node &a = spheres_[pair.first], &b = spheres_[pair.second];
    if (pair.first == pair.second) {
      write({a.left, a.left});
      write({a.left, a.right});
      write({a.right, a.right});
      return;
    }
    const Separation gap = detail::separation(a, b, 0);
    if (gap == Separation::near) {
      found_.pairs.push_back({a.first, b.first});
    } else if (gap == Separation::apart) {
      if (family_ != nullptr) family_->pairs.push_back({pair.first, pair.second});
    } else if (size_of(pair) == size_by_first(pair)) {
      write({a.left, pair.second});
      write({a.right, pair.second});
    } else {
      write({pair.first, b.left});
      write({pair.first, b.right});
    }
  }

  static constexpr std::uint64_t impossible = ~std::uint64_t{0};
  std::span<const Node> spheres_;
  SeparatingFamily* family_;
  BeadId least_apart_ = 0;
  std::unordered_map<std::uint64_t, std::uint64_t> sizes_;
  PairsFound found_;
};

template <int Dimension>
void require_connected_chain(const SphereTree<Dimension>& tree, const PairsAsked& asked) {
  if (tree.roots().size() != 1 || !asked.within || asked.apart < 2)
    throw std::invalid_argument("an explicit family is one of the nonadjacent beads of one necklace");
  refuse_groups(asked, "an explicit family");
  const auto spheres = tree.spheres();
  const auto beads = spheres.last(std::size_t{spheres.back().last} + 1);
  for (std::size_t b = 0; b + 1 < beads.size(); ++b)
    if (detail::separation(beads[b], beads[b + 1], 0) != Separation::near)
      throw std::invalid_argument("an explicit family needs a connected necklace, but beads " +
                                  std::to_string(b) + " and " + std::to_string(b + 1) + " do not meet");
}

}  // namespace

template <int Dimension>
std::uint64_t explicit_family(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                              SeparatingFamily* family) {
  const FloatingPointGuard to_nearest;
  require_connected_chain(tree, asked);
  if (family != nullptr) *family = detail::family_over(tree);
  return ExplicitFamily<Dimension>(tree, asked.apart, family).write_from(tree.roots().front());
}

template <int Dimension>
PairsFound smallest_family(const SphereTree<Dimension>& tree, const PairsAsked& asked,
                           SeparatingFamily* family) {
  const FloatingPointGuard to_nearest;
  if (family != nullptr) *family = detail::family_over(tree);
  SmallestFamily<Dimension> smallest(tree, family);
  detail::for_each_root(tree.roots(), asked,
                        [&](const NodePair& roots, BeadId least_apart) { smallest.add(roots, least_apart); });
  return smallest.result();
}

template std::uint64_t explicit_family(const SphereTree<2>&, const PairsAsked&, SeparatingFamily*);
template std::uint64_t explicit_family(const SphereTree<3>&, const PairsAsked&, SeparatingFamily*);
template PairsFound smallest_family(const SphereTree<2>&, const PairsAsked&, SeparatingFamily*);
template PairsFound smallest_family(const SphereTree<3>&, const PairsAsked&, SeparatingFamily*);

}  // namespace kds
