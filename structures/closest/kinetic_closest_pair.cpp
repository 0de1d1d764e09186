#include "structures/closest/kinetic_closest_pair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"

namespace kds {

namespace {

constexpr std::size_t most_pairs = 100'000'000;
constexpr double more = 1 + 0x1p-40;  // factor above all roundings of a difference and a sum of three

/// The range of a bead's coordinate during the step.
struct Extent {
  double low, high;
  BeadId bead;
};

template <int Dimension>
std::vector<Extent> extents(const Curves<Dimension>& curves, std::span<const char> absent, int axis) {
  std::vector<Extent> all;
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    if (b < absent.size() && absent[b] != 0) continue;
    Extent extent{curves.coordinate(b, 0, axis), curves.coordinate(b, 0, axis), b};
    for (int k = 1; k <= curves.own_degree(); ++k) {
      extent.low = std::min(extent.low, curves.coordinate(b, k, axis));
      extent.high = std::max(extent.high, curves.coordinate(b, k, axis));
    }
    all.push_back(extent);
  }
  std::sort(all.begin(), all.end(), [](const Extent& a, const Extent& b) {
    return a.low != b.low ? a.low < b.low : a.bead < b.bead;
  });
  return all;
}

/// Returns the extents along the axis on which they reach farthest, where the fewest beads are level.
template <int Dimension>
std::vector<Extent> widest_extents(const Curves<Dimension>& curves, std::span<const char> absent) {
  std::vector<Extent> widest = extents(curves, absent, 0);
  if (widest.empty()) return widest;
  const auto width = [](const std::vector<Extent>& e) { return e.back().low - e.front().low; };
  for (int axis = 1; axis < Dimension; ++axis) {
    std::vector<Extent> other = extents(curves, absent, axis);
    if (width(other) > width(widest)) widest = std::move(other);
  }
  return widest;
}

/// Bounds of the distance of two beads throughout the step, up to rounding. The lower bound is the least
/// distance along the axis for which it is largest; the upper bound is the largest sum of the distances along
/// all axes. Squares are avoided because they might underflow.
struct Distance {
  double least = 0, most = 0;
};
template <int Dimension>
Distance distance(const Curves<Dimension>& curves, BeadId a, BeadId b) {
  std::array<double, Dimension> low, high;
  low.fill(std::numeric_limits<double>::infinity());
  high.fill(-std::numeric_limits<double>::infinity());
  Distance distance;
  for (int k = 0; k <= curves.own_degree(); ++k) {
    double way = 0;
    for (int axis = 0; axis < Dimension; ++axis) {
      const double d = curves.coordinate(b, k, axis) - curves.coordinate(a, k, axis);
      const auto i = static_cast<std::size_t>(axis);
      low[i] = std::min(low[i], d);
      high[i] = std::max(high[i], d);
      way += std::abs(d);
    }
    distance.most = std::max(distance.most, way);
  }
  for (std::size_t i = 0; i < Dimension; ++i) distance.least = std::max({distance.least, low[i], -high[i]});
  return distance;
}

constexpr std::array<BeadId, 2> no_pair{no_bead, no_bead};

constexpr std::array<IdRole, 2> pair_was_is{{{"was", 2}, {"is", 2}}};
constexpr auto pair_kinds = with_edits(std::array{EventKind{"overtake", false, false, pair_was_is},
                                                  EventKind{"replace", true, false, pair_was_is}});
static_assert(pair_kinds.size() == KineticClosestPair<2>::changes + 1);

}  // namespace

template <int Dimension>
std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<Dimension>& curves,
                                                   std::span<const char> absent) {
  const std::vector<Extent> sorted = widest_extents(curves, absent);
  double limit = std::numeric_limits<double>::infinity();
  // Visits all pairs whose extents are at most `limit` apart; `limit` may shrink meanwhile.
  const auto each_near_pair = [&](auto visit) {
    for (std::size_t i = 0; i < sorted.size(); ++i)
      for (std::size_t j = i + 1; j < sorted.size() && sorted[j].low - sorted[i].high <= limit; ++j)
        visit(sorted[i].bead, sorted[j].bead);
  };
  each_near_pair([&](BeadId a, BeadId b) { limit = std::min(limit, distance(curves, a, b).most * more); });
  limit *= more;
  std::vector<std::array<BeadId, 2>> pairs;
  each_near_pair([&](BeadId a, BeadId b) {
    if (distance(curves, a, b).least > limit) return;
    if (pairs.size() == most_pairs)
      throw InputError("closest: more than " + std::to_string(most_pairs) +
                       " pairs of beads may be the closest in one step; expected fewer beads, or shorter "
                       "steps");
    pairs.push_back({std::min(a, b), std::max(a, b)});
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<2>&, std::span<const char>);
template std::vector<std::array<BeadId, 2>> candidate_pairs(const Curves<3>&, std::span<const char>);

template <int Dimension>
KineticClosestPair<Dimension>::KineticClosestPair(Simulator& simulator, const MotionRef<Dimension>& motion)
    : EditableBase(simulator, motion.bead_count(), "closest", pair_kinds),
      motion_(motion),
      table_(simulator, *this, index(), 0, motion),
      tournament_(table_, Ahead{&candidates_}) {}

template <int Dimension>
void KineticClosestPair<Dimension>::build() {
  present().structure_is_built();
  pair_.reset();
  for (const Pair& pair : candidate_pairs(motion_.curves(), present().absent())) {
    if (!pair_ || table_.search().sign_just_after(simulator().kernel(), {pair, *pair_}, Instant(0),
                                                  statistics.stages) > 0)
      pair_ = pair;
  }
}

template <int Dimension>
void KineticClosestPair<Dimension>::start_step() {
  candidates_ = candidate_pairs(motion_.curves(), present().absent());
  tournament_.start(static_cast<std::uint32_t>(candidates_.size()));
  needs_after_batch = true;
  count_certificates();
}

template <int Dimension>
void KineticClosestPair<Dimension>::count_certificates() {
  CertificatesPerBead per_bead(statistics.certificates, bead_count());
  tournament_.each_contest([&](std::uint32_t a, std::uint32_t b) {
    for (const Pair& pair : {candidates_[a], candidates_[b]})
      for (const BeadId bead : pair) per_bead.add(bead);
  });
}

template <int Dimension>
void KineticClosestPair<Dimension>::fail(unsigned, std::uint32_t slot) {
  const std::uint32_t place = table_.place_in_structure(slot);
  const auto contest = tournament_.contest(place);
  const std::uint32_t closest = tournament_.winner();
  tournament_.fail(place);
  if (tournament_.winner() != closest) {
    needs_after_batch = true;
  } else {
    const Pair &behind = candidates_[contest.winner], &ahead = candidates_[contest.loser];
    record(overtake, {behind[0], behind[1], ahead[0], ahead[1]});
  }
}

template <int Dimension>
void KineticClosestPair<Dimension>::after_batch() {
  const std::optional<Pair> before = pair_;
  pair_.reset();
  if (!candidates_.empty()) pair_ = candidates_[tournament_.winner()];
  if (pair_ == before) return;
  const auto [i, j] = before.value_or(no_pair);
  const auto [k, l] = pair_.value_or(no_pair);
  record(replace, {i, j, k, l});
}

template <int Dimension>
void KineticClosestPair<Dimension>::apply(const Change& change) {
  if (apply_edit(change)) return;
  const Pair before{change.ids[0], change.ids[1]}, now{change.ids[2], change.ids[3]};
  const auto require_pair = [this](const Pair& pair) {
    if (pair[0] >= pair[1]) throw std::invalid_argument("there is no such pair of beads");
    for (const BeadId bead : pair) present().require(bead, false);
  };
  if (change.kind == overtake) {  // the tournament is not replayed; only check the beads
    require_pair(before);
    return require_pair(now);
  }
  if (pair_.value_or(no_pair) != before) throw std::invalid_argument("the first pair is not the closest");
  const bool none = now == no_pair && present().count() < 2;
  if (!none) require_pair(now);
  pair_ = none ? std::nullopt : std::optional(now);
}

// Edits: beads are inserted, erased, or change course.

template <int Dimension>
void KineticClosestPair<Dimension>::edit(std::uint8_t kind, BeadId bead) {
  PresentBeads present = this->present();
  present.set_absent(bead, kind == erases);
  std::vector<Pair> candidates = candidate_pairs(motion_.curves(), present.absent());
  this->present() = std::move(present);
  record(kind, {bead});
  if (candidates == candidates_) return;
  tournament_.give_up_all();
  start_among(std::move(candidates));
}

template <int Dimension>
void KineticClosestPair<Dimension>::release(std::span<const BeadId>) {
  tournament_.give_up_all();
}

template <int Dimension>
void KineticClosestPair<Dimension>::follow(std::span<const BeadId>) {
  start_among(candidate_pairs(motion_.curves(), present().absent()));
}

template <int Dimension>
void KineticClosestPair<Dimension>::start_among(std::vector<Pair> candidates) {
  candidates_ = std::move(candidates);
  tournament_.start(static_cast<std::uint32_t>(candidates_.size()));
  after_batch();
}

template <int Dimension>
std::optional<std::string> KineticClosestPair<Dimension>::audit(const Dyadic& time) {
  if (!pair_ && present().count() > 1) return "no pair is known as the closest";
  if (!pair_) return std::nullopt;
  for (const BeadId bead : *pair_)
    if (is_absent(bead)) return "bead " + std::to_string(bead) + " of the closest pair is absent";
  std::vector<decltype(exact_position(motion_.curves(), 0, time))> at;
  for (BeadId b = 0; b < bead_count(); ++b) at.push_back(exact_position(motion_.curves(), b, time));
  const auto square = [&](BeadId a, BeadId b, std::size_t axes) {
    Rational sum = 0;
    for (std::size_t axis = 0; axis < axes; ++axis)
      sum += (at[b][axis] - at[a][axis]) * (at[b][axis] - at[a][axis]);
    return sum;
  };
  const Rational least = square((*pair_)[0], (*pair_)[1], Dimension);
  std::vector<BeadId> sorted = present().all();
  std::sort(sorted.begin(), sorted.end(), [&](BeadId a, BeadId b) { return at[a][0] < at[b][0]; });
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    for (std::size_t j = i + 1; j < sorted.size() && square(sorted[i], sorted[j], 1) < least; ++j) {
      if (square(sorted[i], sorted[j], Dimension) < least)
        return "beads " + std::to_string(sorted[i]) + " and " + std::to_string(sorted[j]) +
               " are closer than beads " + std::to_string((*pair_)[0]) + " and " +
               std::to_string((*pair_)[1]);
    }
  }
  return std::nullopt;
}

template class KineticClosestPair<2>;
template class KineticClosestPair<3>;

}  // namespace kds
