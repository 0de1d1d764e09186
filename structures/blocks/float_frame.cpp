#include "structures/blocks/float_frame.h"

#include "motions/numbers/lanes.h"

namespace kds {

namespace {

template <std::size_t Dimension>
[[KDS_LANES_TARGETS]] void place(const std::array<double, Dimension>& shift, double scale,
                                 const std::array<std::array<double, Dimension>, Dimension>& axes,
                                 const std::array<const double*, Dimension>& coordinates,
                                 const std::array<double*, Dimension>& places, std::size_t count) {
  for (std::size_t b = 0; b < count; b += Lanes::width) {
    std::array<Lanes, Dimension> from;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      from[axis] = Lanes::load(coordinates[axis] + b) * scale - shift[axis];
    for (std::size_t k = 0; k < Dimension; ++k) {
      Lanes sum = from[0].v * axes[k][0];
      for (std::size_t axis = 1; axis < Dimension; ++axis) sum += from[axis].v * axes[k][axis];
      __builtin_memcpy(places[k] + b, &sum.v, sizeof sum.v);
    }
  }
}

}  // namespace

template <int Dimension>
void place_along_axes(const FloatFrame<Dimension>& frame,
                      const std::array<const double*, static_cast<std::size_t>(Dimension)>& coordinates,
                      const std::array<double*, static_cast<std::size_t>(Dimension)>& places,
                      std::size_t count) {
  place(frame.shift, frame.scale, frame.axes.value(), coordinates, places, count);
}

template void place_along_axes(const FloatFrame<2>&, const std::array<const double*, 2>&,
                               const std::array<double*, 2>&, std::size_t);
template void place_along_axes(const FloatFrame<3>&, const std::array<const double*, 3>&,
                               const std::array<double*, 3>&, std::size_t);

}  // namespace kds
