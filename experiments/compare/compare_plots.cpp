#include "experiments/compare/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <numeric>
#include <span>

#include "experiments/events/event_distribution.h"
#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

using Points = std::vector<std::pair<double, double>>;
// The points of a row. `bars` has an error bar for each point, or is empty.
struct PlottedRow {
  Points points, bars = {};
};

bool at_smallest_stride(const Comparison& comparison, const CompareRow& row) {
  return row.stride == comparison.rows.front().stride;
}

// Returns "wrapped", or "wrapped, hermite, 300K.dcd" if there are several motions and inputs.
std::string curve_name(const Comparison& comparison, const CompareRow& row) {
  const std::string more = distinction(comparison, row);
  return row.structure.name + (more.empty() ? "" : ", " + more);
}

Curve& curve_of(LinePlot& plot, const std::string& name) {
  const auto found = std::ranges::find(plot.curves, name, &Curve::name);
  return found != plot.curves.end() ? *found : plot.curves.emplace_back(Curve{name, {}});
}

// Returns one plot if there are few curves. Otherwise returns a small plot for each structure and each group
// of eight inputs and motions.
std::string plot_of(const Comparison& comparison, const LinePlot& empty,
                    const std::function<PlottedRow(const CompareRow&)>& points_of) {
  constexpr std::size_t few = 4, most = 8;
  const std::vector<std::string> cases = cases_of(comparison);
  LinePlot together = empty;
  std::vector<std::pair<std::string, LinePlot>> apart;  // by structure and group of eight
  for (const CompareRow& row : comparison.rows) {
    const PlottedRow plotted = points_of(row);
    if (plotted.points.empty()) continue;
    const auto add_to = [&](Curve& curve) {
      curve.points.insert(curve.points.end(), plotted.points.begin(), plotted.points.end());
      curve.bars.insert(curve.bars.end(), plotted.bars.begin(), plotted.bars.end());
    };
    add_to(curve_of(together, curve_name(comparison, row)));
    const std::string of_case = distinction(comparison, row);
    const auto eight = static_cast<std::size_t>(std::ranges::find(cases, of_case) - cases.begin()) / most;
    const std::string title = row.structure.name + (eight == 0 ? "" : fmt::format(" ({})", eight + 1));
    auto panel = std::ranges::find(apart, title, &std::pair<std::string, LinePlot>::first);
    if (panel == apart.end()) panel = apart.insert(panel, {title, empty});
    add_to(curve_of(panel->second, of_case));
  }
  if (together.curves.empty()) return "";
  if (together.curves.size() <= few) return svg_plot(together);
  PanelPlot panels;
  for (auto& [title, plot] : apart) panels.panels.push_back({title, std::move(plot)});
  return svg_plot(panels);
}

// Plots `value` by stride, with `interval`, if given, as its error bar.
std::string over_strides(const Comparison& comparison, const char* label, const char* caption,
                         const std::function<std::optional<double>(const CompareRow&)>& value,
                         const std::function<std::optional<MeanInterval>(const CompareRow&)>& interval = {}) {
  bool has_bars = false;
  const std::string plot =
      plot_of(comparison, {"stride", label, Drawn::points, {}}, [&](const CompareRow& row) {
        const std::optional<double> y = row.has_events() ? value(row) : std::nullopt;
        if (!y) return PlottedRow{};
        const auto known = interval ? interval(row) : std::nullopt;
        has_bars = has_bars || known;
        return PlottedRow{{{static_cast<double>(row.stride), *y}},
                          {known ? std::pair(known->lower, known->upper) : std::pair(*y, *y)}};
      });
  if (plot.empty()) return "";
  return html_figure(
      plot, std::string(caption) + (has_bars ? " Error bars are 95% intervals; values of fewer than 50 steps "
                                               "have none."
                                             : ""));
}

// Groups the inputs by chain. Trajectories of one chain at several temperatures, for example, belong
// together.
std::vector<std::vector<const ComparedInput*>> inputs_by_chain(const Comparison& comparison) {
  std::vector<std::vector<const ComparedInput*>> chains;
  for (const ComparedInput& input : comparison.inputs) {
    const auto same = std::ranges::find_if(
        chains, [&](const auto& chain) { return chain.front()->bead_names == input.bead_names; });
    (same != chains.end() ? *same : chains.emplace_back()).push_back(&input);
  }
  return chains;
}

double share(const CompareRow& row, std::size_t bead) {
  return 100 * static_cast<double>(row.structure.distribution.by_bead[bead]) /
         static_cast<double>(row.events());
}

// Returns the beads that most events name, in descending order of the number of events.
std::vector<std::size_t> busiest(const CompareRow& row, std::size_t most) {
  const auto& counts = row.structure.distribution.by_bead;
  std::vector<std::size_t> beads(counts.size());
  std::iota(beads.begin(), beads.end(), std::size_t{0});
  const std::size_t shown = std::min(most, beads.size());
  std::partial_sort(
      beads.begin(), beads.begin() + static_cast<std::ptrdiff_t>(shown), beads.end(),
      [&](std::size_t a, std::size_t b) { return counts[a] != counts[b] ? counts[a] > counts[b] : a < b; });
  beads.resize(shown);
  std::erase_if(beads, [&](std::size_t bead) { return counts[bead] == 0; });
  return beads;
}

// Orders the rows such that the inputs and motions of a structure follow each other.
std::vector<std::reference_wrapper<const CompareRow>> by_structure(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const CompareRow& row : comparison.rows)
    if (std::ranges::find(names, row.structure.name) == names.end()) names.push_back(row.structure.name);
  std::vector<std::reference_wrapper<const CompareRow>> rows;
  for (const std::string& name : names)
    for (const CompareRow& row : comparison.rows)
      if (row.structure.name == name) rows.emplace_back(row);
  return rows;
}

std::string along_chain(const Comparison& comparison, const std::vector<const ComparedInput*>& inputs) {
  constexpr std::size_t listed = 5;
  const ComparedInput& chain = *inputs.front();
  const auto name_of = [&chain](std::size_t bead) { return bead_text(bead, chain.bead_names[bead]); };
  RowsPlot plot{"bead", chain.beads, name_of, {}};
  std::vector<HtmlRow> table;
  for (const CompareRow& row : by_structure(comparison)) {
    const bool here =
        std::ranges::any_of(inputs, [&](const ComparedInput* input) { return input->name == row.input; });
    if (!here || !at_smallest_stride(comparison, row) || row.events() == 0) continue;
    const std::vector<std::size_t> beads = busiest(row, listed);
    if (beads.empty()) continue;
    RowsPlot::Row& bars = plot.rows.emplace_back(RowsPlot::Row{curve_name(comparison, row), "", {}});
    bars.note = fmt::format("at most {}% of its events, at {}", tick_label(share(row, beads.front())),
                            name_of(beads.front()));
    for (std::size_t bead = 0; bead < chain.beads; ++bead) bars.values.push_back(share(row, bead));
    HtmlRow& line = table.emplace_back(HtmlRow{{bars.name}});
    for (const std::size_t bead : beads)
      line.cells.push_back(fmt::format("{} ({} events)", name_of(bead),
                                       with_thousands(row.structure.distribution.by_bead[bead])));
  }
  if (plot.rows.empty()) return "";
  std::string files;
  for (const ComparedInput* input : inputs) files += (files.empty() ? "" : ", ") + input->short_name;
  return html_figure(
             svg_plot(plot),
             fmt::format(
                 "{}: share of a structure's events that name a bead, along the chain, each "
                 "row on its own scale. On wide pages the pointer shows the bead and all shares in %.",
                 html_escaped(files))) +
         html_table({"most events name", "first", "second", "third", "fourth", "fifth"}, table, "<");
}

}  // namespace

std::vector<std::string> cases_of(const Comparison& comparison) {
  std::vector<std::string> cases;
  for (const CompareRow& row : comparison.rows)
    if (const std::string name = distinction(comparison, row); std::ranges::find(cases, name) == cases.end())
      cases.push_back(name);
  return cases;
}

std::string plots_over_strides(const Comparison& comparison) {
  if (comparison.rows.front().stride == comparison.rows.back().stride) return "";
  return over_strides(
             comparison, "events per step", "Events from one frame to the next, by stride.",
             [](const CompareRow& row) { return std::optional(row.events_per_step()); },
             [](const CompareRow& row) { return row.events_per_step_interval(); }) +
         over_strides(comparison, "events a ps", "Events in a picosecond, by stride.",
                      [](const CompareRow& row) { return row.events_per_picosecond(); }) +
         over_strides(
             comparison, "events", "Events of the whole run, by stride.",
             [](const CompareRow& row) { return std::optional(static_cast<double>(row.events())); }) +
         over_strides(
             comparison, "events a net change",
             "Events per net change, by stride. Changes that are undone before the next frame make it "
             "larger.",
             [](const CompareRow& row) { return row.events_per_net_change(); },
             [](const CompareRow& row) { return row.events_per_net_change_interval(); });
}

std::string plots_over_time(const Comparison& comparison) {
  constexpr std::size_t most_bins = 100;
  const std::string plot =
      plot_of(comparison, {"frame", "events per step", Drawn::line, {}}, [&](const CompareRow& row) {
        Points points;
        if (!at_smallest_stride(comparison, row)) return PlottedRow{};
        const std::size_t width = bin_width(row.steps, most_bins);
        const std::span<const double> steps(row.events_of_steps);
        for (std::size_t first = 0; first < steps.size(); first += width) {
          const auto bin = steps.subspan(first, std::min(width, steps.size() - first));
          const auto count = static_cast<double>(bin.size());
          const double middle = (static_cast<double>(first) + count / 2) * static_cast<double>(row.stride);
          points.emplace_back(middle, std::accumulate(bin.begin(), bin.end(), 0.0) / count);
        }
        return PlottedRow{std::move(points)};
      });
  return plot.empty() ? ""
                      : html_figure(plot,
                                    "Events per step over the course of the run, as means of neighbouring "
                                    "steps. Frames are counted from the first frame read.");
}

std::string plots_by_kind(const Comparison& comparison) {
  const std::vector<std::string> cases = cases_of(comparison);
  std::vector<std::pair<std::string, BarPlot>> plots;  // by structure
  for (const CompareRow& row : comparison.rows) {
    if (!at_smallest_stride(comparison, row) || row.events() + row.internal() == 0) continue;
    const std::string& name = row.structure.name;
    auto plot = std::ranges::find(plots, name, &std::pair<std::string, BarPlot>::first);
    if (plot == plots.end()) plot = plots.insert(plot, {name, {"events per step", {}, cases}});
    const auto series =
        static_cast<std::size_t>(std::ranges::find(cases, distinction(comparison, row)) - cases.begin());
    for (const auto& [kind, count] : row.structure.events_by_kind)
      plot->second.bars.push_back({row.structure.label_of(kind),
                                   static_cast<double>(count) / static_cast<double>(row.steps), series});
  }
  std::string html;
  for (auto& [name, plot] : plots) {
    std::vector<std::string> with_any;
    for (const BarPlot::Bar& bar : plot.bars)
      if (bar.value > 0) with_any.push_back(bar.name);
    std::erase_if(plot.bars,
                  [&](const auto& bar) { return std::ranges::find(with_any, bar.name) == with_any.end(); });
    // The bars of a kind for all inputs and motions are adjacent, and only the first shows the kind's name.
    std::vector<std::string> kinds;
    for (const BarPlot::Bar& bar : plot.bars)
      if (std::ranges::find(kinds, bar.name) == kinds.end()) kinds.push_back(bar.name);
    std::ranges::stable_sort(plot.bars, {}, [&](const BarPlot::Bar& bar) {
      return std::ranges::find(kinds, bar.name) - kinds.begin();
    });
    std::string last;
    for (BarPlot::Bar& bar : plot.bars) last = std::exchange(bar.name, bar.name == last ? "" : bar.name);
    html += html_figure(svg_plot(plot), fmt::format("Events of {} by kind, at stride {}.", html_escaped(name),
                                                    comparison.rows.front().stride));
  }
  return html;
}

std::string plots_by_level(const Comparison& comparison) {
  const std::string plot =
      plot_of(comparison, {"level of the tree, root 0", "% of events", Drawn::points, {}},
              [&](const CompareRow& row) {
                Points points;
                if (!at_smallest_stride(comparison, row) || row.events() == 0) return PlottedRow{};
                for (const std::uint64_t count : row.structure.distribution.by_level)
                  points.emplace_back(static_cast<double>(points.size()),
                                      100 * static_cast<double>(count) / static_cast<double>(row.events()));
                return PlottedRow{std::move(points)};
              });
  return plot.empty() ? "" : html_figure(plot, "Share of the events at each level of the tree.");
}

std::string plots_along_chain(const Comparison& comparison) {
  std::string html;
  for (const auto& inputs : inputs_by_chain(comparison)) html += along_chain(comparison, inputs);
  return html;
}

}  // namespace kds
