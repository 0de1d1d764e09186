#include "experiments/reproduce/findings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string_view>

#include "experiments/output/text.h"

namespace kds {

namespace {

std::size_t place_of(const PaperTable& table, std::string_view column) {
  const auto place = std::ranges::find(table.columns, column, &PaperColumn::name);
  return static_cast<std::size_t>(place - table.columns.begin());
}
double value_of(const PaperTable& table, const PaperRow& row, std::string_view column) {
  return row.ours[place_of(table, column)].value;
}

using RowFilter = std::function<bool(const PaperRow&)>;

// Returns the values of a column in order, for the rows that the filter takes.
std::vector<double> values_of(
    const PaperTable& table, std::string_view column,
    const RowFilter& takes = [](const PaperRow&) { return true; }) {
  std::vector<double> values;
  for (const PaperRow& row : table.rows)
    if (takes(row)) values.push_back(value_of(table, row, column));
  return values;
}

bool is_large_protein(const PaperRow& row) {
  return row.name.starts_with("1a4y") || row.name.starts_with("1cem");
}
bool is_in_dynamics(const PaperRow& row) {
  return row.name.starts_with("villin") || row.name.starts_with("random");
}
bool is_protein(const PaperRow& row) { return is_large_protein(row) || is_in_dynamics(row); }

struct Range {
  double least, most;
};
Range range_of(const std::vector<double>& values) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  return {*least, *most};
}
// Counts have no decimals.
std::string text_of(double value, bool is_count) {
  return is_count ? with_thousands(static_cast<std::uint64_t>(value)) : short_decimal(value);
}
std::string text_of(const Range& range) {
  const bool are_counts = range.least == std::floor(range.least) && range.most == std::floor(range.most);
  return fmt::format("{} to {}", text_of(range.least, are_counts), text_of(range.most, are_counts));
}

// Returns a time of each row divided by n log n.
std::vector<double> per_n_log_n(const PaperTable& table, std::string_view column, const RowFilter& takes) {
  std::vector<double> times;
  for (const PaperRow& row : table.rows) {
    const auto n = static_cast<double>(row.beads);
    if (takes(row)) times.push_back(value_of(table, row, column) / (n * std::log2(n)));
  }
  return times;
}

// Judges whether the time of a static helix grows no faster than n log n from 640 to 10,240 beads, give or
// take a tenth, for kds and for CGAL.
Finding on_sampling_time(const PaperTable& table) {
  const auto is_sampled = [](const PaperRow& row) { return row.name == "static helix" && row.beads >= 640; };
  const std::vector<double> ours = per_n_log_n(table, "wrapped_ms", is_sampled);
  const std::vector<double> cgal = per_n_log_n(table, "cgal_ms", is_sampled);
  const double of_ours = ours.back() / ours.front(), of_cgal = cgal.back() / cgal.front();
  return {"n-log-n",
          "From 640 to 10,240 beads, the time to build the wrapped hierarchy grows no faster than n log n",
          std::max(of_ours, of_cgal) <= 1.1,
          fmt::format("{:.2f} times the growth of n log n for kds, {:.2f} for CGAL, 0.77 in the paper",
                      of_ours, of_cgal)};
}

// Judges whether time / (n log n) of necklaces of about equal length varies by less than half.
Finding on_shape(const PaperTable& table) {
  const auto is_about_equal = [](const PaperRow& row) { return row.beads >= 1000 && row.beads <= 1400; };
  const Range ours = range_of(per_n_log_n(table, "wrapped_ms", is_about_equal));
  const Range cgal = range_of(per_n_log_n(table, "cgal_ms", is_about_equal));
  return {
      "shape",
      "The time depends very little on the shape: for 1,000 to 1,400 beads, time / (n log n) agrees within "
      "a factor of 1.5",
      std::max(ours.most / ours.least, cgal.most / cgal.least) <= 1.5,
      fmt::format("it varies {:.2f} times for kds, {:.2f} times for CGAL, 1.36 times in the paper",
                  ours.most / ours.least, cgal.most / cgal.least)};
}

std::vector<Finding> on_construction(const PaperTable& table) {
  const std::vector<double> averages = values_of(table, "rho_avg");
  double mean = 0;
  for (const double rho : averages) mean += rho / static_cast<double>(averages.size());
  const Range average = range_of(averages), least = range_of(values_of(table, "rho_min"));
  const Range layered = range_of(values_of(table, "layered_per_wrapped"));
  const std::vector<double> wrapped = values_of(table, "wrapped_ms"), power = values_of(table, "power_ms");
  std::vector<double> power_per_wrapped;
  for (std::size_t i = 0; i < power.size(); ++i) power_per_wrapped.push_back(power[i] / wrapped[i]);
  const Range dearer = range_of(power_per_wrapped);
  const auto is_long = [](const PaperRow& row) { return row.beads >= 50; };
  const Range proteins =
      range_of(values_of(table, "rho_avg", [&](const auto& row) { return is_protein(row); }));
  const Range others = range_of(
      values_of(table, "rho_avg", [&](const auto& row) { return is_long(row) && !is_protein(row); }));
  return {{"cages-alike", "Cages of the two hierarchies are alike within 5% on average", mean >= 0.95,
           fmt::format(
               "{} over all rows, {} by row; {} of {} rows within 5%", short_decimal(mean), text_of(average),
               std::ranges::count_if(averages, [](double rho) { return rho >= 0.95; }), averages.size())},
          {"cages-half", "Some wrapped cages are half as large as the layered ones", least.least < 0.6,
           fmt::format("least rho {}", short_decimal(least.least))},
          {"cages-of-proteins", "Among rows of 50 beads or more, cages differ most in a protein",
           proteins.least < others.least,
           fmt::format("average rho {} in a protein, at least {} in others", short_decimal(proteins.least),
                       short_decimal(others.least))},
          {"layered-cheapest", "The layered hierarchy is the cheapest to build", layered.most < 1,
           fmt::format("{} times the wrapped one's time", text_of(layered))},
          {"diagram-dearest", "The power diagram is the dearest to build", dearer.least > 1,
           fmt::format("{} times the wrapped hierarchy's time", text_of(dearer))},
          on_sampling_time(table),
          on_shape(table)};
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

// Returns the largest ratio of verifying time, naive or by the cascade, to lazy time.
double most_cheaper(const PaperTable& table) {
  double most = 0;
  for (const PaperRow& row : table.rows)
    most = std::max(most, std::max(value_of(table, row, "naive_ms"), value_of(table, row, "cascade_ms")) /
                              value_of(table, row, "lazy_ms"));
  return most;
}

std::vector<Finding> on_verification(const PaperTable& table) {
  const Range cascade = range_of(values_of(table, "cascade_per_naive"));
  const Range lazy = range_of(values_of(table, "lazy_per_naive"));
  const double spline = values_of(table, "cascade_per_naive", [](const PaperRow& row) {
                          return row.name == "spline" && row.beads == 1000;
                        }).front();
  const double cheaper = most_cheaper(table);
  return {
      on_frontier(table),
      on_tests(table),
      {"cascade-as-naive", "Cascade and naive verification take about as long, within a factor of 1.5",
       cascade.least > 1 / 1.5 && cascade.most < 1.5, fmt::format("{} times", text_of(cascade))},
      {"cascade-on-spline", "On the most finely sampled spline the cascade takes at most 0.8 of naive time",
       spline <= 0.8, fmt::format("{} times", short_decimal(spline))},
      {"lazy-cheaper", "Lazy updates are cheaper than verifying", lazy.most < 1,
       fmt::format("{} times", text_of(lazy))},
      {"lazy-ten-at-rest", "At rest, lazy updates can be ten times cheaper than verifying", cheaper >= 10,
       fmt::format("up to {} times", short_decimal(cheaper))}};
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

// Judges whether pairs per bead grow, or fall, from 640 to 10,240 beads of a helix.
Finding on_sampling(const PaperTable& table, std::string id, std::string_view helix, bool grows) {
  std::vector<double> per_bead;
  for (const PaperRow& row : table.rows)
    if (row.name == helix && row.beads >= 640)
      per_bead.push_back(value_of(table, row, "wrapped_pairs") / static_cast<double>(row.beads));
  return {std::move(id),
          fmt::format("Pairs per bead {} as the {} is sampled more finely", grows ? "rise" : "fall", helix),
          (per_bead.front() < per_bead.back()) == grows,
          fmt::format("{:.2f} to {:.2f}", per_bead.front(), per_bead.back())};
}

std::vector<Finding> on_static_collision(const PaperTable& table) {
  std::vector<Finding> findings = on_collision(table);
  const Range large = range_of(values_of(table, "layered_per_wrapped", is_large_protein));
  const Range others = range_of(
      values_of(table, "layered_per_wrapped", [](const PaperRow& row) { return !is_large_protein(row); }));
  findings.push_back({"layered-slower", "On large proteins the layered hierarchy is slower", large.least > 1,
                      fmt::format("{} times", text_of(large))});
  findings.push_back({"layered-as-fast", "On the other models it is as fast, within 15%",
                      others.least > 1 / 1.15 && others.most < 1.15,
                      fmt::format("{} times", text_of(others))});
  findings.push_back(on_sampling(table, "static-falls", "static helix", false));
  findings.push_back(on_sampling(table, "scaling-rises", "scaling helix", true));
  return findings;
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
  const Range in_dynamics = range_of(values_of(table, "cells_changed", is_in_dynamics));
  const double cheaper = most_cheaper(table);
  std::vector<double> removal;
  for (const PaperRow& row : table.rows)
    if (is_in_dynamics(row))
      removal.push_back(
          std::min(value_of(table, row, "reinsert_per_rebuild"), value_of(table, row, "greedy_per_rebuild")));
  const Range removals = range_of(removal);
  return {
      {"more-stable", "The wrapped hierarchy is more stable than the diagram", holds && all_bases < all_cells,
       fmt::format("{} bases and {} cells change in all rows together",
                   with_thousands(static_cast<std::uint64_t>(all_bases)),
                   with_thousands(static_cast<std::uint64_t>(all_cells)))},
      {"hundred-cells", "In molecular dynamics more than 100 cells change at each step",
       in_dynamics.least > 100, text_of(in_dynamics)},
      on_tests(table),
      {"cascade-no-slower", "The cascade is no slower than naive verification", cascade.most <= 1,
       fmt::format("{} times", text_of(cascade))},
      {"lazy-ten", "Between frames, lazy updates can be ten times cheaper than verifying", cheaper >= 10,
       fmt::format("up to {} times; the paper's own table shows 3.2 at most", short_decimal(cheaper))},
      {"removal-fast", "In molecular dynamics, removing beads is faster than rebuilding the diagram",
       removals.most < 1,
       fmt::format("the better of two removals takes {} times as long", text_of(removals))}};
}

// Returns the share of the variance of y that the best line in x explains.
double explained_share(const std::vector<double>& x, const std::vector<double>& y) {
  const auto mean = [](const std::vector<double>& v) {
    return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
  };
  const double x_mean = mean(x), y_mean = mean(y);
  double xx = 0, xy = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xx += (x[i] - x_mean) * (x[i] - x_mean);
    xy += (x[i] - x_mean) * (y[i] - y_mean);
    yy += (y[i] - y_mean) * (y[i] - y_mean);
  }
  return xx > 0 && yy > 0 ? xy * xy / (xx * yy) : 0;
}

std::vector<Finding> on_stability(const PaperTable& table) {
  const auto several = [](const PaperRow& row) { return std::stod(row.at) >= 2; };
  const Range bases = range_of(values_of(table, "bases_changed", several));
  const std::vector<double> cells = values_of(table, "cells_changed");
  std::vector<double> logarithms;
  for (const PaperRow& row : table.rows) logarithms.push_back(std::log2(std::stod(row.at)));
  const double share = explained_share(logarithms, cells);
  return {{"bases-flat", "Basis changes are flat from 2 frames on, within a factor of 1.5",
           bases.most <= 1.5 * bases.least, text_of(bases)},
          {"diagram-grows", "Changes of the diagram grow",
           std::is_sorted(cells.begin(), cells.end()) && cells.front() < cells.back(),
           fmt::format("from {} to {}", text_of(cells.front(), true), text_of(cells.back(), true))},
          {"diagram-grows-as-log",
           "They grow as the logarithm of the number of frames, which explains 95% of their variance or more",
           share >= 0.95, fmt::format("{:.1f}%", 100 * share)}};
}

std::vector<Finding> on_two_spirals(const PaperTable& table) {
  const PaperRow& closest = table.rows.back();
  const Range per_lazy_far = range_of(values_of(table, "layered_per_lazy", [&](const PaperRow& row) {
    return value_of(table, row, "wrapped_pairs") < 10;
  }));
  const Range per_full = range_of(values_of(table, "layered_per_full"));
  const std::vector<double> layered = values_of(table, "layered_pairs"),
                            wrapped = values_of(table, "wrapped_pairs");
  std::size_t fewer = 0;
  for (std::size_t i = 0; i < layered.size(); ++i) fewer += wrapped[i] <= layered[i] ? 1 : 0;
  return {
      {"lazy-far",
       "Where curves are far apart, lazy updates are up to 200 times as fast as the layered hierarchy, say "
       "100 times or more",
       per_lazy_far.most >= 100, fmt::format("{} times", text_of(per_lazy_far))},
      {"lazy-near", "Where curves almost touch, the advantage is gone, within a factor of two",
       value_of(table, closest, "layered_per_lazy") <= 2,
       fmt::format("{} times as fast", short_decimal(value_of(table, closest, "layered_per_lazy")))},
      {"wrapped-sets-smaller", "Wrapped sets are no larger than layered ones", fewer == layered.size(),
       fmt::format("{} of {} rows", fewer, layered.size())},
      {"layered-anew", "Building the layered hierarchy anew is faster than updating the whole wrapped one",
       per_full.most < 1, fmt::format("{} times the time", text_of(per_full))},
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
    case 3:
      return on_static_collision(table);
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
