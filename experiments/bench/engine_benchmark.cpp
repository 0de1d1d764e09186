// Compares whole kinetic runs of moving-point instances with CGAL's static build of the same points, in turn
// in one process. The counters are `ns` per event, `events_per_second`, `run_us`, `build_us`, and
// `static_builds`, the cost of one run in static builds. Compares the queue of events with Boost's heap.
//
//   kds_benchmarks --benchmark_filter='power|sorted|queue'

#include <algorithm>
#include <array>
#include <boost/heap/d_ary_heap.hpp>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "experiments/bench/subject.h"
#include "kds/event_queue.h"
#include "motions/models/elementary.h"
#include "motions/readers/instance.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/static_build.h"

namespace kds::bench {

namespace {

StaticBuild static_build_of(const Scene& scene, const Eigen::Matrix3Xd& centers,
                            std::span<const double> weights) {
  switch (scene.dimension()) {
    case 1:
      return order_by_sorting(centers);
    case 2:
      return triangulation_by_cgal<2>(centers, weights);
    default:
      return triangulation_by_cgal<3>(centers, weights);
  }
}

void run_instance(Turns& turns, const std::filesystem::path& file, Kernel kernel) {
  const Scene scene(read_instance(file));
  const std::string structure = scene.dimension() == 1 ? "sorted" : "power";
  const Eigen::Matrix3Xd centers = scene.centers(0);
  const std::vector<double> weights = scene.weights(0);
  const StaticBuild build = static_build_of(scene, centers, weights);
  std::vector<double> runs, static_builds, ratios;
  std::uint64_t events = 0;
  while (turns.another()) {
    runs.push_back(processor_seconds_of([&] {
      KineticRun run(scene, {.structures = {structure}, .kernel = kernel});
      run.finish();
      const auto& per_step = run.structures().front()->statistics.events_per_step;
      events = std::accumulate(per_step.begin(), per_step.end(), std::uint64_t{0});
    }));
    turns.took(runs.back());
    static_builds.push_back(processor_seconds_per_call(build));
    ratios.push_back(runs.back() / static_builds.back());
  }
  const double run = median_of(runs);
  turns.note("events", static_cast<double>(events));
  turns.note_spread("ns", runs, 1e9 / static_cast<double>(events));
  turns.note("events_per_second", static_cast<double>(events) / run);
  turns.note_spread("run_us", runs, 1e6);
  turns.note("build_us", median_of(static_builds) * 1e6);
  turns.note("static_builds", median_of(ratios));
}

/// A failure that is due at a time.
struct Due {
  double time = 0;
  std::uint32_t number = 0;
};

class OurQueue {
 public:
  explicit OurQueue(std::size_t size) : handles_(size) {}
  void push(Due due) {
    handles_[due.number] = queue_.push([&](QueueHandle) { return due; });
  }
  void erase(std::uint32_t number) { queue_.erase(handles_[number]); }
  Due pop() {
    const Due due = queue_.top();
    queue_.pop();
    return due;
  }

 private:
  struct Order {
    [[nodiscard]] static bool before(const Due& a, const Due& b) { return a.time < b.time; }
    [[nodiscard]] static double earliest(const Due& due) { return due.time; }
    [[nodiscard]] static double latest(const Due& due) { return due.time; }
  };
  Order order_;
  EventQueue<Due, Order> queue_{order_};
  std::vector<QueueHandle> handles_;
};

class BoostQueue {
 public:
  explicit BoostQueue(std::size_t size) : handles_(size) {}
  void push(Due due) { handles_[due.number] = queue_.push(due); }
  void erase(std::uint32_t number) { queue_.erase(handles_[number]); }
  Due pop() {
    const Due due = queue_.top();
    queue_.pop();
    return due;
  }

 private:
  struct Later {
    bool operator()(const Due& a, const Due& b) const { return b.time < a.time; }
  };
  using Queue = boost::heap::d_ary_heap<Due, boost::heap::arity<4>, boost::heap::mutable_<true>,
                                        boost::heap::compare<Later>>;
  Queue queue_;
  std::vector<Queue::handle_type> handles_;
};

/// Runs as many events as a queue holds failures. At each event the first failure gets another time, and so
/// do four others, which are cancelled. Returns a checksum of the order.
template <class Queue>
std::uint64_t run_queue(std::size_t size) {
  models::Random random(1);
  Queue queue(size);
  for (std::uint32_t number = 0; number < size; ++number) queue.push({random.uniform(), number});
  std::uint64_t sum = 0;
  for (std::size_t event = 0; event < size; ++event) {
    const Due first = queue.pop();
    sum = 31 * sum + first.number;
    const auto later = [&] { return first.time + (1 - first.time) * random.uniform(); };
    queue.push({later(), first.number});
    for (int cancelled = 0; cancelled < 4; ++cancelled) {
      const auto number = static_cast<std::uint32_t>(random.uniform() * static_cast<double>(size));
      queue.erase(number);
      queue.push({later(), number});
    }
  }
  return sum;
}

struct Goal {
  std::string_view instance;
  double events_per_second;
  std::optional<double> static_builds;
};
constexpr std::array goals{Goal{"d3_n200_linear", 400'000, 55}, Goal{"d3_n500_linear", 250'000, 120},
                           Goal{"d3_n50_degree3", 30'000, std::nullopt}};

}  // namespace

std::vector<Subject> queue_subjects() {
  std::vector<Subject> all;
  for (const std::size_t size : {10'000U, 100'000U}) {
    all.push_back({"queue/" + std::to_string(size), "random times", size, "boost::heap::d_ary_heap",
                   std::nullopt, std::nullopt, [size](Turns& turns) {
                     if (run_queue<OurQueue>(size) != run_queue<BoostQueue>(size))
                       throw std::logic_error("two queues give failures in different orders");
                     turns.take(
                         size, [&] { keep(run_queue<OurQueue>(size)); },
                         [&] { return processor_seconds_of([&] { keep(run_queue<BoostQueue>(size)); }); });
                   }});
  }
  return all;
}

std::vector<Subject> engine_subjects(const std::filesystem::path& instances) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(instances)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() == ".txt" && stem.starts_with('d') && !stem.starts_with("degenerate"))
      files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  std::vector<Subject> all;
  for (const std::filesystem::path& file : files) {
    const Instance instance = read_instance(file);
    const std::string stem = file.stem().string();
    const bool sorted = instance.dimension() == 1;
    const auto add = [&](const char* kernel, Kernel name) {
      Subject subject{std::string(sorted ? "sorted" : "power") + "/" + stem + "/" + kernel,
                      stem,
                      instance.point_count(),
                      sorted ? "std::sort" : "CGAL static build",
                      std::nullopt,
                      std::nullopt,
                      [=](Turns& turns) { run_instance(turns, file, name); }};
      const auto goal =
          std::find_if(goals.begin(), goals.end(), [&](const Goal& g) { return g.instance == stem; });
      if (name == Kernel::filtered && goal != goals.end()) {
        subject.most_ns = 1e9 / goal->events_per_second;
        subject.most_ratio = goal->static_builds;
      }
      all.push_back(std::move(subject));
    };
    add("filtered", Kernel::filtered);
    constexpr std::size_t few = 50;  // larger instances take too long in integer arithmetic
    if (instance.point_count() <= few) add("exact", Kernel::exact);
  }
  return all;
}

}  // namespace kds::bench
