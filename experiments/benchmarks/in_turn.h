#pragma once
// Ours and a peer timed in turn, and the medians of both. Machines drift: the ratio is what counts.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <vector>

#include "experiments/benchmarks/allocations.h"

namespace kds::bench {

template <class Work>
double seconds_of(const Work& work) {
  const auto start = std::chrono::steady_clock::now();
  work();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of `items` each: `ours` does them all, `peer` says how many seconds it took for as many (NaN: no peer).
/// Counters: `ns` and `peer_ns` an item, `ratio` = ours / peer, `allocations` of ours an item.
template <class Ours, class Peer>
void measure_in_turn(benchmark::State& state, std::size_t items, const Ours& ours, const Peer& peer) {
  std::vector<double> our_seconds, peer_seconds, ratios;
  std::uint64_t allocated = 0;
  ours();  // warm
  for (auto _ : state) {
    const std::uint64_t before = allocations();
    const double seconds = seconds_of(ours);
    allocated += allocations() - before;
    our_seconds.push_back(seconds);
    peer_seconds.push_back(peer());
    ratios.push_back(our_seconds.back() / peer_seconds.back());
    state.SetIterationTime(our_seconds.back());
  }
  const auto n = static_cast<double>(items);
  state.counters["items"] = n;
  state.counters["ns"] = median(our_seconds) / n * 1e9;
  state.counters["allocations"] =
      static_cast<double>(allocated) / (n * static_cast<double>(our_seconds.size()));
  if (std::isnan(ratios.front())) return;
  state.counters["peer_ns"] = median(peer_seconds) / n * 1e9;
  state.counters["ratio"] = median(ratios);
}

}  // namespace kds::bench
