#include "experiments/collide/missed_report.h"

#include <fmt/format.h>

#include <optional>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

/// None of no contacts.
std::optional<double> missed_fraction(const MissedRow& row) {
  if (row.contacts == 0) return std::nullopt;
  return static_cast<double>(row.missed()) / static_cast<double>(row.contacts);
}

/// A curve over strides for each factor that has contacts.
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

// Of each factor, at the least stride and at the largest.
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
        "<p>With radii times {}, of {} contacts <strong>{}</strong> are missed by looking at {}",
        least.factor, with_thousands(least.contacts), percent_text(least), frames_at(least.stride));
    if (end - first > 1)
      html +=
          fmt::format(", <strong>{}</strong> by looking at {}", percent_text(most), frames_at(most.stride));
    html += ".</p>\n";
    first = end;
  }
  return html;
}

std::string table(std::span<const MissedRow> rows) {
  std::vector<HtmlRow> lines;
  for (const MissedRow& row : rows)
    lines.push_back({{fmt::format("{}", row.factor), with_thousands(row.stride), with_thousands(row.frames),
                      with_thousands(row.contacts), with_thousands(row.found), with_thousands(row.missed()),
                      percent_text(row)}});
  return html_table({"radii times", "stride", "frames", "contacts", "found", "missed", "missed %"}, lines);
}

}  // namespace

Json missed_rows_json(std::span<const MissedRow> rows) {
  Json json = Json::array();
  for (const MissedRow& row : rows) {
    const auto fraction = missed_fraction(row);
    json.push_back({{"factor", row.factor},
                    {"stride", row.stride},
                    {"frames", row.frames},
                    {"contacts", row.contacts},
                    {"found", row.found},
                    {"missed", row.missed()},
                    {"missed_fraction", fraction ? Json(*fraction) : Json(nullptr)}});
  }
  return json;
}

std::string missed_csv(std::span<const MissedRow> rows) {
  std::string text = "factor,stride,frames,contacts,found,missed,missed_fraction\n";
  for (const MissedRow& row : rows) {
    const auto fraction = missed_fraction(row);
    text += fmt::format("{},{},{},{},{},{},{}\n", row.factor, row.stride, row.frames, row.contacts, row.found,
                        row.missed(), fraction ? fmt::format("{}", *fraction) : "");
  }
  return text;
}

std::string missed_table(std::span<const MissedRow> rows) {
  std::string text = fmt::format("{:>12}{:>8}{:>8}{:>12}{:>12}{:>12}{:>10}\n", "radii times", "stride",
                                 "frames", "contacts", "found", "missed", "missed %");
  for (const MissedRow& row : rows) {
    const auto fraction = missed_fraction(row);
    text +=
        fmt::format("{:>12}{:>8}{:>8}{:>12}{:>12}{:>12}{:>10}\n", row.factor, row.stride,
                    with_thousands(row.frames), with_thousands(row.contacts), with_thousands(row.found),
                    with_thousands(row.missed()), fraction ? fmt::format("{:.1f}", 100 * *fraction) : "-");
  }
  return text;
}

std::string missed_page(std::span<const MissedRow> rows, const std::string& input, Page page) {
  page.title = "kds missed: " + input;
  page.found = findings(rows);
  page.words =
      "A <em>contact</em> of two beads goes from the moment at which their closed balls begin to meet to "
      "that at which they part, or is a touch; those that last at the first or the last frame count too. "
      "Their times are exact for beads that move between frames as told. One frame in <em>stride</em> is "
      "looked at, the first among them, <em>frames</em> in all: a contact is <em>found</em> if one of them "
      "lies in it, its ends included, and <em>missed</em> otherwise.";
  if (const std::string plot = plot_of(rows); !plot.empty())
    page.body = html_section(
        "By stride",
        html_figure(plot, "Contacts that are missed by looking at one frame in <em>stride</em>."));
  page.body += html_section("Figures", table(rows));
  return html_page(page);
}

}  // namespace kds
