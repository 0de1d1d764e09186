#pragma once
// Plans the necklaces and sizes on which each theorem is measured.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "experiments/theorems/theorem_series.h"

namespace kds {

struct TheoremOptions {
  std::vector<Theorem> theorems;     ///< ascending
  std::size_t most_beads = 100'000;  ///< beads of the largest necklaces
  double gap = 0.05;                 ///< between rows of grids, in diameters
  std::uint64_t seed = 1;            ///< of random necklaces
  std::size_t rounds = 3;            ///< of each time measurement
};

struct TheoremPlan {
  std::vector<TheoremSeries> series;  ///< without points
  std::vector<std::size_t> sizes;     ///< number of points of each series
  /// Each function adds a point to one series, or to two series that share a measurement. Call the functions
  /// in order.
  std::vector<std::function<void(std::vector<TheoremSeries>&)>> work;
};

[[nodiscard]] TheoremPlan plan_theorems(const TheoremOptions& options);

/// Returns the least value of most_beads for which each series has three sizes, as a fit needs.
[[nodiscard]] std::size_t least_beads_for(const std::vector<Theorem>& theorems);
[[nodiscard]] bool measures_time(const std::vector<Theorem>& theorems);

}  // namespace kds
