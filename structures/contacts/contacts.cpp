#include "structures/contacts/contacts.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motions/base/interruption.h"
#include "motions/curves/positions.h"
#include "motions/scene/near_pairs.h"
#include "structures/necklace/pairs_in_question.h"

namespace kds {

namespace {

Contact disjoint(const BeadPair& pair) { return {{pair.first, pair.second}, 1}; }
Contact overlapping(const BeadPair& pair) { return {{pair.first, pair.second}, -1}; }

constexpr std::array<IdRole, 2> contact_pair{{{"first"}, {"second"}}};
constexpr auto contact_kinds = with_edits(std::array{EventKind{"begin", true, false, contact_pair},
                                                     EventKind{"end", true, false, contact_pair},
                                                     EventKind{"touch", true, false, contact_pair}});
static_assert(contact_kinds.size() == Contacts<2>::changes + 1);

// Returns a fault of a set of contacts at a given time, or none, with a grid over all beads. The sign of each
// near pair's function is computed at that time, in integers if doubles do not decide. At the ends of a step,
// pairs that touch exactly may be in contact or not, because changes at a frame belong to the next step, and
// changes before the first frame belong to none. `absent` marks beads that take no part; if it is empty, all
// beads take part.
template <int Dimension>
std::optional<std::string> contact_fault(const Curves<Dimension>& curves,
                                         const CertificateSearch<Contact>& search, const Dyadic& time,
                                         const PairsAsked& asked, std::span<const char> absent,
                                         const ContactSet& contacts) {
  const double u = time.round_down();
  const Eigen::Matrix3Xd centers = approximate_positions(curves, u);
  const std::vector<double> radii = approximate_radii(curves, u);
  // Exceeds by far what the rounding of times, control points' sums and squares can add to a distance.
  double largest = 0;
  for (BeadId b = 0; b < curves.bead_count(); ++b) {
    for (int k = 0; k <= curves.own_degree(); ++k) {
      for (int axis = 0; axis < Dimension; ++axis)
        largest = std::max(largest, std::abs(curves.coordinate(b, k, axis)));
      largest = std::max(largest, curves.radius(b, k));
    }
  }
  const double spare = 0x1p-40 * largest;
  const bool at_end = time == Dyadic(0.0) || time == Dyadic(1.0);
  std::optional<std::string> fault;
  std::size_t met = 0;
  const auto look_at = [&](BeadId a, BeadId b) {
    if (fault || !asked.asks({a, b})) return;
    if (!absent.empty() && (absent[a] != 0 || absent[b] != 0)) return;
    const double distance = (centers.col(a) - centers.col(b)).template head<Dimension>().stableNorm();
    const double gap = distance - radii[a] - radii[b];
    const bool is_clear = std::isfinite(gap) && std::abs(gap) > 4 * spare && spare > 0x1p-900;
    const int sign = is_clear ? (gap > 0 ? 1 : -1) : search.sign_at({{a, b}, 1}, time);
    const bool in_contact = contacts.contains({a, b});
    met += in_contact ? 1 : 0;
    if (sign == 0 && at_end) return;
    if (in_contact != (sign <= 0))
      fault = fmt::format("beads {} and {} {}, but are {} as in contact", a, b,
                          sign > 0 ? "are apart" : "meet", in_contact ? "known" : "not known");
  };
  if (std::isfinite(4 * largest)) {
    std::vector<double> larger = radii;
    for (double& radius : larger) radius += 4 * spare;
    visit_near_pairs(centers, larger, look_at);
  } else {
    for (BeadId a = 0; a < curves.bead_count(); ++a)
      for (BeadId b = a + 1; b < curves.bead_count(); ++b) look_at(a, b);
  }
  if (!fault && met != contacts.size())
    fault =
        fmt::format("{} of {} pairs known as in contact are apart", contacts.size() - met, contacts.size());
  return fault;
}

}  // namespace

std::vector<double> contact_radii(const ContactDistance& distance, std::span<const double> radii) {
  std::vector<double> own;
  for (const double radius : radii)
    own.push_back((distance.between_surfaces ? radius : 0) + 0.5 * distance.length);
  return own;
}

template <int D>
Contacts<D>::Contacts(Simulator& simulator, const MotionRef<D>& motion, PairsAsked asked,
                      std::vector<double> radii)
    : EditableBase(simulator, motion.bead_count(), "contacts", contact_kinds),
      own_radii_(radii.empty() ? nullptr : std::make_unique<OtherRadii<D>>(motion, radii)),
      motion_(own_radii_ ? MotionRef<D>(*own_radii_) : motion),
      family_(std::move(asked), motion.degree()),
      disjoint_(simulator, *this, index(), 0, motion_, TouchPolicy::reported),
      overlapping_(simulator, *this, index(), 1, motion_),
      per_bead_(statistics.certificates, motion.bead_count()) {}

template <int D>
void Contacts<D>::find_pairs(typename MovingFamily<D>::Resting resting, bool list_overlapping,
                             PairsOfBlocks& pairs) {
  if (simulator().kernel() != Kernel::exact) {
    family_.find_pairs(motion_.curves(), resting, list_overlapping, pairs);
  } else {
    pairs.clear();
    PairsInQuestion(family_.asked()).for_each([&](BeadId i, BeadId j) { pairs.unclear.push_back({i, j}); });
  }
  const std::span<const char> absent = present().absent();
  if (absent.empty()) return;
  const auto names_absent = [absent](const BeadPair& p) {
    return absent[p.first] != 0 || absent[p.second] != 0;
  };
  std::erase_if(pairs.unclear, names_absent);
  std::erase_if(pairs.overlapping, names_absent);
}

template <int D>
void Contacts<D>::build() {
  present().structure_is_built();
  contacts_.clear();
  family_.forget_rest();
  find_pairs(MovingFamily<D>::Resting::looked_at, true, pairs_);
  for (const BeadPair& pair : pairs_.overlapping) contacts_.insert(pair);
  const Instant start(0.0);
  for (const BeadPair& pair : pairs_.unclear) {
    InterruptionCheck::ask();
    const int sign =
        disjoint_.search().sign_just_after(simulator().kernel(), disjoint(pair), start, statistics.stages);
    if (sign <= 0) contacts_.insert(pair);
  }
}

template <int D>
std::vector<Change> Contacts<D>::built() const {
  std::vector<Change> begun;
  for (const BeadPair& pair : pairs()) begun.push_back({begin, 2, {pair.first, pair.second}});
  return begun;
}

template <int D>
std::vector<BeadId> Contacts<D>::state() const {
  std::vector<BeadId> state;
  for (const BeadPair& pair : pairs()) state.insert(state.end(), {pair.first, pair.second});
  return state;
}

template <int D>
void Contacts<D>::start_step() {
  find_pairs(MovingFamily<D>::Resting::left_out, false, pairs_);
  disjoint_.hold_never(family_.size() + pairs_.proved_apart);
  at_once_.clear();
  watch_from(0, true);
  if (!at_once_.empty()) settle_now();
  count_per_bead();
}

template <int D>
void Contacts<D>::watch_from(std::uint32_t place, bool at_start) {
  for (; place < pairs_.unclear.size(); ++place) {
    const BeadPair& pair = pair_at(place);
    if (contacts_.contains(pair)) {
      overlapping_.one_of_many(place, KnownAtStart::unknown) = overlapping(pair);
    } else {
      disjoint_.one_of_many(place, KnownAtStart::unknown) = disjoint(pair);
    }
  }
  const Curves<D> curves = motion_.curves();
  disjoint_.watch_enqueued([&](std::uint32_t at, CertificateHandle handle) {
    InterruptionCheck::ask();
    const BeadPair& pair = pair_at(at);
    if (handle == CertificateHandle::violated || handle == CertificateHandle::zero) {
      at_once_.push_back({pair, begin, handle == CertificateHandle::violated ? at : no_place});
    } else if (at_start && is_zero_at_start(curves, pair)) {
      at_once_.push_back({pair, touch, no_place});
    }
  });
  overlapping_.watch_enqueued([&](std::uint32_t at, CertificateHandle handle) {
    InterruptionCheck::ask();
    if (handle == CertificateHandle::violated) at_once_.push_back({pair_at(at), end, at});
  });
}

// Settles the changes of the present moment, at a frame or after edits, in the order of the beads, like all
// simultaneous events. Then watches the certificates of the pairs that changed.
template <int D>
void Contacts<D>::settle_now() {
  std::sort(at_once_.begin(), at_once_.end());
  for (const Happens& event : at_once_) {
    record_contact(event.kind, event.pair);
    if (event.place == no_place) continue;
    if (event.kind == begin) {
      (void)overlapping_.watch(overlapping(event.pair), event.place);
    } else {
      (void)disjoint_.watch(disjoint(event.pair), event.place);
    }
  }
}

// Edits: beads are inserted, erased, or change course.

template <int D>
void Contacts<D>::edit(std::uint8_t kind, BeadId bead) {
  if (kind == inserts) {
    present().set_absent(bead, false);
    record(inserts, {bead});
    find_of({&bead, 1});
  } else {
    drop_of({&bead, 1});
    for (const BeadPair& pair : contacts_.pairs())
      if (pair.first == bead || pair.second == bead) record_contact(end, pair);
    present().set_absent(bead, true);
    record(erases, {bead});
  }
}

template <int D>
std::vector<char> Contacts<D>::marked(std::span<const BeadId> beads) const {
  std::vector<char> marks(bead_count(), 0);
  for (const BeadId bead : beads) marks[bead] = 1;
  return marks;
}

template <int D>
void Contacts<D>::drop_of(std::span<const BeadId> beads) {
  const std::vector<char> marks = marked(beads);
  const auto names_one = [&](const Contact& c) { return marks[c.beads[0]] != 0 || marks[c.beads[1]] != 0; };
  disjoint_.drop_if(names_one);
  overlapping_.drop_if(names_one);
}

template <int D>
void Contacts<D>::release(std::span<const BeadId> beads) {
  drop_of(beads);
}

// Finds the pairs of these beads. The pairs' previous state is known, but the pairs have no certificates yet.
template <int D>
void Contacts<D>::find_of(std::span<const BeadId> beads) {
  const std::vector<char> marks = marked(beads);
  const auto names_none = [&](const BeadPair& p) { return marks[p.first] == 0 && marks[p.second] == 0; };
  PairsOfBlocks found;
  find_pairs(MovingFamily<D>::Resting::looked_at, true, found);
  std::erase_if(found.unclear, names_none);
  std::erase_if(found.overlapping, names_none);
  at_once_.clear();
  for (const BeadPair& pair : found.overlapping)
    if (!contacts_.contains(pair)) at_once_.push_back({pair, begin, no_place});
  ContactSet may_meet;
  for (const BeadPair& pair : found.overlapping) may_meet.insert(pair);
  for (const BeadPair& pair : found.unclear) may_meet.insert(pair);
  for (const BeadPair& pair : contacts_.pairs())
    if (!names_none(pair) && !may_meet.contains(pair)) at_once_.push_back({pair, end, no_place});
  const auto first = static_cast<std::uint32_t>(pairs_.unclear.size());
  pairs_.unclear.insert(pairs_.unclear.end(), found.unclear.begin(), found.unclear.end());
  watch_from(first, false);
  settle_now();
}

template <int D>
void Contacts<D>::fail(unsigned table, std::uint32_t slot) {
  const bool ends = table == overlapping_.number();
  const std::uint32_t place = (ends ? overlapping_ : disjoint_).place_in_structure(slot);
  const BeadPair pair = pair_at(place);
  if (ends) {
    record_contact(end, pair);
    (void)disjoint_.watch(disjoint(pair), place, KnownAtStart::at_own_root);
  } else if (disjoint_.touches(slot)) {
    record_contact(touch, pair);
    (void)disjoint_.watch(disjoint(pair), place);
  } else {
    record_contact(begin, pair);
    (void)overlapping_.watch(overlapping(pair), place, KnownAtStart::at_own_root);
  }
}

template <int D>
void Contacts<D>::record_contact(Kind kind, const BeadPair& pair) {
  if (kind == begin) contacts_.insert(pair);
  if (kind == end) contacts_.erase(pair);
  record(kind, {pair.first, pair.second});
}

// Decides in double if that is certain: the sum has an error below 2^-48 of its terms unless these underflow.
template <int D>
bool Contacts<D>::is_zero_at_start(const Curves<D>& curves, const BeadPair& pair) {
  const double reach = curves.radius(pair.first, 0) + curves.radius(pair.second, 0);
  double distance = 0;
  for (int axis = 0; axis < D; ++axis) {
    const double d = curves.coordinate(pair.second, 0, axis) - curves.coordinate(pair.first, 0, axis);
    distance += d * d;
  }
  const double size = distance + reach * reach;
  if (simulator().kernel() != Kernel::exact && size > 0x1p-900 &&
      std::abs(distance - reach * reach) > 0x1p-48 * size)
    return false;
  return disjoint_.search().sign_now(simulator().kernel(), disjoint(pair), Instant(0.0), statistics.stages) ==
         0;
}

template <int D>
void Contacts<D>::count_per_bead() {
  for (const BeadPair& pair : pairs_.unclear)
    for (const BeadId bead : {pair.first, pair.second}) per_bead_.add(bead);
  for (const BeadPair& pair : pairs_.unclear)
    for (const BeadId bead : {pair.first, pair.second}) per_bead_.reset(bead);
}

template <int D>
void Contacts<D>::apply(const Change& change) {
  if (change.size != (change.kind < inserts ? 2 : 1))
    throw std::invalid_argument("a change of contacts has other numbers of beads");
  if (apply_edit(change)) return;
  const BeadPair pair{change.ids[0], change.ids[1]};
  if (!(pair.first < pair.second && pair.second < bead_count() && family_.asked().asks(pair)) ||
      is_absent(pair.first) || is_absent(pair.second))
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
  return contact_fault<D>(motion_.curves(), disjoint_.search(), time, family_.asked(), present().absent(),
                          contacts_);
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace kds
