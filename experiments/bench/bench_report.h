#pragma once
// Rows of `kds bench`: ours beside a peer in the same process. For programs and for people.

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
  std::string peer;                  ///< empty: none
  std::optional<double> peer_value;  ///< in the same unit
  /// What the ratio ours / peer is to be at most, or the value where there is no peer or the goal is in its
  /// unit; none where no figure is asked for.
  std::optional<double> goal;
  bool goal_in_unit = false;
  std::optional<Spread> spread = {};  ///< of the value over the rounds, in its unit; none where it is a count

  /// None beside nothing.
  [[nodiscard]] std::optional<double> ratio() const {
    return peer_value && *peer_value != 0 ? std::optional(value / *peer_value) : std::nullopt;
  }
  /// None without a goal.
  [[nodiscard]] std::optional<bool> holds() const {
    return goal ? std::optional((goal_in_unit ? value : ratio().value_or(value)) <= *goal) : std::nullopt;
  }
};

/// The row with the spread of its value: that of ours by round, times what the value is in.
[[nodiscard]] BenchRow with_spread(BenchRow row, const std::vector<double>& seconds, double units);

/// Ends with a newline.
[[nodiscard]] std::string bench_json(std::string command, Json settings, std::span<const BenchRow> rows);
/// A header and one line a row.
[[nodiscard]] std::string bench_csv(std::span<const BenchRow> rows);
[[nodiscard]] std::string bench_table(std::span<const BenchRow> rows);
/// `page` says how it was made.
[[nodiscard]] std::string bench_page(const std::string& subject, std::span<const BenchRow> rows, Page page);

}  // namespace kds
