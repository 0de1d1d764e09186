#pragma once
// `kds bench readers`. Measures how long a reader takes for all atoms of all frames of a file. The peer reads
// the bytes of the file and nothing else. The time to open the file does not count.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct ReaderBenchOptions {
  std::vector<std::filesystem::path> trajectories;  ///< inputs, in any format with frames
  std::size_t rounds = 5;
};

[[nodiscard]] std::vector<BenchRow> bench_readers(
    const ReaderBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
