#pragma once
// Counts how often bonds pass through each other on the paths between frames: a check of their spacing.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/result_json.h"
#include "motions/scene/scene.h"

namespace kds {

struct CrossingCounts {
  std::uint64_t crosses = 0;  ///< bonds that pass through each other inside both
  std::uint64_t at_ends = 0;  ///< events of a bond whose end passes through another bond
  std::uint64_t touches = 0;
  std::size_t bonds = 0;  ///< all bonds of the scene

  /// Takes the events of a run's structure (Crossings).
  CrossingCounts(const Scene& scene, const std::vector<std::uint64_t>& events_by_kind);

  /// Returns a sentence without a full stop.
  [[nodiscard]] std::string sentence() const;
  [[nodiscard]] Json json() const;
};

/// Returns whether the scene has bonds that can pass through each other.
[[nodiscard]] bool has_crossings(const Scene& scene);
/// Runs the crossings of the scene on all cores. The scene must have some (has_crossings).
[[nodiscard]] CrossingCounts count_crossings(
    const Scene& scene, const std::function<void(std::size_t done, std::size_t total)>& progress);

}  // namespace kds
