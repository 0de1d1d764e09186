#include "structures/contacts/swept_contacts.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "motions/base/floating_point_guard.h"
#include "motions/numbers/exact_number.h"

namespace kds {

namespace {

using detail::dot;
using detail::minus;

/// Exceeds by far all roundings of a squared distance: 2^-45 of its terms, and possible underflow.
constexpr double spare = 0x1p-45;

template <int D>
[[gnu::always_inline]] inline bool are_apart(const Cage<D>& a, const Cage<D>& b) {
  const Point<D> d = minus(a.center, b.center);
  const double reach = a.radius + b.radius;
  return dot(d, d) * (1 - spare) > reach * reach + 0x1p-900;
}

/// Bernstein coefficients of |d|^2 - s^2 along a step, where d is linear from d0 to d1 and s from s0 to s1.
template <class N>
struct Quadratic {
  N q0, q1, q2;

  /// Returns whether the quadratic is positive and has no zero. If both ends are positive, the quadratic is
  /// positive if and only if q1 > -sqrt(q0 q2).
  [[nodiscard]] bool is_positive() const { return q0 > 0 && q2 > 0 && (q1 >= 0 || q1 * q1 < q0 * q2); }
};

/// Returns 1 if the spheres stay apart during the whole step, -1 if they meet, 0 if doubles do not decide.
template <int D>
[[nodiscard]] int told_apart(const Cage<D>& a0, const Cage<D>& b0, const Cage<D>& a1, const Cage<D>& b1) {
  const Point<D> d0 = minus(a0.center, b0.center), d1 = minus(a1.center, b1.center);
  const double s0 = a0.radius + b0.radius, s1 = a1.radius + b1.radius;
  const double first = dot(d0, d0), last = dot(d1, d1), mixed = dot(d0, d1);
  const double size = first + last + s0 * s0 + s1 * s1;
  if (!(size >= 0x1p-400 && size <= 0x1p400)) return 0;  // else its square loses digits
  const double error = spare * size;
  const double q0 = first - s0 * s0, q1 = mixed - s0 * s1, q2 = last - s1 * s1;
  if (Quadratic<double>{q0 - error, q1 - error, q2 - error}.is_positive()) return 1;
  if (!Quadratic<double>{q0 + error, q1 + error, q2 + error}.is_positive()) return -1;
  return 0;
}

template <int D>
Cage<D> ball_at(const Curves<D>& curves, BeadId bead, int k) {
  Cage<D> ball;
  for (int axis = 0; axis < D; ++axis)
    ball.center[static_cast<std::size_t>(axis)] = curves.coordinate(bead, k, axis);
  ball.radius = curves.radius(bead, k);
  return ball;
}

template <int D>
bool meet_exactly(const Curves<D>& curves, const BeadPair& pair, const std::array<int, 2>& controls) {
  std::array<std::array<Rational, static_cast<std::size_t>(D) + 1>, 2> numbers;  // differences, radii
  for (std::size_t end = 0; end < 2; ++end) {
    const int k = controls[end];
    for (int axis = 0; axis < D; ++axis)
      numbers[end][static_cast<std::size_t>(axis)] = Rational(curves.coordinate(pair.first, k, axis)) -
                                                     Rational(curves.coordinate(pair.second, k, axis));
    numbers[end][D] = Rational(curves.radius(pair.first, k)) + Rational(curves.radius(pair.second, k));
  }
  const auto product = [&](std::size_t a, std::size_t b) {
    Rational sum = -numbers[a][D] * numbers[b][D];
    for (std::size_t axis = 0; axis < D; ++axis) sum += numbers[a][axis] * numbers[b][axis];
    return sum;
  };
  return !Quadratic<Rational>{product(0, 0), product(0, 1), product(1, 1)}.is_positive();
}

/// Returns a static sphere that holds a sphere in linear motion. Half the path is at most half the sum of its
/// coordinates, which needs no root. The radius is rounded up and covers the rounding of the middle.
template <int D>
[[gnu::always_inline]] inline Cage<D> around_way(const Cage<D>& start, const Cage<D>& end) {
  Cage<D> cage;
  double way = 0, size = 0;
  for (std::size_t axis = 0; axis < D; ++axis) {
    cage.center[axis] = 0.5 * start.center[axis] + 0.5 * end.center[axis];
    way += std::abs(end.center[axis] - start.center[axis]);
    size += std::abs(cage.center[axis]);
  }
  cage.radius = (std::max(start.radius, end.radius) + 0.5 * way) * (1 + 0x1p-48) + 0x1p-50 * size + 0x1p-1060;
  return cage;
}

}  // namespace

template <int D>
SweptContacts<D>::SweptContacts(const NecklaceTree& tree, PairsAsked asked)
    : asked_(std::move(asked)), nodes_(static_cast<Item>(tree.node_count())) {
  check_groups(asked_);
  ranges_.assign(tree.ranges().begin(), tree.ranges().end());
  const BeadId beads = asked_.necklaces.empty() ? 0 : asked_.necklaces.back().last + 1;
  for (BeadId b = 0; b < beads; ++b) ranges_.push_back({b, b});
  const auto item = [&](NodeId child, BeadId leaf) {
    return child == NecklaceTree::leaf ? nodes_ + leaf : child;
  };
  for (NodeId node = 0; node < nodes_; ++node)
    children_.push_back(
        {item(tree.left(node), tree.range(node).first), item(tree.right(node), tree.range(node).last)});
  for (const BeadRange& necklace : asked_.necklaces)
    roots_.push_back(necklace.first == necklace.last ? nodes_ + necklace.first : *tree.find(necklace));
  resting_.resize(ranges_.size());
}

/// `may_meet(a, b)` tests two items. A pair of two beads is not split further.
template <int D>
template <class MayMeet>
void SweptContacts<D>::traverse(const MayMeet& may_meet, FoundPairs& found) {
  struct Task {
    Item a, b;  // equal items: the item paired with itself
  };
  std::vector<Task> stack;
  for (std::size_t i = roots_.size(); i-- > 0;) {
    for (std::size_t j = roots_.size(); j-- > i + 1;)
      if (asked_.asks_of(i, j)) stack.push_back({roots_[i], roots_[j]});
    if (asked_.asks_of(i, i) && roots_[i] < nodes_) stack.push_back({roots_[i], roots_[i]});
  }
  while (!stack.empty()) {
    const auto [a, b] = stack.back();
    stack.pop_back();
    if (a == b) {
      const auto [left, right] = children_[a];
      if (ranges_[a].last - ranges_[a].first < asked_.apart) continue;
      if (left < nodes_) stack.push_back({left, left});
      if (right < nodes_) stack.push_back({right, right});
      stack.push_back({left, right});
      continue;
    }
    ++found.tests;
    if (!may_meet(a, b)) continue;
    const BeadRange &of_a = ranges_[a], &of_b = ranges_[b];
    const BeadId beads_a = of_a.last - of_a.first, beads_b = of_b.last - of_b.first;
    if (beads_a == 0 && beads_b == 0) {
      const BeadPair pair{of_a.first, of_b.first};
      if (asked_.joins_groups(pair)) found.pairs.push_back(pair);
      continue;
    }
    const auto open = [&](const Task& task) {
      // All their beads are too near along the chain.
      if (ranges_[task.b].last - ranges_[task.a].first < asked_.apart &&
          (asked_.apart == 1 || asked_.necklace_of(of_a.first) == asked_.necklace_of(of_b.first)))
        return;
      stack.push_back(task);
    };
    if (beads_a >= beads_b) {
      open({children_[a].left, b});
      open({children_[a].right, b});
    } else {
      open({a, children_[b].left});
      open({a, children_[b].right});
    }
  }
}

template <int D>
void SweptContacts<D>::find(const OutwardCages<D>& start, const OutwardCages<D>& end, const Curves<D>& curves,
                            FoundPairs& found) {
  const FloatingPointGuard to_nearest;
  if (curves.own_degree() != 1) throw std::invalid_argument("swept contacts are of linear motion");
  found.pairs.clear();
  found.tests = 0;
  for (Item item = 0; item < nodes_; ++item) resting_[item] = around_way<D>(start[item], end[item]);
  for (Item item = nodes_; item < resting_.size(); ++item)
    resting_[item] = around_way<D>(ball_at(curves, item - nodes_, 0), ball_at(curves, item - nodes_, 1));
  traverse(
      [&](Item a, Item b) {
        if (are_apart<D>(resting_[a], resting_[b])) return false;
        if (a < nodes_ && b < nodes_) return told_apart<D>(start[a], start[b], end[a], end[b]) <= 0;
        const auto at = [&](Item item, int k) -> Cage<D> {
          return item < nodes_ ? (k == 0 ? start : end)[item] : ball_at(curves, item - nodes_, k);
        };
        const int told = told_apart<D>(at(a, 0), at(b, 0), at(a, 1), at(b, 1));
        if (told != 0 || a < nodes_ || b < nodes_) return told <= 0;
        return meet_exactly(curves, {a - nodes_, b - nodes_}, {0, 1});
      },
      found);
}

template <int D>
void SweptContacts<D>::find_static(const OutwardCages<D>& cages, const Curves<D>& curves, int k,
                                   FoundPairs& found) {
  const FloatingPointGuard to_nearest;
  found.pairs.clear();
  found.tests = 0;
  for (Item item = 0; item < nodes_; ++item) resting_[item] = cages[item];
  for (Item item = nodes_; item < resting_.size(); ++item) resting_[item] = ball_at(curves, item - nodes_, k);
  traverse(
      [&](Item a, Item b) {
        if (are_apart<D>(resting_[a], resting_[b])) return false;
        if (a < nodes_ || b < nodes_) return true;
        const int told = told_apart<D>(resting_[a], resting_[b], resting_[a], resting_[b]);
        if (told != 0) return told < 0;
        return meet_exactly(curves, {a - nodes_, b - nodes_}, {k, k});
      },
      found);
}

template class SweptContacts<2>;
template class SweptContacts<3>;

}  // namespace kds
