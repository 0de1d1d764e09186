#include "experiments/reproduce/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "experiments/output/text.h"

namespace kds {

namespace {

const char* yes_or_no(bool holds) { return holds ? "yes" : "no"; }

// The values of a column that there are, in order.
std::vector<double> values_of(const PaperTable& table, std::string_view column) {
  const auto place = std::find_if(table.columns.begin(), table.columns.end(),
                                  [&](const PaperColumn& c) { return c.name == column; });
  const auto index = static_cast<std::size_t>(place - table.columns.begin());
  std::vector<double> values;
  for (const PaperRow& row : table.rows)
    if (row.ours[index]) values.push_back(*row.ours[index]);
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

std::vector<std::string> on_construction(const PaperTable& table) {
  const std::vector<double> averages = values_of(table, "rho_avg");
  double mean = 0;
  for (const double rho : averages) mean += rho / static_cast<double>(averages.size());
  const Range average = range_of(averages), least = range_of(values_of(table, "rho_min"));
  const Range layered = range_of(values_of(table, "layered_per_wrapped"));
  const Range power = range_of(values_of(table, "power_per_wrapped"));
  return {
      fmt::format(
          "Cages of the two hierarchies are alike within 5% on average: {} ({} over all rows, {} by row).",
          yes_or_no(mean >= 0.95), short_decimal(mean), text_of(average)),
      fmt::format("Some wrapped cages are half as large as the layered ones: {} (least rho {}).",
                  yes_or_no(least.least < 0.6), short_decimal(least.least)),
      fmt::format("The layered hierarchy is the cheapest to build: {} ({} times the wrapped one's time).",
                  yes_or_no(layered.most < 1), text_of(layered)),
      fmt::format("The power diagram is the dearest to build: {} ({} times the wrapped hierarchy's time).",
                  yes_or_no(power.least > 1), text_of(power))};
}

std::string on_frontier(const PaperTable& table) {
  const Range frontier = range_of(values_of(table, "frontier"));
  return fmt::format("The average frontier is below 10: {} ({}).", yes_or_no(frontier.most < 10),
                     text_of(frontier));
}

std::string on_tests(const PaperTable& table) {
  const Range tests = range_of(values_of(table, "cascade_tests_per_naive"));
  return fmt::format("The cascade does fewer tests than naive verification: {} ({} times as many).",
                     yes_or_no(tests.most < 1), text_of(tests));
}

std::vector<std::string> on_verification(const PaperTable& table) {
  const Range cascade = range_of(values_of(table, "cascade_per_naive"));
  const Range lazy = range_of(values_of(table, "lazy_per_naive"));
  return {
      on_frontier(table), on_tests(table),
      fmt::format("Cascade and naive verification take about as long, within a factor of 1.5: {} ({} times).",
                  yes_or_no(cascade.least > 1 / 1.5 && cascade.most < 1.5), text_of(cascade)),
      fmt::format("Lazy updates are cheaper than verifying: {} ({} times).", yes_or_no(lazy.most < 1),
                  text_of(lazy))};
}

std::vector<std::string> on_collision(const PaperTable& table) {
  const std::vector<double> pairs = values_of(table, "wrapped_pairs"), edges = values_of(table, "edges");
  std::size_t smaller = 0;
  for (std::size_t i = 0; i < pairs.size(); ++i) smaller += pairs[i] < edges[i] ? 1 : 0;
  const Range quadratic = range_of(values_of(table, "quadratic_per_wrapped"));
  return {fmt::format("Separating sets are smaller than the diagram's edges: {} ({} of {} rows).",
                      yes_or_no(smaller == pairs.size()), smaller, pairs.size()),
          fmt::format("The hierarchy is faster than all pairs: {} (all pairs take {} times as long).",
                      yes_or_no(quadratic.least > 1), text_of(quadratic))};
}

std::vector<std::string> on_maintenance(const PaperTable& table) {
  const std::vector<double> cells = values_of(table, "cells_changed"),
                            bases = values_of(table, "bases_changed");
  bool holds = true;
  double all_cells = 0, all_bases = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    holds = holds && (bases[i] < cells[i] || cells[i] == 0);
    all_cells += cells[i];
    all_bases += bases[i];
  }
  return {
      fmt::format(
          "The wrapped hierarchy is more stable than the diagram: {} ({} bases and {} cells change in "
          "all rows together).",
          yes_or_no(holds && all_bases < all_cells), with_thousands(static_cast<std::uint64_t>(all_bases)),
          with_thousands(static_cast<std::uint64_t>(all_cells))),
      on_tests(table),
      fmt::format("The cascade is no slower than naive verification: {} ({} times).",
                  yes_or_no(range_of(values_of(table, "cascade_per_naive")).most <= 1),
                  text_of(range_of(values_of(table, "cascade_per_naive"))))};
}

std::vector<std::string> on_stability(const PaperTable& table) {
  const std::vector<double> bases = values_of(table, "bases_changed"),
                            cells = values_of(table, "cells_changed");
  const Range of_bases = range_of(bases);
  return {fmt::format("Basis changes are flat in the number of frames, within a factor of 1.5: {} ({}).",
                      yes_or_no(of_bases.most <= 1.5 * of_bases.least), text_of(of_bases)),
          fmt::format("Changes of the diagram grow: {} (from {} to {}).",
                      yes_or_no(std::is_sorted(cells.begin(), cells.end()) && cells.front() < cells.back()),
                      short_decimal(cells.front()), short_decimal(cells.back()))};
}

std::vector<std::string> on_two_spirals(const PaperTable& table) {
  const Range lazy = range_of(values_of(table, "lazy_per_full"));
  return {
      fmt::format("Lazy updates are up to 200 times as fast as full ones where curves are far apart, say 100 "
                  "times or more: {} ({} times).",
                  yes_or_no(1 / lazy.least >= 100), short_decimal(1 / lazy.least)),
      fmt::format(
          "Where they nearly touch the advantage is gone, within a factor of two: {} ({} times as fast).",
          yes_or_no(1 / lazy.most <= 2), short_decimal(1 / lazy.most)),
      on_frontier(table)};
}

}  // namespace

std::vector<std::string> findings_of(const PaperTable& table) {
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
