#include "structures/contacts/contacts.h"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "motions/base/grow_little.h"
#include "motions/base/interruption.h"
#include "motions/curves/positions.h"
#include "motions/scene/near_pairs.h"
#include "structures/images/laid_images.h"

namespace kds {

namespace {

Contact disjoint(const BeadPair& pair) { return {{pair.first, pair.second}, 1}; }
Contact overlapping(const BeadPair& pair) { return {{pair.first, pair.second}, -1}; }

TableMotion whose_motion(bool own) { return own ? TableMotion::of_structure : TableMotion::of_run; }

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
    const bool in_contact = contacts.contains(BeadPair{a, b});
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
Contacts<D>::Contacts(Simulator& simulator, const MotionRef<D>& motion, const PairsAsked& asked,
                      std::vector<double> radii)
    : EditableBase(simulator, motion.bead_count(), "contacts", contact_kinds),
      own_radii_(radii.empty() ? nullptr : std::make_unique<OtherRadii<D>>(motion, radii)),
      motion_(own_radii_ ? MotionRef<D>(*own_radii_) : motion),
      near_balls_(asked, motion.degree()),
      shifted_(motion.degree()),
      disjoint_(simulator, *this, index(), 0, motion_, TouchPolicy::reported,
                whose_motion(own_radii_ != nullptr)),
      overlapping_(simulator, *this, index(), 1, motion_, TouchPolicy::ignored,
                   whose_motion(own_radii_ != nullptr)),
      disjoint_images_(simulator, *this, index(), 2, MotionRef<D>(shifted_), TouchPolicy::reported,
                       TableMotion::of_structure),
      overlapping_images_(simulator, *this, index(), 3, MotionRef<D>(shifted_), TouchPolicy::ignored,
                          TableMotion::of_structure),
      per_bead_(statistics.certificates, motion.bead_count()) {}

template <int D>
void Contacts<D>::find_pairs(typename NearBalls<D>::Resting resting, bool list_overlapping,
                             PairsOfImages& found) {
  near_balls_.find(motion_.curves(), simulator().kernel(), resting, list_overlapping, shifts_, found);
  if (shifts_.size() > 1) shifted_.set(motion_.curves(), shifts_);
  leave_out_absent(found);
}

template <int D>
void Contacts<D>::leave_out_absent(PairsOfImages& found) {
  const std::span<const char> absent = present().absent();
  if (absent.empty()) return;
  const auto names_absent = [absent](const ImagePair& p) {
    return absent[p.pair.first] != 0 || absent[p.pair.second] != 0;
  };
  std::erase_if(found.unclear, names_absent);
  std::erase_if(found.overlapping, names_absent);
}

template <int D>
int Contacts<D>::sign_of(const ImagePair& image, Moment moment, const Instant& time) {
  const Kernel kernel = simulator().kernel();
  StageCounts& stages = statistics.stages;
  if (image.shift == 0)
    return kds::sign_of(disjoint_.search(), kernel, disjoint(image.pair), moment, time, stages);
  return kds::sign_of(disjoint_images_.search(), kernel, image_contact(image, 1), moment, time, stages);
}

template <int D>
void Contacts<D>::build() {
  present().structure_is_built();
  contacts_.clear();
  several_.clear();
  knows_images_ = true;
  near_balls_.forget_rest();
  find_pairs(NearBalls<D>::Resting::looked_at, true, found_);
  const Instant start(0.0);
  for (const ImagePair& image : found_.unclear) {
    InterruptionCheck::ask();
    if (sign_of(image, Moment::just_after, start) <= 0) found_.overlapping.push_back(image);
  }
  for (const ImagePair& image : found_.overlapping) {
    if (contacts_.contains(image.pair)) {
      std::vector<std::uint32_t> shifts = shifts_in_contact(image.pair);
      shifts.push_back(image.shift);
      set_in_contact(image.pair, shifts);
    } else {
      contacts_.insert(image.pair, image.shift);
    }
  }
}

template <int D>
std::vector<Change> Contacts<D>::built() const {
  std::vector<Change> begun;
  for (const BeadPair& pair : pairs()) begun.push_back({begin, 2, {pair.first, pair.second}});
  return begun;
}

// Shifts have other numbers in another run, so the state has the shifts themselves.
template <int D>
std::vector<BeadId> Contacts<D>::state() const {
  std::vector<BeadId> state;
  for (const BeadPair& pair : pairs()) {
    state.insert(state.end(), {pair.first, pair.second});
    if (!is_periodic()) continue;
    std::vector<CellShift<D>> shifts;
    for (const std::uint32_t number : shifts_in_contact(pair)) shifts.push_back(shifts_.shift(number));
    std::sort(shifts.begin(), shifts.end());
    state.push_back(static_cast<BeadId>(shifts.size()));
    for (const CellShift<D>& shift : shifts)
      for (const std::int32_t multiple : shift) state.push_back(static_cast<BeadId>(multiple));
  }
  return state;
}

template <int D>
void Contacts<D>::start_step() {
  forget_images();
  watched_.clear();
  find_pairs(NearBalls<D>::Resting::left_out, false, found_);
  disjoint_.hold_never(found_.proved);
  at_once_.clear();
  watch_all(found_, true);
  gather_several({});
  if (!at_once_.empty()) settle_now();
  for (BeadId bead = 0; bead < bead_count(); ++bead) per_bead_.reset(bead);
}

// Only images whose certificates may fail get a place. The others are most of them, so images are taken in
// blocks, and their memory is given back.
template <int D>
void Contacts<D>::watch_all(PairsOfImages& found, bool at_start) {
  constexpr std::size_t most = 1U << 16U;
  while (!found.unclear.empty()) {
    const std::size_t count = std::min(most, found.unclear.size());
    const auto last = found.unclear.begin() + static_cast<std::ptrdiff_t>(count);
    const std::size_t first = watched_.size();
    grow_little(watched_, first + count);
    std::copy(found.unclear.begin(), last, watched_.begin() + static_cast<std::ptrdiff_t>(first));
    found.unclear.erase(found.unclear.begin(), last);
    watch_from(static_cast<std::uint32_t>(first), at_start);
  }
}

template <int D>
void Contacts<D>::watch_from(std::uint32_t first, bool at_start) {
  for (std::uint32_t place = first; place < watched_.size(); ++place) {
    const ImagePair& image = watched_[place];
    if (at_start)
      for (const BeadId bead : {image.pair.first, image.pair.second}) per_bead_.add(bead);
    const bool in_contact = is_in_contact(image);
    if (image.shift != 0) {
      (in_contact ? overlapping_images_ : disjoint_images_).one_of_many(place, KnownAtStart::unknown) =
          image_contact(image, in_contact ? -1 : 1);
    } else if (in_contact) {
      overlapping_.one_of_many(place, KnownAtStart::unknown) = overlapping(image.pair);
    } else {
      disjoint_.one_of_many(place, KnownAtStart::unknown) = disjoint(image.pair);
    }
  }
  struct Kept {
    std::uint32_t place;
    CertificateHandle handle;
    std::size_t at_once;  // the index in at_once_, if the certificate is violated
    bool is_overlapping;
  };
  std::vector<Kept> kept;
  const auto keep = [&](std::uint32_t place, CertificateHandle handle, bool is_overlapping) {
    if (has_slot(handle) || handle == CertificateHandle::violated)
      kept.push_back({place, handle, at_once_.size(), is_overlapping});
  };
  const Curves<D> curves = motion_.curves();
  const auto begins = [&](std::uint32_t at, CertificateHandle handle) {
    InterruptionCheck::ask();
    keep(at, handle, false);
    const ImagePair& image = watched_[at];
    if (handle == CertificateHandle::violated || handle == CertificateHandle::zero) {
      at_once_.push_back({image, begin, no_place});
    } else if (at_start && is_zero_at_start(curves, image)) {
      at_once_.push_back({image, touch, no_place});
    }
  };
  const auto ends = [&](std::uint32_t at, CertificateHandle handle) {
    InterruptionCheck::ask();
    keep(at, handle, true);
    if (handle == CertificateHandle::violated) at_once_.push_back({watched_[at], end, no_place});
  };
  disjoint_.watch_enqueued(begins);
  overlapping_.watch_enqueued(ends);
  disjoint_images_.watch_enqueued(begins);
  overlapping_images_.watch_enqueued(ends);
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.place < b.place; });
  std::uint32_t place = first;
  for (const Kept& one : kept) {
    const ImagePair image = watched_[one.place];
    watched_[place] = image;
    if (one.handle == CertificateHandle::violated) {
      at_once_[one.at_once].place = place;
    } else if (image.shift != 0) {
      (one.is_overlapping ? overlapping_images_ : disjoint_images_).set_place(one.handle, place);
    } else {
      (one.is_overlapping ? overlapping_ : disjoint_).set_place(one.handle, place);
    }
    ++place;
  }
  watched_.resize(place);
}

template <int D>
void Contacts<D>::watch(std::uint32_t place, bool in_contact, KnownAtStart birth) {
  const ImagePair& image = image_at(place);
  if (image.shift != 0) {
    (void)(in_contact ? overlapping_images_ : disjoint_images_)
        .watch(image_contact(image, in_contact ? -1 : 1), place, birth);
  } else if (in_contact) {
    (void)overlapping_.watch(overlapping(image.pair), place, birth);
  } else {
    (void)disjoint_.watch(disjoint(image.pair), place, birth);
  }
}

// Settles the changes of the present moment, at a frame or after edits, in the order of the beads, like all
// simultaneous events. Then watches the certificates of the pairs that changed. The images of a pair change
// together.
template <int D>
void Contacts<D>::settle_now() {
  std::sort(at_once_.begin(), at_once_.end());
  for (std::size_t from = 0, to = 0; from < at_once_.size(); from = to) {
    const BeadPair pair = at_once_[from].image.pair;
    while (to < at_once_.size() && at_once_[to].image.pair == pair) ++to;
    const std::span<const Happens> of_pair = std::span(at_once_).subspan(from, to - from);
    std::vector<std::uint32_t> shifts = shifts_in_contact(pair);
    const bool before = !shifts.empty();
    bool touches = false;
    for (const Happens& change : of_pair) {
      if (change.kind == begin) shifts.push_back(change.image.shift);
      if (change.kind == end) std::erase(shifts, change.image.shift);
      touches = touches || change.kind == touch;
    }
    const bool after = !shifts.empty();
    if (before != after) {
      record_contact(after ? begin : end, of_pair.front().image);
    } else if (touches && !before) {
      record_contact(touch, of_pair.front().image);
    }
    set_in_contact(pair, shifts);
    for (const Happens& change : of_pair)
      if (change.place != no_place) watch(change.place, change.kind == begin);
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
    for (const BeadPair& pair : contacts_.pairs()) {
      if (pair.first != bead && pair.second != bead) continue;
      record_contact(end, {pair});
      several_.erase(key_of(pair));
    }
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
  const auto names_one = [&](const auto& c) { return marks[c.beads[0]] != 0 || marks[c.beads[1]] != 0; };
  disjoint_.drop_if(names_one);
  overlapping_.drop_if(names_one);
  disjoint_images_.drop_if(names_one);
  overlapping_images_.drop_if(names_one);
}

template <int D>
void Contacts<D>::release(std::span<const BeadId> beads) {
  drop_of(beads);
}

// Finds the pairs of these beads. The pairs' previous state is known, but the pairs have no certificates yet.
template <int D>
void Contacts<D>::find_of(std::span<const BeadId> beads) {
  const std::vector<char> marks = marked(beads);
  const auto names_none = [&](const ImagePair& p) {
    return marks[p.pair.first] == 0 && marks[p.pair.second] == 0;
  };
  PairsOfImages found;
  near_balls_.find_of(motion_.curves(), beads, simulator().kernel(), NearBalls<D>::Resting::looked_at, true,
                      shifts_, found);
  if (shifts_.size() > 1) shifted_.set_of(motion_.curves(), beads, shifts_);
  leave_out_absent(found);
  std::erase_if(found.unclear, names_none);
  std::erase_if(found.overlapping, names_none);
  at_once_.clear();
  for (const ImagePair& image : found.overlapping)
    if (!is_in_contact(image)) at_once_.push_back({image, begin, no_place});
  std::vector<ImagePair> may_meet(found.overlapping.begin(), found.overlapping.end());
  may_meet.insert(may_meet.end(), found.unclear.begin(), found.unclear.end());
  std::sort(may_meet.begin(), may_meet.end());
  for (const BeadPair& pair : contacts_.pairs()) {
    for (const std::uint32_t shift : shifts_in_contact(pair)) {
      const ImagePair image{pair, shift};
      if (!names_none(image) && !std::binary_search(may_meet.begin(), may_meet.end(), image))
        at_once_.push_back({image, end, no_place});
    }
  }
  found_.may_repeat = found_.may_repeat || found.may_repeat;
  std::set<BeadPair> at_once;  // pairs that change now by images that are not in question
  for (const Happens& change : at_once_) at_once.insert(change.image.pair);
  watch_all(found, false);
  gather_several(at_once);
  settle_now();
}

template <int D>
void Contacts<D>::fail(unsigned table, std::uint32_t slot) {
  if (table == overlapping_.number()) return fail_at(overlapping_.place_in_structure(slot), end);
  if (table == overlapping_images_.number())
    return fail_at(overlapping_images_.place_in_structure(slot), end);
  const auto fails = [&](const auto& disjoint) {
    fail_at(disjoint.place_in_structure(slot), disjoint.touches(slot) ? touch : begin);
  };
  if (table == disjoint_.number()) return fails(disjoint_);
  fails(disjoint_images_);
}

template <int D>
void Contacts<D>::fail_at(std::uint32_t place, Kind kind) {
  const ImagePair image = image_at(place);
  const auto several = several_.empty() ? several_.end() : several_.find(key_of(image.pair));
  if (several == several_.end()) {
    record_contact(kind, image);
  } else {
    settle_several(several->second, image.pair);
    if (kind == begin) several->second.in_contact.push_back(image.shift);
    if (kind == end) std::erase(several->second.in_contact, image.shift);
  }
  const bool at_root = kind != touch;
  watch(place, kind == begin, at_root ? KnownAtStart::at_own_root : KnownAtStart::unknown);
}

template <int D>
void Contacts<D>::record_contact(Kind kind, const ImagePair& image) {
  if (kind == begin) contacts_.insert(image.pair, image.shift);
  if (kind == end) contacts_.erase(image.pair);
  record(kind, {image.pair.first, image.pair.second});
}

// Decides in double if that is certain: the sum has an error below 2^-48 of its terms unless these underflow.
template <int D>
bool Contacts<D>::is_zero_at_start(const Curves<D>& curves, const ImagePair& image) {
  const auto [first, second] = image.pair;
  const double reach = curves.radius(first, 0) + curves.radius(second, 0);
  double distance = 0, largest = 0;
  for (int axis = 0; axis < D; ++axis) {
    double d = curves.coordinate(second, 0, axis) - curves.coordinate(first, 0, axis);
    if (image.shift != 0) {
      largest = std::max(largest, std::abs(d));
      d += shifted_.coordinate(shifted_.to(image.shift), 0, axis);
    }
    distance += d * d;
  }
  const double size = distance + reach * reach + largest * largest;
  if (simulator().kernel() != Kernel::exact && size > 0x1p-900 &&
      std::abs(distance - reach * reach) > 0x1p-46 * size)
    return false;
  return sign_of(image, Moment::now, Instant(0.0)) == 0;
}

// Pairs with several images.

template <int D>
bool Contacts<D>::is_in_contact(const ImagePair& image) const {
  if (!several_.empty()) {
    const auto several = several_.find(key_of(image.pair));
    if (several != several_.end()) return std::ranges::count(several->second.in_contact, image.shift) > 0;
  }
  return contacts_.contains(image);
}

template <int D>
std::vector<std::uint32_t> Contacts<D>::shifts_in_contact(const BeadPair& pair) const {
  const auto several = several_.find(key_of(pair));
  if (several != several_.end()) return several->second.in_contact;
  if (!contacts_.contains(pair)) return {};
  return {contacts_.shift_of(pair)};
}

template <int D>
void Contacts<D>::set_in_contact(const BeadPair& pair, const std::vector<std::uint32_t>& shifts) {
  const auto several = several_.find(key_of(pair));
  if (several != several_.end()) {
    several->second.in_contact = shifts;
    several->second.settled = ~std::uint64_t{0};
  } else if (shifts.size() > 1) {
    several_[key_of(pair)].in_contact = shifts;
  } else if (shifts.size() == 1) {
    contacts_.insert(pair, shifts.front());
  }
}

template <int D>
void Contacts<D>::forget_images() {
  std::erase_if(several_, [this](auto& entry) {
    const auto& [key, several] = entry;
    const BeadPair pair{static_cast<BeadId>(key >> 32U), static_cast<BeadId>(key)};
    if (several.in_contact.size() > 1) return false;
    if (several.in_contact.size() == 1) contacts_.insert(pair, several.in_contact.front());
    return true;
  });
  if (shifts_.size() < 2 * shifts_in_use_ + 64) return;
  ShiftNumbers<D> in_use;
  const auto renumber = [&](std::uint32_t& shift) { shift = in_use.number_of(shifts_.shift(shift)); };
  for (auto& [key, several] : several_)
    for (std::uint32_t& shift : several.in_contact) renumber(shift);
  contacts_.renumber_shifts([&](std::uint32_t shift) {
    renumber(shift);
    return shift;
  });
  shifts_ = std::move(in_use);
  shifts_in_use_ = shifts_.size();
}

template <int D>
void Contacts<D>::gather_several(const std::set<BeadPair>& at_once) {
  if (!found_.may_repeat && several_.empty()) return;
  for (auto& [key, several] : several_) several.places.clear();
  std::vector<std::pair<std::uint64_t, std::uint32_t>> places;
  for (std::uint32_t place = 0; place < watched_.size(); ++place)
    places.emplace_back(key_of(image_at(place).pair), place);
  std::sort(places.begin(), places.end());
  for (std::size_t from = 0, to = 0; from < places.size(); from = to) {
    while (to < places.size() && places[to].first == places[from].first) ++to;
    const ImagePair& image = image_at(places[from].second);
    const bool other_in_contact = contacts_.contains(image.pair) && !contacts_.contains(image);
    if (to - from == 1 && !other_in_contact && !several_.contains(places[from].first) &&
        !at_once.contains(image.pair))
      continue;
    std::vector<std::uint32_t> in_contact = shifts_in_contact(image.pair);
    SeveralImages& several = several_[places[from].first];
    several.in_contact = std::move(in_contact);
    for (std::size_t i = from; i < to; ++i) several.places.push_back(places[i].second);
  }
}

// The first failure of a pair's image at a moment decides the pair's event.
template <int D>
void Contacts<D>::settle_several(SeveralImages& several, const BeadPair& pair) {
  if (several.settled == simulator().moment()) return;
  several.settled = simulator().moment();
  const bool before = !several.in_contact.empty();
  bool now = false;
  std::optional<ImagePair> after;
  for (const std::uint32_t shift : several.in_contact) {  // without a certificate, it stays in contact
    const auto is_it = [&](std::uint32_t place) { return image_at(place).shift == shift; };
    if (std::ranges::none_of(several.places, is_it)) after = ImagePair{pair, shift};
  }
  for (const std::uint32_t place : several.places) {
    if (sign_of(image_at(place), Moment::now, simulator().now()) <= 0) now = true;
    if (sign_of(image_at(place), Moment::just_after, simulator().now()) <= 0) after = image_at(place);
  }
  if (before && !after) {
    record_contact(end, {pair});
  } else if (!before && after) {
    record_contact(begin, *after);
  } else if (!before && now) {
    record_contact(touch, {pair});
  }
}

template <int D>
void Contacts<D>::apply(const Change& change) {
  if (change.size != (change.kind < inserts ? 2 : 1))
    throw std::invalid_argument("a change of contacts has other numbers of beads");
  if (apply_edit(change)) return;
  const BeadPair pair{change.ids[0], change.ids[1]};
  if (!(pair.first < pair.second && pair.second < bead_count() && near_balls_.asked().asks(pair)) ||
      is_absent(pair.first) || is_absent(pair.second))
    throw std::invalid_argument(
        fmt::format("beads {} and {} are no pair that is asked about", pair.first, pair.second));
  knows_images_ = false;
  const bool in_contact = contacts_.contains(pair);
  if (in_contact != (change.kind == end))
    throw std::invalid_argument(fmt::format("beads {} and {} are {}in contact already", pair.first,
                                            pair.second, in_contact ? "" : "not "));
  if (change.kind == begin) contacts_.insert(pair);
  if (change.kind == end) contacts_.erase(pair);
}

template <int D>
std::optional<std::string> Contacts<D>::audit(const Dyadic& time) {
  if (is_periodic()) return fault_of_images(time);
  return contact_fault<D>(motion_.curves(), disjoint_.search(), time, near_balls_.asked(), present().absent(),
                          contacts_);
}

// Returns a fault of the images in contact at a given time, or none. Beads are moved into the cell, and all
// their images within reach of it are laid around it. Otherwise like contact_fault.
template <int D>
std::optional<std::string> Contacts<D>::fault_of_images(const Dyadic& time) {
  const Curves<D> curves = motion_.curves();
  const LaidImages<D> laid(curves, time.round_down());
  const bool at_end = time == Dyadic(0.0) || time == Dyadic(1.0);
  const std::span<const char> absent = present().absent();
  std::map<BeadPair, int> least;  // sign of the nearest image, where it is not positive
  std::optional<std::string> fault;
  laid.visit_near([&](BeadId a, BeadId b, const CellShift<D>& shift, double gap) {
    const BeadPair pair{a, b};
    if (fault || !near_balls_.asked().asks(pair)) return;
    if (!absent.empty() && (absent[a] != 0 || absent[b] != 0)) return;
    const std::optional<std::uint32_t> number = shifts_.find(shift);
    if (!number && laid.is_clear(gap) && gap > 0) return;  // apart, and never in question
    const ImagePair image{pair, number ? *number : shifts_.number_of(shift)};
    int sign = gap > 0 ? 1 : -1;
    if (!laid.is_clear(gap)) {
      if (!number) shifted_.set(curves, shifts_);
      sign = image.shift == 0 ? disjoint_.search().sign_at(disjoint(pair), time)
                              : disjoint_images_.search().sign_at(image_contact(image, 1), time);
    }
    if (sign <= 0) least[pair] = std::min(sign, least[pair]);
    if (sign == 0 && at_end) return;
    if (knows_images_ && is_in_contact(image) != (sign <= 0))
      fault = fmt::format("bead {} and an image of bead {} {}, but are {} as in contact", a, b,
                          sign > 0 ? "are apart" : "meet", sign > 0 ? "known" : "not known");
  });
  if (fault) return fault;
  for (const auto& [pair, sign] : least) {
    if (sign == 0 && at_end) continue;
    if (!contacts_.contains(pair))
      return fmt::format("beads {} and {} meet, but are not known as in contact", pair.first, pair.second);
  }
  for (const BeadPair& pair : contacts_.pairs())
    if (!least.contains(pair))
      return fmt::format("beads {} and {} are apart, but are known as in contact", pair.first, pair.second);
  return std::nullopt;
}

template class Contacts<2>;
template class Contacts<3>;

}  // namespace kds
