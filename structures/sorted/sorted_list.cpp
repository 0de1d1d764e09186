#include "structures/sorted/sorted_list.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace kds {

namespace {

constexpr std::array<IdRole, 2> interchanged_beads{{{"first"}, {"second"}}};
constexpr std::array<IdRole, 2> inserted_bead{{{"bead"}, {"after"}}};
constexpr auto list_kinds =
    with_edits(std::array{EventKind{"interchange", true, false, interchanged_beads}}, inserted_bead);
static_assert(list_kinds.size() == SortedList<1>::changes + 1);

}  // namespace

template <int D>
SortedList<D>::SortedList(Simulator& simulator, const MotionRef<D>& motion)
    : CertifiedPlaces(simulator, motion, "sorted", list_kinds), motion_(motion) {}

template <int D>
void SortedList<D>::build() {
  const Curves<D> curves = motion_.curves();
  present().structure_is_built();
  order_ = present().all();
  // Just after u = 0, the first control points that differ decide.
  std::stable_sort(order_.begin(), order_.end(), [&](BeadId a, BeadId b) {
    int k = 0;
    while (k < curves.own_degree() && curves.coordinate(a, k, 0) == curves.coordinate(b, k, 0)) ++k;
    return curves.coordinate(a, k, 0) < curves.coordinate(b, k, 0);
  });
}

template <int D>
void SortedList<D>::start_step() {
  CertifiedPlaces::start_step();
  auto& most = statistics.certificates.per_bead_max;
  most = std::max<std::uint64_t>(most, std::min<std::size_t>(2, place_count()));
}

template <int D>
void SortedList<D>::repair(std::size_t i) {
  record(interchanges, {order_[i], order_[i + 1]});
  std::swap(order_[i], order_[i + 1]);
  for (const std::size_t beside : {i - 1, i + 1}) {  // i - 1 wraps round at 0
    if (beside < place_count()) certify_anew(beside);
  }
}

// Edits: beads are inserted, erased, or change course.

template <int D>
void SortedList<D>::edit(std::uint8_t kind, BeadId bead) {
  kind == inserts ? add(bead) : remove(bead);
  certify_all();
}

template <int D>
std::size_t SortedList<D>::index_for(BeadId bead) {
  const auto comes_first = [&](BeadId other) { return sign_just_after({{other, bead}}) >= 0; };
  return static_cast<std::size_t>(std::partition_point(order_.begin(), order_.end(), comes_first) -
                                  order_.begin());
}

template <int D>
void SortedList<D>::add(BeadId bead) {
  const std::size_t i = index_for(bead), pairs = place_count();
  record(inserts, {bead, i == 0 ? no_bead : order_[i - 1]});
  put_in(i, bead);
  if (order_.size() < 2) return;
  insert_place(std::min(i, pairs));
  if (i > 0 && i + 1 < order_.size()) certify_anew(i - 1);  // the bead separates this pair
}

template <int D>
void SortedList<D>::remove(BeadId bead) {
  record(erases, {bead});
  const std::size_t i = take_out(bead);
  if (order_.empty()) return;
  erase_place(std::min(i, place_count()));
  if (i > 0 && i < order_.size()) certify_anew(i - 1);  // the bead separated this pair
}

template <int D>
void SortedList<D>::put_in(std::size_t i, BeadId bead) {
  present().set_absent(bead, false);
  order_.insert(order_.begin() + static_cast<std::ptrdiff_t>(i), bead);
}

template <int D>
std::size_t SortedList<D>::take_out(BeadId bead) {
  present().set_absent(bead, true);
  const auto at = std::find(order_.begin(), order_.end(), bead);
  return static_cast<std::size_t>(order_.erase(at) - order_.begin());
}

template <int D>
void SortedList<D>::release(std::span<const BeadId> beads) {
  std::vector<char> among(bead_count(), 0);
  for (const BeadId bead : beads) among[bead] = 1;
  for (std::size_t i = 0; i < place_count(); ++i)
    if (among[order_[i]] != 0 || among[order_[i + 1]] != 0) certify_anew(i);
}

template <int D>
void SortedList<D>::apply(const Change& change) {
  const BeadId bead = change.ids[0];
  if (change.size != (change.kind == interchanges || change.kind == inserts ? 2 : 1))
    throw std::invalid_argument("a change of a list has other numbers of beads");
  if (change.kind != interchanges) {
    present().require(bead, change.kind == inserts);
    if (change.kind == erases) take_out(bead);
    if (change.kind != inserts) return;
    const BeadId before = change.ids[1];
    if (before == no_bead) return put_in(0, bead);
    present().require(before, false);
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
    if (table().search().sign_at(pair, time) < 0) {
      return "beads " + std::to_string(order_[i]) + " and " + std::to_string(order_[i + 1]) +
             " are out of order";
    }
  }
  if (order_.size() != present().count())
    return std::to_string(order_.size()) + " beads are in order, of " + std::to_string(present().count());
  return std::nullopt;
}

template class SortedList<1>;
template class SortedList<2>;
template class SortedList<3>;

}  // namespace kds
