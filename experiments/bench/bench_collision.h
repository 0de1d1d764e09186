#pragma once
// `kds bench collision`. Measures the detector of kds beside the common alternatives in one process: a cell
// list on single scenes, a Verlet list from frame to frame, and the trees of FCL and Bullet if this program
// was built with them. All frames are distinct, and the detectors see the same frames in turn. Also measures
// the computation of the times at which contacts begin and end beside the cell list.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct CollisionBenchOptions {
  std::vector<std::size_t> sizes{1000, 10240, 102400};  ///< numbers of beads of generated chains
  std::vector<std::filesystem::path> trajectories;      ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;
};

/// Runs the benchmark. Throws std::logic_error if two detectors find different pairs.
[[nodiscard]] std::vector<BenchRow> bench_collision(
    const CollisionBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
