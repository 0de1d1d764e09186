#include "structures/closest/kinetic_closest_pair.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>
#include <utility>

#include "motions/curves/positions.h"
#include "structures/closest/candidate_pairs.h"
#include "structures/images/laid_images.h"

namespace kds {

namespace {

constexpr std::array<BeadId, 2> no_pair{no_bead, no_bead};

constexpr std::array<IdRole, 2> pair_was_is{{{"was", 2}, {"is", 2}}};
constexpr auto pair_kinds = with_edits(std::array{EventKind{"overtake", false, false, pair_was_is},
                                                  EventKind{"replace", true, false, pair_was_is}});
static_assert(pair_kinds.size() == KineticClosestPair<2>::changes + 1);

}  // namespace

template <int Dimension>
KineticClosestPair<Dimension>::KineticClosestPair(Simulator& simulator, const MotionRef<Dimension>& motion)
    : EditableBase(simulator, motion.bead_count(), "closest", pair_kinds),
      motion_(motion),
      shifted_(motion.degree()),
      table_(simulator, *this, index(), 0, MotionRef<Dimension>(shifted_)),
      tournament_(table_, Ahead{this}) {}

template <int Dimension>
std::vector<ImagePair> KineticClosestPair<Dimension>::find_candidates(std::span<const char> absent) {
  const Curves<Dimension> curves = motion_.curves();
  std::vector<ImagePair> candidates;
  if (curves.cell() != nullptr) {
    candidates = candidate_images(curves, shifts_, absent);
  } else {
    for (const Pair& pair : candidate_pairs(curves, absent)) candidates.push_back({{pair[0], pair[1]}});
  }
  shifted_.set(curves, shifts_);
  return candidates;
}

template <int Dimension>
Closer::Pair KineticClosestPair<Dimension>::shifted_pair(const ImagePair& image) const {
  Closer::Pair pair{{image.pair.first, image.pair.second}};
  if (image.shift != 0) pair.shift = {shifted_.to(image.shift), shifted_.from(image.shift)};
  return pair;
}

template <int Dimension>
void KineticClosestPair<Dimension>::build() {
  present().structure_is_built();
  pair_.reset();
  Closer::Pair closest;
  for (const ImagePair& image : find_candidates(present().absent())) {
    const Closer::Pair pair = shifted_pair(image);
    if (pair_ && table_.search().sign_just_after(simulator().kernel(), {pair, closest}, Instant(0),
                                                 statistics.stages) <= 0)
      continue;
    pair_ = pair.beads;
    closest = pair;
  }
}

template <int Dimension>
void KineticClosestPair<Dimension>::start_step() {
  shifts_ = {};
  candidates_ = find_candidates(present().absent());
  tournament_.start(static_cast<std::uint32_t>(candidates_.size()));
  needs_after_batch = true;
  count_certificates();
}

template <int Dimension>
void KineticClosestPair<Dimension>::count_certificates() {
  CertificatesPerBead per_bead(statistics.certificates, bead_count());
  tournament_.each_contest([&](std::uint32_t a, std::uint32_t b) {
    for (const ImagePair& image : {candidates_[a], candidates_[b]})
      for (const BeadId bead : {image.pair.first, image.pair.second}) per_bead.add(bead);
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
    const BeadPair &behind = candidates_[contest.winner].pair, &ahead = candidates_[contest.loser].pair;
    if (behind != ahead) record(overtake, {behind.first, behind.second, ahead.first, ahead.second});
  }
}

template <int Dimension>
void KineticClosestPair<Dimension>::after_batch() {
  const std::optional<Pair> before = pair_;
  pair_.reset();
  if (!candidates_.empty()) {
    const BeadPair& winner = candidates_[tournament_.winner()].pair;
    pair_ = {winner.first, winner.second};
  }
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
  std::vector<ImagePair> candidates = find_candidates(present.absent());
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
  start_among(find_candidates(present().absent()));
}

template <int Dimension>
void KineticClosestPair<Dimension>::start_among(std::vector<ImagePair> candidates) {
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
  if (motion_.curves().cell() != nullptr) return fault_of_images(time);
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

// All images that are about as near as the nearest of the known pair are compared with it exactly.
template <int Dimension>
std::optional<std::string> KineticClosestPair<Dimension>::fault_of_images(const Dyadic& time) {
  const Curves<Dimension> curves = motion_.curves();
  const LaidImages<Dimension> beads(curves, time.round_down(), std::vector<double>(bead_count(), 0));
  const double reach = beads.distance((*pair_)[0], (*pair_)[1]);
  const LaidImages<Dimension> laid(curves, time.round_down(),
                                   std::vector<double>(bead_count(), 0.5 * reach + 4 * beads.spare()));
  std::vector<ImagePair> near;
  laid.visit_near([&](BeadId a, BeadId b, const CellShift<Dimension>& shift, double gap) {
    if (gap > 0 || is_absent(a) || is_absent(b)) return;
    near.push_back({{a, b}, shifts_.number_of(shift)});
  });
  shifted_.set(curves, shifts_);
  const auto is_closer = [&](const ImagePair& one, const ImagePair& other) {
    return one != other && table_.search().sign_at({shifted_pair(one), shifted_pair(other)}, time) > 0;
  };
  std::optional<ImagePair> known, closest;
  for (const ImagePair& image : near) {
    if (!closest || is_closer(image, *closest)) closest = image;
    if (image.pair != BeadPair{(*pair_)[0], (*pair_)[1]}) continue;
    if (!known || is_closer(image, *known)) known = image;
  }
  if (known && !is_closer(*closest, *known)) return std::nullopt;
  return fmt::format("images of beads {} and {} are closer than those of beads {} and {}",
                     closest->pair.first, closest->pair.second, (*pair_)[0], (*pair_)[1]);
}

template class KineticClosestPair<2>;
template class KineticClosestPair<3>;

}  // namespace kds
