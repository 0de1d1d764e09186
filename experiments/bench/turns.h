#pragma once
// Ours and a peer timed in turn, whoever counts the turns: Google Benchmark in kds_benchmarks, or `kds
// bench`. Machines drift: the ratio is what counts. Seconds are the processor's.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/timing.h"

namespace kds::bench {

/// The compiler must have it.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r,m"(value) : "memory");
}

inline constexpr double no_peer = std::numeric_limits<double>::quiet_NaN();

class Turns {
 public:
  virtual ~Turns() = default;

  /// Whether to take another turn.
  [[nodiscard]] virtual bool another() = 0;
  /// Ours took so long in this turn.
  virtual void took(double seconds) = 0;
  virtual void note(std::string_view figure, double value) = 0;
  /// Of this process so far; none where nobody counts.
  [[nodiscard]] virtual std::uint64_t allocations() const { return 0; }

  /// NAME, the median, NAME_least and NAME_most, of values each times `units`.
  void note_spread(const std::string& name, const std::vector<double>& values, double units) {
    const Spread spread = spread_of(values);
    note(name, spread.median * units);
    note(name + "_least", spread.least * units);
    note(name + "_most", spread.most * units);
  }

  /// Of `items` each: `ours` does them all, `peer` says how many seconds it took for as many (or no_peer).
  /// Notes medians: `ns`, with its spread, and `peer_ns` an item, `ratio` = ours / peer; `items`,
  /// `allocations` of ours an item.
  template <class Ours, class Peer>
  void take(std::size_t items, const Ours& ours, const Peer& peer) {
    std::vector<double> our_seconds, peer_seconds, ratios;
    std::uint64_t allocated = 0;
    ours();  // warm
    while (another()) {
      const std::uint64_t before = allocations();
      const double seconds = processor_seconds_of(ours);
      allocated += allocations() - before;
      took(seconds);
      our_seconds.push_back(seconds);
      peer_seconds.push_back(peer());
      ratios.push_back(our_seconds.back() / peer_seconds.back());
    }
    const auto n = static_cast<double>(items);
    note("items", n);
    note_spread("ns", our_seconds, 1e9 / n);
    note("allocations", static_cast<double>(allocated) / (n * static_cast<double>(our_seconds.size())));
    if (std::isnan(ratios.front())) return;
    note("peer_ns", median_of(peer_seconds) / n * 1e9);
    note("ratio", median_of(ratios));
  }
};

}  // namespace kds::bench
