#include "structures/hierarchy/node_slack.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "motions/numbers/lanes.h"
#include "structures/moving_sphere/chord_lanes.h"

namespace kds {

namespace {

using detail::BeadLanes;
using detail::beads_of;
using detail::End;
using detail::end_of;
using detail::gather;
using detail::margin;
using detail::up;
using detail::Vec;

/// Two bounds of the slack of a sphere, for four spheres: `most`, and (reach - farthest) / pace. `farthest`
/// is the largest distance from the centre to a point of the balls outside the basis.
template <int D>
struct Room {
  Vec<D> center;
  Lanes reach, pace, most;
};

/// Upper bounds of the lengths of the gradients of barycentric coordinates, of the longest sum of some of
/// them, and of the Frobenius norm of the matrix of all but the first. Infinite if the simplex may be flat.
template <std::size_t M>
struct Gradients {
  std::array<Lanes, M> each;  // all but the first
  Lanes longest, longest_sum, norm;
};

template <int D, std::size_t M>
[[gnu::always_inline]] inline Gradients<M> gradients_of(const std::array<Vec<D>, M>& d, const Lanes& size) {
  const auto length = [](const Vec<D>& v) __attribute__((always_inline)) { return root(detail::dot(v, v)); };
  const auto sum = [](const Vec<D>& a, const Vec<D>& b) __attribute__((always_inline)) {
    Vec<D> c;
    for (std::size_t axis = 0; axis < D; ++axis) c[axis] = a[axis] + b[axis];
    return c;
  };
  Gradients<M> g;
  Lanes volume, power(1.0), sum_of_two(0.0), first;
  if constexpr (M == 1) {
    volume = length(d[0]);
    g.each[0] = first = Lanes(1.0);
  } else if constexpr (M == 2) {
    const Vec<D> edge = detail::minus(d[1], d[0]);
    if constexpr (D == 2) {
      volume = abs(d[0][0] * d[1][1] - d[0][1] * d[1][0]);
    } else {
      volume = length(detail::cross(d[0], d[1]));
    }
    power = size;
    g.each = {length(d[1]), length(d[0])};
    first = length(edge);
  } else {
    const std::array<Vec<D>, 3> n{detail::cross(d[1], d[2]), detail::cross(d[2], d[0]),
                                  detail::cross(d[0], d[1])};
    volume = abs(detail::dot(n[0], d[0]));
    power = size * size;
    for (std::size_t i = 0; i < 3; ++i) g.each[i] = length(n[i]);
    first = length(sum(sum(n[0], n[1]), n[2]));
    sum_of_two =
        Lanes::max(length(sum(n[0], n[1])), Lanes::max(length(sum(n[1], n[2])), length(sum(n[2], n[0]))));
  }
  const Lanes rounding = Lanes(4 * margin) * power;
  volume = volume * Lanes(1 - 0x1p-30) - Lanes(margin) * power * size;
  const Lanes over = Lanes::choose(volume > Lanes(0.0), Lanes(up) / volume, Lanes(HUGE_VAL));
  g.longest = first = (first + rounding) * over;
  Lanes square(0.0);
  for (Lanes& each : g.each) {
    each = (each + rounding) * over;
    g.longest = Lanes::max(g.longest, each);
    square += each * each;
  }
  g.longest_sum = Lanes::max(g.longest, (sum_of_two + rounding) * over);
  g.norm = root(square) * Lanes(up);
  return g;
}

template <int D, std::size_t M, bool equal>
[[KDS_LANES_TARGETS]] void find_room(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads,
                                     const Lanes& wanted, Room<D>& room) {
  constexpr double root_of_m = detail::root_of[M];
  std::array<Vec<D>, M> d;
  std::array<Lanes, M> s;
  s.fill(Lanes(0.0));
  Lanes size(0.0);
  for (int axis = 0; axis < D + (equal ? 0 : 1); ++axis) {
    const double* column = paths.column(0, axis);
    const Lanes base = gather(column, beads[0]);
    for (std::size_t i = 0; i < M; ++i) {
      Lanes& x = axis < D ? d[i][static_cast<std::size_t>(axis)] : s[i];
      x = gather(column, beads[i + 1]) - base;
      size = Lanes::max(size, abs(x));
    }
  }
  size = size * Lanes(detail::root_of[3]);
  const End<D, M> end = end_of<equal, D, M>(d, s);
  Lanes l = size;
  for (const Lanes& x : end.z) l = Lanes::max(l, abs(x));
  l = Lanes::max(l * Lanes(detail::root_of[3]), abs(end.rho));
  const Lanes rounding = Lanes(margin) * l;

  const Gradients<M> g = gradients_of<D, M>(d, size);
  // A fifth of the movement that could make the simplex flat.
  const Lanes most = Lanes::min(wanted, Lanes(0.1 / root_of_m) / g.norm);
  const Lanes turn = Lanes(1.4143 * 1.25 * 2 * root_of_m) * g.norm * g.norm * most;

  Vec<D> bend = end.z;
  Lanes lightest = end.weight[0];
  for (std::size_t i = 0; i < M; ++i) {
    lightest = Lanes::min(lightest, end.weight[i + 1]);
    for (std::size_t axis = 0; axis < D; ++axis) bend[axis] -= end.weight[i + 1] * d[i][axis];
  }
  lightest -= Lanes(margin);
  const Lanes off = root(detail::dot(bend, bend)) * Lanes(up) + rounding;  // |z - sum w_i d_i|
  Lanes error = abs(root(detail::dot(end.z, end.z)) - end.rho), largest = end.rho, least = end.rho,
        slope(0.0);
  for (std::size_t i = 0; i < M; ++i) {
    const Vec<D> v = detail::minus(d[i], end.z);
    const Lanes touch = end.rho - s[i];
    error = Lanes::max(error, abs(root(detail::dot(v, v)) - touch));
    largest = Lanes::max(largest, touch);
    least = Lanes::min(least, touch);
    if constexpr (!equal) slope += (g.each[i] + turn) * (abs(s[i]) + rounding);
  }
  error = (error + off + rounding) * Lanes(up);

  // The centre moves from z' by at most drift * t + drift_at_start. The radius is known to within
  // radius_error.
  Lanes drift(0.0), drift_at_start(0.0);
  if constexpr (!(equal && M == 1)) {  // otherwise it is the midpoint
    const Lanes gain = (g.longest_sum * Lanes(2.0) + turn * Lanes(2 * root_of_m)) * (largest + most + error);
    drift = gain * Lanes(2.0) * (Lanes(1.0 + margin) - lightest) * Lanes(up);
    drift_at_start = gain * error * Lanes(up);
  }
  const Lanes radius_error = (drift_at_start + error) / (Lanes(1.0) - slope) * Lanes(up);
  drift = (drift + slope) * Lanes(up);
  drift_at_start = (drift_at_start + slope * radius_error) * Lanes(up);

  const Lanes steepest = (g.longest + turn * Lanes(root_of_m)) * Lanes(up);
  const Lanes by_weight =
      (lightest / steepest - drift_at_start) / drift;  // infinite if the centre stays at z'
  const Lanes by_radius = Lanes(0.5) * (least - radius_error - rounding);
  const Lanes::Mask proved = (size > Lanes(0x1p-150)) & (Lanes(paths.extent()) < Lanes(0x1p150)) &
                             (slope < Lanes(0.9)) & (lightest > steepest * drift_at_start) &
                             (error < l);  // false too if a bound is NaN
  room.center = end.z;
  room.reach = end.rho - (off + drift_at_start + radius_error) * Lanes(up) -
               Lanes(margin) * (Lanes(paths.extent()) + l);
  room.pace = (Lanes(3.0) + drift) * Lanes(up);
  room.most = Lanes::choose(proved, Lanes::min(most, Lanes::min(by_weight, by_radius)), Lanes(0.0));
}

/// Returns the greatest distance from `center`, relative to the basis' first ball, of a point of a ball
/// outside the basis, less the first ball's radius.
template <int D, bool equal>
[[KDS_LANES_TARGETS]] void find_farthest(const BeadPaths<D>& paths, const BeadRange& range,
                                         const Basis& basis, const std::array<double, D>& center,
                                         double& farthest) {
  constexpr int columns = D + (equal ? 0 : 1);
  std::array<Lanes, columns> from;
  std::array<const double*, columns> column;
  for (std::size_t axis = 0; axis < columns; ++axis) {
    column[axis] = paths.column(0, static_cast<int>(axis));
    from[axis] = Lanes(column[axis][basis.beads[0]]);
  }
  constexpr std::array<Lanes::Mask, 4> one{{{-1, 0, 0, 0}, {0, -1, 0, 0}, {0, 0, -1, 0}, {0, 0, 0, -1}}};
  Lanes most(-HUGE_VAL);
  const BeadId* member = basis.begin();
  for (BeadId b = range.first; b <= range.last; b += Lanes::width) {
    Lanes square(0.0);
    for (std::size_t axis = 0; axis < D; ++axis) {
      const Lanes v = Lanes(Lanes::load(column[axis] + b)) - from[axis] - Lanes(center[axis]);
      square += v * v;
    }
    Lanes reach = square;
    if constexpr (!equal) reach = root(square) + (Lanes(Lanes::load(column[D] + b)) - from[D]);
    for (; member != basis.end() && *member - b < Lanes::width; ++member)
      reach = Lanes::choose(one[*member - b], Lanes(-HUGE_VAL), reach);
    if (range.last - b < Lanes::width - 1) {
      constexpr Lanes::Vector lane{0, 1, 2, 3};
      reach =
          Lanes::choose(Lanes(lane) > Lanes(static_cast<double>(range.last - b)), Lanes(-HUGE_VAL), reach);
    }
    most = Lanes::max(most, reach);
  }
  farthest = std::max(std::max(most.v[0], most.v[1]), std::max(most.v[2], most.v[3]));
  if (equal && farthest > 0) farthest = std::sqrt(farthest);
}

template <int D, bool equal>
void find_slack(const BeadPaths<D>& paths, std::span<const BeadRange> nodes, std::span<const Basis> bases,
                std::span<const double> wanted, std::span<double> slack) {
  Lanes most;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane)
    most.v[lane] = wanted[std::min(lane, wanted.size() - 1)];
  Room<D> room;
  const std::size_t size = bases.front().size;
  if (size == 1) {  // a ball that holds the others
    room.center.fill(Lanes(0.0));
    room.reach = Lanes(-margin * paths.extent());
    room.pace = Lanes(3.0);
    room.most = paths.extent() > 0x1p-150 && paths.extent() < 0x1p150 ? most : Lanes(0.0);
  } else if (size == 2) {
    find_room<D, 1, equal>(paths, beads_of<2>(bases), most, room);
  } else if (D == 2 || size == 3) {
    find_room<D, 2, equal>(paths, beads_of<3>(bases), most, room);
  } else if constexpr (D == 3) {
    find_room<D, 3, equal>(paths, beads_of<4>(bases), most, room);
  }
  for (std::size_t lane = 0; lane < bases.size(); ++lane) {
    slack[lane] = 0;
    if (!(room.most.v[lane] > 0)) continue;
    std::array<double, D> center;
    for (std::size_t axis = 0; axis < D; ++axis) center[axis] = room.center[axis].v[lane];
    double farthest = 0;
    find_farthest<D, equal>(paths, nodes[lane], bases[lane], center, farthest);
    // Reduces slack to cover the rounding here and in each step that uses up a part of it.
    constexpr double down = 1 - 0x1p-20;
    const double by_others = (room.reach.v[lane] - farthest) / room.pace.v[lane];
    slack[lane] = std::min(room.most.v[lane], by_others) * down;
  }
}

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
void sphere_slack(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, std::span<const double> wanted, std::span<double> slack) {
  return paths.equal_radii() ? find_slack<Dimension, true>(paths, nodes, bases, wanted, slack)
                             : find_slack<Dimension, false>(paths, nodes, bases, wanted, slack);
}

template void sphere_slack(const BeadPaths<2>&, std::span<const BeadRange>, std::span<const Basis>,
                           std::span<const double>, std::span<double>);
template void sphere_slack(const BeadPaths<3>&, std::span<const BeadRange>, std::span<const Basis>,
                           std::span<const double>, std::span<double>);

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
void NodeSlack<Dimension>::take_out_skipped(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                                            std::vector<NodeId>& nodes) {
  if (has_reference_) {
    look_at(paths);
    if (share_skipped(nodes) >= worth_keeping_) {
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
  // A sample of nodes from the whole tree decides whether slack is worthwhile.
  std::vector<NodeId> some;
  const std::size_t stride = nodes.size() / sample_size + 1;
  for (std::size_t i = 0; i < nodes.size(); i += stride) some.push_back(nodes[i]);
  take_slack(paths, bases, some);
  const double share = share_skipped(some);
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
double NodeSlack<Dimension>::share_skipped(std::span<const NodeId> nodes) const {
  std::size_t count = 0;
  for (const NodeId id : nodes) count += is_skipped(id) ? 1 : 0;
  return nodes.empty() ? 0 : static_cast<double>(count) / static_cast<double>(nodes.size());
}

template <int Dimension>
void NodeSlack<Dimension>::take_out(std::vector<NodeId>& nodes) const {
  std::size_t count = 0;
  for (const NodeId id : nodes) {  // no branch, because the outcome is unpredictable
    nodes[count] = id;
    count += is_skipped(id) ? 0 : 1;
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
