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
      balls_(motion, bonds_.first_beads),
      near_balls_(bonds_.pairs, motion.degree()),
      is_periodic_(is_periodic),
      shifted_(motion.degree()),
      orientation_(simulator, *this, index(), 0, points(), TouchPolicy::reported, whose()),
      sides_x_(simulator, *this, index(), 1, points(), TouchPolicy::reported, whose()),
      sides_y_(simulator, *this, index(), 2, points(), TouchPolicy::reported, whose()),
      sides_z_(simulator, *this, index(), 3, points(), TouchPolicy::reported, whose()),
      ends_(simulator, *this, index(), 4, points(), TouchPolicy::reported, whose()),
      test_(points(), simulator.kernel(), statistics.stages),
      per_bead_(statistics.certificates, motion.bead_count()) {}

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
  for (const ImagePairs* pairs : {&found_.unclear, &found_.overlapping})
    for (const ImagePair& image : *pairs)
      near_.push_back({image.pair, is_periodic_ ? found_shifts.shift(image.shift) : CellShift<3>{}, {}});
  std::sort(near_.begin(), near_.end());
  // Shifts are numbered in the order of the pairs, so that simultaneous events have the same order whatever
  // found the pairs.
  ShiftNumbers<3> shifts;
  if (is_periodic_) {
    for (const NearPair& near : near_) (void)shifts.number_of(near.shift);
    shifted_.set(motion_.curves(), shifts);
  }
  for (NearPair& near : near_) {
    const BeadId a = bonds_.first_beads[near.bonds.first], b = bonds_.first_beads[near.bonds.second];
    near.features = {ImpactKind::edge_edge, {a, a + 1, b, b + 1}, {a, a}};
    if (!is_periodic_) continue;
    const std::uint32_t number = shifts.number_of(near.shift);
    near.features.shift = {shifted_.to(number), shifted_.from(number)};
  }
}

int Crossings::orientation_now(const NearPair& near, const Instant& time) const {
  StageCounts stages;
  return orientation_.search().sign_now(simulator().kernel(), near.features.orientation(), time, stages);
}

int Crossings::sign_before(const NearPair& near) const {
  const auto found = std::lower_bound(before_.begin(), before_.end(), near);
  return found != before_.end() && !(near < *found) ? found->sign : 0;
}

void Crossings::start_step() {
  std::swap(near_, before_);
  find_pairs();
  for (std::uint32_t place = 0; place < near_.size(); ++place) {
    InterruptionCheck::ask();
    for (const BeadId bead : near_[place].features.points) per_bead_.add(bead);
    start(place);
  }
  for (BeadId bead = 0; bead < bead_count(); ++bead) per_bead_.reset(bead);
  has_step_before_ = true;
}

void Crossings::start(std::uint32_t place) {
  NearPair& near = near_[place];
  const Instant start(0.0);
  near.sign = orientation_.search().sign_just_after(simulator().kernel(), near.features.orientation(), start,
                                                    statistics.stages);
  const bool is_planar = near.sign == 0;
  if (has_step_before_ && orientation_now(near, start) == 0 && test_.meet(near.features, start)) {
    const int before = sign_before(near);
    if (is_planar && test_.meet(near.features, start, Moment::just_after)) {
      near.sign = before;
    } else {
      record_meeting(near, !is_planar && before == -near.sign);
    }
  }
  if (is_planar) {
    watch_in_plane(place);
  } else {
    watch(place, KnownAtStart::unknown);
  }
}

void Crossings::watch(std::uint32_t place, KnownAtStart birth) {
  (void)orientation_.watch(near_[place].features.orientation(near_[place].sign), place, birth);
}

void Crossings::watch_in_plane(std::uint32_t place) {
  const FeaturePair& features = near_[place].features;
  for (const FeaturePair::EdgeAndPoint& of : features.edges_and_points()) {
    const std::array side{of.a, of.b, of.a, of.point};
    watch_in_plane(sides_x_, features.cross<0>(side), place);
    watch_in_plane(sides_y_, features.cross<1>(side), place);
    watch_in_plane(sides_z_, features.cross<2>(side), place);
    watch_in_plane(ends_, features.beyond(of), place);
  }
}

template <class Certificate>
void Crossings::watch_in_plane(CertificateTable<Certificate>& table, Certificate certificate,
                               std::uint32_t place) {
  certificate.sign =
      table.search().sign_just_after(simulator().kernel(), certificate, simulator().now(), statistics.stages);
  if (certificate.sign != 0) (void)table.watch(certificate, place);
}

void Crossings::fail(unsigned table, std::uint32_t slot) {
  if (table == sides_x_.number()) return fail_in_plane(sides_x_, slot);
  if (table == sides_y_.number()) return fail_in_plane(sides_y_, slot);
  if (table == sides_z_.number()) return fail_in_plane(sides_z_, slot);
  if (table == ends_.number()) return fail_in_plane(ends_, slot);
  const std::uint32_t place = orientation_.place_in_structure(slot);
  const bool passes = !orientation_.touches(slot);
  NearPair& near = near_[place];
  if (passes) near.sign = -near.sign;
  if (test_.meet(near.features, simulator().now())) record_meeting(near, passes);
  watch(place, passes ? KnownAtStart::at_own_root : KnownAtStart::unknown);
}

// Several certificates of a pair may fail at one moment; the first one settles the pair.
template <class Certificate>
void Crossings::fail_in_plane(CertificateTable<Certificate>& table, std::uint32_t slot) {
  const std::uint32_t place = table.place_in_structure(slot);
  const bool passes = !table.touches(slot);
  Certificate certificate = table.certificate(slot);
  if (passes) certificate.sign = -certificate.sign;
  (void)table.watch(certificate, place, passes ? KnownAtStart::at_own_root : KnownAtStart::unknown);
  NearPair& near = near_[place];
  if (near.settled == simulator().moment()) return;
  near.settled = simulator().moment();
  const Instant& now = simulator().now();
  if (!test_.meet(near.features, now) || test_.meet(near.features, now, Moment::just_after)) return;
  near.sign = 0;
  record_meeting(near, false);
}

void Crossings::record_meeting(const NearPair& near, bool passes) {
  Kind kind = touch;
  if (passes) {
    const bool at_end = test_.meet_at_end(near.features, simulator().now());
    kind = near.sign > 0 ? (at_end ? end_plus : cross_plus) : (at_end ? end_minus : cross_minus);
  }
  const auto& [a, b, c, d] = near.features.points;
  record(kind, {a, b, c, d});
}

std::vector<BeadId> Crossings::state() const {
  std::vector<BeadId> state;
  const Instant end(1.0);
  for (const NearPair& near : near_) {
    if (orientation_now(near, end) != 0 || !test_.meet(near.features, end)) continue;
    state.insert(state.end(), {near.bonds.first, near.bonds.second, static_cast<BeadId>(near.sign)});
    for (const std::int32_t multiple : near.shift) state.push_back(static_cast<BeadId>(multiple));
  }
  return state;
}

// Checks a logged change. A crossing leaves no state.
void Crossings::apply(const Change& change) {
  const auto& [a, b, c, d] = std::array{change.ids[0], change.ids[1], change.ids[2], change.ids[3]};
  const auto is_bond = [&](BeadId first, BeadId second) {
    return second == first + 1 &&
           std::binary_search(bonds_.first_beads.begin(), bonds_.first_beads.end(), first);
  };
  if (change.size != 4 || !is_bond(a, b) || !is_bond(c, d) || !(b < c))
    throw std::invalid_argument("a change of crossings does not name two bonds that share no bead");
}

// Checks that each near pair of bonds is known, and has the right sign.
std::optional<std::string> Crossings::audit(const Dyadic& time) {
  if (!has_step_before_ || bonds_.first_beads.empty()) return std::nullopt;  // a replay has no near pairs
  std::optional<std::string> fault;
  const auto look_at = [&](BeadId first, BeadId second, const CellShift<3>& shift) {
    if (fault || !bonds_.pairs.asks({first, second})) return;
    const NearPair wanted{{first, second}, shift, {}};
    const auto found = std::lower_bound(near_.begin(), near_.end(), wanted);
    const BeadId a = bonds_.first_beads[first], b = bonds_.first_beads[second];
    if (found == near_.end() || wanted < *found) {
      fault = fmt::format("bonds {}-{} and {}-{} are near, but not watched", a, a + 1, b, b + 1);
      return;
    }
    const int sign = orientation_.search().sign_at(found->features.orientation(), time);
    if (sign * found->sign < 0)
      fault = fmt::format("bonds {}-{} and {}-{} have orientation {}, but are known with {}", a, a + 1, b,
                          b + 1, sign, found->sign);
  };
  const Curves<3> balls(balls_);
  const double u = time.round_down();
  if (is_periodic_) {
    const LaidImages<3> laid(balls, u);
    laid.visit_near([&](BeadId a, BeadId b, const CellShift<3>& shift, double gap) {
      if (gap < 0 && laid.is_clear(gap)) look_at(a, b, shift);
    });
  } else {
    const Eigen::Matrix3Xd centers = approximate_positions(balls, u);
    const std::vector<double> radii = approximate_radii(balls, u);
    visit_near_pairs(centers, radii, [&](BeadId a, BeadId b) {
      if ((centers.col(a) - centers.col(b)).stableNorm() < 0.999 * (radii[a] + radii[b])) look_at(a, b, {});
    });
  }
  return fault;
}

}  // namespace kds
