#include "structures/crossings/crossings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

#include "motions/base/interruption.h"
#include "motions/curves/positions.h"
#include "motions/scene/near_pairs.h"
#include "structures/images/laid_images.h"

namespace kds {

namespace {

constexpr std::array<IdRole, 2> bond_roles{{{"first", 2}, {"second", 2}}};
constexpr std::array<EventKind, 5> crossing_kinds{{{"cross_plus", true, false, bond_roles},
                                                   {"cross_minus", true, false, bond_roles},
                                                   {"end_plus", true, false, bond_roles},
                                                   {"end_minus", true, false, bond_roles},
                                                   {"touch", true, false, bond_roles}}};

}  // namespace

Crossings::Crossings(Simulator& simulator, const MotionRef<3>& motion, ChainBonds bonds, bool is_periodic)
    : StructureBase(simulator, motion.bead_count(), "crossings", crossing_kinds),
      motion_(motion),
      bonds_(std::move(bonds)),
      balls_(motion, bonds_.first),
      near_balls_(bonds_.pairs, motion.degree()),
      is_periodic_(is_periodic),
      shifted_(motion.degree()),
      orientation_(simulator, *this, index(), 0, is_periodic ? MotionRef<3>(shifted_) : motion,
                   TouchPolicy::reported, is_periodic ? TableMotion::of_structure : TableMotion::of_run),
      test_(is_periodic ? MotionRef<3>(shifted_) : motion, simulator.kernel(), statistics.stages) {}

void Crossings::build() {
  near_.clear();
  has_step_before_ = false;
  near_balls_.forget_rest();
}

void Crossings::find_pairs() {
  balls_.move_to_step();
  ShiftNumbers<3> found_shifts;
  near_balls_.find(Curves<3>(balls_), simulator().kernel(), NearBalls<3>::Resting::looked_at, true,
                   found_shifts, found_);
  orientation_.hold_never(found_.proved);
  near_.clear();
  for (const std::vector<ImagePair>* pairs : {&found_.unclear, &found_.overlapping})
    for (const ImagePair& image : *pairs)
      near_.push_back({image.pair, is_periodic_ ? found_shifts.shift(image.shift) : Shift{}, {}});
  std::sort(near_.begin(), near_.end());
  // Shifts are numbered in the order of the pairs, so that simultaneous events have the same order whatever
  // found the pairs.
  ShiftNumbers<3> shifts;
  if (is_periodic_) {
    for (const NearPair& near : near_) (void)shifts.number_of(near.shift);
    shifted_.set(motion_.curves(), shifts);
  }
  for (NearPair& near : near_) {
    const BeadId a = bonds_.first[near.bonds.first], b = bonds_.first[near.bonds.second];
    near.pair = {ImpactKind::edge_edge, {a, a + 1, b, b + 1}, {a, a}};
    if (!is_periodic_) continue;
    const std::uint32_t number = shifts.number_of(near.shift);
    near.pair.shift = {shifted_.to(number), shifted_.from(number)};
  }
}

int Crossings::sign_now(const NearPair& near, const Instant& time) const {
  StageCounts stages;
  return orientation_.search().sign_now(simulator().kernel(), near.pair.orientation(1), time, stages);
}

int Crossings::sign_before(const NearPair& pair) const {
  const auto found = std::lower_bound(before_.begin(), before_.end(), pair);
  return found != before_.end() && !(pair < *found) ? found->sign : 0;
}

void Crossings::start_step() {
  std::swap(near_, before_);
  find_pairs();
  for (std::uint32_t place = 0; place < near_.size(); ++place) {
    InterruptionCheck::ask();
    start(place);
  }
  has_step_before_ = true;
}

void Crossings::start(std::uint32_t place) {
  NearPair& near = near_[place];
  const Instant start(0.0);
  near.sign = orientation_.search().sign_just_after(simulator().kernel(), near.pair.orientation(1), start,
                                                    statistics.stages);
  if (has_step_before_ && sign_now(near, start) == 0 && test_.meet(near.pair, start)) {
    const int before = sign_before(near);
    if (near.sign != 0) {
      record_meeting(near, before == -near.sign);
    } else if (before != 0 && test_.meet_throughout(near.pair)) {
      near.sign = before;  // compared when they leave the plane
      return;
    }
  }
  if (near.sign != 0) watch(place, KnownAtStart::unknown);
}

void Crossings::watch(std::uint32_t place, KnownAtStart birth) {
  (void)orientation_.watch(near_[place].pair.orientation(near_[place].sign), place, birth);
}

void Crossings::fail(unsigned, std::uint32_t slot) {
  const std::uint32_t place = orientation_.place_in_structure(slot);
  const bool passes = !orientation_.touches(slot);
  NearPair& near = near_[place];
  if (passes) near.sign = -near.sign;
  if (test_.meet(near.pair, simulator().now())) record_meeting(near, passes);
  watch(place, passes ? KnownAtStart::at_own_root : KnownAtStart::unknown);
}

void Crossings::record_meeting(const NearPair& near, bool passes) {
  Kind kind = touch;
  if (passes) {
    const bool at_end = test_.meet_at_end(near.pair, simulator().now());
    kind = near.sign > 0 ? (at_end ? end_plus : cross_plus) : (at_end ? end_minus : cross_minus);
  }
  const auto& [a, b, c, d] = near.pair.points;
  record(kind, {a, b, c, d});
}

std::vector<BeadId> Crossings::state() const {
  std::vector<BeadId> state;
  for (const NearPair& near : near_) {
    if (sign_now(near, Instant(1.0)) != 0 || !test_.meet(near.pair, Instant(1.0))) continue;
    state.insert(state.end(), {near.bonds.first, near.bonds.second, static_cast<BeadId>(near.sign)});
    for (const std::int32_t multiple : near.shift) state.push_back(static_cast<BeadId>(multiple));
  }
  return state;
}

// Crossings are moments, so nothing is left of a change.
void Crossings::apply(const Change& change) {
  const auto& [a, b, c, d] = std::array{change.ids[0], change.ids[1], change.ids[2], change.ids[3]};
  const auto is_bond = [&](BeadId first, BeadId second) {
    return second == first + 1 && std::binary_search(bonds_.first.begin(), bonds_.first.end(), first);
  };
  if (change.size != 4 || !is_bond(a, b) || !is_bond(c, d) || !(b < c))
    throw std::invalid_argument("a change of crossings does not name two bonds that share no bead");
}

// Checks the signs of all pairs of bonds that are near at this time, which must be known as such.
std::optional<std::string> Crossings::audit(const Dyadic& time) {
  const bool at_end = time == Dyadic(0.0) || time == Dyadic(1.0);
  std::optional<std::string> fault;
  const auto look_at = [&](BeadId first, BeadId second, const Shift& shift) {
    const BeadPair bonds{std::min(first, second), std::max(first, second)};
    if (fault || at_end || !bonds_.pairs.asks(bonds)) return;
    const NearPair wanted{bonds, shift, {}};
    const auto found = std::lower_bound(near_.begin(), near_.end(), wanted);
    const BeadId a = bonds_.first[bonds.first], b = bonds_.first[bonds.second];
    if (found == near_.end() || wanted < *found) {
      fault = fmt::format("bonds {}-{} and {}-{} are near, but not watched", a, a + 1, b, b + 1);
      return;
    }
    const int sign = orientation_.search().sign_at(found->pair.orientation(1), time);
    if (sign * found->sign < 0)
      fault = fmt::format("bonds {}-{} and {}-{} have orientation {}, but are known with {}", a, a + 1, b,
                          b + 1, sign, found->sign);
  };
  if (bonds_.first.empty()) return std::nullopt;
  const Curves<3> balls(balls_);
  const double u = time.round_down();
  if (is_periodic_) {
    const LaidImages<3> laid(balls, u);
    laid.visit_near([&](BeadId a, BeadId b, const Shift& shift, double gap) {
      if (gap < 0 && laid.is_clear(gap)) look_at(a, b, shift);
    });
  } else {
    const Eigen::Matrix3Xd centers = approximate_positions(balls, u);
    const std::vector<double> radii = approximate_radii(balls, u);
    visit_near_pairs(centers, radii, [&](BeadId a, BeadId b) {
      if ((centers.col(a) - centers.col(b)).norm() < 0.999 * (radii[a] + radii[b])) look_at(a, b, {});
    });
  }
  return fault;
}

}  // namespace kds
