#pragma once
// `kds bench hierarchies`. Measures wrapped and layered hierarchies that are built, updated from frame to
// frame, and updated kinetically. Their peer is CGAL's Min_sphere_of_spheres_d at every node. Also compares
// the number of events with the net change.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct HierarchyBenchOptions {
  std::vector<std::size_t> sizes{640, 10240, 102400};  ///< numbers of beads of generated chains
  std::vector<std::filesystem::path> trajectories;     ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                              ///< at least; more if rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_hierarchies(
    const HierarchyBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
