#pragma once
// What the formulas of relaxed spheres are about: beads and a relaxation, and the whole numbers it stands
// for.

#include <array>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "certificates/base/relaxation.h"
#include "motions/base/bead.h"
#include "motions/numbers/bernstein.h"

namespace kds {

/// By default the greatest relaxation there is, so that bounds
/// derived from the formula hold for all.
template <std::size_t N>
struct RelaxedBeads : std::array<BeadId, N> {
  Relaxation relaxation = Relaxation::greatest();
};

namespace detail {

/// A whole number of times a polynomial.
template <class Number, int Degree>
[[nodiscard]] Bernstein<Number, Degree> times(std::int64_t factor, Bernstein<Number, Degree> p) {
  for (Number& c : p.scaled) {
    if constexpr (std::is_floating_point_v<Number>) {
      c *= static_cast<Number>(factor);
    } else if constexpr (requires { Number::constant(1.0); }) {
      c = Number::constant(static_cast<double>(factor)) * c;
    } else if constexpr (requires { c *= static_cast<long long>(factor); }) {
      c *= static_cast<long long>(factor);
    } else {
      c = Number{static_cast<double>(factor)} * c;
    }
  }
  return p;
}

}  // namespace detail

}  // namespace kds

template <std::size_t N>
struct std::tuple_size<kds::RelaxedBeads<N>> : std::integral_constant<std::size_t, N> {};
