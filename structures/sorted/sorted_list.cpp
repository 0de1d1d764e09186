#include "structures/sorted/sorted_list.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace kds {

template <int D>
SortedList<D>::SortedList(Simulator& simulator, const MotionRef<D>& motion)
    : simulator_(simulator),
      motion_(motion),
      index_(simulator.add(*this)),
      table_(simulator, *this, index_, 0, motion),
      present_(name(), motion) {}

template <int D>
std::span<const EventKind> SortedList<D>::kinds() const {
  static constexpr std::array<IdRole, 2> interchanged{{{"first"}, {"second"}}};
  static constexpr std::array<IdRole, 2> inserted{{{"bead"}, {"after"}}};
  static constexpr std::array<IdRole, 1> bead{{{"bead"}}};
  static constexpr std::array<EventKind, 4> kinds{{{"interchange", true, false, interchanged},
                                                   {"insert", false, true, inserted},
                                                   {"erase", false, true, bead},
                                                   {"change", false, true, bead}}};
  return kinds;
}

template <int D>
void SortedList<D>::build() {
  const Curves<D> curves = motion_.curves();
  present_.structure_is_built();
  order_ = present_.all();
  // Just after u = 0, the first control points that differ decide.
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

/// Guards all pairs that have no guard. A pair that is out of order just after now trades places at once.
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
  simulator_.record(index_, Change{interchanges, 2, {order_[i], order_[i + 1]}});
  std::swap(order_[i], order_[i + 1]);
  guards_[i] = watch(i, known);
  for (const std::size_t beside : {i - 1, i + 1}) {  // i - 1 wraps round at 0
    if (beside < guards_.size()) give_up(beside);
  }
}

template <int D>
void SortedList<D>::give_up(std::size_t i) {
  table_.drop(guards_[i]);
  guards_[i] = CertificateHandle::violated;
  unguarded_.push_back(i);
}

// Edits: beads are inserted, erased, or change course.

template <int D>
std::size_t SortedList<D>::place_for(BeadId bead) {
  const auto comes_first = [&](BeadId other) {
    const Precedes pair{{other, bead}};
    return table_.search().sign_just_after(simulator_.kernel(), pair, simulator_.now(), statistics.stages) >=
           0;
  };
  return static_cast<std::size_t>(std::partition_point(order_.begin(), order_.end(), comes_first) -
                                  order_.begin());
}

template <int D>
void SortedList<D>::insert(BeadId bead) {
  const Simulator::ComputeScope scope(simulator_);
  present_.require(bead, true);
  simulator_.require_standing_still();
  const std::size_t i = place_for(bead);
  simulator_.record(index_, Change{inserts, 2, {bead, i == 0 ? no_bead : order_[i - 1]}});
  put_in(i, bead);
  if (order_.size() < 2) return;
  const std::size_t guard = std::min(i, guards_.size());
  guards_.insert(guards_.begin() + static_cast<std::ptrdiff_t>(guard), CertificateHandle::violated);
  renumber_from(guard + 1);
  give_up(guard);
  if (i > 0 && i + 1 < order_.size()) give_up(i - 1);  // the bead separates this pair
  guard_all();
}

template <int D>
void SortedList<D>::erase(BeadId bead) {
  const Simulator::ComputeScope scope(simulator_);
  present_.require(bead, false);
  simulator_.require_standing_still();
  simulator_.record(index_, Change{erases, 1, {bead}});
  const std::size_t i = take_out(bead);
  if (guards_.empty()) return;
  const std::size_t guard = std::min(i, guards_.size() - 1);
  table_.drop(guards_[guard]);
  guards_.erase(guards_.begin() + static_cast<std::ptrdiff_t>(guard));
  renumber_from(guard);
  if (i > 0 && i < order_.size()) give_up(i - 1);  // the bead separated this pair
  guard_all();
}

template <int D>
void SortedList<D>::put_in(std::size_t i, BeadId bead) {
  present_.set_absent(bead, false);
  order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(i), bead);
}

template <int D>
std::size_t SortedList<D>::take_out(BeadId bead) {
  present_.set_absent(bead, true);
  const auto at = std::find(order_.begin(), order_.end(), bead);
  return static_cast<std::size_t>(order_.erase(at) - order_.begin());
}

/// Updates the places stored with the certificates of the pairs from i on.
template <int D>
void SortedList<D>::renumber_from(std::size_t i) {
  for (; i < guards_.size(); ++i) table_.set_place(guards_[i], static_cast<std::uint32_t>(i));
}

template <int D>
void SortedList<D>::release(std::span<const BeadId> beads) {
  std::vector<char> among(motion_.bead_count(), 0);
  for (const BeadId bead : beads) among[bead] = 1;
  for (std::size_t i = 0; i < guards_.size(); ++i)
    if (among[order_[i]] != 0 || among[order_[i + 1]] != 0) give_up(i);
}

template <int D>
void SortedList<D>::take_up(std::span<const BeadId> beads) {
  for (const BeadId bead : beads)
    if (!is_absent(bead)) simulator_.record(index_, Change{changes, 1, {bead}});
  guard_all();
}

template <int D>
void SortedList<D>::apply(const Change& change) {
  const BeadId bead = change.ids[0];
  if (change.size != (change.kind == interchanges || change.kind == inserts ? 2 : 1))
    throw std::invalid_argument("a change of a list has other numbers of beads");
  if (change.kind != interchanges) {
    present_.require(bead, change.kind == inserts);
    if (change.kind == erases) take_out(bead);
    if (change.kind != inserts) return;
    const BeadId before = change.ids[1];
    if (before == no_bead) return put_in(0, bead);
    present_.require(before, false);
    const auto at = std::find(order_.begin(), order_.end(), before);
    return put_in(static_cast<std::size_t>(at - order_.begin()) + 1, bead);
  }
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
  if (order_.size() != present_.count())
    return std::to_string(order_.size()) + " beads are in order, of " + std::to_string(present_.count());
  return std::nullopt;
}

template class SortedList<1>;
template class SortedList<2>;
template class SortedList<3>;

}  // namespace kds
