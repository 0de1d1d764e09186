#pragma once
// Runs a pass over all runs of a bottom-up order, on one thread or on all.

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <future>
#include <system_error>
#include <thread>
#include <vector>

#include "motions/base/floating_point_guard.h"
#include "structures/hierarchy/bottom_up_order.h"

namespace kds {

/// Each thread has at least this many runs, because starting a thread takes as long as about three.
inline constexpr std::size_t least_runs_of_thread = 64;

/// `pass(run)` handles a run's groups in their order and returns its counts. Returns the sum of all counts.
template <class Counts, class Pass>
Counts over_runs(const BottomUpOrder& order, Threads threads, const Pass& pass) {
  const std::size_t last = order.runs().size() - 1;  // the nodes above all others
  Counts sum{};
  if (threads == Threads::one) {
    for (std::size_t i = 0; i <= last; ++i) sum += pass(i);
    return sum;
  }
  std::vector<Counts> counts(last + 1);
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    const FloatingPointGuard to_nearest;
    for (std::size_t i = next++; i < last; i = next++) counts[i] = pass(i);
  };
  std::vector<std::future<void>> others;
  const std::size_t most =
      std::min<std::size_t>(std::thread::hardware_concurrency(), last / least_runs_of_thread);
  try {
    while (others.size() + 1 < most) others.push_back(std::async(std::launch::async, work));
  } catch (const std::system_error&) {
    // The system has no more threads. This thread and those that have started do the work.
  }
  work();
  for (std::future<void>& other : others) other.get();
  counts[last] = pass(last);
  for (const Counts& c : counts) sum += c;
  return sum;
}

}  // namespace kds
