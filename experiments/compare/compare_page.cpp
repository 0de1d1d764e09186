#include "experiments/compare/compare_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "experiments/compare/compare_report.h"
#include "experiments/events/event_places.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::string_view kWords =
    "An <em>event</em> changes the structure itself; <em>internal</em> ones are its bookkeeping. <em>Net "
    "changes</em> are what is not the same at one frame and the next, whatever happened in between: nodes of "
    "the wrapped hierarchy with another basis, cells of one power diagram that are not in the other, pairs "
    "that meet in one frame only, ranks of the sorted list with another bead. <em>Efficiency</em> is events "
    "a net change. Where all that changes changes once it is 1 for nodes and pairs, 0.2 for flips in space, "
    "which exchange five cells, and 0.5 for interchanges. <em>Peak</em>, the most certificates at once, is "
    "compactness; <em>on bead</em>, the most on one bead, is locality; the time an event takes, certificates "
    "that never fail included, is responsiveness. Seconds are the median of the rounds, and in brackets the "
    "least and the most.";

std::size_t least_stride(const Comparison& comparison) { return comparison.rows.front().stride; }
std::size_t most_stride(const Comparison& comparison) { return comparison.rows.back().stride; }

// "wrapped", or "wrapped, 300K.dcd, linear" where inputs and motions are several.
std::string curve_name(const Comparison& comparison, const CompareRow& row) {
  const std::string more = distinction(comparison, row);
  return row.structure.name + (more.empty() ? "" : ", " + more);
}

template <class Value>
std::string over_strides(const Comparison& comparison, const char* label, const char* caption, Value value) {
  LinePlot plot{"stride", label, Drawn::points, {}};
  for (const CompareRow& row : comparison.rows) {
    const std::optional<double> y = value(row);
    if (!y) continue;
    const std::string name = curve_name(comparison, row);
    auto curve =
        std::find_if(plot.curves.begin(), plot.curves.end(), [&](const Curve& c) { return c.name == name; });
    if (curve == plot.curves.end()) curve = plot.curves.insert(curve, {name, {}});
    curve->points.emplace_back(static_cast<double>(row.stride), *y);
  }
  return plot.curves.empty() ? "" : html_figure(svg_plot(plot), caption);
}

std::string plots_over_strides(const Comparison& comparison) {
  if (least_stride(comparison) == most_stride(comparison)) return "";
  return over_strides(
             comparison, "events", "Events of the whole run, by stride.",
             [](const CompareRow& row) { return std::optional(static_cast<double>(row.events())); }) +
         over_strides(comparison, "events a step", "Events from one frame to the next, by stride.",
                      [](const CompareRow& row) { return std::optional(row.events_per_step()); }) +
         over_strides(comparison, "events a net change",
                      "Events a net change, by stride: what is undone before the next frame counts here.",
                      [](const CompareRow& row) { return row.efficiency(); });
}

// Of the rows at the least stride that have events.
template <class Points>
std::string by_place(const Comparison& comparison, const char* x_label, Drawn drawn, const char* caption,
                     Points points_of) {
  LinePlot plot{x_label, "% of events", drawn, {}};
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison) || row.events() == 0) continue;
    Curve curve{curve_name(comparison, row), points_of(row)};
    for (auto& [x, y] : curve.points) y *= 100 / static_cast<double>(row.events());
    if (!curve.points.empty()) plot.curves.push_back(std::move(curve));
  }
  return plot.curves.empty() ? "" : html_figure(svg_plot(plot), caption);
}

std::vector<std::pair<double, double>> points_by_level(const CompareRow& row) {
  std::vector<std::pair<double, double>> points;
  for (const std::uint64_t count : row.structure.places.by_level)
    points.emplace_back(static_cast<double>(points.size()), static_cast<double>(count));
  return points;
}

std::string plots_by_kind(const Comparison& comparison) {
  std::string html;
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison) || row.events() == 0) continue;
    BarPlot plot{"events", {}};
    for (const auto& [kind, count] : row.structure.events_by_kind)
      if (count > 0) plot.bars.emplace_back(kind, static_cast<double>(count));
    if (plot.bars.size() > 1)
      html += html_figure(svg_plot(plot), fmt::format("Events of {} by kind, at stride {}.",
                                                      html_escaped(curve_name(comparison, row)), row.stride));
  }
  return html;
}

std::string bead_text(const ComparedInput& input, std::size_t bead) {
  const std::string& name = input.bead_names[bead];
  return name.empty() ? fmt::format("bead {}", bead) : fmt::format("bead {}, {}", bead, name);
}

// The beads with the most events.
std::string busiest_beads(const Comparison& comparison) {
  constexpr std::size_t most = 5;
  std::string html;
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison) || row.events() == 0) continue;
    const auto input = std::find_if(comparison.inputs.begin(), comparison.inputs.end(),
                                    [&](const ComparedInput& i) { return i.file == row.input; });
    std::vector<std::size_t> beads(row.structure.places.by_bead.size());
    for (std::size_t b = 0; b < beads.size(); ++b) beads[b] = b;
    const std::size_t shown = std::min(most, beads.size());
    std::partial_sort(beads.begin(), beads.begin() + static_cast<std::ptrdiff_t>(shown), beads.end(),
                      [&](std::size_t a, std::size_t b) {
                        const auto& counts = row.structure.places.by_bead;
                        return counts[a] != counts[b] ? counts[a] > counts[b] : a < b;
                      });
    html +=
        fmt::format("<p>Most events of <strong>{}</strong> name ", html_escaped(curve_name(comparison, row)));
    for (std::size_t i = 0; i < shown; ++i)
      html += fmt::format("{}{} ({})", i == 0 ? "" : "; ", html_escaped(bead_text(*input, beads[i])),
                          with_thousands(row.structure.places.by_bead[beads[i]]));
    html += ".</p>\n";
  }
  return html;
}

// One structure beside another of the same run.
std::string beside_the_first(const Comparison& comparison) {
  const CompareRow& first = comparison.rows.front();
  std::string text;
  for (const CompareRow& row : comparison.rows) {
    if (&row == &first || row.stride != first.stride || row.input != first.input ||
        row.motion != first.motion || first.events() == 0)
      continue;
    text += fmt::format(
        "{}<strong>{}</strong> {} times as often", text.empty() ? "" : ", ", html_escaped(row.structure.name),
        short_decimal(static_cast<double>(row.events()) / static_cast<double>(first.events())));
  }
  return text;
}

std::string findings(const Comparison& comparison) {
  const CompareRow& first = comparison.rows.front();
  std::string html = fmt::format("<p>In {} {} of {} the <strong>{}</strong> structure changed {} times",
                                 with_thousands(first.steps), first.steps == 1 ? "step" : "steps",
                                 html_escaped(std::filesystem::path(first.input).filename().string()),
                                 html_escaped(first.structure.name), with_thousands(first.events()));
  const std::string others = beside_the_first(comparison);
  html += (others.empty() ? "" : ", " + others) + ".</p>\n<ul>\n";
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison)) continue;
    html += fmt::format("<li><strong>{}</strong> changes {} times a step",
                        html_escaped(curve_name(comparison, row)), short_decimal(row.events_per_step()));
    const auto last =
        std::find_if(comparison.rows.begin(), comparison.rows.end(), [&](const CompareRow& other) {
          return other.stride == most_stride(comparison) && other.structure.name == row.structure.name &&
                 other.input == row.input && other.motion == row.motion;
        });
    if (last->stride != row.stride && row.events() > 0)
      html += fmt::format("; at stride {} a step has {} times as many events", with_thousands(last->stride),
                          short_decimal(last->events_per_step() / row.events_per_step()));
    if (const auto efficiency = row.efficiency())
      html += fmt::format("; {} events a net change", short_decimal(*efficiency));
    html += ".</li>\n";
  }
  return html + "</ul>\n";
}

std::string figures(const Comparison& comparison) {
  std::vector<HtmlRow> rows;
  for (const CompareRow& row : comparison.rows) {
    HtmlRow& line = rows.emplace_back(HtmlRow{compare_cells(row)});
    line.cells.front() = curve_name(comparison, row);
  }
  return html_table(compare_columns(), rows);
}

std::string title(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const ComparedInput& input : comparison.inputs)
    names.push_back(std::filesystem::path(input.file).filename().string());
  return fmt::format("kds compare: {}", fmt::join(names, ", "));
}

}  // namespace

std::string compare_page(const Comparison& comparison, Page page) {
  page.title = title(comparison);
  page.found = findings(comparison);
  page.words = kWords;
  page.body = html_section("By stride", plots_over_strides(comparison));
  page.body += html_section(
      "Along the chain",
      by_place(comparison, "bead", Drawn::staircase, "Share of the events that name a bead, along the chain.",
               [](const CompareRow& row) { return means_along_chain(row.structure.places.by_bead); }) +
          busiest_beads(comparison));
  page.body +=
      html_section("By level", by_place(comparison, "level of the tree, root 0", Drawn::points,
                                        "Share of the events at each level of the tree.", points_by_level));
  page.body += html_section("By kind", plots_by_kind(comparison));
  page.body += html_section("Figures", figures(comparison));
  return html_page(page);
}

}  // namespace kds
