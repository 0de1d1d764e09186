#include "experiments/bench/bench_report.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

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

Table<BenchRow> bench_columns() {
  using Row = BenchRow;
  const auto decimal = [](std::string key, std::string heading, auto value) {
    return Column<Row>{.key = std::move(key),
                       .heading = std::move(heading),
                       .value = [value](const Row& r) { return Field(value(r)); },
                       .format = shortly};
  };
  return {{
      {"name", "name", [](const Row& r) { return Field(r.name); }},
      {"input", "input", [](const Row& r) { return Field(r.input); }},
      {"n", "n", [](const Row& r) { return Field(r.n); }},
      {"value", "value", [](const Row& r) { return Field(r.value); }, with_figures(4), Shown::in_text},
      {.heading = "value",
       .value = [](const Row& r) { return Field(r.value); },
       .shown = Shown::on_pages,
       .words = [](const Row& r) { return r.spread ? spread_text(*r.spread) : short_decimal(r.value); }},
      {"unit", "unit", [](const Row& r) { return Field(r.unit); }},
      {.key = "peer", .value = [](const Row& r) { return text_or_nothing(r.peer); }},
      decimal("peer_value", "peer's value", [](const Row& r) { return r.peer_value; }),
      decimal("ratio", "ratio", [](const Row& r) { return r.ratio(); }),
      decimal("goal", "goal", [](const Row& r) { return r.goal; }),
      {"holds", "holds", [](const Row& r) { return Field(r.holds()); }},
      {.heading = "peer", .value = [](const Row& r) { return text_or_nothing(r.peer); }},
      {.key = "value_least", .value = [](const Row& r) { return Field(least_of(r)); }},
      {.key = "value_most", .value = [](const Row& r) { return Field(most_of(r)); }},
  }};
}

std::string ratios(std::span<const BenchRow> rows) {
  PointPlot plot{"n", "ours / peer", {"goal reached", "goal missed", "no goal"}, {}};
  for (const BenchRow& row : rows) {
    if (!row.ratio() || !(*row.ratio() > 0) || row.n == 0) continue;
    const auto holds = row.holds();
    const std::size_t series = !holds ? 2U : *holds ? 0U : 1U;
    const double unit = *row.ratio() / row.value;
    plot.points.push_back({row.name + ", " + row.input, static_cast<double>(row.n), *row.ratio(), series,
                           row.spread ? unit * row.spread->least : 0,
                           row.spread ? unit * row.spread->most : 0});
  }
  return plot.points.empty()
             ? ""
             : html_figure(svg_plot(plot),
                           "Ours as a multiple of the peer, by the number of beads or points. Both axes are "
                           "logarithmic. Bars reach from our shortest to our longest round, compared with "
                           "the peer's median.");
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
  json["rows"] = bench_columns().json(rows);
  add_provenance(json, std::move(command));
  return text_of(json);
}

std::string bench_csv(std::span<const BenchRow> rows) { return bench_columns().csv(rows); }

std::string bench_table(std::span<const BenchRow> rows) { return bench_columns().text(rows); }

std::string bench_page(const std::string& subject, std::span<const BenchRow> rows, Page page) {
  page.title = "kds bench " + subject;
  page.found = findings(subject, rows);
  page.words =
      "Ours and the peer take turns in one process. <em>n</em>: beads or points; <em>value</em>: the median "
      "of the rounds, and for times the least and the most in brackets; times are processor times unless "
      "threads share the work; <em>ratio</em>: ours divided by the peer's; <em>goal</em>: the upper limit of "
      "the ratio, or of the value if there is no peer.";
  page.body =
      html_section("Beside the peer", ratios(rows)) + html_section("Numbers", bench_columns().html(rows));
  return html_page(page);
}

}  // namespace kds
