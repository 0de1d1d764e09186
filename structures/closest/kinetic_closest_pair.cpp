#include "structures/closest/kinetic_closest_pair.h"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "motions/curves/positions.h"
#include "structures/closest/candidate_pairs.h"

namespace kds {

template <int Dimension>
KineticClosestPair<Dimension>::KineticClosestPair(Simulator& simulator, const MotionRef<Dimension>& motion)
    : simulator_(simulator),
      motion_(motion),
      index_(simulator.add(*this)),
      table_(simulator, *this, index_, 0, motion),
      tournament_(table_, Ahead{&candidates_}) {}

template <int Dimension>
std::span<const EventKind> KineticClosestPair<Dimension>::kinds() const {
  static constexpr std::array<IdRole, 2> was_is{{{"was", 2}, {"is", 2}}};
  static constexpr std::array<EventKind, 2> kinds{
      {{"overtake", false, false, was_is}, {"replace", true, false, was_is}}};
  return kinds;
}

template <int Dimension>
void KineticClosestPair<Dimension>::build() {
  pair_.reset();
  for (const Pair& pair : candidate_pairs(motion_.curves())) {
    if (!pair_ || table_.search().sign_just_after(simulator_.kernel(), {pair, *pair_}, Instant(0),
                                                  statistics.stages) > 0)
      pair_ = pair;
  }
}

template <int Dimension>
void KineticClosestPair<Dimension>::start_step() {
  candidates_ = candidate_pairs(motion_.curves());
  tournament_.start(static_cast<std::uint32_t>(candidates_.size()));
  needs_after_batch = true;
  std::vector<std::uint32_t> certificates_of(motion_.bead_count(), 0);
  auto& most = statistics.certificates.per_bead_max;
  tournament_.each_contest([&](std::uint32_t a, std::uint32_t b) {
    for (const Pair& pair : {candidates_[a], candidates_[b]})
      for (const BeadId bead : pair) most = std::max<std::uint64_t>(most, ++certificates_of[bead]);
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
    simulator_.record(index_, Change{overtake, 4, {behind[0], behind[1], ahead[0], ahead[1]}});
  }
}

template <int Dimension>
void KineticClosestPair<Dimension>::after_batch() {
  if (!pair_) return;
  const Pair before = *pair_, now = candidates_[tournament_.winner()];
  if (now == before) return;
  pair_ = now;
  simulator_.record(index_, Change{replace, 4, {before[0], before[1], now[0], now[1]}});
}

template <int Dimension>
void KineticClosestPair<Dimension>::apply(const Change& change) {
  const Pair before{change.ids[0], change.ids[1]}, now{change.ids[2], change.ids[3]};
  for (const Pair& pair : {before, now})
    if (pair[0] >= pair[1] || pair[1] >= motion_.bead_count())
      throw std::invalid_argument("there is no such pair of beads");
  if (change.kind == overtake) return;  // the tournament is not replayed, only what it tells
  if (pair_ != before) throw std::invalid_argument("the first pair is not the closest");
  pair_ = now;
}

template <int Dimension>
std::optional<std::string> KineticClosestPair<Dimension>::audit(const Dyadic& time) {
  if (!pair_) return std::nullopt;
  std::vector<decltype(exact_position(motion_.curves(), 0, time))> at;
  for (BeadId b = 0; b < motion_.bead_count(); ++b) at.push_back(exact_position(motion_.curves(), b, time));
  const auto square = [&](BeadId a, BeadId b, std::size_t axes) {
    Rational sum = 0;
    for (std::size_t axis = 0; axis < axes; ++axis)
      sum += (at[b][axis] - at[a][axis]) * (at[b][axis] - at[a][axis]);
    return sum;
  };
  const Rational least = square((*pair_)[0], (*pair_)[1], Dimension);
  std::vector<BeadId> sorted(at.size());
  for (BeadId b = 0; b < sorted.size(); ++b) sorted[b] = b;
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
