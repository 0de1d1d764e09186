#pragma once
// Contacts of beads, kept while they move: when any two closed balls begin to meet and when they part, and
// when they only touch. At every moment it knows which pairs are in contact.
//
// Exact. Each pair that a separating family (moving_family.h) does not prove apart in a step gets
// certificates: "disjoint", whose failure is a beginning, or a touch where its function is zero and positive
// again; "overlapping", whose failure is an end. A pair that stays exactly in touch for a while is in contact
// for that time: closed balls. What happens at a frame is judged by what was before and what is just after:
// balls that meet right then and part at once only touch. Before the first frame there is nothing, and balls
// in contact then have begun by then: no event, but part of what is built. With `exact` no pair is left to
// the family, each is looked at on integers.
//
// A bead that goes ends its contacts, one that comes begins those that it has just after that time. A bead
// costs, when it goes, a look at all certificates, when it comes or changes course, what the family costs.

#include <cstdint>
#include <span>
#include <vector>

#include "certificates/types/contact.h"
#include "kds/bead_edits.h"
#include "kds/certificate_table.h"
#include "kds/present_beads.h"
#include "structures/contacts/contact_set.h"
#include "structures/contacts/moving_family.h"

namespace kds {

template <int Dimension>
class Contacts final : public KineticStructure, public BeadEdits {
 public:
  /// Kinds of its events; ids: the two beads, ascending; of an edit: the bead.
  enum Kind : std::uint8_t { begin, end, touch, inserts, erases, changes };

  Contacts(Simulator& simulator, const MotionRef<Dimension>& motion, PairsAsked asked);

  [[nodiscard]] std::string_view name() const override { return "contacts"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  /// Those in contact just after the present time, ascending.
  [[nodiscard]] std::vector<BeadPair> pairs() const { return contacts_.pairs(); }
  /// Pairs of boxes that were proved apart in the present step.
  [[nodiscard]] std::uint64_t family_size() const { return family_.size(); }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

  void leave_out(BeadId bead) override { present_.leave_out(bead); }
  void insert(BeadId bead) override;
  void erase(BeadId bead) override;
  [[nodiscard]] bool is_absent(BeadId bead) const override { return present_.is_absent(bead); }

 private:
  static constexpr std::uint32_t no_place = 0xffffffffU;  // nothing to watch any more
  struct Happens {                                        // at the present time
    BeadPair pair;
    Kind kind;
    std::uint32_t place;
    friend bool operator<(const Happens& a, const Happens& b) { return a.pair < b.pair; }
  };

  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;
  [[nodiscard]] std::vector<char> marked(std::span<const BeadId> beads) const;
  /// Gives up all certificates that name some of them.
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

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  std::size_t index_;
  MovingFamily<Dimension> family_;
  CertificateTable<Contact> disjoint_, overlapping_;
  PresentBeads<Dimension> present_;
  ContactSet contacts_;
  PairsOfBlocks pairs_;  // of the step
  std::vector<Happens> at_once_;
  std::vector<std::uint32_t> certificates_of_bead_;
};

static_assert(EditableStructure<Contacts<2>>);

}  // namespace kds
