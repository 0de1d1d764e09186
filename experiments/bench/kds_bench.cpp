// Compares the speed of kds with that of other libraries. compare.py runs this program, divides times and
// checks goals; --help lists the options of Google Benchmark.

#include <cstdio>
#include <exception>

#include "experiments/bench/bench.h"
#include "experiments/output/result_json.h"
#include "motions/base/floating_point_scope.h"

int main(int argc, char** argv) try {
  const kds::FloatingPointScope to_nearest;
  kds::bench::add_certificates();
  kds::bench::add_engine();
  kds::bench::add_hierarchies();
  kds::bench::add_power();
  kds::bench::add_collision();
  kds::bench::add_impacts();
  kds::bench::add_readers();
  benchmark::AddCustomContext("version", kds::program_version());
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "kds_bench: %s\n", error.what());
  return 2;
}
