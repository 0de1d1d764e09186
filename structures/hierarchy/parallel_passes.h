#pragma once
// Runs a pass over all runs of a bottom-up order, on one thread or on all.

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <vector>

#include "motions/base/floating_point_guard.h"
#include "structures/hierarchy/bottom_up_order.h"

namespace kds {

/// `pass(run)` handles a run's groups in their order and returns its counts. Returns the sum of all counts.
template <class Counts, class Pass>
Counts over_runs(const BottomUpOrder& order, Threads threads, const Pass& pass) {
  const std::size_t runs = order.runs().size();
  Counts sum{};
  if (threads == Threads::one) {
    for (std::size_t i = 0; i < runs; ++i) sum += pass(i);
    return sum;
  }
  std::vector<Counts> counts(runs);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, runs - 1, 1),
                    [&](const tbb::blocked_range<std::size_t>& some) {
                      const FloatingPointGuard of_worker;
                      for (std::size_t i = some.begin(); i < some.end(); ++i) counts[i] = pass(i);
                    });
  counts.back() = pass(runs - 1);
  for (const Counts& c : counts) sum += c;
  return sum;
}

}  // namespace kds
