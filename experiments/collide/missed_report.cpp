#include "experiments/collide/missed_report.h"

#include <fmt/format.h>

#include <optional>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

/// Returns no value if there are no contacts.
std::optional<double> missed_fraction(const MissedRow& row) {
  if (row.contacts == 0) return std::nullopt;
  return static_cast<double>(row.missed()) / static_cast<double>(row.contacts);
}

/// Returns a plot with a curve over strides for each factor that has contacts.
std::string plot_of(std::span<const MissedRow> rows) {
  LinePlot plot{"stride", "% of contacts missed", Drawn::points, {}};
  for (const MissedRow& row : rows) {
    const auto fraction = missed_fraction(row);
    if (!fraction) continue;
    const std::string name = fmt::format("radii times {}", row.factor);
    if (plot.curves.empty() || plot.curves.back().name != name) plot.curves.push_back({name, {}});
    plot.curves.back().points.emplace_back(static_cast<double>(row.stride), 100 * *fraction);
  }
  const bool has_line = !plot.curves.empty() && plot.curves.front().points.size() > 1;
  return has_line ? svg_plot(plot) : "";
}

std::string percent_text(const MissedRow& row) {
  const auto fraction = missed_fraction(row);
  return fraction ? fmt::format("{:.1f}%", 100 * *fraction) : "-";
}

std::string frames_at(std::size_t stride) {
  return stride == 1 ? "every frame" : fmt::format("one frame in {}", stride);
}

// Returns a sentence for each factor about its smallest and its largest stride.
std::string findings(std::span<const MissedRow> rows) {
  std::string html;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first;
    while (end < rows.size() && rows[end].factor == rows[first].factor) ++end;
    const MissedRow &least = rows[first], &most = rows[end - 1];
    if (least.contacts == 0) {
      html += fmt::format("<p>With radii times {} there are no contacts to miss.</p>\n", least.factor);
      first = end;
      continue;
    }
    html += fmt::format(
        "<p>With radii times {0}, <strong>{2}</strong> of {1} contacts are missed if only {3} is examined",
        least.factor, with_thousands(least.contacts), percent_text(least), frames_at(least.stride));
    if (end - first > 1)
      html += fmt::format(", <strong>{}</strong> if only {} is", percent_text(most), frames_at(most.stride));
    html += ".</p>\n";
    first = end;
  }
  return html;
}

}  // namespace

const Table<MissedRow>& missed_columns() {
  using Row = MissedRow;
  static const Table<Row> table{{
      {"factor", "radii times", [](const Row& r) { return Field(r.factor); }},
      {"stride", "stride", [](const Row& r) { return Field(r.stride); }},
      {"frames", "frames", [](const Row& r) { return Field(r.frames); }},
      {"contacts", "contacts", [](const Row& r) { return Field(r.contacts); }},
      {"found", "found", [](const Row& r) { return Field(r.found); }},
      {"missed", "missed", [](const Row& r) { return Field(r.missed()); }},
      {.key = "missed_fraction",
       .heading = "missed %",
       .value = [](const Row& r) { return Field(missed_fraction(r)); },
       .words = percent_text},
  }};
  return table;
}

std::string missed_page(std::span<const MissedRow> rows, const std::string& input, Page page) {
  page.title = "kds missed: " + input;
  page.found = findings(rows);
  page.words =
      "A <em>contact</em> of two beads lasts from the moment at which their closed balls begin to meet to "
      "the moment at which they part. A touch is a contact too, and so is a contact that lasts at the first "
      "or the last frame. The times are exact for the motion between frames that the run was asked for. One "
      "frame in <em>stride</em> is examined, beginning with the first; <em>frames</em> is their number. A "
      "contact is <em>found</em> if an examined frame lies in it, its ends included, and <em>missed</em> "
      "otherwise.";
  if (const std::string plot = plot_of(rows); !plot.empty())
    page.body = html_section(
        "By stride",
        html_figure(plot, "Contacts that are missed if one frame in <em>stride</em> is examined."));
  page.body += html_section("Figures", missed_columns().html(rows));
  return html_page(page);
}

}  // namespace kds
