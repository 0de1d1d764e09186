#pragma once
// Registers the benchmarks of kds_bench, which time kds and its peers with Google Benchmark.
//
// A benchmark is named SUBJECT/INPUT/N/MEASURE, where N is the number of beads or points. "MEASURE beside
// PEER" times the peer of this measure, or of all measures whose names start with MEASURE. compare.py divides
// their times, which are processor times.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <concepts>
#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>

#include "experiments/program/timing.h"

namespace kds::bench {

/// The work that a benchmark repeats.
struct Work {
  std::size_t items = 0;      ///< processed by one call; 0 if only the time of a call is of interest
  std::string unit = "ns";    ///< of the time per item, such as "ns/bead"
  std::function<void()> run;  ///< timed by Google Benchmark
  std::map<std::string, double> counters = {};  ///< ratios of counts, by the names of their rows
};

/// Work that prepares each call. The preparation is not timed.
struct TimedWork {
  std::size_t items = 0;
  std::string unit = "ns";
  std::function<double()> seconds;              ///< returns the seconds of one call without its preparation
  std::map<std::string, double> counters = {};  ///< like Work::counters
};

/// Returns a function that calls `make` at its first call, keeps the result and returns a reference to it. So
/// only inputs of benchmarks that run are made.
template <class Make>
auto lazily(Make make) {
  using Made = std::invoke_result_t<Make>;
  return [make, made = std::make_shared<std::unique_ptr<Made>>()]() -> Made& {
    if (*made == nullptr) made->reset(new Made(make()));
    return **made;
  };
}

/// Registers a benchmark. `make` returns its Work or TimedWork, which is called once before it is timed.
template <class Make>
void add(const std::string& name, const Make& make) {
  constexpr bool timed = std::same_as<std::invoke_result_t<Make>, TimedWork>;
  const auto made = lazily([make] {
    auto work = make();
    if constexpr (timed)
      static_cast<void>(work.seconds());
    else
      work.run();
    return work;
  });
  const auto repeat = [made](benchmark::State& state) {
    const auto& work = made();
    if constexpr (timed) {
      for ([[maybe_unused]] auto call : state) state.SetIterationTime(work.seconds());
    } else {
      for ([[maybe_unused]] auto call : state) work.run();
    }
    for (const auto& [counter, value] : work.counters) state.counters[counter] = value;
    state.SetLabel(work.unit);
    if (work.items > 0) state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(work.items));
  };
  auto* const registered = benchmark::RegisterBenchmark(name.c_str(), repeat);
  if (timed) registered->UseManualTime();
}

/// Registers a measure and its peer, which share what `make` returns: an object with the member `items`.
template <class Make, class Ours, class Peer>
void add_pair(const std::string& name, std::string_view peer, const std::string& unit, const Make& make,
              const Ours& ours, const Peer& theirs) {
  const auto shared = lazily(make);
  add(name, [=] {
    auto& input = shared();
    return Work{input.items, unit, [&input, ours] { ours(input); }};
  });
  add(fmt::format("{} beside {}", name, peer), [=] {
    auto& input = shared();
    return Work{input.items, unit, [&input, theirs] { theirs(input); }};
  });
}

void add_certificates();
void add_engine();
void add_hierarchies();
void add_power();
void add_collision();
void add_impacts();
void add_readers();

}  // namespace kds::bench
