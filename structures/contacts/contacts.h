#pragma once
// Kinetic contacts of beads: reports when two closed balls begin to meet, when they part, and when they only
// touch. Knows at every moment which pairs are in contact.
//
// A separating family (moving_family.h) proves most pairs apart for the whole step. Each remaining pair has a
// certificate. The failure of "disjoint" is a beginning, or a touch if its function is zero and then positive
// again. The failure of "overlapping" is an end. A pair that stays exactly in touch for a while is in contact
// during that time, because balls are closed. Events at a frame follow from the states before and just after
// the frame: balls that meet exactly then and part at once only touch.
//
// With groups of beads (PairsAsked::groups), only pairs of a bead of each group are followed. The contacts of
// these pairs are those of the run without groups.
//
// In a periodic cell (HasCell), two beads are in contact while any image of one is within reach of the other.
// Each image in question has a certificate of its own (shifted_beads.h). A contact begins with the first
// image that meets and ends with the last. If one image ends at the moment at which another begins, the pair
// stays in contact, because balls are closed. A uniform grid finds the images that may meet (near_images.h).
// A bead is never in contact with its own image.
//
// Contacts present at the first frame are part of the built structure and cause no events. All results are
// exact. With the kernel `exact`, every pair is decided on integers and none is left to the family; in a
// periodic cell, doubles first exclude images that are out of reach.
//
// Erasing a bead ends its contacts. Inserting one begins the contacts that it has just after that time.
// Erasing costs one pass over all certificates. Inserting a bead or changing its course costs that, and in a
// periodic cell the bead's neighbours (NearImages::find_of), otherwise as much as the family.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "certificates/search/moment.h"
#include "certificates/types/distances.h"
#include "kds/certificate_table.h"
#include "kds/structure_base.h"
#include "motions/curves/other_radii.h"
#include "structures/contacts/contact_distance.h"
#include "structures/contacts/near_balls.h"
#include "structures/images/near_images.h"
#include "structures/images/shifted_beads.h"
#include "structures/necklace/bead_pairs.h"

namespace kds {

/// The pairs of beads in contact, in a hash table with open addressing. The table is queried for each pair
/// that may change. Each pair has the shift of an image that is in contact.
class ContactSet {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool contains(const BeadPair& pair) const {
    return size_ > 0 && slots_[slot_of(key_of(pair))] != empty;
  }
  /// Returns the shift of a pair that is in the set.
  [[nodiscard]] std::uint32_t shift_of(const BeadPair& pair) const {
    return shifts_.empty() ? 0 : shifts_[slot_of(key_of(pair))];
  }
  [[nodiscard]] bool contains(const ImagePair& image) const {
    return contains(image.pair) && shift_of(image.pair) == image.shift;
  }
  /// Replaces the shift and returns false if the pair was in the set.
  bool insert(const BeadPair& pair, std::uint32_t shift = 0) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    const std::size_t at = slot_of(key_of(pair));
    if (shift != 0 && shifts_.empty()) shifts_.resize(slots_.size(), 0);
    if (!shifts_.empty()) shifts_[at] = shift;
    if (slots_[at] != empty) return false;
    slots_[at] = key_of(pair);
    ++size_;
    return true;
  }
  /// Returns false if the pair was not in the set.
  bool erase(const BeadPair& pair) {
    if (!contains(pair)) return false;
    std::size_t gap = slot_of(key_of(pair));
    // Moves later entries into the gap if the gap lies between their home slot and their present slot.
    for (std::size_t at = next(gap); slots_[at] != empty; at = next(at)) {
      const std::size_t home = home_of(slots_[at]);
      if (((at - home) & mask()) < ((at - gap) & mask())) continue;
      slots_[gap] = slots_[at];
      if (!shifts_.empty()) shifts_[gap] = shifts_[at];
      gap = at;
    }
    slots_[gap] = empty;
    --size_;
    return true;
  }
  void clear() {
    std::fill(slots_.begin(), slots_.end(), empty);
    shifts_.clear();
    size_ = 0;
  }
  /// Gives each pair another shift, which `of(shift)` returns.
  template <class Of>
  void renumber_shifts(Of of) {
    for (std::size_t at = 0; at < shifts_.size(); ++at)
      if (slots_[at] != empty) shifts_[at] = of(shifts_[at]);
  }
  /// Returns all pairs, ascending.
  [[nodiscard]] std::vector<BeadPair> pairs() const {
    std::vector<BeadPair> all;
    all.reserve(size_);
    for (const std::uint64_t key : slots_)
      if (key != empty) all.push_back({static_cast<BeadId>(key >> 32U), static_cast<BeadId>(key)});
    std::sort(all.begin(), all.end());
    return all;
  }

 private:
  static constexpr std::uint64_t empty = ~std::uint64_t{0};  // no pair has this key, because first < second

  static std::uint64_t key_of(const BeadPair& pair) {
    return (static_cast<std::uint64_t>(pair.first) << 32U) | pair.second;
  }
  [[nodiscard]] std::size_t mask() const { return slots_.size() - 1; }
  [[nodiscard]] std::size_t next(std::size_t slot) const { return (slot + 1) & mask(); }
  [[nodiscard]] std::size_t home_of(std::uint64_t key) const {
    return static_cast<std::size_t>((key * 0x9e3779b97f4a7c15ULL) >> 32U) & mask();
  }
  /// Returns the slot that holds the key, or the slot to insert it.
  [[nodiscard]] std::size_t slot_of(std::uint64_t key) const {
    std::size_t slot = home_of(key);
    while (slots_[slot] != key && slots_[slot] != empty) slot = next(slot);
    return slot;
  }
  void grow() {
    std::vector<std::uint64_t> old(std::max<std::size_t>(64, 2 * slots_.size()), empty);
    old.swap(slots_);
    std::vector<std::uint32_t> old_shifts(shifts_.empty() ? 0 : slots_.size(), 0);
    old_shifts.swap(shifts_);
    for (std::size_t from = 0; from < old.size(); ++from) {
      if (old[from] == empty) continue;
      const std::size_t to = slot_of(old[from]);
      slots_[to] = old[from];
      if (!shifts_.empty()) shifts_[to] = old_shifts[from];
    }
  }

  std::vector<std::uint64_t> slots_;   // size is a power of two
  std::vector<std::uint32_t> shifts_;  // empty as long as all are 0
  std::size_t size_ = 0;
};

template <int Dimension>
class Contacts final : public EditableBase {
 public:
  /// Kinds of events. The ids are the two beads, ascending, or the edited bead.
  enum Kind : std::uint8_t { begin, end, touch, inserts, erases, changes };

  /// `radii` has one radius for each bead. If it is empty, balls have the radii of the motion.
  Contacts(Simulator& simulator, const MotionRef<Dimension>& motion, const PairsAsked& asked,
           std::vector<double> radii = {});

  /// Returns the pairs in contact just after the present time, ascending.
  [[nodiscard]] std::vector<BeadPair> pairs() const { return contacts_.pairs(); }
  /// Returns the changes that build the structure from nothing (RunningStructure::built).
  [[nodiscard]] std::vector<Change> built() const;
  /// Returns the pairs in contact with the shifts of their images that meet, which determine all later events
  /// (RunningStructure::state).
  [[nodiscard]] std::vector<BeadId> state() const;

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  static constexpr std::uint32_t no_place = 0xffffffffU;  // no certificate is left
  struct Happens {                                        // an event at the present time
    ImagePair image;
    Kind kind;
    std::uint32_t place;
    friend bool operator<(const Happens& a, const Happens& b) { return a.image < b.image; }
  };
  /// Several images of one bead that are in contact with another, or in question in this step.
  struct SeveralImages {
    std::vector<std::uint32_t> in_contact;      // shifts
    std::vector<std::uint32_t> places;          // of those in question
    std::uint64_t settled = ~std::uint64_t{0};  // the moment at which the pair was settled last
  };

  void edit(std::uint8_t kind, BeadId bead) override;
  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override { find_of(beads); }
  [[nodiscard]] std::vector<char> marked(std::span<const BeadId> beads) const;
  /// Drops all certificates that name one of these beads.
  void drop_of(std::span<const BeadId> beads);
  void find_of(std::span<const BeadId> beads);

  void find_pairs(typename NearBalls<Dimension>::Resting resting, bool list_overlapping,
                  PairsOfImages& found);
  /// Drops pairs of absent beads.
  void leave_out_absent(PairsOfImages& found);
  [[nodiscard]] bool is_periodic() const { return motion_.curves().cell() != nullptr; }
  /// Watches the images that may meet, and takes them out of `found`.
  void watch_all(PairsOfImages& found, bool at_start);
  /// Creates the certificates of the images from this place on, and keeps those that may fail.
  void watch_from(std::uint32_t first, bool at_start);
  /// Watches whether the image at this place stays apart, or in contact.
  void watch(std::uint32_t place, bool in_contact, KnownAtStart birth = KnownAtStart::unknown);
  [[nodiscard]] const ImagePair& image_at(std::uint32_t place) const { return watched_[place]; }
  [[nodiscard]] ImageContact image_contact(const ImagePair& image, int sign) const {
    return {{image.pair.first, image.pair.second, shifted_.to(image.shift), shifted_.from(image.shift)},
            sign};
  }
  /// Returns the sign of the distance of an image less its reach, at or just after the present time.
  [[nodiscard]] int sign_of(const ImagePair& image, Moment moment, const Instant& time);
  [[nodiscard]] bool is_zero_at_start(const Curves<Dimension>& curves, const ImagePair& image);
  void fail_at(std::uint32_t place, Kind kind);
  /// Changes the set of contacts and records the change.
  void record_contact(Kind kind, const ImagePair& image);
  void settle_now();

  // Pairs with several images.

  [[nodiscard]] static std::uint64_t key_of(const BeadPair& pair) {
    return (std::uint64_t{pair.first} << 32U) | pair.second;
  }
  [[nodiscard]] bool is_in_contact(const ImagePair& image) const;
  /// Returns the shifts of the pair's images that are in contact.
  [[nodiscard]] std::vector<std::uint32_t> shifts_in_contact(const BeadPair& pair) const;
  /// Sets the shifts of the pair's images in contact. Records no event.
  void set_in_contact(const BeadPair& pair, const std::vector<std::uint32_t>& shifts);
  /// Removes entries with at most one image in contact, and keeps that image in `contacts_`. Numbers the
  /// shifts anew if few of them are in use.
  void forget_images();
  /// Finds the pairs that have several images in question or in contact. `at_once`: pairs that change now by
  /// images that are not in question.
  void gather_several(const std::set<BeadPair>& at_once);
  void settle_several(SeveralImages& several, const BeadPair& pair);
  [[nodiscard]] std::optional<std::string> fault_of_images(const Dyadic& time);

  std::unique_ptr<const OtherRadii<Dimension>> own_radii_;  // null: the motion's
  MotionRef<Dimension> motion_;
  NearBalls<Dimension> near_balls_;
  ShiftNumbers<Dimension> shifts_;
  std::size_t shifts_in_use_ = 1;  // when they were numbered
  ShiftedBeads<Dimension> shifted_;
  CertificateTable<Contact> disjoint_, overlapping_;
  CertificateTable<ImageContact> disjoint_images_, overlapping_images_;  // of shifts other than 0
  ContactSet contacts_;
  std::unordered_map<std::uint64_t, SeveralImages> several_;
  PairsOfImages found_;             // images that may meet in the present step, until they are watched
  std::vector<ImagePair> watched_;  // images whose certificates may fail, by place
  bool knows_images_ = false;       // not after changes from a log, which names pairs only
  std::vector<Happens> at_once_;
  CertificatesPerBead per_bead_;  // all zero between steps
};

static_assert(EditableStructure<Contacts<2>>);

}  // namespace kds
