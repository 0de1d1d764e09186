#pragma once
// The subjects of kds_benchmarks and of `kds bench`: measurements of certificates and of whole runs. The
// measurements time kds and a peer in turn. Google Benchmark in kds_benchmarks or `kds bench` determines the
// number of turns. Because the speed of a machine drifts, only the ratio is reliable. Times are processor
// times.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "experiments/program/timing.h"

namespace kds::bench {

/// Forces the compiler to compute `value`.
template <class T>
void keep(const T& value) {
  asm volatile("" : : "r,m"(value) : "memory");
}

inline constexpr double no_peer = std::numeric_limits<double>::quiet_NaN();

class Turns {
 public:
  virtual ~Turns() = default;

  /// Returns whether to take another turn.
  [[nodiscard]] virtual bool another() = 0;
  /// Records our time in this turn.
  virtual void took(double seconds) = 0;
  virtual void note(std::string_view figure, double value) = 0;
  /// Returns the allocations of this process so far, or 0 if they are not counted.
  [[nodiscard]] virtual std::uint64_t allocations() const { return 0; }

  /// Notes the median as NAME, and the extremes as NAME_least and NAME_most. All values are multiplied by
  /// `units`.
  void note_spread(const std::string& name, const std::vector<double>& values, double units) {
    const Spread spread = spread_of(values);
    note(name, spread.median * units);
    note(name + "_least", spread.least * units);
    note(name + "_most", spread.most * units);
  }

  /// Measures `items` items per turn. `ours` processes all of them; `peer` returns the seconds that the peer
  /// took for as many items (or no_peer). Notes medians: `ns` per item with its spread, `peer_ns` per item,
  /// and `ratio` = ours / peer. Also notes `items` and our `allocations` per item.
  template <class Ours, class Peer>
  void take(std::size_t items, const Ours& ours, const Peer& peer) {
    std::vector<double> our_seconds, peer_seconds, ratios;
    ours();  // warms up
    const std::uint64_t before = allocations();
    ours();
    const std::uint64_t allocated = allocations() - before;
    while (another()) {
      our_seconds.push_back(processor_seconds_per_call(ours));
      took(our_seconds.back());
      peer_seconds.push_back(peer());
      ratios.push_back(our_seconds.back() / peer_seconds.back());
    }
    const auto n = static_cast<double>(items);
    note("items", n);
    note_spread("ns", our_seconds, 1e9 / n);
    note("allocations", static_cast<double>(allocated) / n);
    if (std::isnan(ratios.front())) return;
    note("peer_ns", median_of(peer_seconds) / n * 1e9);
    note("ratio", median_of(ratios));
  }
};

/// A measurement of certificates or of a whole run.
struct Subject {
  std::string name;   ///< such as settle/facet/linear
  std::string input;  ///< the data it runs on
  std::size_t beads;
  std::string peer;
  /// Goals: the largest permitted time of an item in nanoseconds, or its ratio to the peer's time.
  std::optional<double> most_ns, most_ratio;
  std::function<void(Turns&)> run;
};

/// `instances` is the folder of the moving-point files. Throws InputError if a file is missing.
[[nodiscard]] std::vector<Subject> certificate_subjects(const std::filesystem::path& instances);
[[nodiscard]] std::vector<Subject> slack_subjects();
/// An item is an event: the first failure and four others get new times.
[[nodiscard]] std::vector<Subject> queue_subjects();
/// An item is an event. The peer is one static build.
[[nodiscard]] std::vector<Subject> engine_subjects(const std::filesystem::path& instances);

}  // namespace kds::bench
