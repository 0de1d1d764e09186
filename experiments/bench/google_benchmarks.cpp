// Microbenchmarks that run kds and a peer in turn in one process. Microbenchmarks are not tests. Run them
// from the folder that contains data/, or set KDS_INSTANCES to the folder of moving-point instances. `kds
// bench certificates` and `kds bench engine` print the same measures as rows.

#include <benchmark/benchmark.h>
#include <gmp.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "experiments/bench/subject.h"

namespace {

std::uint64_t allocations_so_far = 0;  // through operator new and GMP; not atomic: benchmarks use one thread

void* counted(std::size_t size) {
  ++allocations_so_far;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}

void* counted(void* memory, std::size_t, std::size_t size) {
  ++allocations_so_far;
  if (void* longer = std::realloc(memory, size)) return longer;
  throw std::bad_alloc();
}

[[maybe_unused]] const bool gmp_is_counted = [] {
  mp_set_memory_functions(counted, counted, [](void* memory, std::size_t) { std::free(memory); });
  return true;
}();

class GoogleTurns final : public kds::bench::Turns {
 public:
  explicit GoogleTurns(benchmark::State& state) : state_(state) {}

  bool another() override { return state_.KeepRunning(); }
  void took(double seconds) override { state_.SetIterationTime(seconds); }
  void note(std::string_view figure, double value) override { state_.counters[std::string(figure)] = value; }
  std::uint64_t allocations() const override { return allocations_so_far; }

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

void* operator new(std::size_t size) { return counted(size); }
void* operator new[](std::size_t size) { return counted(size); }
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }

int main(int argc, char** argv) try {
  const char* named = std::getenv("KDS_INSTANCES");
  const std::filesystem::path instances = named ? named : "data/kinetic";
  add(kds::bench::certificate_subjects(instances), 21);
  add(kds::bench::slack_subjects(), 21);
  add(kds::bench::queue_subjects(), 7);
  add(kds::bench::engine_subjects(instances), 7);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
} catch (const std::exception& error) {
  std::fprintf(stderr, "kds_benchmarks: %s\n", error.what());
  return 2;
}
