#include "experiments/run/html_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <vector>

#include "experiments/output/html_page.h"
#include "experiments/output/svg_plot.h"
#include "experiments/output/text.h"
#include "experiments/run/event_bins.h"
#include "experiments/run/summary_rows.h"

namespace kds {
namespace {

constexpr std::string_view kWords =
    "An <em>event</em> is a change of the structure itself, found at the exact time at which one of its "
    "<em>certificates</em> fails: sign conditions on a few beads that, while they hold, prove the structure "
    "right. "
    "Between two frames every bead moves by a known polynomial, so nothing that happens in between is "
    "missed; "
    "internal events are bookkeeping and not in the total. The last rows compare the time with building the "
    "same "
    "structure from nothing at every frame.";

std::string title(const RunReport& report) {
  std::string names;
  for (const std::string& file : report.files)
    names += (names.empty() ? "" : ", ") + std::filesystem::path(file).filename().string();
  return "kds run: " + names;
}

std::string findings(const RunReport& report) {
  const std::size_t steps = step_count(report);
  std::string html;
  for (const StructureReport& structure : report.structures) {
    html += fmt::format("<p>The <strong>{}</strong> structure changed {} times in {} {}",
                        html_escaped(structure.name), with_thousands(structure.events_total),
                        with_thousands(steps), steps == 1 ? "motion step" : "motion steps");
    if (structure.static_seconds > 0)
      html += fmt::format("; keeping it took {} times as long as rebuilding it at every frame",
                          short_decimal(structure.seconds / structure.static_seconds));
    html += ".</p>\n";
  }
  return html;
}

std::string inputs(const RunReport& report) {
  std::string html = "<dl>\n";
  for (const auto& [label, value] : input_lines(report))
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", html_escaped(label), html_escaped(value));
  return html +
         fmt::format("<dt>fingerprint</dt><dd><code>{}</code></dd>\n</dl>\n", hex_digits(report.fingerprint));
}

std::string table(const RunReport& report) {
  std::string html = "<div class=\"scroll\"><table>\n<thead><tr><th></th>";
  for (const StructureReport& structure : report.structures)
    html += fmt::format("<th scope=\"col\">{}</th>", html_escaped(structure.name));
  html += "</tr></thead>\n<tbody>\n";
  for (const SummaryRow& row : summary_rows(report)) {
    html += fmt::format("<tr{}><th scope=\"row\">{}</th>", row.detail ? " class=\"detail\"" : "",
                        html_escaped(row.label));
    for (std::size_t i = 0; i < report.structures.size(); ++i)
      html += fmt::format("<td>{}</td>", row.cells.empty() ? "" : html_escaped(row.cells[i]));
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

std::string plots_over_time(const RunReport& report) {
  std::size_t width = 1;
  LinePlot rate{"rate", "frame", "events per step", true, {}};
  LinePlot sum{"sum", "frame", "events so far", false, {}};
  for (const StructureReport& structure : report.structures) {
    const std::vector<EventBin>& bins = structure.course.bins();
    width = std::max(width, structure.course.width());
    Curve per_step{structure.name, {}}, so_far{structure.name, {}};
    so_far.points.emplace_back(bins.empty() ? 0.0 : static_cast<double>(bins.front().first_frame), 0.0);
    for (std::size_t b = 0; b < bins.size(); ++b) {
      const EventBin& bin = bins[b];
      const double first = static_cast<double>(bin.first_frame);
      const double end = static_cast<double>(b + 1 < bins.size() ? bins[b + 1].first_frame
                                             : report.last_frame ? report.last_frame->number
                                                                 : bin.first_frame + bin.steps);
      const double mean = static_cast<double>(bin.events) / static_cast<double>(bin.steps);
      if (!per_step.points.empty()) per_step.points.pop_back();
      per_step.points.insert(per_step.points.end(), {{first, mean}, {end, mean}});
      so_far.points.emplace_back(end, static_cast<double>(bin.cumulative));
    }
    rate.curves.push_back(std::move(per_step));
    sum.curves.push_back(std::move(so_far));
  }
  std::string rate_caption = "Events between each frame and the next.",
              sum_caption = "Events since the first frame.";
  if (width > 1) {
    rate_caption =
        fmt::format("Events between a frame and the next, each point the mean over {} steps.", width);
    sum_caption += fmt::format(" One point for {} steps.", width);
  }
  if (report.first_frame && report.first_frame->picoseconds && report.last_frame &&
      report.last_frame->picoseconds)
    sum_caption += fmt::format(" The frames are those from {:.6g} to {:.6g} ps.",
                               *report.first_frame->picoseconds, *report.last_frame->picoseconds);
  return html_figure(svg_plot(rate), rate_caption) + html_figure(svg_plot(sum), sum_caption);
}

// One motion step has no course over frames: what happened is drawn instead of when.
std::string plots_by_kind(const RunReport& report) {
  std::string html;
  for (std::size_t i = 0; i < report.structures.size(); ++i) {
    const StructureReport& structure = report.structures[i];
    BarPlot plot{fmt::format("kinds{}", i), "events", {}};
    for (const auto& [kind, count] : structure.events_by_kind)
      plot.bars.emplace_back(kind_label(kind), static_cast<double>(count));
    if (plot.bars.empty()) plot.bars.emplace_back("all", static_cast<double>(structure.events_total));
    html += html_figure(svg_plot(plot), fmt::format("Events of the {} structure by kind, in one motion step.",
                                                    html_escaped(structure.name)));
  }
  return html;
}

std::string plots(const RunReport& report) {
  if (report.structures.empty()) return "";
  return step_count(report) > 1 ? plots_over_time(report) : plots_by_kind(report);
}

}  // namespace

std::string html_report(const RunReport& report) {
  return html_page(title(report),
                   fmt::format("{}{}<h2>Events</h2>\n{}<h2>Comparison</h2>\n{}<h2>How to read "
                               "this</h2>\n<p>{}</p>\n",
                               inputs(report), findings(report), plots(report), table(report), kWords));
}

}  // namespace kds
