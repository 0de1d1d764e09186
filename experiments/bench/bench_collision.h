#pragma once
// `kds bench collision`: the detector that users get beside what they would use otherwise, in one process: a
// cell list on single scenes, a Verlet list from frame to frame, and the trees of FCL and Bullet where this
// program was built with them. Frames are distinct, and what one detector sees the others see in turn. And
// the times at which contacts begin and end, beside the cell list.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct CollisionBenchOptions {
  std::vector<std::size_t> sizes{1000, 10240, 102400};  ///< beads of generated chains
  std::vector<std::filesystem::path> trajectories;      ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;
};

/// Throws std::logic_error where two detectors do not find the same pairs.
[[nodiscard]] std::vector<BenchRow> bench_collision(
    const CollisionBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
