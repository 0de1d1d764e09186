#pragma once
// Counts how often bonds pass through each other on the paths between frames: a check of their spacing.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "motions/scene/scene.h"

namespace kds {

struct CrossingCounts {
  std::uint64_t crosses = 0;       ///< bonds that pass through each other inside both
  std::uint64_t at_ends = 0;       ///< events of a bond whose end passes through another bond
  std::uint64_t plus_at_ends = 0;  ///< those with the sign +
  std::uint64_t touches = 0;
  std::size_t bonds = 0;  ///< all bonds of the scene

  /// Takes the events of a run's structure (Crossings).
  CrossingCounts(const Scene& scene, const std::vector<std::uint64_t>& events_by_kind);

  /// Returns whether strands pass through each other. Events at an end that have opposite signs are those of
  /// a bend that grazes a bond.
  [[nodiscard]] bool any() const { return crosses > 0 || 2 * plus_at_ends != at_ends; }
  /// Returns a sentence without a full stop.
  [[nodiscard]] std::string sentence() const;
  [[nodiscard]] Json json() const;
};

/// Returns whether the structure `crossings` accepts the scene.
[[nodiscard]] bool has_crossings(const Scene& scene);
/// Runs the crossings of the scene on one thread. has_crossings(scene) must be true.
[[nodiscard]] CrossingCounts count_crossings(
    const Scene& scene, const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace kds
