// Compares whole kinetic runs of moving-point instances with CGAL's static build of the same points, and the
// queue of events with Boost's heap.

#include <array>
#include <boost/heap/d_ary_heap.hpp>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "experiments/bench/bench.h"
#include "experiments/program/input_options.h"
#include "kds/event_queue.h"
#include "motions/models/elementary.h"
#include "motions/readers/instance.h"
#include "structures/session/kinetic_run.h"
#include "structures/triangulation/static_build.h"

namespace kds::bench {

namespace {

// An item is an event. The peer has no items, because a run is compared with one build.
void add_run(const std::string& name, std::size_t points) {
  const auto scene =
      lazily([name] { return Scene(read_instance(source_data_folder() / "kinetic" / (name + ".txt"))); });
  const std::string measure = fmt::format("engine/{0}/{1}/power/{0}/filtered", name, points);
  const auto events_of_run = [scene] {
    KineticRun run(scene(), {.structures = {"power"}});
    run.finish();
    const auto& per_step = run.structures().front()->statistics.events_per_step;
    return std::accumulate(per_step.begin(), per_step.end(), std::uint64_t{0});
  };
  add(measure, [=] {
    return Work{events_of_run(), "ns", [=] { benchmark::DoNotOptimize(events_of_run()); }};
  });
  add(measure + " beside CGAL static build", [=] {
    const Eigen::Matrix3Xd centers = scene().centers(0);
    const std::vector<double> weights = scene().weights(0);
    return Work{0, "ns",
                scene().dimension() == 2 ? triangulation_by_cgal<2>(centers, weights)
                                         : triangulation_by_cgal<3>(centers, weights)};
  });
}

/// A failure that is due at a time.
struct Due {
  double time = 0;
  std::uint32_t number = 0;
};

struct ByTime {
  [[nodiscard]] static bool before(const Due& a, const Due& b) { return a.time < b.time; }
  [[nodiscard]] static double earliest(const Due& due) { return due.time; }
  [[nodiscard]] static double latest(const Due& due) { return due.time; }
};
struct OurQueue {
  ByTime order;
  EventQueue<Due, ByTime> queue{order};
  QueueHandle push(const Due& due) {
    return queue.push([&](QueueHandle) { return due; });
  }
};

struct BoostQueue {
  struct Later {
    bool operator()(const Due& a, const Due& b) const { return b.time < a.time; }
  };
  boost::heap::d_ary_heap<Due, boost::heap::arity<4>, boost::heap::mutable_<true>,
                          boost::heap::compare<Later>>
      queue;
  auto push(const Due& due) { return queue.push(due); }
};

/// Runs as many events as a queue holds failures. At each event the first failure gets another time, and so
/// do four others, which are cancelled. Returns a checksum of the order.
template <class Queue>
std::uint64_t run_queue(std::size_t size) {
  models::Random random(1);
  Queue failures;
  std::vector<decltype(failures.push({}))> handles(size);
  const auto push = [&](double time, std::uint32_t number) {
    handles[number] = failures.push({time, number});
  };
  for (std::uint32_t number = 0; number < size; ++number) push(random.uniform(), number);
  std::uint64_t sum = 0;
  for (std::size_t event = 0; event < size; ++event) {
    const Due first = failures.queue.top();
    failures.queue.pop();
    sum = 31 * sum + first.number;
    const auto later = [&] { return first.time + (1 - first.time) * random.uniform(); };
    push(later(), first.number);
    for (int cancelled = 0; cancelled < 4; ++cancelled) {
      const auto number = static_cast<std::uint32_t>(random.uniform() * static_cast<double>(size));
      failures.queue.erase(handles[number]);
      push(later(), number);
    }
  }
  return sum;
}

void add_queue(std::size_t size) {
  const std::string name = fmt::format("engine/random times/{0}/queue/{0}", size);
  add(name, [=] {
    if (run_queue<OurQueue>(size) != run_queue<BoostQueue>(size))
      throw std::logic_error("two queues give failures in different orders");
    return Work{size, "ns", [=] { benchmark::DoNotOptimize(run_queue<OurQueue>(size)); }};
  });
  add(name + " beside boost::heap::d_ary_heap", [=] {
    return Work{size, "ns", [=] { benchmark::DoNotOptimize(run_queue<BoostQueue>(size)); }};
  });
}

}  // namespace

void add_engine() {
  add_run("d2_n200_linear", 200);
  add_run("d3_n200_linear", 200);
  add_run("d3_n500_linear", 500);
  add_run("d3_n50_degree3", 50);
  for (const std::size_t size : {10'000U, 100'000U}) add_queue(size);
}

}  // namespace kds::bench
