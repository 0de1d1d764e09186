#include "structures/moving_sphere/bead_paths.h"

#include <cmath>

namespace kds {

namespace {

// The distance is at least that along the sum of both ends' differences, by control points. Where it is no
// small part of them the roundings, below 2^-45 of them, do not matter.
template <int D, int K>
[[KDS_LANES_TARGETS]] void find_apart(const BeadPaths<D>& paths, std::uint8_t* apart) {
  constexpr double up = 1 + 0x1p-30, part = 0x1p-10;
  for (BeadId b = 0; b + 1 < paths.bead_count(); b += Lanes::width) {
    std::array<std::array<Lanes, D>, K + 1> d;
    Lanes limit(0.0);  // the greatest square of a difference of radii, or of a part of d
    for (std::size_t k = 0; k <= K; ++k) {
      const auto to_next = [&](int axis) __attribute__((always_inline)) {
        const double* const column = paths.column(static_cast<int>(k), axis) + b;
        return Lanes(Lanes::load(column + 1)) - Lanes(Lanes::load(column));
      };
      Lanes square(0.0);
      for (std::size_t axis = 0; axis < D; ++axis) {
        d[k][axis] = to_next(static_cast<int>(axis));
        square += d[k][axis] * d[k][axis];
      }
      const Lanes s = to_next(D);
      limit = Lanes::max(limit, Lanes::max(s * s, Lanes(part * part) * square));
    }
    std::array<Lanes, D> along;
    Lanes length(0.0), least(HUGE_VAL);
    for (std::size_t axis = 0; axis < D; ++axis) {
      along[axis] = d[0][axis] + d[K][axis];
      length += along[axis] * along[axis];
    }
    for (std::size_t k = 0; k <= K; ++k) {
      Lanes product(0.0);
      for (std::size_t axis = 0; axis < D; ++axis) product += along[axis] * d[k][axis];
      least = Lanes::min(least, product);
    }
    // Away from overflow and from subnormal numbers.
    const Lanes::Mask are = (Lanes(paths.extent()) < Lanes(0x1p150)) & (limit > Lanes(0x1p-300)) &
                            (least > Lanes(0.0)) & (least * least > limit * length * Lanes(up));
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) apart[b + lane] = are[lane] != 0;
  }
}

}  // namespace

template <int Dimension>
void BeadPaths<Dimension>::find_apart_from_next(std::vector<std::uint8_t>& apart) const {
  apart.resize(beads_ + padding);
  switch (degree_) {
    case 1:
      return find_apart<Dimension, 1>(*this, apart.data());
    case 2:
      return find_apart<Dimension, 2>(*this, apart.data());
    default:
      return find_apart<Dimension, 3>(*this, apart.data());
  }
}

template class BeadPaths<2>;
template class BeadPaths<3>;

}  // namespace kds
