#pragma once
// `kds bench power`. Measures the power diagram from frame to frame, kinetically with an exact order of
// events, and by the other techniques of structures/power_diagram/diagram_update.h. The peer is CGAL's static
// build. Regular scenes, in which many balls lie on one sphere and many events coincide, are measured only
// kinetically. Their peer is CGAL's static build of both frames.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct PowerBenchOptions {
  std::vector<std::size_t> sizes{10240};            ///< numbers of beads of generated chains
  std::vector<std::size_t> regular{1000, 8000};     ///< numbers of beads of regular scenes
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more if rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_power(
    const PowerBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
