#include "experiments/compare/compare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/compare/compare_report.h"
#include "experiments/output/html_page.h"
#include "experiments/output/svg_plot.h"
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
    "that never fail included, is responsiveness.";

std::size_t least_stride(const Comparison& comparison) { return comparison.rows.front().stride; }
std::size_t most_stride(const Comparison& comparison) { return comparison.rows.back().stride; }

// "wrapped", or "wrapped, 300K.dcd, linear" where inputs and motions are several.
std::string curve_name(const Comparison& comparison, const CompareRow& row) {
  const std::string more = distinction(comparison, row);
  return row.structure.name + (more.empty() ? "" : ", " + more);
}

template <class Value>
std::string over_strides(const Comparison& comparison, const char* id, const char* label, const char* caption,
                         Value value) {
  LinePlot plot{id, "stride", label, false, {}};
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
             comparison, "events", "events", "Events of the whole run, by stride.",
             [](const CompareRow& row) { return std::optional(static_cast<double>(row.events())); }) +
         over_strides(comparison, "per-step", "events a step",
                      "Events from one frame to the next, by stride.",
                      [](const CompareRow& row) { return std::optional(row.events_per_step()); }) +
         over_strides(comparison, "efficiency", "events a net change",
                      "Events a net change, by stride: what is undone before the next frame counts here.",
                      [](const CompareRow& row) { return row.efficiency(); });
}

// Shares, by a number that is known of each row at the least stride.
template <class Values>
std::string by_place(const Comparison& comparison, const char* id, const char* x_label, const char* caption,
                     Values values) {
  LinePlot plot{id, x_label, "% of events", std::string_view(id) == "chain", {}};
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison) || row.events() == 0) continue;
    const std::vector<std::uint64_t>& counts = values(row);
    if (counts.empty()) continue;
    Curve curve{curve_name(comparison, row), {}};
    for (std::size_t i = 0; i < counts.size(); ++i)
      curve.points.emplace_back(static_cast<double>(i),
                                100 * static_cast<double>(counts[i]) / static_cast<double>(row.events()));
    plot.curves.push_back(std::move(curve));
  }
  return plot.curves.empty() ? "" : html_figure(svg_plot(plot), caption);
}

std::string plots_by_kind(const Comparison& comparison) {
  std::string html;
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison) || row.events() == 0) continue;
    BarPlot plot{fmt::format("kinds-{}", &row - comparison.rows.data()), "events", {}};
    for (const auto& [kind, count] : row.structure.events_by_kind)
      plot.bars.emplace_back(kind, static_cast<double>(count));
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
    std::vector<std::size_t> beads(row.places.by_bead.size());
    for (std::size_t b = 0; b < beads.size(); ++b) beads[b] = b;
    const std::size_t shown = std::min(most, beads.size());
    std::partial_sort(beads.begin(), beads.begin() + static_cast<std::ptrdiff_t>(shown), beads.end(),
                      [&](std::size_t a, std::size_t b) {
                        const auto& counts = row.places.by_bead;
                        return counts[a] != counts[b] ? counts[a] > counts[b] : a < b;
                      });
    html +=
        fmt::format("<p>Most events of <strong>{}</strong> name ", html_escaped(curve_name(comparison, row)));
    for (std::size_t i = 0; i < shown; ++i)
      html += fmt::format("{}{} ({})", i == 0 ? "" : "; ", html_escaped(bead_text(*input, beads[i])),
                          with_thousands(row.places.by_bead[beads[i]]));
    html += ".</p>\n";
  }
  return html;
}

std::string findings(const Comparison& comparison) {
  std::string html;
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != least_stride(comparison)) continue;
    html += fmt::format("<p><strong>{}</strong> changes {} times a step",
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
    html += ".</p>\n";
  }
  return html;
}

std::string figures(const Comparison& comparison) {
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr>";
  for (const std::string& column : compare_columns())
    html += fmt::format("<th scope=\"col\">{}</th>", html_escaped(column));
  html += "</tr></thead>\n<tbody>\n";
  for (const CompareRow& row : comparison.rows) {
    std::vector<std::string> cells = compare_cells(row);
    cells.front() = curve_name(comparison, row);
    html += "<tr>";
    for (std::size_t c = 0; c < cells.size(); ++c)
      html += c == 0 ? fmt::format("<th scope=\"row\">{}</th>", html_escaped(cells[c]))
                     : fmt::format("<td>{}</td>", html_escaped(cells[c]));
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string title(const Comparison& comparison) {
  std::string names;
  for (const ComparedInput& input : comparison.inputs)
    names += (names.empty() ? "" : ", ") + std::filesystem::path(input.file).filename().string();
  return "kds compare: " + names;
}

}  // namespace

std::string compare_page(const Comparison& comparison, const std::string& command_line) {
  std::string body = findings(comparison) + plots_over_strides(comparison);
  body += "<h2>Along the chain</h2>\n" +
          by_place(
              comparison, "chain", "bead", "Share of the events that name a bead, along the chain.",
              [](const CompareRow& row) -> const auto& { return row.places.by_bead; }) +
          busiest_beads(comparison);
  const std::string levels = by_place(
      comparison, "levels", "level of the tree, root 0", "Share of the events at each level of the tree.",
      [](const CompareRow& row) -> const auto& { return row.places.by_level; });
  if (!levels.empty()) body += "<h2>By level</h2>\n" + levels;
  if (const std::string kinds = plots_by_kind(comparison); !kinds.empty())
    body += "<h2>By kind</h2>\n" + kinds;
  body += fmt::format("<h2>Figures</h2>\n{}<h2>How to read this</h2>\n<p>{}</p>\n<p><code>{}</code></p>\n",
                      figures(comparison), kWords, html_escaped(command_line));
  return html_page(title(comparison), body);
}

}  // namespace kds
