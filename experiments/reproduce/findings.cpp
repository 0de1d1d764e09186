#include "experiments/reproduce/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <string_view>

#include "experiments/output/text.h"

namespace kds {

namespace {

// Returns the values of a column in order.
std::vector<double> values_of(const PaperTable& table, std::string_view column) {
  const auto place = std::find_if(table.columns.begin(), table.columns.end(),
                                  [&](const PaperColumn& c) { return c.name == column; });
  const auto index = static_cast<std::size_t>(place - table.columns.begin());
  std::vector<double> values;
  for (const PaperRow& row : table.rows) values.push_back(row.ours[index].value);
  return values;
}

struct Range {
  double least, most;
};
Range range_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}
std::string text_of(const Range& range) {
  return fmt::format("{} to {}", short_decimal(range.least), short_decimal(range.most));
}

std::vector<Finding> on_construction(const PaperTable& table) {
  const std::vector<double> averages = values_of(table, "rho_avg");
  double mean = 0;
  for (const double rho : averages) mean += rho / static_cast<double>(averages.size());
  const Range average = range_of(averages), least = range_of(values_of(table, "rho_min"));
  const Range layered = range_of(values_of(table, "layered_per_wrapped"));
  const Range power = range_of(values_of(table, "power_per_wrapped"));
  return {{"cages-alike", "Cages of the two hierarchies differ by less than 5% on average", mean >= 0.95,
           fmt::format("{} over all rows, {} by row", short_decimal(mean), text_of(average))},
          {"cages-half", "Some wrapped cages are half as large as the layered ones", least.least < 0.6,
           fmt::format("least rho {}", short_decimal(least.least))},
          {"layered-cheapest", "The layered hierarchy is the cheapest to build", layered.most < 1,
           fmt::format("{} times the wrapped one's time", text_of(layered))},
          {"diagram-dearest", "The power diagram is the most expensive to build", power.least > 1,
           fmt::format("{} times the wrapped hierarchy's time", text_of(power))}};
}

Finding on_frontier(const PaperTable& table) {
  const Range frontier = range_of(values_of(table, "frontier"));
  return {"frontier", "The average frontier is below 10", frontier.most < 10, text_of(frontier)};
}

Finding on_tests(const PaperTable& table) {
  const Range tests = range_of(values_of(table, "cascade_tests_per_naive"));
  return {"cascade-tests", "The cascade does fewer tests than naive verification", tests.most < 1,
          fmt::format("{} times as many", text_of(tests))};
}

std::vector<Finding> on_verification(const PaperTable& table) {
  const Range cascade = range_of(values_of(table, "cascade_per_naive"));
  const Range lazy = range_of(values_of(table, "lazy_per_naive"));
  return {on_frontier(table),
          on_tests(table),
          {"cascade-as-naive", "Cascade and naive verification take about as long, within a factor of 1.5",
           cascade.least > 1 / 1.5 && cascade.most < 1.5, fmt::format("{} times", text_of(cascade))},
          {"lazy-cheaper", "Lazy updates are cheaper than verifying", lazy.most < 1,
           fmt::format("{} times", text_of(lazy))}};
}

std::vector<Finding> on_collision(const PaperTable& table) {
  const std::vector<double> pairs = values_of(table, "wrapped_pairs"), edges = values_of(table, "edges");
  std::size_t smaller = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) smaller += pairs[i] < edges[i] ? 1 : 0;
  const Range quadratic = range_of(values_of(table, "quadratic_per_wrapped"));
  return {{"sets-smaller", "Separating sets are smaller than the diagram's edges", smaller == pairs.size(),
           fmt::format("{} of {} rows", smaller, pairs.size())},
          {"faster-than-all", "The hierarchy is faster than all pairs", quadratic.least > 1,
           fmt::format("all pairs take {} times as long", text_of(quadratic))}};
}

std::vector<Finding> on_maintenance(const PaperTable& table) {
  const std::vector<double> cells = values_of(table, "cells_changed"),
                            bases = values_of(table, "bases_changed");
  bool holds = true;
  double all_cells = 0, all_bases = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    holds = holds && (bases[i] < cells[i] || cells[i] == 0);
    all_cells += cells[i];
    all_bases += bases[i];
  }
  const Range cascade = range_of(values_of(table, "cascade_per_naive"));
  return {
      {"more-stable", "The wrapped hierarchy is more stable than the diagram", holds && all_bases < all_cells,
       fmt::format("{} bases and {} cells change in all rows together",
                   with_thousands(static_cast<std::uint64_t>(all_bases)),
                   with_thousands(static_cast<std::uint64_t>(all_cells)))},
      on_tests(table),
      {"cascade-no-slower", "The cascade is no slower than naive verification", cascade.most <= 1,
       fmt::format("{} times", text_of(cascade))}};
}

std::vector<Finding> on_stability(const PaperTable& table) {
  const std::vector<double> bases = values_of(table, "bases_changed"),
                            cells = values_of(table, "cells_changed");
  const Range of_bases = range_of(bases);
  return {{"bases-flat", "Basis changes are flat in the number of frames, within a factor of 1.5",
           of_bases.most <= 1.5 * of_bases.least, text_of(of_bases)},
          {"diagram-grows", "Changes of the diagram grow",
           std::is_sorted(cells.begin(), cells.end()) && cells.front() < cells.back(),
           fmt::format("from {} to {}", short_decimal(cells.front()), short_decimal(cells.back()))}};
}

std::vector<Finding> on_two_spirals(const PaperTable& table) {
  const Range lazy = range_of(values_of(table, "lazy_per_full"));
  return {{"lazy-far",
           "Lazy updates are up to 200 times as fast as full ones where curves are far apart, say 100 times "
           "or more",
           1 / lazy.least >= 100, fmt::format("{} times", short_decimal(1 / lazy.least))},
          {"lazy-near", "If curves nearly touch, lazy updates are at most twice as fast", 1 / lazy.most <= 2,
           fmt::format("{} times as fast", short_decimal(1 / lazy.most))},
          on_frontier(table)};
}

}  // namespace

std::string sentence_of(const Finding& finding) {
  return fmt::format("{}: {} ({}).", finding.claim, finding.holds ? "yes" : "no", finding.figures);
}

ClaimsJudged judged(std::span<const PaperTable> tables) {
  std::map<std::string, bool> claims;
  for (const PaperTable& table : tables)
    for (const Finding& finding : findings_of(table)) {
      const auto [place, is_new] = claims.emplace(finding.id, finding.holds);
      place->second = place->second && finding.holds;
    }
  const auto hold = std::ranges::count_if(claims, [](const auto& claim) { return claim.second; });
  return {claims.size(), static_cast<std::size_t>(hold)};
}

std::vector<Finding> findings_of(const PaperTable& table) {
  switch (table.number) {
    case 1:
      return on_construction(table);
    case 2:
      return on_verification(table);
    case 5:
      return on_maintenance(table);
    case 6:
      return on_stability(table);
    case 7:
      return on_two_spirals(table);
    default:
      return on_collision(table);
  }
}

}  // namespace kds
