#include "experiments/bench/bench_report.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "experiments/output/page/html_text.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

Json number_or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }
std::string number_or_empty(const std::optional<double>& x) { return x ? fmt::format("{}", *x) : ""; }
std::string figure(const std::optional<double>& x) { return x ? fmt::format("{:.4g}", *x) : "-"; }

std::optional<double> least_of(const BenchRow& row) {
  return row.spread ? std::optional(row.spread->least) : std::nullopt;
}
std::optional<double> most_of(const BenchRow& row) {
  return row.spread ? std::optional(row.spread->most) : std::nullopt;
}

std::string findings(const std::string& subject, std::span<const BenchRow> rows) {
  std::size_t with_goal = 0, holding = 0;
  const BenchRow *best = nullptr, *worst = nullptr;
  for (const BenchRow& row : rows) {
    with_goal += row.goal ? 1 : 0;
    holding += row.holds().value_or(false) ? 1 : 0;
    if (!row.ratio() || !row.spread) continue;
    if (best == nullptr || *row.ratio() < *best->ratio()) best = &row;
    if (worst == nullptr || *row.ratio() > *worst->ratio()) worst = &row;
  }
  std::string html = fmt::format("<p><strong>{}</strong> of {} {} reached, in {} {} of {}.", holding,
                                 with_goal, with_goal == 1 ? "goal" : "goals", rows.size(),
                                 rows.size() == 1 ? "measure" : "measures", html_escaped(subject));
  const auto told = [](const BenchRow& row) {
    return fmt::format("<strong>{}</strong> on {} takes {} times as long as {}", html_escaped(row.name),
                       html_escaped(row.input), short_decimal(*row.ratio()), html_escaped(row.peer));
  };
  if (best != nullptr)
    html += " At best, " + told(*best) + (worst == best ? "." : "; at worst, " + told(*worst) + ".");
  return html + "</p>\n";
}

std::string shown(const std::optional<double>& x) { return x ? short_decimal(*x) : "-"; }

std::string value_text(const BenchRow& row) {
  return row.spread ? spread_text(*row.spread) : shown(row.value);
}

std::string ratios(std::span<const BenchRow> rows) {
  PointPlot plot{"n", "ours / peer", {"goal reached", "goal missed", "no goal"}, {}};
  for (const BenchRow& row : rows) {
    if (!row.ratio() || !(*row.ratio() > 0) || row.n == 0) continue;
    const auto holds = row.holds();
    plot.points.push_back({row.name + ", " + row.input, static_cast<double>(row.n), *row.ratio(),
                           std::size_t{!holds   ? 2U
                                       : *holds ? 0U
                                                : 1U}});
  }
  return plot.points.empty()
             ? ""
             : html_figure(svg_plot(plot),
                           "Ours as a multiple of the peer, by the number of beads or points; both axes are "
                           "logarithmic.");
}

}  // namespace

BenchRow with_spread(BenchRow row, const std::vector<double>& seconds, double units) {
  const Spread spread = spread_of(seconds);
  row.spread = Spread{spread.median * units, spread.least * units, spread.most * units};
  return row;
}

std::string bench_json(std::string command, Json settings, std::span<const BenchRow> rows) {
  Json json;
  json["settings"] = std::move(settings);
  json["rows"] = Json::array();
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    json["rows"].push_back({{"name", row.name},
                            {"input", row.input},
                            {"n", row.n},
                            {"value", row.value},
                            {"unit", row.unit},
                            {"peer", row.peer.empty() ? Json(nullptr) : Json(row.peer)},
                            {"peer_value", number_or_null(row.peer_value)},
                            {"ratio", number_or_null(row.ratio())},
                            {"goal", number_or_null(row.goal)},
                            {"holds", holds ? Json(*holds) : Json(nullptr)},
                            {"value_least", number_or_null(least_of(row))},
                            {"value_most", number_or_null(most_of(row))}});
  }
  add_provenance(json, std::move(command));
  return text_of(json);
}

std::string bench_csv(std::span<const BenchRow> rows) {
  std::string text = "name,input,n,value,unit,peer,peer_value,ratio,goal,holds,value_least,value_most\n";
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(row.name), csv_field(row.input),
                        row.n, row.value, row.unit, csv_field(row.peer), number_or_empty(row.peer_value),
                        number_or_empty(row.ratio()), number_or_empty(row.goal),
                        holds ? (*holds ? "true" : "false") : "", number_or_empty(least_of(row)),
                        number_or_empty(most_of(row)));
  }
  return text;
}

std::string bench_table(std::span<const BenchRow> rows) {
  std::vector<std::vector<std::string>> lines{
      {"name", "input", "n", "value", "unit", "peer", "ratio", "goal", "holds", "peer is"}};
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    lines.push_back({row.name, row.input, fmt::format("{}", row.n), figure(row.value), row.unit,
                     figure(row.peer_value), figure(row.ratio()), figure(row.goal),
                     holds ? (*holds ? "yes" : "no") : "-", row.peer});
  }
  std::string text;
  for (const std::string& line : in_columns(lines, "<<>><>>><<")) text += line + "\n";
  return text;
}

std::string bench_page(const std::string& subject, std::span<const BenchRow> rows, Page page) {
  page.title = "kds bench " + subject;
  page.found = findings(subject, rows);
  page.words =
      "Ours and the peer take turns in one process. <em>n</em>: beads or points; <em>value</em>: the median "
      "of the rounds, of times in "
      "brackets "
      "the least and the most, by processor time but where threads share the work; <em>ratio</em>: ours by "
      "the "
      "peer's; <em>goal</em>: the most that the ratio, or else the value, was asked to be.";
  std::vector<HtmlRow> lines;
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    lines.push_back({{row.name, row.input, with_thousands(row.n), value_text(row), row.unit,
                      shown(row.ratio()), shown(row.goal), holds ? (*holds ? "yes" : "no") : "-",
                      shown(row.peer_value), row.peer.empty() ? "-" : row.peer}});
  }
  page.body = html_section("Beside the peer", ratios(rows)) +
              html_section("Figures", html_table({"name", "input", "n", "value", "unit", "ratio", "goal",
                                                  "holds", "peer's value", "peer"},
                                                 lines));
  return html_page(page);
}

}  // namespace kds
