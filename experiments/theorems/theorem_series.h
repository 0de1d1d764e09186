#pragma once
// A quantity that a theorem bounds, measured on one family of necklaces over a range of sizes.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/power_fit.h"
#include "experiments/program/timing.h"

namespace kds {

/// The theorems of Agarwal et al. (2004) about the growth of a quantity.
enum class Theorem : std::uint8_t {
  tightness,    ///< 2.3: layered root at most sqrt(h + 1) times the wrapped root, almost tight
  family,       ///< 3.1: a separating family of O(n log n) pairs in the plane, O(n^(4/3)) in space
  search,       ///< 3.2: collisions decided within the time of 3.1
  closest_pair  ///< 3.5: the closest pair is among the pairs that the power diagram and the chain give
};
/// The names of the enumerators in order.
inline constexpr std::array<std::string_view, 4> theorem_names{"2.3", "3.1", "3.2", "3.5"};
[[nodiscard]] constexpr std::string_view name_of(Theorem theorem) {
  return theorem_names[static_cast<std::size_t>(theorem)];
}

/// Returns the measured quantity in words, with its unit.
[[nodiscard]] std::string_view quantity_of(Theorem theorem);

struct TheoremPoint {
  std::size_t beads = 0;
  double value = 0;             ///< quantity_of the theorem
  std::optional<double> bound;  ///< the theorem's bound, without its constant if that is unspecified
  std::optional<Spread> seconds;
  std::optional<bool> holds;  ///< empty if one size cannot decide it
};

struct TheoremSeries {
  Theorem theorem = Theorem::tightness;
  std::string model;
  int dimension = 3;
  std::string hierarchy;           ///< empty if none
  std::optional<double> expected;  ///< exponent in the theorem; empty if it says nothing about this model
  std::vector<TheoremPoint> points;

  /// Fits the growth with the number of beads n. For 2.3, fits the growth with the tree's height. For 3.1 and
  /// 3.2 in the plane, fits the growth of value / log2 n.
  [[nodiscard]] std::optional<PowerFit> fit() const;
};

/// Returns a name such as "grid in space, wrapped".
[[nodiscard]] std::string name_of(const TheoremSeries& series);

}  // namespace kds
