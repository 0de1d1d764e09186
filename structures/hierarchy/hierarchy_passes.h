#pragma once
// The work of a static wrapped hierarchy at its nodes, many nodes of one height at a time. Computes bases
// from the children's bases or from the previous time's, their spheres, and proofs that all beads are inside
// (pivot_sphere.h).

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "structures/enclosing_sphere/pivot_sphere.h"
#include "structures/enclosing_sphere/sphere_scan.h"
#include "structures/hierarchy/lane_nodes.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"

namespace kds::detail {

// A node with more beads first tests whether cages below it are inside, and only then tests beads.
inline constexpr BeadId most_in_block = 256;
// A node with more beads, built from scratch, first searches the beads of its children's bases.
inline constexpr BeadId most_scanned = 100;
// If doubles have proved a cage, its beads lie within its radius times this factor.
inline constexpr double looseness = 1 + 0x1p-27;
inline constexpr std::size_t nodes_at_a_time = 64;

enum class Start : std::uint8_t { children, old_bases };

// Returns the sphere of a basis without verifying it. Superfluous beads are dropped.
template <class Form>
Cage<Form::Dimension> trusted_cage(const Balls<Form::Dimension>& balls, Basis basis) {
  while (true) {
    const typename Form::Sphere sphere = sphere_of_basis<Form>(balls, basis);
    if (sphere.least > 0 || basis.size == 1) return {sphere.center, sphere.radius};
    std::size_t index = 0;
    visit_size<Form::Dimension>(basis.size, [&](auto m) {
      if constexpr (m > 0) index = lightest<m>(balls, basis);
    });
    erase_bead_at(basis, index);
  }
}

/// Computes spheres of nodes from the nodes below or from old bases. Loops over beads and over the spheres of
/// many nodes are separate functions, compiled for each vector target (KDS_SCAN_TARGETS). The control flow
/// between them is compiled once.
template <class Form>
class NodeWrapper {
 public:
  static constexpr int Dimension = Form::Dimension;
  using Sphere = typename Form::Sphere;

  const NecklaceTree& tree;
  const Balls<Dimension>& balls;
  Basis* bases;
  Cage<Dimension>* cages;
  std::uint8_t* loose;
  Update how;
  Frontiers& frontiers;
  WrapCounts counts{};

  // Computes the spheres of independent nodes. Until a node's sphere is proved, its cage is the last one
  // tried.
  void wrap(const NodeId* nodes, std::size_t count, Start start) {
    if (start == Start::children) {
      for (std::size_t i = 0; i < count; ++i) bases[nodes[i]] = far_pair_of(nodes[i]);
      const BeadRange& range = tree.range(nodes[0]);
      if (range.last - range.first > most_scanned) pivot_among_children(nodes, count);
      counts.changed += count;
    }
    std::array<Bounds, nodes_at_a_time> bounds;
    std::array<std::size_t, nodes_at_a_time> outside;
    std::array<NodeId, nodes_at_a_time> left;
    std::array<Basis, nodes_at_a_time> before;  // old bases of the nodes in `left`
    const NodeId* waiting = nodes;
    for (int round = 0; count > 0; ++round) {
      // Each loop runs over all nodes, so that the processor overlaps independent work without branches.
      spheres_of(waiting, count, bounds.data());
      count_all_outside(waiting, count, bounds.data(), outside.data());
      std::size_t lefts = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const NodeId node = waiting[i];
        const Sphere sphere = sphere_by(node, bounds[i]);
        if (is_proved<Form>(bases[node], sphere, outside[i])) {
          loose[node] = 0;
          if (round > 0) finish(node, before[i], start);
          continue;
        }
        const Basis old = round == 0 ? bases[node] : before[i];
        if (round < most_pivots && improve(node, sphere)) {
          ++counts.pivots;
          left[lefts] = node;
          before[lefts++] = old;
        } else {
          decide_in_exact_numbers(node);
          finish(node, old, start);
        }
      }
      waiting = left.data();
      count = lefts;
    }
  }

  // Computes the spheres of the present bases without verifying them.
  void trust(const NodeId* nodes, std::size_t count) {
    std::array<Bounds, nodes_at_a_time> bounds;
    spheres_of<false>(nodes, count, bounds.data());
    for (std::size_t i = 0; i < count; ++i)
      if (!(bounds[i].least > 0)) cages[nodes[i]] = trusted_cage<Form>(balls, bases[nodes[i]]);
  }

  // Computes a sphere by a cascade that starts from the last frontier or from the children. `known` is the
  // run's previous list, `next` its new one.
  void wrap_by_cascade(NodeId node, const std::vector<std::uint32_t>& known,
                       std::vector<std::uint32_t>& next) {
    const Sphere sphere = sphere_of_basis<Form>(balls, bases[node]);
    const BottomUpOrder::Group old = frontiers.of_node[node];
    const auto start = static_cast<std::uint32_t>(next.size());
    if (sphere.certain && cascade(node, sphere, {known.data() + old.first, known.data() + old.end}, next)) {
      cages[node] = {sphere.center, sphere.radius};
      loose[node] = 0;
    } else {
      next.resize(start);
      wrap(&node, 1, Start::old_bases);
    }
    frontiers.of_node[node] = {start, static_cast<std::uint32_t>(next.size())};
    counts.frontier += next.size() - start;
  }

  // Handles nodes of two beads.
  void trust_pairs(const NodeId* nodes, std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto sphere = sphere_of_both(tree.range(nodes[i]));
      cages[nodes[i]] = {sphere.center, sphere.radius};
      if (!sphere.certain) cages[nodes[i]] = trusted_cage<Form>(balls, bases[nodes[i]]);
    }
  }
  void wrap_pairs(const NodeId* nodes, std::size_t count, Start start) {
    if (start == Start::children) {
      wrap_pairs_one_by_one(nodes, count, start);
      counts.changed += count;
      return;
    }
    std::array<NodeId, nodes_at_a_time> left;
    for (std::size_t i = 0; i < count; i += nodes_at_a_time) {
      const std::size_t some = std::min(nodes_at_a_time, count - i);
      const std::size_t lefts = keep_pairs<Form::of_points, Dimension>(
          nodes + i, some, tree.ranges().data(), balls.rows(), bases, cages, loose, left.data());
      wrap_pairs_one_by_one(left.data(), lefts, start);
    }
  }

 private:
  // The members of a BasisSphere that a node's cage lacks.
  struct alignas(32) Bounds {
    double inner, outer, least, certain;  // certain: 1 or 0
  };
  [[gnu::always_inline]] Sphere sphere_by(NodeId node, const Bounds& bounds) const {
    const Cage<Dimension>& cage = cages[node];
    return {cage.center, cage.radius, bounds.inner, bounds.outer, bounds.least, bounds.certain > 0};
  }

  void wrap_pairs_one_by_one(const NodeId* nodes, std::size_t count, Start start) {
    for (std::size_t i = 0; i < count; ++i) {
      const NodeId node = nodes[i];
      const BeadRange range = tree.range(node);
      const auto sphere = sphere_of_both(range);
      cages[node] = {sphere.center, sphere.radius};
      loose[node] = sphere.loose ? 1 : 0;
      const Basis before = bases[node];
      Basis& basis = bases[node];
      basis.size = 2;
      basis.beads[0] = range.first;
      basis.beads[1] = range.last;
      if (!sphere.certain && !decide_nested_pair(node, range)) decide_in_exact_numbers(node);
      finish(node, before, start);
    }
  }
  [[gnu::always_inline]] PairSphere<double, Dimension> sphere_of_both(const BeadRange& range) const {
    BasisBalls<double, Dimension, 1> both;
    both.center = {center_of(balls, range.first), center_of(balls, range.last)};
    both.radius = {balls.radii()[range.first], balls.radii()[range.last]};
    return sphere_of_pair<Form::of_points, Dimension, double>(both);
  }

  // Takes the larger ball as basis if it certainly holds the other. Returns whether it does.
  bool decide_nested_pair(NodeId node, const BeadRange& range) {
    if constexpr (Form::of_points) return false;
    const Point<Dimension> d = minus(center_of(balls, range.last), center_of(balls, range.first));
    const double a = balls.radii()[range.first], b = balls.radii()[range.last];
    const double distance = std::sqrt(dot(d, d));
    const double larger = std::max(a, b);
    if (!(larger >= 0x1p-150 && larger <= 0x1p150)) return false;
    if (!(distance + std::min(a, b) < larger * (1 - 0x1p-40))) return false;
    bases[node] = Basis();
    insert_bead(bases[node], a < b ? range.last : range.first);
    cages[node] = {center_of(balls, bases[node].beads[0]), larger};
    loose[node] = 0;
    return true;
  }

  void finish(NodeId node, const Basis& before, Start start) {
    if (start == Start::old_bases && !(before == bases[node])) ++counts.changed;
  }

  void decide_in_exact_numbers(NodeId node) {
    const BeadRange range = tree.range(node);
    ++counts.exact;
    loose[node] = 1;
    cages[node] = enclosing_sphere_exactly(balls, range.first, range.last, bases[node], Form::of_points);
  }

  // Counts for each node the beads that are not certainly inside its sphere.
  [[KDS_SCAN_TARGETS]] void count_all_outside(const NodeId* nodes, std::size_t count, const Bounds* bounds,
                                              std::size_t* outside) {
    for (std::size_t i = 0; i < count; ++i)
      outside[i] = count_outside<Form>(balls, sphere_by(nodes[i], bounds[i]), below(nodes[i]));
  }
  [[KDS_SCAN_TARGETS]] BeadId escaped_from(NodeId node, const Sphere& sphere) {
    return escaped_bead<Form>(balls, sphere, below(node));
  }
  bool improve(NodeId node, const Sphere& sphere) {
    return next_basis<Form>(balls, bases[node], sphere, [&] { return escaped_from(node, sphere); });
  }
  [[gnu::always_inline]] auto below(NodeId node) {
    return [ this, node ](const Sphere& sphere, const auto& look) __attribute__((always_inline)) {
      this->visit_blocks(node, sphere, look);
    };
  }

  // Stores the spheres of the nodes' bases as their cages, four at a time among bases of one size.
  template <bool with_bounds = true>
  [[KDS_LANES_TARGETS]] void spheres_of(const NodeId* nodes, std::size_t count, Bounds* bounds) const {
    std::array<std::array<std::uint8_t, nodes_at_a_time>, Basis::max_size> indices;
    std::uint64_t counts_of_sizes = 0;  // 16 bits per size: no branch, and no store to wait for
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t m = bases[nodes[i]].size - 1U;
      indices[m][counts_of_sizes >> 16 * m & 0xffff] = static_cast<std::uint8_t>(i);
      counts_of_sizes += std::uint64_t{1} << 16 * m;
    }
    std::array<std::size_t, Basis::max_size> of_size;
    for (std::size_t m = 0; m < Basis::max_size; ++m) of_size[m] = counts_of_sizes >> 16 * m & 0xffff;
    for (std::size_t i = 0; i < of_size[0]; ++i) {
      const NodeId node = nodes[indices[0][i]];
      const Sphere sphere = Form::sphere(basis_balls<0>(balls, bases[node]));
      cages[node] = {sphere.center, sphere.radius};
      bounds[indices[0][i]] = {sphere.inner, sphere.outer, sphere.least, sphere.certain ? 1.0 : 0.0};
    }
    spheres_of_size<with_bounds, 1>(nodes, indices[1].data(), of_size[1], bounds);
    spheres_of_size<with_bounds, 2>(nodes, indices[2].data(), of_size[2], bounds);
    if constexpr (Dimension == 3)
      spheres_of_size<with_bounds, 3>(nodes, indices[3].data(), of_size[3], bounds);
  }
  template <bool with_bounds, std::size_t M>
  [[gnu::always_inline]] void spheres_of_size(const NodeId* nodes, const std::uint8_t* indices,
                                              std::size_t count, Bounds* bounds) const {
    for (std::size_t i = 0; i < count; i += Lanes::width) {
      BasisBalls<Lanes, Dimension, M> members;
      FourIndices four, beside;
      for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
        beside[lane] = indices[std::min(i + lane, count - 1)];
        four[lane] = nodes[beside[lane]];
      }
      gather(balls.rows(), bases, four, members);
      // Stored as whole rows only: if lanes are extracted one by one, g++ 12 also computes the roots one by
      // one.
      const BasisSphere<Lanes, Dimension> sphere = Form::template sphere<with_bounds>(members);
      FourBalls<Dimension> spheres;
      for (std::size_t axis = 0; axis < Dimension; ++axis) spheres.center[axis].v = sphere.center[axis].v;
      spheres.radius.v = sphere.radius.v;
      spheres.store(cages, four);
      if constexpr (with_bounds) {
        const Lanes certain = Lanes::choose(sphere.certain, Lanes(1.0), Lanes(0.0));
        store_rows(sphere.inner, sphere.outer, sphere.least, certain, bounds, beside);
      } else {
        for (std::size_t lane = 0; lane < Lanes::width && i + lane < count; ++lane)
          bounds[indices[i + lane]].least = sphere.least.v[lane];
      }
    }
  }

  // Returns whether the sphere certainly holds a cage and therefore its beads. Beads within `inner` are
  // inside.
  [[gnu::always_inline]] bool holds_cage(const Sphere& sphere, double inner, NodeId node) const {
    const double room = inner - cages[node].radius * looseness;
    const Point<Dimension> d = minus(cages[node].center, sphere.center);
    return room > 0x1p-200 && dot(d, d) <= room * room * (1 - 0x1p-40) && loose[node] == 0;
  }

  // Visits blocks of beads below a node, from the left, except blocks whose cages are certainly inside.
  template <class Look>
  [[gnu::always_inline]] void visit_blocks(NodeId node, const Sphere& sphere, const Look& look) {
    const BeadRange all = tree.range(node);
    if (all.last - all.first < most_in_block || how == Update::naive) {
      counts.bead_tests += all.last - all.first + 1;
      return look(all.first, all.last);
    }
    const double inner = sphere.certain ? Form::inner_radius(sphere) : 0;
    std::array<NodeId, 64> stack;
    std::size_t depth = 0;
    stack[depth++] = tree.right(node);
    stack[depth++] = tree.left(node);
    while (depth > 0) {
      const NodeId v = stack[--depth];
      ++counts.cage_tests;
      if (holds_cage(sphere, inner, v)) continue;
      const BeadRange range = tree.range(v);
      if (range.last - range.first < most_in_block) {
        counts.bead_tests += range.last - range.first + 1;
        look(range.first, range.last);
        continue;
      }
      stack[depth++] = tree.right(v);
      stack[depth++] = tree.left(v);
    }
  }

  // Returns whether all beads below the node are inside. Appends the frontier where this was decided, from
  // the left.
  [[KDS_SCAN_TARGETS]] bool cascade(NodeId node, const Sphere& sphere, std::span<const std::uint32_t> known,
                                    std::vector<std::uint32_t>& next) {
    const auto child = [](NodeId v, BeadId leaf) {
      return v == NecklaceTree::leaf ? Frontiers::bead | leaf : v;
    };
    const auto left = [&](NodeId v) { return child(tree.left(v), tree.range(v).first); };
    const auto right = [&](NodeId v) { return child(tree.right(v), tree.range(v).last); };
    const std::array<std::uint32_t, 2> children{left(node), right(node)};
    if (known.empty()) known = children;
    const double inner = Form::inner_radius(sphere);
    const auto measure = Form::measure(balls, sphere);
    std::array<std::uint32_t, 64> stack;
    for (const std::uint32_t from : known) {
      std::size_t depth = 0;
      stack[depth++] = from;
      while (depth > 0) {
        const std::uint32_t v = stack[--depth];
        if ((v & Frontiers::bead) != 0) {
          const BeadId b = v & ~Frontiers::bead;
          if (!bases[node].contains(b)) {
            ++counts.bead_tests;
            OutsideCount one;
            one.scan(measure, b, b);
            if (one.result() > 0) return false;
          }
        } else {
          ++counts.cage_tests;
          if (!holds_cage(sphere, inner, v)) {
            stack[depth++] = right(v);
            stack[depth++] = left(v);
            continue;
          }
        }
        next.push_back(v);
      }
    }
    return true;
  }

  std::span<const BeadId> members(NodeId child, const BeadId& leaf) const {
    return child == NecklaceTree::leaf ? std::span<const BeadId>(&leaf, 1)
                                       : std::span<const BeadId>(bases[child].begin(), bases[child].size);
  }
  // Returns a far pair among the beads of both children's bases.
  Basis far_pair_of(NodeId node) const {
    const BeadRange range = tree.range(node);
    const NodeId left = tree.left(node);
    return far_pair<Form>(balls, members(tree.right(node), range.last), members(left, range.first),
                          left == NecklaceTree::leaf ? center_of(balls, range.first) : cages[left].center);
  }

  // The beads of both children's bases; some may occur twice.
  struct Few {
    std::array<std::array<double, 8>, Dimension> centers;
    std::array<double, 8> radii;
    std::array<BeadId, 8> ids;
  };
  Few few_of(NodeId node) const {
    const BeadRange range = tree.range(node);
    const auto of_left = members(tree.left(node), range.first);
    const auto of_right = members(tree.right(node), range.last);
    Few few;
    for (std::size_t k = 0; k < 8; ++k) {
      const std::size_t r = k - of_left.size();
      const BeadId b = k < of_left.size() ? of_left[k] : of_right[r < of_right.size() ? r : 0];
      few.ids[k] = b;
      for (std::size_t axis = 0; axis < Dimension; ++axis) few.centers[axis][k] = balls.coordinates(axis)[b];
      few.radii[k] = balls.radii()[b];
    }
    return few;
  }
  // Finds for each sphere the bead of `few[index]` that sticks out farthest, or no_bead.
  [[KDS_SCAN_TARGETS]] void escaped_of_few(const Few* few, const std::uint8_t* index, const NodeId* nodes,
                                           std::size_t count, const Bounds* bounds, BeadId* escaped) const {
    const auto measure_of = [&](std::size_t i) __attribute__((always_inline)) {
      auto measure = Form::measure(balls, sphere_by(nodes[i], bounds[i]));
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        measure.centers[axis] = few[index[i]].centers[axis].data();
      if constexpr (!Form::of_points) measure.radii = few[index[i]].radii.data();
      return measure;
    };
    std::array<double, nodes_at_a_time> farthest;
    for (std::size_t i = 0; i < count; ++i) {
      Farthest most;
      most.scan(measure_of(i), 0, 7);
      farthest[i] = most.result();
    }
    for (std::size_t i = 0; i < count; ++i) {
      escaped[i] = no_bead;
      if (!(farthest[i] > bounds[i].outer) || !(bounds[i].least > 0)) continue;
      const BeadId found = find_value(measure_of(i), 0, 7, farthest[i]);
      if (found != no_bead) escaped[i] = few[index[i]].ids[found];
    }
  }

  // Replaces the bases by the likely bases of the beads of both children's bases.
  void pivot_among_children(const NodeId* nodes, std::size_t count) {
    std::array<Few, nodes_at_a_time> few;
    std::array<Bounds, nodes_at_a_time> bounds;
    std::array<BeadId, nodes_at_a_time> escaped;
    std::array<NodeId, nodes_at_a_time> waiting;
    std::array<std::uint8_t, nodes_at_a_time> index;
    for (std::size_t i = 0; i < count; ++i) {
      few[i] = few_of(nodes[i]);
      waiting[i] = nodes[i];
      index[i] = static_cast<std::uint8_t>(i);
    }
    for (int round = 0; count > 0 && round < 8; ++round) {
      spheres_of(waiting.data(), count, bounds.data());
      escaped_of_few(few.data(), index.data(), waiting.data(), count, bounds.data(), escaped.data());
      std::size_t left = 0;
      for (std::size_t i = 0; i < count; ++i) {
        Basis& basis = bases[waiting[i]];
        if (escaped[i] == no_bead || basis.contains(escaped[i]) || !Form::pivot(balls, basis, escaped[i]))
          continue;
        ++counts.pivots;
        waiting[left] = waiting[i];
        index[left++] = index[i];
      }
      count = left;
    }
  }
};

}  // namespace kds::detail
