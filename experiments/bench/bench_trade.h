#pragma once
// `kds bench trade`. Measures levers that trade accuracy for speed beside the exact run of the same structure
// in the same process: the steps alone, as in `kds trade`, and with the construction of the motion from the
// frames.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct TradeBenchOptions {
  std::vector<std::filesystem::path> trajectories;  ///< inputs, each as `kds run` reads it
  std::size_t rounds = 5;                           ///< at least; more if rounds are short
};

[[nodiscard]] std::vector<BenchRow> bench_trade(
    const TradeBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
