#pragma once
// Beads sorted along the first axis, kept sorted while they move: the smallest complete kinetic structure,
// and the one to read first. One certificate a pair of neighbours; when it fails they trade places.

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "certificates/precedes.h"
#include "kds/certificate_table.h"

namespace kds {

template <Motion M, Kernel K>
class SortedList final : public KineticStructure {
 public:
  SortedList(Simulator& simulator, const M& motion)
      : simulator_(simulator),
        motion_(motion),
        index_(simulator.add(*this)),
        table_(simulator, *this, index_, 0, motion) {}

  [[nodiscard]] std::string_view name() const override { return "sorted"; }
  [[nodiscard]] std::span<const EventKind> kinds() const override {
    static constexpr std::array<EventKind, 1> kinds{
        {{"interchange"}}};  // ids: the bead that was left, the other
    return kinds;
  }
  [[nodiscard]] const std::vector<BeadId>& order() const { return order_; }

  void build() override {
    order_.resize(motion_.bead_count());
    std::iota(order_.begin(), order_.end(), BeadId{0});
    // The first control points that differ decide just after u = 0.
    std::stable_sort(order_.begin(), order_.end(), [this](BeadId a, BeadId b) {
      int k = 0;
      while (k < M::degree && motion_.coordinate(a, k, 0) == motion_.coordinate(b, k, 0)) ++k;
      return motion_.coordinate(a, k, 0) < motion_.coordinate(b, k, 0);
    });
  }

  void start_step() override {
    guards_.assign(order_.empty() ? 0 : order_.size() - 1, Guard::violated);
    for (std::size_t i = 0; i < guards_.size(); ++i) watch(i);
    statistics.certificates.per_bead_max = std::max<std::uint64_t>(statistics.certificates.per_bead_max,
                                                                   std::min<std::size_t>(2, guards_.size()));
  }

  void fail(unsigned, std::uint32_t slot) override {
    const std::size_t i = table_.place_in_structure(slot);
    guards_[i] = Guard::violated;  // it is gone already
    interchange(i);
  }

  void apply(const Change& change) override {
    const auto i =
        static_cast<std::size_t>(std::find(order_.begin(), order_.end(), change.ids[0]) - order_.begin());
    if (i + 1 >= order_.size() || order_[i + 1] != change.ids[1])
      throw std::invalid_argument("the beads are not neighbours in this order");
    std::swap(order_[i], order_[i + 1]);
  }

  [[nodiscard]] std::optional<std::string> audit(const Dyadic& time) override {
    for (std::size_t i = 0; i + 1 < order_.size(); ++i) {
      const Precedes pair{{order_[i], order_[i + 1]}};
      if (pair.function(MomentView<M>(motion_, pair.beads, time)).scaled[0] < 0) {
        return "beads " + std::to_string(order_[i]) + " and " + std::to_string(order_[i + 1]) +
               " are out of order";
      }
    }
    return std::nullopt;
  }

 private:
  /// Guards the pair at i and i+1, or trades its places at once if it is already out of order just after now.
  void watch(std::size_t i, Birth birth = Birth::unknown) {
    guards_[i] = table_.watch({{order_[i], order_[i + 1]}}, static_cast<std::uint32_t>(i), birth);
    if (guards_[i] == Guard::violated) interchange(i);
  }

  void interchange(std::size_t i) {
    const Change change{0, 2, {order_[i], order_[i + 1]}};
    simulator_.record(index_, change);
    std::swap(order_[i], order_[i + 1]);
    if (i > 0) table_.drop(guards_[i - 1]);
    if (i + 1 < guards_.size()) table_.drop(guards_[i + 1]);
    watch(i, Birth::at_own_root);
    if (i > 0) watch(i - 1);
    if (i + 1 < guards_.size()) watch(i + 1);
  }

  Simulator& simulator_;
  const M& motion_;
  std::size_t index_;
  CertificateTable<Precedes, M, K> table_;
  std::vector<BeadId> order_;
  std::vector<Guard> guards_;  // of the pair at i and i+1
};

}  // namespace kds
