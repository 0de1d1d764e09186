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
// Contacts present at the first frame are part of the built structure and cause no events. All results are
// exact. With the kernel `exact`, every pair is decided on integers and none is left to the family.
//
// Erasing a bead ends its contacts. Inserting one begins the contacts that it has just after that time.
// Erasing costs one pass over all certificates; inserting a bead or changing its course costs as much as the
// family.

#include <cstdint>
#include <span>
#include <vector>

#include "certificates/types/contact.h"
#include "kds/certificate_table.h"
#include "kds/structure_base.h"
#include "structures/contacts/contact_set.h"
#include "structures/contacts/moving_family.h"

namespace kds {

template <int Dimension>
class Contacts final : public EditableBase {
 public:
  /// Kinds of events. The ids are the two beads, ascending, or the edited bead.
  enum Kind : std::uint8_t { begin, end, touch, inserts, erases, changes };

  Contacts(Simulator& simulator, const MotionRef<Dimension>& motion, PairsAsked asked);

  /// Returns the pairs in contact just after the present time, ascending.
  [[nodiscard]] std::vector<BeadPair> pairs() const { return contacts_.pairs(); }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  static constexpr std::uint32_t no_place = 0xffffffffU;  // no certificate is left
  struct Happens {                                        // an event at the present time
    BeadPair pair;
    Kind kind;
    std::uint32_t place;
    friend bool operator<(const Happens& a, const Happens& b) { return a.pair < b.pair; }
  };

  void edit(std::uint8_t kind, BeadId bead) override;
  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId> beads) override { find_of(beads); }
  [[nodiscard]] std::vector<char> marked(std::span<const BeadId> beads) const;
  /// Drops all certificates that name one of these beads.
  void drop_of(std::span<const BeadId> beads);
  void find_of(std::span<const BeadId> beads);

  void find_pairs(typename MovingFamily<Dimension>::Resting resting, bool list_overlapping,
                  PairsOfBlocks& pairs);
  /// Guards the pairs from this place on.
  void watch_from(std::uint32_t place, bool at_start);
  [[nodiscard]] const BeadPair& pair_at(std::uint32_t place) const { return pairs_.unclear[place]; }
  [[nodiscard]] bool is_zero_at_start(const Curves<Dimension>& curves, const BeadPair& pair);
  void record(Kind kind, const BeadPair& pair);
  void settle_now();
  void count_per_bead();

  MotionRef<Dimension> motion_;
  MovingFamily<Dimension> family_;
  CertificateTable<Contact> disjoint_, overlapping_;
  ContactSet contacts_;
  PairsOfBlocks pairs_;  // of the step
  std::vector<Happens> at_once_;
  std::vector<std::uint32_t> certificates_of_bead_;
};

static_assert(EditableStructure<Contacts<2>>);

}  // namespace kds
