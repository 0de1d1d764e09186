#include "structures/chord_cages/chord_cages.h"

#include <utility>

#include "motions/base/floating_point_guard.h"

namespace kds {

namespace {

template <int D>
void bring_to(StaticWrappedHierarchy<D>& hierarchy, const Balls<D>& balls) {
  (void)hierarchy.update(balls);
}
template <int D>
void bring_to(LayeredHierarchy<D>& hierarchy, const BallRows<D>& balls) {
  hierarchy.build(balls);
}

}  // namespace

template <class Hierarchy>
ChordCages<Hierarchy>::ChordCages(std::span<const BeadRange> necklaces, int degree, bool keep_bases)
    : hierarchy_(necklaces),
      balls_(static_cast<std::size_t>(degree) + 1),
      cages_(static_cast<std::size_t>(degree) + 1),
      keep_bases_(keep_bases) {}

template <class Hierarchy>
void ChordCages<Hierarchy>::take(int k) {
  const auto place = static_cast<std::size_t>(k);
  bring_to(hierarchy_, balls_[place]);
  cages_[place].take(hierarchy_, balls_[place]);
}

template <class Hierarchy>
void ChordCages<Hierarchy>::build(const Curves<dimension>& curves) {
  const FloatingPointGuard to_nearest;
  moved_ = false;
  balls_.front().move_to(curves, 0);
  take(0);
}

template <class Hierarchy>
void ChordCages<Hierarchy>::move_to(const Curves<dimension>& curves) {
  const FloatingPointGuard to_nearest;
  if (moved_) {
    std::swap(balls_.front(), balls_.back());
    std::swap(cages_.front(), cages_.back());
  }
  if (!balls_[1].move_on_from(balls_.front(), curves)) {
    balls_.front().move_to(curves, 0);
    take(0);
  }
  if constexpr (requires { hierarchy_.bases(); }) {
    const auto bases = hierarchy_.bases();
    if (keep_bases_) start_bases_.assign(bases.begin(), bases.end());
  }
  for (int k = 1; k <= degree(); ++k) {
    if (k > 1) balls_[static_cast<std::size_t>(k)].move_to(curves, k);
    take(k);
  }
  moved_ = true;
}

template class ChordCages<StaticWrappedHierarchy<2>>;
template class ChordCages<StaticWrappedHierarchy<3>>;
template class ChordCages<LayeredHierarchy<2>>;
template class ChordCages<LayeredHierarchy<3>>;

}  // namespace kds
