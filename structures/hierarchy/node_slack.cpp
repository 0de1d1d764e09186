#include "structures/hierarchy/node_slack.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/numbers/lanes.h"

namespace kds {

namespace {

/// Columns of the present and the earlier coordinates of beads.
template <int D>
struct Moved {
  std::array<const double*, D> to, from;

  [[gnu::always_inline]] Lanes along(std::size_t axis, std::size_t bead) const {
    return Lanes(Lanes::load(to[axis] + bead)) - Lanes(Lanes::load(from[axis] + bead));
  }
};

template <int D>
[[KDS_LANES_TARGETS]] void add_up(const Moved<D>& moved, std::size_t beads, std::array<double, D>& sum) {
  for (std::size_t axis = 0; axis < D; ++axis) {
    Lanes total(0.0);
    for (std::size_t b = 0; b + Lanes::width <= beads; b += Lanes::width) total += moved.along(axis, b);
    sum[axis] = (total.v[0] + total.v[1]) + (total.v[2] + total.v[3]);
  }
}

/// Raises each number of `stray` to how far the bead has moved apart from the drift.
template <int D>
[[KDS_LANES_TARGETS]] void find_strays(const Moved<D>& moved, std::size_t beads,
                                       const std::array<double, D>& drift, double rounding, double* stray) {
  for (std::size_t b = 0; b < beads; b += Lanes::width) {
    Lanes square(0.0);
    for (std::size_t axis = 0; axis < D; ++axis) {
      const Lanes v = moved.along(axis, b) - Lanes(drift[axis]);
      square += v * v;
    }
    const Lanes far = Lanes(Lanes::Vector{std::sqrt(square.v[0]), std::sqrt(square.v[1]),
                                          std::sqrt(square.v[2]), std::sqrt(square.v[3])}) *
                          Lanes(1 + 0x1p-40) +
                      Lanes(rounding);
    // Overflow may give NaN, which a maximum would not keep.
    const Lanes known = Lanes::choose(far < Lanes(HUGE_VAL), far, Lanes(HUGE_VAL));
    const Lanes most = Lanes::max(known, Lanes(Lanes::load(stray + b)));
    __builtin_memcpy(stray + b, &most.v, sizeof most.v);
  }
}

}  // namespace

template <int Dimension>
NodeSlack<Dimension>::NodeSlack(const NecklaceTree& tree)
    : tree_(tree), halves_(tree.node_count()), slack_(tree.node_count(), none) {
  const auto nodes = static_cast<std::uint32_t>(tree.node_count());
  for (NodeId id = 0; id < nodes; ++id) {
    const NodeId l = tree.left(id), r = tree.right(id);
    halves_[id] = {l == NecklaceTree::leaf ? nodes + tree.range(id).first : l,
                   r == NecklaceTree::leaf ? nodes + tree.range(id).last : r};
  }
}

template <int Dimension>
void NodeSlack<Dimension>::take_out_resting(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                                            std::vector<NodeId>& nodes) {
  if (has_reference_) {
    look_at(paths);
    if (resting(nodes) >= worth_keeping_) {
      samples_.reset();
      lasted_ = true;
      return take_out(nodes);
    }
    if (!lasted_) return give_up();
  } else if (samples_.skips()) {
    return;
  }
  set_reference(paths);
  look_at(paths);
  // A few nodes from all over the tree tell whether slack is worthwhile.
  std::vector<NodeId> some;
  const std::size_t stride = nodes.size() / sample_size + 1;
  for (std::size_t i = 0; i < nodes.size(); i += stride) some.push_back(nodes[i]);
  take_slack(paths, bases, some);
  const double share = resting(some);
  has_reference_ = share >= least_share;
  if (!has_reference_) return give_up();
  lasted_ = false;
  worth_keeping_ = still_worth * share;
  take_slack(paths, bases, nodes);
  take_out(nodes);
}

template <int Dimension>
void NodeSlack<Dimension>::take_slack(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                                      std::span<const NodeId> nodes) {
  for (const NodeId id : nodes) add(paths, id, bases[id]);
  for (Waiting& some : waiting_) find(paths, some);
}

template <int Dimension>
void NodeSlack<Dimension>::set_reference(const BeadPaths<Dimension>& paths) {
  for (std::size_t c = 0; c <= Dimension; ++c) {
    const double* const now = paths.column(0, static_cast<int>(c));
    reference_[c].assign(now, now + paths.bead_count() + BeadPaths<Dimension>::padding);
  }
  forget_all();
}

// The difference of two positions, and this difference less the drift, are each rounded by 2^-53 of their
// size. If squares are subnormal, lengths are below 2^-500; no slack is that small.
template <int Dimension>
void NodeSlack<Dimension>::look_at(const BeadPaths<Dimension>& paths) {
  const std::size_t nodes = halves_.size(), beads = paths.bead_count();
  stray_.assign(nodes + beads + BeadPaths<Dimension>::padding, 0);
  double* const stray = stray_.data() + nodes;
  Moved<Dimension> moved;
  for (std::size_t axis = 0; axis < Dimension; ++axis) moved.from[axis] = reference_[axis].data();
  bool same_radii = true;
  for (int k = 0; k <= paths.degree(); ++k) {
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      moved.to[axis] = paths.column(k, static_cast<int>(axis));
    if (!paths.radii_are_left_out()) {
      const double* const radii = paths.column(k, Dimension);
      same_radii = same_radii && std::equal(radii, radii + beads, reference_[Dimension].data());
    }
    std::array<double, Dimension> drift;
    add_up<Dimension>(moved, beads, drift);
    double length = 0;
    for (double& x : drift) {
      x /= static_cast<double>(beads);
      length += std::abs(x);
    }
    find_strays<Dimension>(moved, beads, drift, 0x1p-50 * length + 0x1p-500, stray);
  }
  // Slack does not cover radii that change.
  if (!same_radii) std::fill(stray, stray + beads, std::numeric_limits<double>::infinity());
  for (std::size_t id = nodes; id-- > 0;)
    stray_[id] = std::max(stray_[halves_[id][0]], stray_[halves_[id][1]]);
}

template <int Dimension>
double NodeSlack<Dimension>::resting(std::span<const NodeId> nodes) const {
  std::size_t count = 0;
  for (const NodeId id : nodes) count += rests(id) ? 1 : 0;
  return nodes.empty() ? 0 : static_cast<double>(count) / static_cast<double>(nodes.size());
}

template <int Dimension>
void NodeSlack<Dimension>::take_out(std::vector<NodeId>& nodes) const {
  std::size_t count = 0;
  for (const NodeId id : nodes) {  // no branch, because resting nodes are unpredictable
    nodes[count] = id;
    count += rests(id) ? 0 : 1;
  }
  nodes.resize(count);
}

template <int Dimension>
void NodeSlack<Dimension>::add(const BeadPaths<Dimension>& paths, NodeId node, const Basis& basis) {
  Waiting& some = waiting_[basis.size - 1U];
  some.nodes[some.count] = node;
  some.ranges[some.count] = tree_.range(node);
  some.bases[some.count] = basis;
  some.wanted[some.count] = steps_ahead * stray_[node];
  if (++some.count == Waiting::at_once) find(paths, some);
}

template <int Dimension>
void NodeSlack<Dimension>::find(const BeadPaths<Dimension>& paths, Waiting& some) {
  if (some.count == 0) return;
  std::array<double, Waiting::at_once> slack;
  sphere_slack<Dimension>(paths, std::span(some.ranges).first(some.count),
                          std::span(some.bases).first(some.count), std::span(some.wanted).first(some.count),
                          slack);
  for (std::size_t i = 0; i < some.count; ++i) slack_[some.nodes[i]] = slack[i] > 0 ? slack[i] : none;
  some.count = 0;
}

template <int Dimension>
void NodeSlack<Dimension>::forget_all() {
  std::fill(slack_.begin(), slack_.end(), none);
}

template <int Dimension>
void NodeSlack<Dimension>::give_up() {
  has_reference_ = false;
  forget_all();
  samples_.lengthen();
}

template class NodeSlack<2>;
template class NodeSlack<3>;

}  // namespace kds
