#pragma once
// Beads sorted along the first axis, kept sorted while they move: the smallest complete kinetic structure,
// and the one to read first. One certificate a pair of neighbours; when it fails they trade places.

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <vector>

#include "certificates/types/precedes.h"
#include "kds/certificate_table.h"
#include "motions/views/integer_view.h"

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
    guards_.assign(order_.empty() ? 0 : order_.size() - 1, CertificateHandle::violated);
    for (std::size_t i = guards_.size(); i-- > 0;) unguarded_.push_back(i);
    guard_all();
    auto& most = statistics.certificates.per_bead_max;
    most = std::max<std::uint64_t>(most, std::min<std::size_t>(2, guards_.size()));
  }

  void fail(unsigned, std::uint32_t slot) override {
    interchange(table_.place_in_structure(slot), KnownAtStart::at_own_root);
    guard_all();
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
      if (function_of(pair, MomentView<M>(motion_, pair.beads, time)).scaled[0] < 0) {
        return "beads " + std::to_string(order_[i]) + " and " + std::to_string(order_[i + 1]) +
               " are out of order";
      }
    }
    return std::nullopt;
  }

 private:
  /// Guards the pairs that wait for it; one that is out of order just after now trades places at once.
  void guard_all() {
    while (!unguarded_.empty()) {
      const std::size_t i = unguarded_.back();
      unguarded_.pop_back();
      if (guards_[i] == CertificateHandle::violated) guards_[i] = watch(i, KnownAtStart::unknown);
      if (guards_[i] == CertificateHandle::violated) interchange(i, KnownAtStart::unknown);
    }
  }
  [[nodiscard]] CertificateHandle watch(std::size_t i, KnownAtStart birth) {
    return table_.watch({{order_[i], order_[i + 1]}}, static_cast<std::uint32_t>(i), birth);
  }
  void interchange(std::size_t i, KnownAtStart birth) {
    simulator_.record(index_, Change{0, 2, {order_[i], order_[i + 1]}});
    std::swap(order_[i], order_[i + 1]);
    guards_[i] = watch(i, birth);
    for (const std::size_t beside : {i - 1, i + 1}) {  // i - 1 wraps round at 0
      if (beside >= guards_.size()) continue;
      table_.drop(guards_[beside]);
      guards_[beside] = CertificateHandle::violated;
      unguarded_.push_back(beside);
    }
  }

  Simulator& simulator_;
  const M& motion_;
  std::size_t index_;
  CertificateTable<Precedes, M, K> table_;
  std::vector<BeadId> order_;
  std::vector<CertificateHandle> guards_;  // of the pair at i and i+1; violated: none yet
  std::vector<std::size_t> unguarded_;
};

}  // namespace kds
