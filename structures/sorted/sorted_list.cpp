#include "structures/sorted/sorted_list.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>
#include <string>

namespace kds {

template <int D>
SortedList<D>::SortedList(Simulator& simulator, const MotionRef<D>& motion)
    : simulator_(simulator),
      motion_(motion),
      index_(simulator.add(*this)),
      table_(simulator, *this, index_, 0, motion) {}

template <int D>
std::span<const EventKind> SortedList<D>::kinds() const {
  static constexpr std::array<EventKind, 1> kinds{
      {{"interchange"}}};  // ids: the bead that was left, the other
  return kinds;
}

template <int D>
void SortedList<D>::build() {
  const Curves<D> curves = motion_.curves();
  order_.resize(curves.bead_count());
  std::iota(order_.begin(), order_.end(), BeadId{0});
  // The first control points that differ decide just after u = 0.
  std::stable_sort(order_.begin(), order_.end(), [&](BeadId a, BeadId b) {
    int k = 0;
    while (k < curves.own_degree() && curves.coordinate(a, k, 0) == curves.coordinate(b, k, 0)) ++k;
    return curves.coordinate(a, k, 0) < curves.coordinate(b, k, 0);
  });
}

template <int D>
void SortedList<D>::start_step() {
  guards_.assign(order_.empty() ? 0 : order_.size() - 1, CertificateHandle::violated);
  for (std::size_t i = guards_.size(); i-- > 0;) unguarded_.push_back(i);
  guard_all();
  auto& most = statistics.certificates.per_bead_max;
  most = std::max<std::uint64_t>(most, std::min<std::size_t>(2, guards_.size()));
}

template <int D>
void SortedList<D>::fail(unsigned, std::uint32_t slot) {
  interchange(table_.place_in_structure(slot), KnownAtStart::at_own_root);
  guard_all();
}

/// Guards the pairs that wait for it; one that is out of order just after now trades places at once.
template <int D>
void SortedList<D>::guard_all() {
  while (!unguarded_.empty()) {
    const std::size_t i = unguarded_.back();
    unguarded_.pop_back();
    if (guards_[i] == CertificateHandle::violated) guards_[i] = watch(i, KnownAtStart::unknown);
    if (guards_[i] == CertificateHandle::violated) interchange(i, KnownAtStart::unknown);
  }
}

template <int D>
CertificateHandle SortedList<D>::watch(std::size_t i, KnownAtStart known) {
  return table_.watch({{order_[i], order_[i + 1]}}, static_cast<std::uint32_t>(i), known);
}

template <int D>
void SortedList<D>::interchange(std::size_t i, KnownAtStart known) {
  simulator_.record(index_, Change{0, 2, {order_[i], order_[i + 1]}});
  std::swap(order_[i], order_[i + 1]);
  guards_[i] = watch(i, known);
  for (const std::size_t beside : {i - 1, i + 1}) {  // i - 1 wraps round at 0
    if (beside >= guards_.size()) continue;
    table_.drop(guards_[beside]);
    guards_[beside] = CertificateHandle::violated;
    unguarded_.push_back(beside);
  }
}

template <int D>
void SortedList<D>::apply(const Change& change) {
  const auto i =
      static_cast<std::size_t>(std::find(order_.begin(), order_.end(), change.ids[0]) - order_.begin());
  if (i + 1 >= order_.size() || order_[i + 1] != change.ids[1])
    throw std::invalid_argument("the beads are not neighbours in this order");
  std::swap(order_[i], order_[i + 1]);
}

template <int D>
std::optional<std::string> SortedList<D>::audit(const Dyadic& time) {
  for (std::size_t i = 0; i + 1 < order_.size(); ++i) {
    const Precedes pair{{order_[i], order_[i + 1]}};
    if (table_.search().sign_at(pair, time) < 0) {
      return "beads " + std::to_string(order_[i]) + " and " + std::to_string(order_[i + 1]) +
             " are out of order";
    }
  }
  return std::nullopt;
}

template class SortedList<1>;
template class SortedList<2>;
template class SortedList<3>;

}  // namespace kds
