#pragma once
// Beads sorted along the first axis, kept sorted while they move. This is the smallest complete kinetic
// structure; read it first, together with its .cpp. Each pair of neighbours has one certificate; when it
// fails, the two beads trade places. Inserting, erasing or redirecting a bead costs a few certificates and a
// shift of the list.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/types/precedes.h"
#include "kds/bead_edits.h"
#include "kds/certificate_table.h"
#include "kds/present_beads.h"

namespace kds {

template <int Dimension>
class SortedList final : public KineticStructure, public BeadEdits {
 public:
  /// Kinds of events, with these ids: `interchanges`, the bead that was first, then the other; `inserts`, the
  /// bead, then the bead before it or no_bead; `erases`, the bead; `changes`, the bead on another curve.
  enum Kind : std::uint8_t { interchanges, inserts, erases, changes };

  SortedList(Simulator& simulator, const MotionRef<Dimension>& motion);

  [[nodiscard]] std::string_view name() const override { return "sorted"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  [[nodiscard]] const std::vector<BeadId>& order() const { return order_; }

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
  void release(std::span<const BeadId> beads) override;
  void take_up(std::span<const BeadId> beads) override;
  /// Returns the place in the order where an absent bead belongs just after now.
  [[nodiscard]] std::size_t place_for(BeadId bead);
  void put_in(std::size_t i, BeadId bead);
  std::size_t take_out(BeadId bead);
  void give_up(std::size_t i);
  void renumber_from(std::size_t i);
  void guard_all();
  [[nodiscard]] CertificateHandle watch(std::size_t i, KnownAtStart known);
  void interchange(std::size_t i, KnownAtStart known);

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  std::size_t index_;
  CertificateTable<Precedes> table_;
  PresentBeads<Dimension> present_;
  std::vector<BeadId> order_;
  std::vector<CertificateHandle> guards_;  // for the pair at i and i+1; violated: no guard
  std::vector<std::size_t> unguarded_;
};

static_assert(EditableStructure<SortedList<1>>);

}  // namespace kds
