#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <span>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"
#include "experiments/program/growth_columns.h"
#include "experiments/program/growth_fit.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/spread_columns.h"
#include "experiments/program/table_command.h"
#include "experiments/program/timing.h"
#include "experiments/theorems/plan_theorems.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

std::optional<double> ratio_to_bound(const TheoremPoint& point) {
  if (!point.bound) return std::nullopt;
  return point.value / *point.bound;
}

bool is_ratio(Theorem theorem) { return theorem == Theorem::tightness || theorem == Theorem::groupings; }
bool is_count(Theorem theorem) {
  return !is_ratio(theorem) && theorem != Theorem::search && theorem != Theorem::paths;
}
Field end_of(const std::optional<MeanInterval>& interval, double MeanInterval::*end) {
  return interval ? Field((*interval).*end) : Field();
}

// Counts are written in full.
std::string value_text(Theorem theorem, double value) {
  return is_count(theorem) ? with_thousands(static_cast<std::uint64_t>(value)) : short_decimal(value);
}

/// One necklace, which is a row in all forms of the report.
struct PlacedPoint {
  const TheoremSeries* series;
  const TheoremPoint* point;
};
std::vector<PlacedPoint> points_of(std::span<const TheoremSeries> group) {
  std::vector<PlacedPoint> points;
  for (const TheoremSeries& series : group)
    for (const TheoremPoint& point : series.points) points.push_back({&series, &point});
  return points;
}

/// Returns the columns that identify the series. `series_of` returns the series of a row.
template <class Row, class SeriesOf>
std::vector<Column<Row>> series_columns(SeriesOf series_of) {
  return {
      {.key = "theorem", .value = [=](const Row& r) { return Field(name_of(series_of(r).theorem)); }},
      {.key = "model", .value = [=](const Row& r) { return Field(series_of(r).model); }},
      {.key = "dimension", .value = [=](const Row& r) { return Field(series_of(r).dimension); }},
      {.key = "hierarchy", .value = [=](const Row& r) { return text_or_nothing(series_of(r).hierarchy); }},
      {.key = "variant", .value = [=](const Row& r) { return text_or_nothing(series_of(r).variant); }},
  };
}

Table<PlacedPoint> point_columns(std::string_view value_heading = "value") {
  using Row = PlacedPoint;
  Table<Row> table(series_columns<Row>([](const Row& r) -> const TheoremSeries& { return *r.series; }));
  table.add({
      {.heading = "necklaces", .value = [](const Row& r) { return Field(name_of(*r.series)); }},
      {"n", "n", [](const Row& r) { return Field(r.point->beads); }},
      {.key = "quantity", .json = [](const Row& r) { return Json(quantity_of(r.series->theorem)); }},
      {.key = "value",
       .heading = std::string(value_heading),
       .value = [](const Row& r) { return Field(r.point->value); },
       .words = [](const Row& r) { return value_text(r.series->theorem, r.point->value); }},
      {.key = "value_lower",
       .value = [](const Row& r) { return end_of(r.point->over_seeds, &MeanInterval::lower); }},
      {.key = "value_upper",
       .value = [](const Row& r) { return end_of(r.point->over_seeds, &MeanInterval::upper); }},
      {"bound", "bound", [](const Row& r) { return Field(r.point->bound); }, shortly},
      {"ratio", "ratio", [](const Row& r) { return Field(ratio_to_bound(*r.point)); }, shortly},
      {"tests", "pairs compared", [](const Row& r) { return Field(r.point->tests); }},
  });
  table.add(spread_columns<Row>("seconds", "seconds", [](const Row& r) { return r.point->seconds; }));
  return table.add({{.key = "holds",
                     .heading = "holds",
                     .value = [](const Row& r) { return Field(r.point->holds); },
                     .words = [](const Row& r) { return *r.point->holds ? "yes" : "NO"; }}});
}

std::string_view size_of(const TheoremSeries& series) {
  return series.theorem == Theorem::tightness ? "h" : "n";
}

std::string theorem_exponent(const TheoremSeries& series) {
  return fmt::format("{}{:.3f}", series.at_most ? "at most " : "", *series.expected);
}

struct FittedSeries {
  const TheoremSeries* series;
  GrowthSummary growth;
};
std::vector<FittedSeries> fits_of(std::span<const TheoremSeries> series) {
  std::vector<FittedSeries> fits;
  for (const TheoremSeries& one : series)
    if (const auto line = one.fit())
      fits.push_back(
          {&one,
           {line, local_exponents(one.growth()), one.exponent(), one.law(), std::string(size_of(one))}});
  return fits;
}

Table<FittedSeries> fit_columns() {
  using Row = FittedSeries;
  Table<Row> table(series_columns<Row>([](const Row& r) -> const TheoremSeries& { return *r.series; }));
  table.add({{.heading = "necklaces", .value = [](const Row& r) {
                return Field(fmt::format("{}, {}", name_of(r.series->theorem), name_of(*r.series)));
              }}});
  table.add(growth_columns<Row>([](const Row& r) -> const GrowthSummary& { return r.growth; }));
  return table.add({{.key = "expected",
                     .heading = "theorem",
                     .value = [](const Row& r) { return Field(r.series->expected); },
                     .words = [](const Row& r) { return theorem_exponent(*r.series); }},
                    {.key = "at_most", .value = [](const Row& r) { return Field(r.series->at_most); }}});
}

/// Groups the series by theorem.
std::vector<std::span<const TheoremSeries>> by_theorem(std::span<const TheoremSeries> series) {
  std::vector<std::span<const TheoremSeries>> groups;
  for (std::size_t t = 0; t < theorem_names.size(); ++t) {
    const auto theorem = static_cast<Theorem>(t);
    const auto of_it = std::ranges::find_if(series, [&](const auto& s) { return s.theorem == theorem; });
    if (of_it == series.end()) continue;
    const auto after = std::find_if(of_it, series.end(), [&](const auto& s) { return s.theorem != theorem; });
    groups.emplace_back(of_it, after);
  }
  return groups;
}

std::string growing(const TheoremSeries& series) {
  const std::string_view per_level = series.dimension == 2 ? "it grows as log2 n times n^" : "it grows as n^";
  switch (series.theorem) {
    case Theorem::paths:
      return "the tests per node grow as n^";
    case Theorem::tightness:
    case Theorem::groupings:
      return "it grows as h^";
    case Theorem::family:
    case Theorem::families:
    case Theorem::two_necklaces:
    case Theorem::search:
      return std::string(per_level);
    case Theorem::closest_pair:
      return "it grows as n^";
  }
  return "";
}

std::string title_of(Theorem theorem) {
  if (theorem == Theorem::paths) return "paths (remark in section 2.3)";
  if (theorem == Theorem::groupings) return "groupings (remark after theorem 2.3)";
  if (theorem == Theorem::families) return "families (theorem 3.1)";
  return fmt::format("{} {}", theorem == Theorem::two_necklaces ? "corollary" : "theorem", name_of(theorem));
}

std::string_view theorem_says(Theorem theorem) {
  switch (theorem) {
    case Theorem::paths:
      return "testing intersections of the cages on the path to a node costs more than it saves";
    case Theorem::tightness:
      return "the layered root is at most sqrt(h + 1) times the wrapped one, h the height of the tree, and "
             "on some points sqrt(h) times";
    case Theorem::groupings:
      return "the upper bound of 2.3 holds for any grouping. If antipodal points of Lemma 2.5 are grouped "
             "first, all layered spheres are equal";
    case Theorem::family:
      return "the wrapped hierarchy has a separating family of O(n log n) pairs in the plane, O(n^(4/3)) in "
             "space; tight on grids";
    case Theorem::families:
      return "the family of the proof, which takes all disjoint cages within 8 R, and the smallest family, "
             "beside those of searches by other rules and over other groupings";
    case Theorem::search:
      return "collisions are decided in O(n log n) time in the plane, O(n^(4/3)) in space";
    case Theorem::two_necklaces:
      return "collisions of two necklaces of n beads are decided in O(n log n) time in the plane, "
             "O(n^(4/3)) in space";
    case Theorem::closest_pair:
      return "the closest pair is an edge of the power diagram, or has a common neighbour, or a bead beside "
             "an end of the chain";
  }
  return "";
}

// Counts the necklaces that can decide whether a theorem holds.
struct Judged {
  std::size_t all = 0, held = 0;
};
Judged judged_of(std::span<const TheoremSeries> some) {
  Judged judged;
  for (const TheoremSeries& series : some)
    for (const TheoremPoint& point : series.points) {
      judged.all += point.holds ? 1 : 0;
      judged.held += point.holds.value_or(false) ? 1 : 0;
    }
  return judged;
}

std::string_view judgement_of(Theorem theorem) {
  if (is_ratio(theorem)) return "The bound holds";
  if (theorem == Theorem::paths) return "The cascade finds the same nodes to repair";
  if (theorem == Theorem::families) return "The family is no smaller than the smallest one over its tree";
  return "The closest pair is among them";
}

// Returns the findings as sentences.
std::vector<std::string> findings_of(std::span<const TheoremSeries> group) {
  std::vector<std::string> findings;
  for (const TheoremSeries& series : group) {
    if (series.points.empty()) continue;
    const TheoremPoint& last = series.points.back();
    std::string text = fmt::format("{}: {} at {} beads", name_of(series),
                                   value_text(series.theorem, last.value), with_thousands(last.beads));
    if (const auto ratio = ratio_to_bound(last); ratio && series.theorem != Theorem::search)
      text += fmt::format(", {} of the bound", short_decimal(*ratio));
    if (const auto local = local_exponents(series.growth()); !local.empty())
      text += fmt::format("; from the last size but one its exponent is {:.3f}", local.back());
    if (const auto exponent = series.exponent()) {
      text += fmt::format("; beside lower-order terms {}{:.3f}", growing(series), *exponent);
      if (series.expected) text += ", theorem " + theorem_exponent(series);
    }
    if (const auto law = series.law())
      text += fmt::format("; {} is right within {}", growth_text(*law, size_of(series)),
                          in_percent(law->residual_most));
    findings.push_back(text + ".");
  }
  if (const Judged judged = judged_of(group); judged.all > 0)
    findings.insert(
        findings.begin(),
        fmt::format("{} in {} of {} {}.", judgement_of(group.front().theorem), judged.held, judged.all,
                    group.front().theorem == Theorem::families ? "families" : "necklaces"));
  return findings;
}

// A plot has room for eight series: families are shown for one model.
bool is_plotted(const TheoremSeries& series) {
  return series.theorem != Theorem::families ||
         (series.model == "grid" && series.dimension == 3 && series.hierarchy == "wrapped");
}

// Plots the points of each series, its fitted law and its bound. Series that share a bound share its line.
PointPlot plot_of(std::span<const TheoremSeries> group) {
  const Theorem theorem = group.front().theorem;
  PointPlot plot{"beads n", std::string(quantity_of(theorem)), {}, {}};
  plot.x_is_chosen = true;
  for (const TheoremSeries& series : group) {
    if (!is_plotted(series)) continue;
    const std::size_t number = plot.series.size();
    PointPlot::Line bound{{}, number, true}, law{{}, number};
    const auto fit = series.law();
    for (const TheoremPoint& point : series.points) {
      const auto n = static_cast<double>(point.beads);
      const bool has_bars = theorem == Theorem::search && point.seconds;
      plot.points.push_back({"", n, point.value, number, has_bars ? point.seconds->least : 0,
                             has_bars ? point.seconds->most : 0});
      if (point.bound && *point.bound > 0) bound.points.emplace_back(n, *point.bound);
      if (fit) law.points.emplace_back(n, series.predicted(*fit, point.beads));
    }
    const bool is_new =
        std::ranges::find(plot.lines, bound.points, &PointPlot::Line::points) == plot.lines.end();
    if (is_new && !bound.points.empty()) plot.lines.push_back(std::move(bound));
    if (!law.points.empty()) plot.lines.push_back(std::move(law));
    plot.series.push_back(name_of(series));
  }
  return plot;
}

std::string findings_html(std::span<const TheoremSeries> series) {
  const Judged judged = judged_of(series);
  std::string html = "<p>";
  if (judged.all > 0)
    html += fmt::format("Claims that a single necklace can decide held in <strong>{} of {}</strong> cases. ",
                        judged.held, judged.all);
  std::vector<FittedSeries> fits = fits_of(series);
  std::erase_if(fits, [](const FittedSeries& fitted) { return !fitted.series->expected; });
  if (fits.empty()) return html + "</p>\n";
  html += "The quantities that the theorems bound grow with these exponents:</p>\n";
  return html + fit_columns().html(fits);
}

Json theorem_rows_json(std::span<const TheoremSeries> series) {
  return point_columns().json(points_of(series));
}

Json theorem_fits_json(std::span<const TheoremSeries> series) { return fit_columns().json(fits_of(series)); }

std::string theorems_csv(std::span<const TheoremSeries> series) {
  return point_columns().csv(points_of(series));
}

std::string theorems_table(std::span<const TheoremSeries> series) {
  std::string text;
  for (const auto& group : by_theorem(series)) {
    const Theorem theorem = group.front().theorem;
    text += fmt::format("{}{}: {}\n{}", text.empty() ? "" : "\n", title_of(theorem), theorem_says(theorem),
                        point_columns(quantity_of(theorem)).text(points_of(group), "  "));
    for (const std::string& finding : findings_of(group)) text += "  " + finding + "\n";
  }
  return text;
}

// `page` says how the results were made.
std::string theorems_page(std::span<const TheoremSeries> series, Page page) {
  page.title = "kds theorems";
  page.found = findings_html(series);
  for (const auto& group : by_theorem(series)) {
    const Theorem theorem = group.front().theorem;
    std::string title = title_of(theorem);
    title.front() = static_cast<char>(std::toupper(title.front()));
    std::string section = fmt::format("<p>It says: {}.</p>\n<ul>\n", html_escaped(theorem_says(theorem)));
    for (const std::string& finding : findings_of(group))
      section += fmt::format("<li>{}</li>\n", html_escaped(finding));
    section +=
        "</ul>\n" +
        html_figure(
            svg_plot(plot_of(group)),
            fmt::format(
                "{}: {} by the number of beads{}, both axes logarithmic. Dashed lines are fitted laws, and "
                "dotted "
                "lines are the theorem's bounds{}.{}",
                title, quantity_of(theorem),
                theorem == Theorem::families ? ", grid in space, wrapped hierarchy" : "",
                is_ratio(theorem) ? "" : " without their constants",
                theorem == Theorem::search ? " Bars reach from the shortest to the longest round." : "")) +
        point_columns().html(points_of(group));
    page.body += html_section(title, section);
  }
  page.words =
      "The theorems are those of Agarwal, Guibas, Nguyen, Russel and Zhang, <em>Collision detection for "
      "deforming necklaces</em> (2004). Exponents are fitted beside lower-order terms, by least squares of "
      "relative residuals. They hold for these sizes and have no interval, because the residuals are no "
      "independent errors: a measurement proves no theorem. Means over several seeds have Student's interval "
      "of 95% confidence, for chains drawn independently. The law is the form with the least AICc: the "
      "theorem's, alone or with "
      "lower-order terms, and the usual forms where the theorem only bounds the growth. Seconds are "
      "processor times: the median of the rounds, with the least and the most in brackets.";
  return html_page(page);
}

constexpr CommandSpec kTheoremsCommand{
    "kds theorems",
    "Measures, for growing sizes, what the theorems of Agarwal et al. (2004) bound, and fits exponents.\n"
    "The necklaces are models. `kds scale FILE...` measures 2.3, 3.1 and 3.5 on files.\n\n"
    "  paths      tests of a cascade verification, without and with path cages\n"
    "  2.3        radius of the layered root / radius of the wrapped root: at most sqrt(h + 1), h the "
    "tree's height\n"
    "  groupings  the same with antipodal points paired, and with beads grouped by space\n"
    "  3.1        pairs in separating families of packed grids: n log n in the plane, n^(4/3) in space\n"
    "  families   pairs in the family of the proof of 3.1, in the smallest one, and in those of other\n"
    "             searches and groupings, on at most 8192 beads\n"
    "  3.2        time to find the families of 3.1\n"
    "  3.3        pairs in the family between two interleaved grids of n beads each\n"
    "  3.5        pairs that have to be looked at to find the closest one",
    "[THEOREM]...",
    "paths, 2.3, groupings, 3.1, families, 3.2, 3.3 or 3.5 (default: all)",
    "kds theorems --out report\n"
    "kds theorems 3.1 --beads 1000000 --json -\n"
    "kds theorems groupings families",
};

struct TheoremsAsked : Destinations {
  TheoremOptions measured;
};

const OptionList<TheoremsAsked>& theorems_options() {
  using O = TheoremsAsked;
  using M = TheoremOptions;
  Option<M> beads =
      whole_option({"--beads", "N",
                    "beads of the largest necklaces: at least 64 for 2.3 and groupings and "
                    "4096 for the others, so that there are three sizes, and at most 4000000 (default: "
                    "100000)"},
                   &M::most_beads, 0, 0);
  beads.read = [](M& m, const std::string& text) {
    m.most_beads = parse_whole_number("--beads", text, least_beads_for(m.theorems), 4'000'000);
  };
  static const auto list =
      OptionList<O>()
          .with(
              &O::measured,
              {{beads,
                real_option({"--gap", "X", "gap between the rows of grids, in diameters (default: 0.05)"},
                            &M::gap, {0.001, 0.9}),
                whole_option({"--seed", "N", "seed of random chains and of disturbed grids (default: 1)"},
                             &M::seed, 0, UINT64_MAX),
                whole_option({"--seeds", "N",
                              "measure N random necklaces of each size, of seeds from --seed on, and report "
                              "means with 95% intervals from their spread (default: 1)"},
                             &M::seeds, 1, 1000),
                whole_option({"--rounds", "N",
                              "repeat each measurement of time (paths, 3.2, 3.3 and 3.5) N times and report "
                              "the median "
                              "(default: 3)"},
                             &M::rounds, 1, 1000)}})
          .with(destination_options(
              "write theorems.json, theorems.csv and report.html to DIR (default: none)"));
  return list;
}

std::vector<Theorem> theorems_of(const std::vector<std::string>& operands) {
  std::vector<Theorem> theorems;
  for (const std::string& name : operands) {
    const bool is_theorem = std::ranges::find(theorem_names, name) != theorem_names.end();
    if (!is_theorem && (name.find('/') != std::string::npos || std::filesystem::exists(name)))
      throw InputError(fmt::format(
          "THEOREM: '{}' is a path; kds theorems measures models, kds scale FILE... measures files", name));
    const auto theorem = choice_of<Theorem>("THEOREM", name, theorem_names);
    if (std::ranges::find(theorems, theorem) != theorems.end())
      throw InputError(fmt::format("THEOREM: {} is listed twice", name));
    theorems.push_back(theorem);
  }
  if (theorems.empty())
    for (std::size_t t = 0; t < theorem_names.size(); ++t) theorems.push_back(static_cast<Theorem>(t));
  std::ranges::sort(theorems);
  return theorems;
}

TheoremsAsked parse_theorems(const Arguments& arguments) {
  TheoremsAsked asked;
  asked.measured.theorems = theorems_of({});
  const ParsedArguments parsed = parse_for(kTheoremsCommand, theorems_options(), arguments, asked);
  asked.measured.theorems = theorems_of(parsed.operands());  // the theorems bound --beads
  theorems_options().read(parsed, asked);
  if (parsed.has("--rounds") && !measures_time(asked.measured.theorems))
    throw InputError("--rounds applies only to paths, 3.2, 3.3 and 3.5, which measure time");
  return asked;
}

std::vector<TheoremSeries> measure(const TheoremOptions& options, const TableCommand::Progress& progress) {
  TheoremPlan plan = plan_theorems(options);
  std::size_t done = 0;
  for (const auto& work : plan.work) {
    work(plan.series);
    progress(++done, plan.work.size());
  }
  std::ranges::stable_sort(plan.series, {}, &TheoremSeries::theorem);
  return std::move(plan.series);
}

Json settings_json(const TheoremsAsked& asked) {
  std::vector<std::string_view> theorems;
  for (const Theorem theorem : asked.measured.theorems) theorems.push_back(name_of(theorem));
  return theorems_options().settings_json(asked, {{"theorems", theorems}});
}

}  // namespace

int theorems_command(const Arguments& arguments) {
  const TheoremsAsked asked = parse_theorems(arguments);
  TableCommand command("theorems", arguments, asked, "measurement");
  command.check_destinations();
  const std::vector<TheoremSeries> series = measure(asked.measured, command.progress());
  command.bar().erase();

  Json json;
  json["settings"] = settings_json(asked);
  json["rows"] = theorem_rows_json(series);
  json["fits"] = theorem_fits_json(series);
  command.deliver(json, theorems_csv(series), theorems_table(series),
                  [&](Page page) { return theorems_page(series, std::move(page)); });
  return 0;
}

}  // namespace kds
