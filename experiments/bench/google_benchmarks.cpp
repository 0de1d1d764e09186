// Microbenchmarks that run kds and a peer in turn in one process. They are not tests. Run them from the
// folder that contains data/, or set KDS_INSTANCES to the folder of moving-point instances. `kds bench
// certificates` and `kds bench engine` print the same measures as rows.

#include <benchmark/benchmark.h>

#include <cstdio>
#include <cstdlib>
#include <exception>

#include "experiments/bench/allocations.h"
#include "experiments/bench/subject.h"

namespace {

class GoogleTurns final : public kds::bench::Turns {
 public:
  explicit GoogleTurns(benchmark::State& state) : state_(state) {}

  bool another() override { return state_.KeepRunning(); }
  void took(double seconds) override { state_.SetIterationTime(seconds); }
  void note(std::string_view figure, double value) override { state_.counters[std::string(figure)] = value; }
  std::uint64_t allocations() const override { return kds::bench::allocations(); }

 private:
  benchmark::State& state_;
};

void add(const std::vector<kds::bench::Subject>& subjects, benchmark::IterationCount count) {
  for (const kds::bench::Subject& subject : subjects) {
    benchmark::RegisterBenchmark(subject.name.c_str(),
                                 [run = subject.run](benchmark::State& state) {
                                   GoogleTurns turns(state);
                                   run(turns);
                                 })
        ->UseManualTime()
        ->Iterations(count)
        ->Unit(benchmark::kMicrosecond);
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const char* named = std::getenv("KDS_INSTANCES");
  const std::filesystem::path instances = named ? named : "data/kinetic";
  add(kds::bench::certificate_subjects(instances), 21);
  add(kds::bench::slack_subjects(), 21);
  add(kds::bench::engine_subjects(instances), 7);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "kds_benchmarks: %s\n", error.what());
  return 2;
}
