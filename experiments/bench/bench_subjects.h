#pragma once
// `kds bench certificates` and `kds bench engine`. They report the subjects of kds_benchmarks as rows.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <vector>

#include "experiments/bench/bench_report.h"

namespace kds {

struct SubjectBenchOptions {
  std::filesystem::path instances;  ///< the folder of moving-point files
  std::size_t rounds = 5;
};

/// Measures certificates from beads to answers, in nanoseconds each. Throws InputError if an instance is
/// missing.
[[nodiscard]] std::vector<BenchRow> bench_certificates(
    const SubjectBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

/// Measures whole runs of all d1_*, d2_* and d3_* files: the time per event, and a run compared with a static
/// build. Throws InputError if there are no such files.
[[nodiscard]] std::vector<BenchRow> bench_engine(
    const SubjectBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
