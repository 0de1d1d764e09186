#pragma once
// Rows of `kds bench`, which compare kds with a peer in the same process. Reports the rows to programs and
// people.

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/output/page/html_page.h"
#include "experiments/output/result_json.h"
#include "experiments/program/timing.h"

namespace kds {

struct BenchRow {
  std::string name, input;
  std::size_t n = 0;
  double value = 0;
  std::string unit;
  std::string peer;                  ///< empty if none
  std::optional<double> peer_value;  ///< in the same unit
  /// The largest permitted ratio ours / peer. The goal is the largest permitted value instead if there is no
  /// peer or if `goal_in_unit` is set. Empty if there is no goal.
  std::optional<double> goal;
  bool goal_in_unit = false;
  std::optional<Spread> spread = {};  ///< the value over the rounds, in its unit; empty for a count

  /// Returns nothing if there is no peer or its value is 0.
  [[nodiscard]] std::optional<double> ratio() const {
    return peer_value && *peer_value != 0 ? std::optional(value / *peer_value) : std::nullopt;
  }
  /// Returns nothing if there is no goal.
  [[nodiscard]] std::optional<bool> holds() const {
    return goal ? std::optional((goal_in_unit ? value : ratio().value_or(value)) <= *goal) : std::nullopt;
  }
};

/// Returns the row with the spread of its value. `seconds` has our time of each round, and `units` converts
/// it to the value's unit.
[[nodiscard]] BenchRow with_spread(BenchRow row, const std::vector<double>& seconds, double units);

/// Returns text that ends with a newline.
[[nodiscard]] std::string bench_json(std::string command, Json settings, std::span<const BenchRow> rows);
/// Returns a header and one line per row.
[[nodiscard]] std::string bench_csv(std::span<const BenchRow> rows);
[[nodiscard]] std::string bench_table(std::span<const BenchRow> rows);
/// `page` says how the results were made.
[[nodiscard]] std::string bench_page(const std::string& subject, std::span<const BenchRow> rows, Page page);

}  // namespace kds
