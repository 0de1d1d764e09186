#include "structures/hull/convex_hull.h"

#include <algorithm>
#include <array>
#include <concepts>
#include <iterator>
#include <stdexcept>
#include <string>
#include <utility>

#include "motions/curves/positions.h"

namespace kds {

namespace {

// The hull of beads at fixed positions. Stores the lower and upper half, each from the first to the last bead
// along the axis, strictly convex. If beads coincide, only the least is used.
struct StaticHull {
  std::vector<BeadId> lower, upper;

  /// Returns the corners counterclockwise from the first bead.
  [[nodiscard]] std::vector<BeadId> circle() const {
    std::vector<BeadId> all = lower;
    for (std::size_t i = upper.size(); i-- > 2;) all.push_back(upper[i - 1]);
    return all;
  }
};

// Computes the hull of `sorted` by Andrew's monotone chain. `sorted` must list the beads in ascending order
// of their ids. `order(a, b)` compares along the first axis, then along the second: negative if a is before
// b, zero if they coincide. `turn(a, b, c)` is positive if the beads turn counterclockwise.
template <std::invocable<BeadId, BeadId> Order, std::invocable<BeadId, BeadId, BeadId> Turn>
StaticHull static_hull(std::vector<BeadId> sorted, Order order, Turn turn) {
  std::stable_sort(sorted.begin(), sorted.end(), [&](BeadId a, BeadId b) { return order(a, b) < 0; });
  sorted.erase(
      std::unique(sorted.begin(), sorted.end(), [&](BeadId a, BeadId b) { return order(a, b) == 0; }),
      sorted.end());
  const auto half = [&](int side) {
    std::vector<BeadId> chain;
    for (const BeadId bead : sorted) {
      while (chain.size() > 1 && side * turn(chain.end()[-2], chain.back(), bead) <= 0) chain.pop_back();
      chain.push_back(bead);
    }
    return chain;
  };
  return {half(1), half(-1)};
}

constexpr std::array<IdRole, 3> corner_between{{{"corner"}, {"before"}, {"after"}}};
constexpr std::array<IdRole, 2> beads_in_order{{{"first"}, {"second"}}};
constexpr auto hull_kinds = with_edits(std::array{EventKind{"enter", true, false, corner_between},
                                                  EventKind{"leave", true, false, corner_between},
                                                  EventKind{"interchange", false, false, beads_in_order}});
static_assert(hull_kinds.size() == ConvexHull::changes + 1);

using Circle = std::vector<BeadId>;

void begin_with_least(Circle& circle) {
  std::rotate(circle.begin(), std::min_element(circle.begin(), circle.end()), circle.end());
}

Circle sorted(Circle circle) {
  std::sort(circle.begin(), circle.end());
  return circle;
}
bool is_in(const Circle& sorted, BeadId bead) {
  return std::binary_search(sorted.begin(), sorted.end(), bead);
}

/// Returns the corners of the first circle that are also in the second one, in order.
Circle common(const Circle& circle, const Circle& other) {
  const Circle others = sorted(other);
  Circle both;
  std::copy_if(circle.begin(), circle.end(), std::back_inserter(both),
               [&](BeadId b) { return is_in(others, b); });
  begin_with_least(both);
  return both;
}

std::size_t index_of(const Circle& circle, BeadId bead) {
  return static_cast<std::size_t>(std::find(circle.begin(), circle.end(), bead) - circle.begin());
}

/// Returns the corner `steps` corners further around the circle.
BeadId further(const Circle& circle, std::size_t from, std::size_t steps) {
  return circle[(from + steps) % circle.size()];
}

}  // namespace

ConvexHull::ConvexHull(Simulator& simulator, const MotionRef<2>& motion)
    : EditableBase(simulator, motion.bead_count(), "hull", hull_kinds),
      motion_(motion),
      certificates_(simulator, *this, index(), motion) {}

void ConvexHull::build() {
  present().structure_is_built();
  const std::size_t beads = bead_count();
  const Kernel kernel = simulator().kernel();
  const StaticHull hull = static_hull(
      present().all(),
      [&](BeadId a, BeadId b) { return certificates_.order_at_start(kernel, a, b, statistics.stages); },
      [&](BeadId a, BeadId b, BeadId c) {
        return certificates_.turn_at_start(kernel, {a, b, c}, statistics.stages);
      });
  lower_.assign(beads, present().absent(), hull.lower);
  upper_.assign(beads, present().absent(), hull.upper);
  corners_ = hull.circle();
  begin_with_least(corners_);
}

std::vector<BeadId> ConvexHull::state() const {
  std::vector<BeadId> state = corners_;
  for (const HalfHull* const half : {&lower_, &upper_}) {
    state.push_back(no_bead);
    const std::vector<BeadId> chain = half->chain();
    state.insert(state.end(), chain.begin(), chain.end());
  }
  return state;
}

void ConvexHull::start_step() {
  lower_.start();
  upper_.start();
  needs_after_batch = true;
  count_certificates();
}

void ConvexHull::count_certificates() {
  CertificatesPerBead per_bead(statistics.certificates, bead_count());
  for (const HalfHull* half : {&lower_, &upper_}) half->count_certificates(per_bead);
}

void ConvexHull::fail(unsigned table, std::uint32_t slot) {
  const HullCertificates::Failed failed = certificates_.failure(table, slot);
  HalfHull& half = HalfHull::is_upper(failed.place) ? upper_ : lower_;
  half.fail(table, failed.place);
  certificates_.failure_is_over();
  if (half.take_changed()) needs_after_batch = true;
  if (table != HullCertificates::turns) record(interchange, {failed.before, failed.after});
}

// Records the changes from the previous corners to the present corners of both halves.
void ConvexHull::after_batch() {
  const Circle now = StaticHull{lower_.chain(), upper_.chain()}.circle();
  Circle staying = common(now, corners_);
  // If all corners meet in a line or a point, the corners that stay may come out in another order. In this
  // case all but one leave and enter again.
  if (staying != common(corners_, now)) staying.resize(1);
  const std::size_t start = staying.empty() ? 0 : index_of(now, staying.front());
  staying = sorted(std::move(staying));

  for (const BeadId b : Circle(corners_)) {
    if (is_in(staying, b)) continue;
    const std::size_t i = index_of(corners_, b), others = corners_.size() - 1;
    change_corners({leave, 3, {b, further(corners_, i, others), further(corners_, i, 1)}});
  }
  for (std::size_t k = 0; k < now.size(); ++k) {
    const BeadId b = further(now, start, k);
    if (is_in(staying, b)) continue;
    const BeadId before = corners_.empty() ? b : further(now, start, k - 1);
    const BeadId after = corners_.empty() ? b : further(corners_, index_of(corners_, before), 1);
    change_corners({enter, 3, {b, before, after}});
  }
}

void ConvexHull::change_corners(const Change& change) {
  apply(change);
  record(change);
}

void ConvexHull::apply(const Change& change) {
  if (apply_edit(change)) return;
  const auto [bead, before, after] = std::array{change.ids[0], change.ids[1], change.ids[2]};
  if (change.kind == interchange) {  // halves are not replayed; only check the beads
    present().require(bead, false);
    return present().require(before, false);
  }
  const std::size_t i = index_of(corners_, bead);
  const bool is_corner = i < corners_.size();
  if (is_corner != (change.kind == leave))
    throw std::invalid_argument(is_corner ? "the bead is a corner of the hull already"
                                          : "the bead is no corner of the hull");
  if (change.kind == enter) present().require(bead, false);
  if (change.kind == leave) {
    const std::size_t others = corners_.size() - 1;
    if (further(corners_, i, others) != before || further(corners_, i, 1) != after)
      throw std::invalid_argument("the bead does not lie between these corners of the hull");
    corners_.erase(corners_.begin() + static_cast<std::ptrdiff_t>(i));
  } else if (corners_.empty()) {
    corners_ = {bead};
  } else {
    const std::size_t k = index_of(corners_, before);
    if (k == corners_.size() || further(corners_, k, 1) != after)
      throw std::invalid_argument("these are not consecutive corners of the hull");
    corners_.insert(corners_.begin() + static_cast<std::ptrdiff_t>(k) + 1, bead);
  }
  begin_with_least(corners_);
}

// Edits: beads are inserted, erased, or change course.

void ConvexHull::edit(std::uint8_t kind, BeadId bead) {
  record(kind, {bead});
  present().set_absent(bead, kind == erases);
  for (HalfHull* half : {&lower_, &upper_}) kind == inserts ? half->insert(bead) : half->erase(bead);
  after_batch();
}

void ConvexHull::release(std::span<const BeadId> beads) {
  for (HalfHull* half : {&lower_, &upper_})
    for (const BeadId bead : beads)
      if (!is_absent(bead)) half->give_up(bead);
}

void ConvexHull::follow(std::span<const BeadId>) {
  for (HalfHull* half : {&lower_, &upper_}) half->hold_all();
  after_batch();
}

std::optional<std::string> ConvexHull::audit(const Dyadic& time) {
  std::vector<std::array<Rational, 3>> at;
  for (BeadId b = 0; b < bead_count(); ++b) at.push_back(exact_position(motion_.curves(), b, time));
  const auto order = [&](BeadId a, BeadId b) {
    const int in_x = cmp(at[a][0], at[b][0]);
    return in_x != 0 ? in_x : cmp(at[a][1], at[b][1]);
  };
  const auto turn = [&](BeadId a, BeadId b, BeadId c) {
    const Rational ahead = (at[b][0] - at[a][0]) * (at[c][1] - at[a][1]);
    return cmp(ahead, (at[b][1] - at[a][1]) * (at[c][0] - at[a][0]));
  };
  for (const BeadId corner : corners_)
    if (is_absent(corner)) return "corner " + std::to_string(corner) + " is absent";
  for (const BeadId corner : static_hull(present().all(), order, turn).circle()) {
    if (std::none_of(corners_.begin(), corners_.end(), [&](BeadId b) { return order(b, corner) == 0; }))
      return "bead " + std::to_string(corner) + " is a corner, but is not known as one";
  }
  // Corners must be in order around the first corner, without inward turns. At a time of ties, corners may
  // lie on edges.
  for (std::size_t i = 0; i < corners_.size(); ++i) {
    const BeadId b = corners_[i], next = further(corners_, i, 1);
    if (turn(b, next, further(corners_, i, 2)) < 0 || turn(corners_[0], b, next) < 0)
      return "the hull turns inwards at bead " + std::to_string(next);
  }
  return std::nullopt;
}

}  // namespace kds
