#pragma once
// The relaxation of enclosing spheres: the share of the sphere's radius by which its certificates may be
// exceeded before they fail. The share is a multiple of 2^-20, so its square is exact in double and a small
// multiple of 2^-40.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <type_traits>

#include "motions/base/bead.h"

namespace kds {

class Relaxation {
 public:
  static constexpr int digits = 20;
  static constexpr std::int64_t most = std::int64_t{1} << digits;  ///< a share of 1
  static constexpr double least_share = 0x1p-20;                   ///< the smallest share other than zero

  constexpr Relaxation() = default;
  /// Returns the largest relaxation that is at most `share`, a number from 0 to 1.
  [[nodiscard]] static Relaxation of(double share) {
    return Relaxation(static_cast<std::int64_t>(std::floor(std::ldexp(share, digits))));
  }
  [[nodiscard]] static constexpr Relaxation greatest() { return Relaxation(most); }

  [[nodiscard]] constexpr bool any() const { return units_ > 0; }
  /// Returns the share. Exact.
  [[nodiscard]] constexpr double share() const { return static_cast<double>(units_) * 0x1p-20; }
  /// Returns the share in units of 2^-20.
  [[nodiscard]] constexpr std::int64_t units() const { return units_; }
  /// Returns (1 + share)^2 - 1 in units of 2^-40.
  [[nodiscard]] constexpr std::int64_t square_units() const { return units_ * (2 * most + units_); }
  static constexpr std::int64_t one_squared = most * most;  ///< 1 in these units

  friend constexpr bool operator==(const Relaxation&, const Relaxation&) = default;

 private:
  explicit constexpr Relaxation(std::int64_t units) : units_(units) {}

  std::int64_t units_ = 0;
};

/// The arguments of the formulas of relaxed spheres: beads and a relaxation. The default is the greatest
/// relaxation, so that bounds derived from the formula hold for all.
template <std::size_t N>
struct RelaxedBeads : std::array<BeadId, N> {
  Relaxation relaxation = Relaxation::greatest();

  friend constexpr bool operator==(const RelaxedBeads&, const RelaxedBeads&) = default;
};

}  // namespace kds

template <std::size_t N>
struct std::tuple_size<kds::RelaxedBeads<N>> : std::integral_constant<std::size_t, N> {};
