// Microbenchmarks, ours and a peer in turn in one process; never tests. The commands are in the files.

#include <benchmark/benchmark.h>

#include "experiments/benchmarks/benchmarks.h"

int main(int argc, char** argv) {
  kds::bench::add_certificate_benchmarks();
  kds::bench::add_tolerance_benchmarks();
  kds::bench::add_engine_benchmarks();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
