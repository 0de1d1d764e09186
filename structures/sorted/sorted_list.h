#pragma once
// Beads sorted along the first axis, kept sorted while they move. The sorted list is the smallest complete
// kinetic structure; read it first, together with its .cpp. Each pair of neighbours has one certificate; when
// it fails, the two beads swap. Inserting, erasing or redirecting a bead costs a few certificates and a shift
// of the list.

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "certificates/types/precedes.h"
#include "kds/certified_places.h"

namespace kds {

template <int Dimension>
class SortedList final : public CertifiedPlaces<Precedes, EditableBase> {
 public:
  /// Kinds of events, with these ids: `interchanges`, the bead that was first, then the other; `inserts`, the
  /// bead, then the bead before it or no_bead; `erases`, the bead; `changes`, the bead on another curve.
  enum Kind : std::uint8_t { interchanges, inserts, erases, changes };

  SortedList(Simulator& simulator, const MotionRef<Dimension>& motion);

  [[nodiscard]] const std::vector<BeadId>& order() const { return order_; }

  void build() override;
  void start_step() override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  // Place i is the pair of neighbours at i and i + 1.
  [[nodiscard]] std::size_t place_count() const override { return order_.empty() ? 0 : order_.size() - 1; }
  [[nodiscard]] Precedes certificate(std::size_t i) const override { return {{order_[i], order_[i + 1]}}; }
  void repair(std::size_t i) override;

  void edit(std::uint8_t kind, BeadId bead) override;
  void release(std::span<const BeadId> beads) override;
  void follow(std::span<const BeadId>) override { certify_all(); }
  void add(BeadId bead);
  void remove(BeadId bead);
  /// Returns the index in the order where an absent bead belongs just after now.
  [[nodiscard]] std::size_t index_for(BeadId bead);
  void put_in(std::size_t i, BeadId bead);
  std::size_t take_out(BeadId bead);

  MotionRef<Dimension> motion_;
  std::vector<BeadId> order_;
};

static_assert(EditableStructure<SortedList<1>>);

}  // namespace kds
