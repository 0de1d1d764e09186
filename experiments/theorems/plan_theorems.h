#pragma once
// Which necklaces of which sizes each theorem is measured on.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "experiments/theorems/theorem_series.h"

namespace kds {

struct TheoremOptions {
  std::vector<Theorem> theorems;     ///< ascending
  std::size_t most_beads = 100'000;  ///< of the largest necklaces
  double gap = 0.05;                 ///< between rows of grids, in diameters
  std::uint64_t seed = 1;            ///< of random necklaces
  std::size_t rounds = 3;            ///< of each measurement of time
};

struct TheoremPlan {
  std::vector<TheoremSeries> series;  ///< without points
  std::vector<std::size_t> sizes;     ///< of each series: how many points it gets
  /// Each adds a point to one series, or to two that share a measurement; to be done in order.
  std::vector<std::function<void(std::vector<TheoremSeries>&)>> work;
};

[[nodiscard]] TheoremPlan plan_theorems(const TheoremOptions& options);

/// The fewest beads of the largest necklaces with which each series has three sizes, as a fit needs.
[[nodiscard]] std::size_t least_beads_for(const std::vector<Theorem>& theorems);
[[nodiscard]] bool measures_time(const std::vector<Theorem>& theorems);

}  // namespace kds
