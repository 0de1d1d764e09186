#pragma once
// The arguments of the formulas of relaxed spheres: beads and a relaxation.

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>

#include "certificates/base/relaxation.h"
#include "motions/base/bead.h"

namespace kds {

/// The default is the greatest relaxation, so that bounds derived from the formula hold for all.
template <std::size_t N>
struct RelaxedBeads : std::array<BeadId, N> {
  Relaxation relaxation = Relaxation::greatest();

  friend constexpr bool operator==(const RelaxedBeads&, const RelaxedBeads&) = default;
};

}  // namespace kds

template <std::size_t N>
struct std::tuple_size<kds::RelaxedBeads<N>> : std::integral_constant<std::size_t, N> {};
