#include "structures/contacts/near_balls.h"

#include "structures/necklace/pairs_in_question.h"

namespace kds {

template <int D>
void NearBalls<D>::find(const Curves<D>& curves, Kernel kernel, Resting resting, bool list_overlapping,
                        ShiftNumbers<D>& shifts, PairsOfImages& found) {
  if (curves.cell() != nullptr) {
    if (kernel == Kernel::exact) {
      images_.find_by_boxes(curves, shifts, found);
    } else {
      images_.find(curves, list_overlapping, shifts, found);
    }
    return;
  }
  found.clear();
  if (kernel == Kernel::exact) {
    PairsInQuestion(asked()).for_each([&](BeadId i, BeadId j) { found.unclear.push_back({{i, j}}); });
    return;
  }
  family_.find_pairs(curves, resting, list_overlapping, of_blocks_);
  for (const BeadPair& pair : of_blocks_.unclear) found.unclear.push_back({pair});
  for (const BeadPair& pair : of_blocks_.overlapping) found.overlapping.push_back({pair});
  found.proved = family_.size() + of_blocks_.proved_apart;
}

template <int D>
void NearBalls<D>::find_of(const Curves<D>& curves, std::span<const BeadId> beads, Kernel kernel,
                           Resting resting, bool list_overlapping, ShiftNumbers<D>& shifts,
                           PairsOfImages& found) {
  if (curves.cell() == nullptr || kernel == Kernel::exact)
    return find(curves, kernel, resting, list_overlapping, shifts, found);
  images_.find_of(curves, beads, list_overlapping, shifts, found);
}

template class NearBalls<2>;
template class NearBalls<3>;

}  // namespace kds
