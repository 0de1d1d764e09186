#include "experiments/theorems/theorems_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/text.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

std::optional<double> ratio_to_bound(const TheoremPoint& point) {
  if (!point.bound) return std::nullopt;
  return point.value / *point.bound;
}

std::string decimal_or_dash(const std::optional<double>& value) {
  return value ? short_decimal(*value) : "-";
}

// Counts in full.
std::string value_text(Theorem theorem, double value) {
  const bool is_count = theorem == Theorem::family || theorem == Theorem::closest_pair;
  return is_count ? with_thousands(static_cast<std::uint64_t>(value)) : short_decimal(value);
}
std::string seconds_text(const TheoremPoint& point) {
  return point.seconds ? spread_text(*point.seconds) : "-";
}
std::string holds_text(const TheoremPoint& point) {
  if (!point.holds) return "-";
  return *point.holds ? "yes" : "NO";
}

/// Series of one theorem stand together.
std::vector<std::span<const TheoremSeries>> by_theorem(std::span<const TheoremSeries> series) {
  std::vector<std::span<const TheoremSeries>> groups;
  for (const Theorem theorem :
       {Theorem::tightness, Theorem::family, Theorem::search, Theorem::closest_pair}) {
    const auto of_it = std::ranges::find_if(series, [&](const auto& s) { return s.theorem == theorem; });
    if (of_it == series.end()) continue;
    const auto after = std::find_if(of_it, series.end(), [&](const auto& s) { return s.theorem != theorem; });
    groups.emplace_back(of_it, after);
  }
  return groups;
}

std::string growing(const TheoremSeries& series) {
  switch (series.theorem) {
    case Theorem::tightness:
      return "the ratio grows as h^";
    case Theorem::family:
      return series.dimension == 2 ? "family / log2 n grows as n^" : "the family grows as n^";
    case Theorem::search:
      return series.dimension == 2 ? "time / log2 n grows as n^" : "the time grows as n^";
    case Theorem::closest_pair:
      return "the pairs looked at grow as n^";
  }
  return "";
}

std::string_view theorem_says(Theorem theorem) {
  switch (theorem) {
    case Theorem::tightness:
      return "the layered root is at most sqrt(h + 1) times the wrapped one, h the height of the tree, and "
             "on some points sqrt(h) times";
    case Theorem::family:
      return "the wrapped hierarchy has a separating family of O(n log n) pairs in the plane, O(n^(4/3)) in "
             "space; tight on grids";
    case Theorem::search:
      return "collisions are decided in O(n log n) time in the plane, O(n^(4/3)) in space";
    case Theorem::closest_pair:
      return "the closest pair is an edge of the power diagram, or has a common neighbour, or a bead beside "
             "an end of the chain";
  }
  return "";
}

// Necklaces that can tell whether a theorem holds.
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

// Sentences.
std::vector<std::string> findings_of(std::span<const TheoremSeries> group) {
  std::vector<std::string> findings;
  for (const TheoremSeries& series : group) {
    if (series.points.empty()) continue;
    const TheoremPoint& last = series.points.back();
    std::string text = fmt::format("{}: {} at {} beads", name_of(series),
                                   value_text(series.theorem, last.value), with_thousands(last.beads));
    if (const auto ratio = ratio_to_bound(last);
        ratio && (series.theorem == Theorem::family || series.theorem == Theorem::tightness))
      text += fmt::format(", {} of the bound", short_decimal(*ratio));
    if (const auto fit = series.fit()) {
      text += fmt::format("; {}{}", growing(series), exponent_text(*fit));
      if (series.expected) text += fmt::format(", theorem {:.3f}", *series.expected);
    }
    findings.push_back(text + ".");
  }
  if (const Judged judged = judged_of(group); judged.all > 0)
    findings.insert(findings.begin(), fmt::format("{} in {} of {} necklaces.",
                                                  group.front().theorem == Theorem::tightness
                                                      ? "The bound holds"
                                                      : "The closest pair is among them",
                                                  judged.held, judged.all));
  return findings;
}

PointPlot plot_of(std::span<const TheoremSeries> group) {
  const Theorem theorem = group.front().theorem;
  PointPlot plot{"beads n", std::string(quantity_of(theorem)), {}, {}};
  for (const TheoremSeries& series : group) {
    for (const TheoremPoint& point : series.points)
      plot.points.push_back({"", static_cast<double>(point.beads), point.value, plot.series.size()});
    plot.series.push_back(name_of(series));
  }
  return plot;
}

std::string table_of(std::span<const TheoremSeries> group) {
  std::vector<HtmlRow> rows;
  for (const TheoremSeries& series : group)
    for (const TheoremPoint& point : series.points)
      rows.push_back({{name_of(series), with_thousands(point.beads), value_text(series.theorem, point.value),
                       decimal_or_dash(point.bound), decimal_or_dash(ratio_to_bound(point)),
                       seconds_text(point), holds_text(point)}});
  return html_table({"", "n", "value", "bound", "ratio", "seconds", "holds"}, rows);
}

std::string findings_html(std::span<const TheoremSeries> series) {
  const Judged judged = judged_of(series);
  std::string html = "<p>";
  if (judged.all > 0)
    html +=
        fmt::format("What theorems 2.3 and 3.5 say of single necklaces held in <strong>{} of {}</strong>. ",
                    judged.held, judged.all);
  html += "What the theorems bound grows with these exponents:</p>\n";
  std::vector<HtmlRow> rows;
  for (const TheoremSeries& one : series)
    if (const auto fit = one.fit(); fit && one.expected)
      rows.push_back(
          {{fmt::format("{}, {}", name_of(one.theorem), name_of(one)), fmt::format("{:.3f}", fit->exponent),
            fmt::format("{:.3f} to {:.3f}", fit->lower, fit->upper), fmt::format("{:.3f}", *one.expected)}});
  return html + html_table({"", "exponent", "95%", "theorem"}, rows);
}

}  // namespace

Json theorem_rows_json(std::span<const TheoremSeries> series) {
  Json json = Json::array();
  for (const TheoremSeries& one : series)
    for (const TheoremPoint& point : one.points)
      json.push_back({{"theorem", name_of(one.theorem)},
                      {"model", one.model},
                      {"dimension", one.dimension},
                      {"hierarchy", one.hierarchy.empty() ? Json(nullptr) : Json(one.hierarchy)},
                      {"n", point.beads},
                      {"quantity", quantity_of(one.theorem)},
                      {"value", point.value},
                      {"bound", point.bound},
                      {"ratio", ratio_to_bound(point)},
                      {"seconds", point.seconds ? Json(point.seconds->median) : Json(nullptr)},
                      {"seconds_least", point.seconds ? Json(point.seconds->least) : Json(nullptr)},
                      {"seconds_most", point.seconds ? Json(point.seconds->most) : Json(nullptr)},
                      {"holds", point.holds ? Json(*point.holds) : Json(nullptr)}});
  return json;
}

Json theorem_fits_json(std::span<const TheoremSeries> series) {
  Json json = Json::array();
  for (const TheoremSeries& one : series) {
    const auto fit = one.fit();
    if (!fit) continue;
    json.push_back({{"theorem", name_of(one.theorem)},
                    {"model", one.model},
                    {"dimension", one.dimension},
                    {"hierarchy", one.hierarchy.empty() ? Json(nullptr) : Json(one.hierarchy)},
                    {"sizes", fit->points},
                    {"exponent", fit->exponent},
                    {"lower", fit->lower},
                    {"upper", fit->upper},
                    {"factor", fit->factor},
                    {"expected", one.expected}});
  }
  return json;
}

std::string theorems_csv(std::span<const TheoremSeries> series) {
  std::string text =
      "theorem,model,dimension,hierarchy,n,value,bound,ratio,seconds,seconds_least,seconds_most,holds\n";
  for (const TheoremSeries& one : series)
    for (const TheoremPoint& point : one.points) {
      const auto seconds = [&](double Spread::*which) {
        return point.seconds ? fmt::format("{}", (*point.seconds).*which) : "";
      };
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{}\n", name_of(one.theorem), csv_field(one.model),
                          one.dimension, one.hierarchy, point.beads, point.value, value_or_empty(point.bound),
                          value_or_empty(ratio_to_bound(point)), seconds(&Spread::median),
                          seconds(&Spread::least), seconds(&Spread::most),
                          point.holds ? fmt::format("{}", *point.holds) : "");
    }
  return text;
}

std::string theorems_table(std::span<const TheoremSeries> series) {
  std::string text;
  for (const auto& group : by_theorem(series)) {
    const Theorem theorem = group.front().theorem;
    text += fmt::format("{}theorem {}: {}\n  {:<40}{:>11}{:>38}{:>14}{:>8}{:>34}{:>7}\n",
                        text.empty() ? "" : "\n", name_of(theorem), theorem_says(theorem), "", "n",
                        quantity_of(theorem), "bound", "ratio", "seconds", "holds");
    for (const TheoremSeries& one : group)
      for (const TheoremPoint& point : one.points)
        text += fmt::format("  {:<40}{:>11}{:>38}{:>14}{:>8}{:>34}{:>7}\n", name_of(one),
                            with_thousands(point.beads), value_text(theorem, point.value),
                            decimal_or_dash(point.bound), decimal_or_dash(ratio_to_bound(point)),
                            seconds_text(point), holds_text(point));
    for (const std::string& finding : findings_of(group)) text += "  " + finding + "\n";
  }
  return text;
}

std::string theorems_page(std::span<const TheoremSeries> series, Page page) {
  page.title = "kds theorems";
  page.found = findings_html(series);
  for (const auto& group : by_theorem(series)) {
    const Theorem theorem = group.front().theorem;
    std::string section = fmt::format("<p>It says: {}.</p>\n<ul>\n", html_escaped(theorem_says(theorem)));
    for (const std::string& finding : findings_of(group))
      section += fmt::format("<li>{}</li>\n", html_escaped(finding));
    section += "</ul>\n" +
               html_figure(svg_plot(plot_of(group)),
                           fmt::format("Theorem {}: {} by the number of beads, both axes logarithmic.",
                                       name_of(theorem), quantity_of(theorem))) +
               table_of(group);
    page.body += html_section(fmt::format("Theorem {}", name_of(theorem)), section);
  }
  page.words =
      "Theorems are those of Agarwal, Guibas, Nguyen, Russel and Zhang, <em>Collision detection for "
      "deforming necklaces</em> (2004). Powers are fitted by least squares of logarithms, with intervals of "
      "95% confidence as if errors were normal: a measurement proves no theorem. Seconds are of the "
      "processor, the median of the rounds, and in brackets the least and the most.";
  return html_page(page);
}

}  // namespace kds
