#include "structures/blocks/float_conversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "motions/numbers/lanes.h"

namespace kds {

namespace {

template <std::size_t Dimension>
[[KDS_LANES_TARGETS]] void turn(const std::array<double, Dimension>& shift, double scale,
                                const std::array<std::array<double, Dimension>, Dimension>& axes,
                                const std::array<const double*, Dimension>& coordinates,
                                const std::array<double*, Dimension>& turned, std::size_t count) {
  for (std::size_t b = 0; b < count; b += Lanes::width) {
    std::array<Lanes, Dimension> from;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      from[axis] = Lanes::load(coordinates[axis] + b) * scale - shift[axis];
    for (std::size_t k = 0; k < Dimension; ++k) {
      Lanes sum = from[0].v * axes[k][0];
      for (std::size_t axis = 1; axis < Dimension; ++axis) sum += from[axis].v * axes[k][axis];
      __builtin_memcpy(turned[k] + b, &sum.v, sizeof sum.v);
    }
  }
}

template <int Dimension>
using Direction = std::array<double, static_cast<std::size_t>(Dimension)>;

template <std::size_t Dimension>
double dot(const std::array<double, Dimension>& a, const std::array<double, Dimension>& b) {
  double sum = 0;
  for (std::size_t axis = 0; axis < Dimension; ++axis) sum += a[axis] * b[axis];
  return sum;
}

/// Returns `a` scaled to length one, or none if its length is negligible compared with one.
template <std::size_t Dimension>
std::optional<std::array<double, Dimension>> unit(std::array<double, Dimension> a, double least) {
  const double length = std::sqrt(dot(a, a));
  if (!(length > least && std::isfinite(length))) return std::nullopt;
  for (double& x : a) x /= length;
  return a;
}

template <int Dimension>
std::vector<Direction<Dimension>> some_bonds(const Balls<Dimension>& balls, double scale, std::size_t most) {
  const std::size_t bonds = balls.size() - 1, count = std::min(most, bonds);
  std::vector<Direction<Dimension>> directions;
  for (std::size_t k = 0; k < count; ++k) {
    const auto b = static_cast<BeadId>(k * bonds / count);
    Direction<Dimension> step;
    for (std::size_t axis = 0; axis < Dimension; ++axis)
      step[axis] = balls.coordinate(b + 1, axis) * scale - balls.coordinate(b, axis) * scale;
    if (const auto direction = unit(step, 0x1p-200)) directions.push_back(*direction);
  }
  return directions;
}

/// Returns how much longer the bonds are on average along the axes (sum of absolute components) than
/// straight. The result is 0 if every bond lies along an axis.
template <int Dimension>
double detour(const std::vector<Direction<Dimension>>& bonds, const Axes<Dimension>& axes) {
  double sum = 0;
  for (const auto& bond : bonds)
    for (const auto& axis : axes) sum += std::abs(dot(axis, bond));
  return sum / static_cast<double>(bonds.size()) - 1;
}

/// Returns axes with the first along `first` and the next as close to `second` as a perpendicular can be.
/// Returns none if `second` is nearly parallel to `first`.
template <int Dimension>
std::optional<Axes<Dimension>> axes_along(const Direction<Dimension>& first, Direction<Dimension> second) {
  if constexpr (Dimension == 2) {
    return Axes<2>{first, {-first[1], first[0]}};
  } else {
    const double along = dot(first, second);
    for (std::size_t axis = 0; axis < 3; ++axis) second[axis] -= along * first[axis];
    const auto across = unit(second, 0.25);
    if (!across) return std::nullopt;
    const auto& [a, b, c] = first;
    const auto& [d, e, f] = *across;
    return Axes<3>{first, *across, {b * f - c * e, c * d - a * f, a * e - b * d}};
  }
}

/// Returns axes made from one bond and the bond most nearly perpendicular to it.
template <int Dimension>
std::optional<Axes<Dimension>> axes_from(const std::vector<Direction<Dimension>>& bonds, std::size_t first) {
  const auto across = std::min_element(bonds.begin(), bonds.end(), [&](const auto& a, const auto& b) {
    return std::abs(dot(a, bonds[first])) < std::abs(dot(b, bonds[first]));
  });
  return axes_along<Dimension>(bonds[first], *across);
}

/// Returns axes along the mean directions of the bonds nearest to each axis.
template <int Dimension>
std::optional<Axes<Dimension>> averaged(const std::vector<Direction<Dimension>>& bonds,
                                        const Axes<Dimension>& axes) {
  Axes<Dimension> sums = axes;
  for (const auto& bond : bonds) {
    for (std::size_t k = 0; k < Dimension; ++k) {
      const double along = dot(axes[k], bond);
      if (std::abs(along) < 0.9) continue;
      for (std::size_t axis = 0; axis < Dimension; ++axis)
        sums[k][axis] += along < 0 ? -bond[axis] : bond[axis];
    }
  }
  const auto first = unit(sums[0], 0.25), second = unit(sums[1], 0.25);
  return first && second ? axes_along<Dimension>(*first, *second) : std::nullopt;
}

}  // namespace

template <int Dimension>
void turn_to_axes(const FloatConversion<Dimension>& conversion,
                  const std::array<const double*, static_cast<std::size_t>(Dimension)>& coordinates,
                  const std::array<double*, static_cast<std::size_t>(Dimension)>& turned, std::size_t count) {
  turn(conversion.shift, conversion.scale, conversion.axes.value(), coordinates, turned, count);
}

template void turn_to_axes(const FloatConversion<2>&, const std::array<const double*, 2>&,
                           const std::array<double*, 2>&, std::size_t);
template void turn_to_axes(const FloatConversion<3>&, const std::array<const double*, 3>&,
                           const std::array<double*, 3>&, std::size_t);

template <int Dimension>
std::optional<Axes<Dimension>> bond_axes(const Balls<Dimension>& balls, double scale) {
  constexpr double much_better = 0.5;
  if (balls.size() < 2) return std::nullopt;
  constexpr std::size_t few = 32;
  const auto bonds = some_bonds(balls, scale, few);
  if (bonds.empty()) return std::nullopt;
  Axes<Dimension> own{};
  for (std::size_t k = 0; k < Dimension; ++k) own[k][k] = 1;
  const double short_enough = much_better * detour<Dimension>(bonds, own);
  constexpr std::size_t tries = 3;
  for (std::size_t k = 0; k < tries; ++k) {
    auto axes = axes_from<Dimension>(bonds, k * bonds.size() / tries);
    if (axes) axes = averaged<Dimension>(bonds, *axes);
    if (!axes || detour<Dimension>(bonds, *axes) >= short_enough) continue;
    // A long row of beads leaves its box in proportion to the error of the axes, so more bonds are sampled
    // now.
    return averaged<Dimension>(some_bonds(balls, scale, few + std::min<std::size_t>(balls.size() / 32, 2000)),
                               *axes);
  }
  return std::nullopt;
}

template std::optional<Axes<2>> bond_axes(const Balls<2>&, double);
template std::optional<Axes<3>> bond_axes(const Balls<3>&, double);

}  // namespace kds
