#pragma once
// `kds bench power`: the power diagram from frame to frame, in exact order of events and by the other
// techniques of structures/power_diagram/diagram_update.h, beside CGAL's static build. Regular scenes, where
// many balls lie on one sphere and much happens at once, in exact order of events alone, beside CGAL's static
// builds of both frames.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct PowerBenchOptions {
  std::vector<std::size_t> sizes{10240};            ///< beads of generated chains
  std::vector<std::size_t> regular{1000, 8000};     ///< beads of regular scenes
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more where rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_power(
    const PowerBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
