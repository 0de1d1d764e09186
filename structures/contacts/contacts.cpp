#include "structures/contacts/contacts.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "structures/contacts/contact_audit.h"

namespace kds {

namespace {

Contact disjoint(const BeadPair& pair) { return {{pair.first, pair.second}, 1}; }
Contact overlapping(const BeadPair& pair) { return {{pair.first, pair.second}, -1}; }

}  // namespace

template <int D>
Contacts<D>::Contacts(Simulator& simulator, const MotionRef<D>& motion, PairsAsked asked)
    : simulator_(simulator),
      motion_(motion),
      index_(simulator.add(*this)),
      family_(std::move(asked), motion.degree()),
      disjoint_(simulator, *this, index_, 0, motion, TouchPolicy::reported),
      overlapping_(simulator, *this, index_, 1, motion) {}

template <int D>
std::span<const EventKind> Contacts<D>::kinds() const {
  static constexpr std::array<EventKind, 3> kinds{{{"begin"}, {"end"}, {"touch"}}};
  return kinds;
}

template <int D>
void Contacts<D>::find_pairs(typename MovingFamily<D>::Resting resting, bool list_overlapping) {
  if (simulator_.kernel() != Kernel::exact)
    return family_.find_pairs(motion_.curves(), resting, list_overlapping, pairs_);
  pairs_.clear();
  const PairsAsked& asked = family_.asked();
  const auto beads = static_cast<BeadId>(motion_.bead_count());
  for (BeadId i = 0; i < beads; ++i)
    for (BeadId j = i + 1; j < beads; ++j)
      if (asked.asks({i, j})) pairs_.unclear.push_back({i, j});
  pairs_.looked_at = pairs_.unclear.size();
}

template <int D>
void Contacts<D>::build() {
  contacts_.clear();
  family_.forget_rest();
  find_pairs(MovingFamily<D>::Resting::looked_at, true);
  for (const BeadPair& pair : pairs_.overlapping) contacts_.insert(pair);
  const Instant start(0.0);
  for (const BeadPair& pair : pairs_.unclear) {
    const int sign =
        disjoint_.search().sign_just_after(simulator_.kernel(), disjoint(pair), start, statistics.stages);
    if (sign <= 0) contacts_.insert(pair);
  }
}

template <int D>
void Contacts<D>::start_step() {
  find_pairs(MovingFamily<D>::Resting::left_out, false);
  disjoint_.hold_never(family_.size() + pairs_.looked_at - pairs_.unclear.size());
  for (std::uint32_t place = 0; place < pairs_.unclear.size(); ++place) {
    const BeadPair& pair = pair_at(place);
    if (contacts_.contains(pair)) {
      overlapping_.one_of_many(place, KnownAtStart::unknown) = overlapping(pair);
    } else {
      disjoint_.one_of_many(place, KnownAtStart::unknown) = disjoint(pair);
    }
  }
  at_frame_.clear();
  const Curves<D> curves = motion_.curves();
  disjoint_.watch_enqueued([&](std::uint32_t place, CertificateHandle handle) {
    const BeadPair& pair = pair_at(place);
    if (handle == CertificateHandle::violated || handle == CertificateHandle::zero) {
      at_frame_.push_back({pair, begin, handle == CertificateHandle::violated ? place : no_place});
    } else if (is_zero_at_start(curves, pair)) {
      at_frame_.push_back({pair, touch, no_place});
    }
  });
  overlapping_.watch_enqueued([&](std::uint32_t place, CertificateHandle handle) {
    if (handle == CertificateHandle::violated) at_frame_.push_back({pair_at(place), end, place});
  });
  if (!at_frame_.empty()) settle_frame();
  count_per_bead();
}

// What happens at the frame itself, in the order of the beads as all that happens at one time; then the
// certificates of the pairs that changed.
template <int D>
void Contacts<D>::settle_frame() {
  std::sort(at_frame_.begin(), at_frame_.end());
  for (const AtFrame& event : at_frame_) {
    record(event.kind, event.pair);
    if (event.place == no_place) continue;
    if (event.kind == begin) {
      (void)overlapping_.watch(overlapping(event.pair), event.place);
    } else {
      (void)disjoint_.watch(disjoint(event.pair), event.place);
    }
  }
}

template <int D>
void Contacts<D>::fail(unsigned table, std::uint32_t slot) {
  const bool ends = table == overlapping_.number();
  const std::uint32_t place = (ends ? overlapping_ : disjoint_).place_in_structure(slot);
  const BeadPair pair = pair_at(place);
  if (ends) {
    record(end, pair);
    (void)disjoint_.watch(disjoint(pair), place, KnownAtStart::at_own_root);
  } else if (disjoint_.touches(slot)) {
    record(touch, pair);
    (void)disjoint_.watch(disjoint(pair), place);
  } else {
    record(begin, pair);
    (void)overlapping_.watch(overlapping(pair), place, KnownAtStart::at_own_root);
  }
}

template <int D>
void Contacts<D>::record(Kind kind, const BeadPair& pair) {
  if (kind == begin) contacts_.insert(pair);
  if (kind == end) contacts_.erase(pair);
  simulator_.record(index_, {kind, 2, {pair.first, pair.second}});
}

// In double where that is certain: the sum errs by less than 2^-48 of its parts, unless these underflow.
template <int D>
bool Contacts<D>::is_zero_at_start(const Curves<D>& curves, const BeadPair& pair) {
  const double reach = curves.radius(pair.first, 0) + curves.radius(pair.second, 0);
  double distance = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double d = curves.coordinate(pair.second, 0, axis) - curves.coordinate(pair.first, 0, axis);
    distance += d * d;
  }
  const double size = distance + reach * reach;
  if (simulator_.kernel() != Kernel::exact && size > 0x1p-900 &&
      std::abs(distance - reach * reach) > 0x1p-48 * size)
    return false;
  return disjoint_.search().sign_now(simulator_.kernel(), disjoint(pair), Instant(0.0), statistics.stages) ==
         0;
}

template <int D>
void Contacts<D>::count_per_bead() {
  certificates_of_bead_.resize(motion_.bead_count());
  std::uint64_t& most = statistics.certificates.per_bead_max;
  for (const BeadPair& pair : pairs_.unclear) {
    most = std::max<std::uint64_t>(most, ++certificates_of_bead_[pair.first]);
    most = std::max<std::uint64_t>(most, ++certificates_of_bead_[pair.second]);
  }
  for (const BeadPair& pair : pairs_.unclear)
    certificates_of_bead_[pair.first] = certificates_of_bead_[pair.second] = 0;
}

template <int D>
void Contacts<D>::apply(const Change& change) {
  const BeadPair pair{change.ids[0], change.ids[1]};
  if (!(pair.first < pair.second && pair.second < motion_.bead_count() && family_.asked().asks(pair)))
    throw std::invalid_argument(
        fmt::format("beads {} and {} are no pair that is asked about", pair.first, pair.second));
  const bool in_contact = contacts_.contains(pair);
  if (in_contact != (change.kind == end))
    throw std::invalid_argument(fmt::format("beads {} and {} are {}in contact already", pair.first,
                                            pair.second, in_contact ? "" : "not "));
  if (change.kind == begin) contacts_.insert(pair);
  if (change.kind == end) contacts_.erase(pair);
}

template <int D>
std::optional<std::string> Contacts<D>::audit(const Dyadic& time) {
  return contact_fault<D>(motion_.curves(), disjoint_.search(), time, family_.asked(), contacts_);
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace kds
