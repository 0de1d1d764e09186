// Whole kinetic runs of moving-point instances against CGAL's static build of the same points, timed in turn
// in one process: `events_per_second`, and `static_builds`, how many static builds one run costs.
//
//   kds_benchmarks --benchmark_filter='power|sorted'

#include <benchmark/benchmark.h>

#include <chrono>
#include <string>

#include "experiments/benchmarks/benchmarks.h"
#include "experiments/session.h"
#include "motions/instance.h"
#include "structures/regular_triangulation.h"
#include "structures/static_build.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

void run_instance(benchmark::State& state, const std::string& file, const std::string& structure,
                  kds::KernelName kernel) {
  const kds::Scene scene(kds::read_instance(std::string(KDS_DATA_DIR) + "/kinetic/" + file));
  const Eigen::Matrix3Xd centers = scene.centers(0);
  const std::vector<double> weights = scene.weights(0);
  double kinetic = 0;
  double built = 0;
  double events = 0;
  constexpr int builds = 20;
  for (auto _ : state) {
    const auto start = Clock::now();
    const auto session = kds::make_session(scene, {{structure}, kernel, kds::AuditMode::none, {}});
    session->load(0);
    session->simulator().build();
    session->simulator().run_step(true);
    const double seconds = seconds_since(start);
    state.SetIterationTime(seconds);
    kinetic += seconds;
    for (const std::uint64_t count : session->structures().front()->statistics.events_per_step) {
      events += static_cast<double>(count);
    }
    for (int i = 0; i < builds; ++i) {
      built += structure == "sorted" ? kds::seconds_to_sort(centers)
                                     : kds::seconds_to_triangulate<3>(centers, weights);
    }
  }
  state.counters["events_per_second"] = events / kinetic;
  state.counters["static_builds"] = kinetic / (built / builds);
}

}  // namespace

void kds::bench::add_engine_benchmarks() {
  const auto add = [](const std::string& name, const std::string& file, const std::string& structure,
                      KernelName kernel) {
    benchmark::RegisterBenchmark(
        (structure + "/" + name).c_str(),
        [=](benchmark::State& state) { run_instance(state, file, structure, kernel); })
        ->UseManualTime()
        ->Unit(benchmark::kMillisecond);
  };
  for (const char* n : {"50", "200", "500"}) {
    const std::string file = std::string("d3_n") + n + "_linear.txt";
    add(std::string("d3_n") + n + "/filtered", file, "power", KernelName::filtered);
    add(std::string("d3_n") + n + "/fast", file, "power", KernelName::fast);
    add(std::string("d1_n") + n + "/filtered", std::string("d1_n") + n + "_linear.txt", "sorted",
        KernelName::filtered);
  }
  add("d3_n50_degree3/filtered", "d3_n50_degree3.txt", "power", KernelName::filtered);
  add("d3_n50/exact", "d3_n50_linear.txt", "power", KernelName::exact);
}
