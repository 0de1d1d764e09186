#pragma once
// The benchmarks of the program kds_benchmarks, a file each.

#include <benchmark/benchmark.h>

#include <string>

namespace kds::bench {

void add_engine_benchmarks();
void add_certificate_benchmarks();
void add_tolerance_benchmarks();

/// `run` measures by the clock of its own, 21 times.
template <class Run>
void add_benchmark(const std::string& name, const Run& run) {
  benchmark::RegisterBenchmark(name.c_str(), run)
      ->UseManualTime()
      ->Iterations(21)
      ->Unit(benchmark::kMicrosecond);
}

}  // namespace kds::bench
