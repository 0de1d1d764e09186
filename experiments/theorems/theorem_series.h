#pragma once
// What a theorem bounds, measured on one family of necklaces over a range of sizes.

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

/// Those of Agarwal et al. (2004) that say how something grows.
enum class Theorem : std::uint8_t {
  tightness,    ///< 2.3: layered root at most sqrt(h + 1) times the wrapped one, almost tight
  family,       ///< 3.1: a separating family of O(n log n) pairs in the plane, O(n^(4/3)) in space
  search,       ///< 3.2: collisions decided in such time
  closest_pair  ///< 3.5: the closest pair is among those that the power diagram and the chain name
};
/// In the order of the enumerators.
inline constexpr std::array<std::string_view, 4> theorem_names{"2.3", "3.1", "3.2", "3.5"};
[[nodiscard]] constexpr std::string_view name_of(Theorem theorem) {
  return theorem_names[static_cast<std::size_t>(theorem)];
}

/// What is measured, in words and with its unit.
[[nodiscard]] std::string_view quantity_of(Theorem theorem);

struct TheoremPoint {
  std::size_t beads = 0;
  double value = 0;             ///< quantity_of the theorem
  std::optional<double> bound;  ///< the theorem's, without its constant where that is left open
  std::optional<Spread> seconds;
  std::optional<bool> holds;  ///< where one size can tell
};

struct TheoremSeries {
  Theorem theorem = Theorem::tightness;
  std::string model;
  int dimension = 3;
  std::string hierarchy;           ///< empty where there is none
  std::optional<double> expected;  ///< exponent of the theorem; none where it says nothing of this model
  std::vector<TheoremPoint> points;

  /// Growth with the number of beads n; of 2.3 with the tree's height, of 3.1 and 3.2 in the plane that of
  /// value / log2 n.
  [[nodiscard]] std::optional<PowerFit> fit() const;
};

/// "grid in space, wrapped".
[[nodiscard]] std::string name_of(const TheoremSeries& series);

}  // namespace kds
