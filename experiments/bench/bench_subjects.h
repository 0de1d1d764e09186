#pragma once
// `kds bench certificates` and `kds bench engine`: the subjects of kds_benchmarks as rows.

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

/// Certificates from beads to answers, in nanoseconds each. Throws InputError where an instance is missing.
[[nodiscard]] std::vector<BenchRow> bench_certificates(
    const SubjectBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

/// Whole runs of all d1_*, d2_* and d3_* files: an event, and a run beside a static build. Throws InputError
/// where there are none.
[[nodiscard]] std::vector<BenchRow> bench_engine(
    const SubjectBenchOptions& options, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
