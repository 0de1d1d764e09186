#include "experiments/trade/trade_report.h"

#include <fmt/format.h>

#include <cmath>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "experiments/trade/recommend.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

/// The groups, each of which begins with an exact run.
std::vector<std::span<const TradeRow>> groups_of(std::span<const TradeRow> rows) {
  std::vector<std::span<const TradeRow>> groups;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first + 1;
    while (end < rows.size() && !rows[end].is_exact) ++end;
    groups.push_back(rows.subspan(first, end - first));
    first = end;
  }
  return groups;
}

std::string title_of(std::span<const TradeRow> group) {
  const TradeRow& exact = group.front();
  return exact.want == Want::events ? "events of " + exact.setting.structure
                                    : std::string(name_of(exact.want));
}

struct ErrorColumn {
  const char* title;
  std::optional<double> TradeErrors::*value;
  bool share;
};
std::vector<ErrorColumn> columns_for(Want want) {
  using E = TradeErrors;
  const ErrorColumn missed{"missed", &E::events_missed, true},
      invented{"invented", &E::events_invented, true};
  switch (want) {
    case Want::cages:
      return {{"radius", &E::radius_mean, true},
              {"at most", &E::radius_max, true},
              {"at frames", &E::radius_frames_max, true},
              {"outside", &E::beads_outside, false},
              missed,
              invented,
              {"moved", &E::displacement, false}};
    case Want::diagram:
      return {{"wrong", &E::cells_wrong, true},
              {"edges", &E::edges_missed, true},
              missed,
              invented,
              {"moved", &E::displacement, false}};
    case Want::contacts:
      return {{"missed", &E::contacts_missed, true},    {"spurious", &E::contacts_spurious, true},
              {"unsure", &E::contacts_unsure, true},    {"time", &E::contact_time_mean, false},
              {"closest", &E::closest_distance, false}, {"moved", &E::displacement, false}};
    case Want::events:
      return {missed,
              invented,
              {"time", &E::event_time_mean, false},
              {"at most", &E::event_time_max, false},
              {"moved", &E::displacement, false}};
    case Want::scenes:
      return {};
  }
  return {};
}

std::string shown(const std::optional<double>& value, bool share) {
  if (!value) return "-";
  if (*value == 0) return "0";
  if (std::isinf(*value)) return "all";
  return share ? fmt::format("{:.3g}%", 100 * *value) : fmt::format("{:.3g}", *value);
}

Json number_or_null(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

std::string table_of(std::span<const TradeRow> group) {
  const std::vector<ErrorColumn> columns = columns_for(group.front().want);
  std::string text = fmt::format("{:<46}{:>11}{:>10}{:>14}{:>10}{:>11}{:>8}", title_of(group), "seconds",
                                 "ratio", "certificates", "events", "tests", "MB");
  for (const ErrorColumn& column : columns) text += fmt::format("{:>11}", column.title);
  text += "\n";
  for (const TradeRow& row : group) {
    text += fmt::format("{} {:<44}{:>11}{:>10.3f}{:>14}{:>10}{:>11}{:>8.2f}", row.on_front ? '*' : ' ',
                        words_of(row.setting), short_decimal(row.cost.seconds), row.cost.ratio,
                        with_thousands(row.cost.certificates), with_thousands(row.cost.events),
                        shown(row.cost.tests, false), 1e-6 * static_cast<double>(row.cost.memory));
    for (const ErrorColumn& column : columns)
      text += fmt::format("{:>11}", shown(row.errors.*column.value, column.share));
    text += "\n";
  }
  return text;
}

std::string plots_of(std::span<const TradeRow> group) {
  std::string html;
  for (const ErrorColumn& column : columns_for(group.front().want)) {
    PointPlot plot{"processor time / exact run",
                   column.share ? fmt::format("{}, %", column.title) : column.title,
                   {"quickest of its error", "others"},
                   {}};
    for (const TradeRow& row : group) {
      const std::optional<double>& error = row.errors.*column.value;
      if (error && std::isfinite(*error))
        plot.points.push_back({row.on_front ? words_of(row.setting) : "", row.cost.ratio,
                               (column.share ? 100 : 1) * *error,
                               row.on_front ? std::size_t{0} : std::size_t{1}});
    }
    const bool errs = std::any_of(plot.points.begin(), plot.points.end(),
                                  [](const PointPlot::Point& point) { return point.y > 0; });
    const auto of_series = [&](std::size_t series) {
      return std::any_of(plot.points.begin(), plot.points.end(),
                         [&](const PointPlot::Point& point) { return point.series == series; });
    };
    if (!errs) continue;
    if (!of_series(1)) plot.series.pop_back();
    html += html_figure(svg_plot(plot),
                        fmt::format("Cost against error of {}: {}. No error stands at the bottom.",
                                    title_of(group), column.title));
  }
  return html;
}

// What stands between backticks is code.
std::string with_code(const std::string& html) {
  std::string text;
  bool inside = false;
  for (const char c : html) {
    if (c != '`') {
      text += c;
      continue;
    }
    text += inside ? "</code>" : "<code>";
    inside = !inside;
  }
  return text;
}

std::string html_table_of(std::span<const TradeRow> group) {
  const std::vector<ErrorColumn> errors = columns_for(group.front().want);
  std::vector<std::string> columns{title_of(group), "ratio",  "seconds", "least", "most",
                                   "certificates",  "events", "tests",   "MB"};
  for (const ErrorColumn& column : errors) columns.emplace_back(column.title);
  std::vector<HtmlRow> rows;
  for (const TradeRow& row : group) {
    HtmlRow& line = rows.emplace_back(HtmlRow{
        {(row.on_front ? "* " : "") + words_of(row.setting), fmt::format("{:.3f}", row.cost.ratio),
         short_decimal(row.cost.seconds), short_decimal(row.cost.quickest), short_decimal(row.cost.slowest),
         with_thousands(row.cost.certificates), with_thousands(row.cost.events), shown(row.cost.tests, false),
         fmt::format("{:.2f}", 1e-6 * static_cast<double>(row.cost.memory))}});
    for (const ErrorColumn& column : errors)
      line.cells.push_back(shown(row.errors.*column.value, column.share));
  }
  return html_table(columns, rows);
}

constexpr const char* words_of_columns =
    "Each row is a setting of `kds run`; a stride is the third part of --frames. Seconds: of the processor, "
    "median of the rounds, without reading and the first build, those of --certify with its runs; their "
    "ratio "
    "to the exact run is for as many frames. Tests: of two spheres, by a search for contacts in the "
    "hierarchy, "
    "on average. Errors are against beads on straight lines between all frames, at frames and at random "
    "times "
    "between: radius, of spheres from the smallest, on average and at most, and at most at frames; outside, "
    "beads outside their spheres, mean of the times (with --certify spheres are larger by what is "
    "certified); "
    "wrong, cells that are not in the true diagram; edges, short ones missed; "
    "missed and invented or spurious, events or contacts beside the exact run (with --certify all possible "
    "contacts count as found, and unsure are those that it calls no more; of --select ca, which is another "
    "model, contacts of residues count that are at least its --apart apart); time, in frames; closest, of "
    "the closest "
    "distance; moved, a bead from its place. *: no other row of the group is as quick and as right.";

}  // namespace

Json trade_rows_json(std::span<const TradeRow> rows) {
  Json json = Json::array();
  for (const TradeRow& row : rows) {
    Json setting = Json::object(), errors = Json::object();
    for (const auto& [name, value] : options_of(row.setting)) setting[name] = value;
    if (row.setting.projected) setting["projected"] = "xy";
    for (const auto& [name, value] : by_name(row.errors)) errors[name] = number_or_null(value);
    json.push_back({{"want", name_of(row.want)},
                    {"setting", setting},
                    {"cost",
                     {{"seconds", row.cost.seconds},
                      {"seconds_least", row.cost.quickest},
                      {"seconds_most", row.cost.slowest},
                      {"ratio", row.cost.ratio},
                      {"events", row.cost.events},
                      {"certificates", row.cost.certificates},
                      {"tests", number_or_null(row.cost.tests)},
                      {"memory", row.cost.memory}}},
                    {"error", errors},
                    {"pareto", row.on_front}});
  }
  return json;
}

std::string trade_csv(std::span<const TradeRow> rows) {
  std::string text = "want,setting,seconds,seconds_least,seconds_most,ratio,events,certificates,tests,memory";
  for (const auto& [name, value] : by_name({})) text += "," + name;
  text += ",pareto\n";
  for (const TradeRow& row : rows) {
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}", name_of(row.want), csv_field(words_of(row.setting)),
                        row.cost.seconds, row.cost.quickest, row.cost.slowest, row.cost.ratio,
                        row.cost.events, row.cost.certificates,
                        row.cost.tests ? fmt::format("{}", *row.cost.tests) : "", row.cost.memory);
    for (const auto& [name, value] : by_name(row.errors)) text += value ? fmt::format(",{}", *value) : ",";
    text += fmt::format(",{}\n", row.on_front ? 1 : 0);
  }
  return text;
}

std::string trade_table(std::span<const TradeRow> rows) {
  std::string text;
  for (const auto& group : groups_of(rows)) text += table_of(group) + "\n";
  return text + recommendation(rows) + "\n";
}

std::string trade_page(std::span<const TradeRow> rows, const std::string& input, Page page) {
  page.title = "kds trade: " + input;
  page.found = fmt::format("<p>{}</p>\n", with_code(html_escaped(recommendation(rows))));
  page.words = with_code(words_of_columns);
  for (const auto& group : groups_of(rows))
    page.body += html_section(title_of(group), html_table_of(group) + plots_of(group));
  return html_page(page);
}

}  // namespace kds
