#include "experiments/sweep/sweep_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <span>
#include <string_view>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

// Returns whether a row tells a value of an axis: "structure power" tells power of --structures.
bool tells(const std::string& row, const std::string& axis, const std::string& value) {
  return std::ranges::any_of(split(row, ','), [&](const std::string& part) {
    const std::string_view words = trimmed(part);
    const std::size_t blank = words.find(' ');
    return axis.starts_with(words.substr(0, blank)) && blank != std::string::npos &&
           words.substr(blank + 1) == value;
  });
}

// Plots the figures of a command over its first axis with several numbers, one plot for each of the first
// measures. Axes of one value do not name series. `pooled` says over what the means are.
std::string plots_of(const PooledFigures& pool, const std::string& command, const std::string& pooled) {
  constexpr std::size_t most_plots = 4, most_series = 12;
  std::vector<const PooledFigure*> figures;
  std::vector<std::set<std::string>> values(pool.names().size());
  for (const PooledFigure& figure : pool.figures()) {
    if (figure.of->command != command) continue;
    figures.push_back(&figure);
    for (std::size_t axis = 0; axis < values.size(); ++axis) values[axis].insert(figure.of->axes[axis]);
  }
  std::string html;
  for (std::size_t axis = 0; axis < pool.names().size() && html.empty(); ++axis) {
    std::map<std::string, PointPlot> plots;  // by measure
    std::vector<std::string> order;
    std::set<std::string> above_zero_only;  // measures with values that have no place on a logarithmic axis
    std::set<std::string> cut_off;          // measures with more series than a plot shows
    for (const PooledFigure* figure : figures) {
      const auto x = parse_double(figure->of->axes[axis]);
      if (!x || !std::isfinite(*x)) continue;
      const std::string& name = figure->measure;
      if (*x <= 0 || !(figure->mean() > 0)) {
        above_zero_only.insert(name);
        continue;
      }
      if (!plots.contains(name)) {
        if (order.size() == most_plots) continue;
        order.push_back(name);
        plots[name] = {pool.names()[axis], name, {}, {}};
        plots[name].x_is_chosen = true;
      }
      PointPlot& plot = plots[name];
      const auto& [of_command, row, texts] = *figure->of;
      std::string series = row;
      for (std::size_t k = 0; k < texts.size(); ++k)
        if (k != axis && values[k].size() > 1 && !texts[k].empty() && !tells(row, pool.names()[k], texts[k]))
          series += (series.empty() ? "" : ", ") + texts[k];
      auto found = std::ranges::find(plot.series, series);
      if (found == plot.series.end()) {
        if (plot.series.size() == most_series) {
          cut_off.insert(name);
          continue;
        }
        plot.series.push_back(series);
        found = plot.series.end() - 1;
      }
      plot.points.push_back({"", *x, figure->mean(), static_cast<std::size_t>(found - plot.series.begin())});
    }
    for (const std::string& name : order) {
      std::vector<double> places;
      for (const auto& point : plots[name].points) places.push_back(point.x);
      std::ranges::sort(places);
      if (places.empty() || places.front() == places.back()) continue;
      html += html_figure(
          svg_plot(plots[name]),
          html_escaped(fmt::format(
              "{}: {} by {}, means over {}, both axes logarithmic{}{}.", command, name, pool.names()[axis],
              pooled, above_zero_only.contains(name) ? ", values above 0 only" : "",
              cut_off.contains(name) ? fmt::format(", the first {} series only", most_series) : "")));
    }
  }
  return html;
}

}  // namespace

std::string sweep_page(const SweepPlan& plan, const CollectedSweep& collected, const PooledFigures& pool,
                       const std::vector<FailedTask>& failed, const std::vector<SweepCount>& counts,
                       const std::string& command_line) {
  constexpr std::size_t most_rows = 300;
  Page page;
  page.title = "kds sweep";
  page.command_line = command_line;
  page.data = {"results.csv", "results.json", "pooled.csv", "times.csv", "failed.csv"};
  const std::size_t tasks = collected.tasks;
  page.found = fmt::format(
      "<p>{} of {} tasks have results, in {} rows.{}</p>\n", with_thousands(collected.done),
      with_thousands(tasks), with_thousands(collected.rows),
      collected.done == tasks ? " The sweep is complete."
                              : fmt::format(" {} failed, {} crashed, {} are missing.", collected.failed,
                                            collected.crashed, collected.missing));
  std::vector<PooledFigure> shown;
  for (const PooledFigure& figure : pool.figures())
    if (shown.size() < most_rows &&
        std::ranges::any_of(figure.values, [](double value) { return value != 0; }))
      shown.push_back(figure);
  std::string pooled = pooled_table(pool.names()).html(shown);
  pooled += fmt::format("<p>{} of {} means; pooled.csv has all.</p>\n", shown.size(),
                        with_thousands(pool.figures().size()));
  const std::vector<std::string>& over = plan.spec().pooled;
  std::string plots;
  for (const SweepCount& count : counts)
    plots += plots_of(pool, count.command,
                      over.empty() ? "equal settings" : fmt::format("{}", fmt::join(over, " and ")));
  page.body = html_section("Plots", plots);
  if (!failed.empty())
    page.body +=
        html_section("Tasks without a result",
                     failed_table().html(std::span(failed).first(std::min(most_rows, failed.size()))));
  page.body += html_section("Tasks", count_table().html(without_repeated_sum(counts)));
  page.body += html_section("Means", pooled);
  page.words = html_escaped(fmt::format(
      "Means pool the tasks that {}. Their 95% intervals are Student's, for "
      "independent values; those of counts stay above 0. An interval takes {} values or more.",
      over.empty() ? "differ in nothing" : fmt::format("differ in {} only", fmt::join(over, ", ")),
      least_pooled));
  return html_page(page);
}

}  // namespace kds
