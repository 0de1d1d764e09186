#pragma once
// Beads sorted along the first axis, kept sorted while they move: the smallest complete kinetic structure,
// and the one to read first, with its .cpp. One certificate a pair of neighbours; when it fails they trade
// places.

#include <cstddef>
#include <vector>

#include "certificates/types/precedes.h"
#include "kds/certificate_table.h"

namespace kds {

template <int Dimension>
class SortedList final : public KineticStructure {
 public:
  SortedList(Simulator& simulator, const MotionRef<Dimension>& motion);

  [[nodiscard]] std::string_view name() const override { return "sorted"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override;
  [[nodiscard]] const std::vector<BeadId>& order() const { return order_; }

  void build() override;
  void start_step() override;
  void fail(unsigned table, std::uint32_t slot) override;
  void apply(const Change& change) override;
  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override;

 private:
  void guard_all();
  [[nodiscard]] CertificateHandle watch(std::size_t i, KnownAtStart known);
  void interchange(std::size_t i, KnownAtStart known);

  Simulator& simulator_;
  MotionRef<Dimension> motion_;
  std::size_t index_;
  CertificateTable<Precedes> table_;
  std::vector<BeadId> order_;
  std::vector<CertificateHandle> guards_;  // of the pair at i and i+1; violated: none yet
  std::vector<std::size_t> unguarded_;
};

}  // namespace kds
