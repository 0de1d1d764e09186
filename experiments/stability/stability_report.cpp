#include "experiments/stability/stability_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/result_json.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

Json row_json(const StabilityRow& row) {
  Json json{{"subject", row.subject},
            {"kind", row.structure ? "structure" : "certificate"},
            {"dimension", row.dimension},
            {"degree", row.degree}};
  json["function_degree"] = row.structure ? Json(nullptr) : Json(row.function_degree);
  json["extreme"] = row.extreme;
  json["cases"] = row.cases;
  json["events"] = row.events;
  json["signs"] = row.signs;
  json["agree"] = row.cases - row.disagreements - row.failed;
  json["disagreements"] = row.disagreements;
  json["refused"] = row.refused;
  json["failed"] = row.failed;
  json["reason"] = text_or_null(row.reason);
  json["motion"] = text_or_null(row.motion);
  json["stages"] = Json::object();
  for (const Stage& stage : stage_table) json["stages"][stage.name] = row.stages.*stage.count;
  json["seconds"] = {{"filtered", row.seconds.filtered}, {"exact", row.seconds.exact}};
  json["rebuilds"] = row.rebuilds;
  json["audits"] = {{"run", row.audits_run}, {"failed", row.audits_failed}};
  json["holds"] = row.holds();
  return json;
}

std::string all_or(const std::vector<std::string>& names) {
  return names.empty() ? "all" : fmt::format("{}", fmt::join(names, ","));
}

// Flattens one row: a field's name is its path joined by underscores. Text fields come last, in quotes.
void add_fields(std::vector<std::pair<std::string, std::string>>& fields, const std::string& prefix,
                const Json& json) {
  for (const auto& [name, value] : *json.members()) {
    if (name == "reason" || name == "motion") continue;
    const std::string path = prefix.empty() ? name : prefix + "_" + name;
    if (value.members() != nullptr) {
      add_fields(fields, path, value);
    } else {
      fields.emplace_back(path, value.is_null() ? "" : value.text() ? *value.text() : *line_of(value));
    }
  }
}

Json stability_settings(const StabilityOptions& options) {
  return {{"subjects", all_or(options.subjects)},
          {"extremes", all_or(options.extremes)},
          {"cases", options.cases.cases},
          {"seed", options.cases.seed}};
}

struct TextColumn {
  std::string_view heading;
  int width;
  std::string (*cell)(const StabilityRow&);
};

std::string count(std::uint64_t value) { return fmt::format("{}", value); }
std::string microseconds(double seconds) {
  const double value = seconds * 1e6;
  return fmt::format("{:.{}f}", value, value < 10 ? 2 : value < 100 ? 1 : 0);
}

constexpr TextColumn kCases{"cases", 6, [](const StabilityRow& row) { return count(row.cases); }};
constexpr TextColumn kEvents{"events", 7, [](const StabilityRow& row) { return count(row.events); }};
constexpr TextColumn kDiffer{"differ", 7,
                             [](const StabilityRow& row) { return count(row.disagreements + row.failed); }};
constexpr TextColumn kDouble{"double", 7, [](const StabilityRow& row) {
                               return count(row.stages.coefficients + row.stages.isolation);
                             }};
constexpr TextColumn kTracked{"tracked", 8,
                              [](const StabilityRow& row) { return count(row.stages.refined); }};
constexpr TextColumn kIntegers{"integer", 8, [](const StabilityRow& row) {
                                 return count(row.stages.exact + row.stages.identically_zero);
                               }};
constexpr TextColumn kBits{"bits", 5, [](const StabilityRow& row) { return count(row.stages.largest_bits); }};
constexpr TextColumn kFilteredTime{
    "filtered", 11, [](const StabilityRow& row) { return microseconds(row.seconds.filtered); }};
constexpr TextColumn kExactTime{"exact", 8,
                                [](const StabilityRow& row) { return microseconds(row.seconds.exact); }};
constexpr TextColumn kAudits{"audits", 7, [](const StabilityRow& row) { return count(row.audits_run); }};

struct Group {
  std::string_view heading;
  std::vector<TextColumn> columns;
};

const std::vector<Group>& groups(bool structure) {
  static const std::vector<Group> certificate{{"", {kCases, kEvents, kDiffer}},
                                              {"settled by", {kDouble, kTracked, kIntegers, kBits}},
                                              {"us per search", {kFilteredTime, kExactTime}}};
  static const std::vector<Group> kinetic{{"", {kCases, kEvents, kDiffer, kAudits}},
                                          {"settled by", {kDouble, kTracked, kIntegers, kBits}},
                                          {"us per run", {kFilteredTime, kExactTime}}};
  return structure ? kinetic : certificate;
}

constexpr int kWidth = 119;
constexpr int kNameWidth = 23;

std::string heading_of(const StabilityRow& row) {
  std::string text = fmt::format("{}, {}D, motion of degree {}", row.subject, row.dimension, row.degree);
  if (!row.structure) text += fmt::format(", function of degree {}", row.function_degree);
  std::string upper(kNameWidth, ' '), lower(kNameWidth, ' ');
  for (const Group& group : groups(row.structure)) {
    int width = 0;
    for (const TextColumn& column : group.columns) {
      lower += fmt::format("{:>{}}", column.heading, column.width);
      width += column.width;
    }
    upper += group.heading.empty() ? std::string(static_cast<std::size_t>(width), ' ')
                                   : fmt::format("  {:-^{}}", fmt::format(" {} ", group.heading), width - 2);
  }
  return text + "\n" + upper + "\n" + lower + "\n";
}

std::string line_of(const StabilityRow& row) {
  std::string text = fmt::format("  {:<{}}", row.extreme, kNameWidth - 2);
  if (row.refused == row.cases)
    return text +
           fmt::format("{:>6} refused: {}", row.cases, one_line(row.reason)).substr(0, kWidth - kNameWidth) +
           "\n";
  for (const Group& group : groups(row.structure))
    for (const TextColumn& column : group.columns)
      text += fmt::format("{:>{}}", column.cell(row), column.width);
  if (row.refused > 0) text += fmt::format("\n{:{}} {} of these refused", "", kNameWidth, row.refused);
  if (!row.holds()) text += fmt::format("\n  DOES NOT HOLD: {}", one_line(row.reason));
  return text + "\n";
}

bool same_block(const StabilityRow& a, const StabilityRow& b) {
  return a.subject == b.subject && a.dimension == b.dimension && a.degree == b.degree;
}

std::string findings(std::span<const StabilityRow> rows) {
  std::uint64_t cases = 0, refused = 0, differing = 0, audits = 0, failed_audits = 0;
  for (const StabilityRow& row : rows) {
    cases += row.cases;
    refused += row.refused;
    differing += row.disagreements + row.failed;
    audits += row.audits_run;
    failed_audits += row.audits_failed;
  }
  return fmt::format(
      "<p>In {0} cases of {1} rows, of which both kernels refuse {2}, <strong>filtered differs from exact in "
      "{3}</strong>.</p>\n<p><strong>{5} of {4} audits failed</strong>.</p>\n",
      with_thousands(cases), with_thousands(rows.size()), with_thousands(refused), with_thousands(differing),
      with_thousands(audits), with_thousands(failed_audits));
}

// Rows with one name: the sums of their cases, and their times.
struct RowGroup {
  std::string name;
  std::size_t rows = 0, failing = 0;
  StabilityRow sum = {};
  std::vector<KernelSeconds> seconds = {};  ///< without refused rows

  void add(const StabilityRow& row) {
    ++rows;
    sum.cases += row.cases;
    sum.events += row.events;
    sum.disagreements += row.disagreements + row.failed;
    sum.refused += row.refused;
    if (row.refused < row.cases) seconds.push_back(row.seconds);
    if (!row.holds()) ++failing;
  }

  /// Returns the median over the rows, or nothing if all rows are refused.
  [[nodiscard]] std::optional<double> microseconds(double KernelSeconds::*kernel) const {
    std::vector<double> values;
    for (const KernelSeconds& one : seconds) values.push_back(1e6 * (one.*kernel));
    return values.empty() ? std::nullopt : std::optional(median(std::move(values)));
  }
};

// Returns a group for each name, in the order of first appearance. Omits rows with an empty name.
template <class Name>
std::vector<RowGroup> grouped(std::span<const StabilityRow> rows, const Name& name) {
  std::vector<RowGroup> groups;
  for (const StabilityRow& row : rows) {
    const std::string group = name(row);
    if (group.empty()) continue;
    auto place = std::ranges::find(groups, group, &RowGroup::name);
    if (place == groups.end()) place = groups.insert(place, {group});
    place->add(row);
  }
  return groups;
}

std::string table(std::span<const RowGroup> groups) {
  using Row = RowGroup;
  const auto count = [](const char* heading, auto value) {
    return Column<Row>{.heading = heading, .value = [value](const Row& g) { return Field(value(g)); }};
  };
  const auto micros = [](const char* heading, double KernelSeconds::*kernel) {
    return Column<Row>{.heading = heading,
                       .value = [kernel](const Row& g) { return Field(g.microseconds(kernel)); },
                       .format = shortly};
  };
  const Table<Row> columns{{
      {.heading = "name", .value = [](const Row& g) { return Field(g.name); }},
      count("rows", [](const Row& g) { return g.rows; }),
      count("cases", [](const Row& g) { return g.sum.cases; }),
      count("events", [](const Row& g) { return g.sum.events; }),
      count("differ", [](const Row& g) { return g.sum.disagreements; }),
      count("refused", [](const Row& g) { return g.sum.refused; }),
      micros("filtered, us", &KernelSeconds::filtered),
      micros("exact, us", &KernelSeconds::exact),
      {.heading = "holds", .value = [](const Row& g) { return Field(g.failing == 0 ? "yes" : "NO"); }},
  }};
  return groups.empty() ? "" : columns.html(groups);
}

std::string subject_of(const StabilityRow& row) {
  return fmt::format("{} {}D, degree {}", row.subject, row.dimension, row.degree);
}

std::string subjects(std::span<const StabilityRow> rows, bool structures) {
  const auto name = [&](const StabilityRow& row) {
    return row.structure == structures ? subject_of(row) : "";
  };
  PointPlot plot{"exact, us", "us", {"filtered"}, {}};
  const std::vector<RowGroup> groups = grouped(rows, name);
  for (const RowGroup& group : groups) {
    const auto exact = group.microseconds(&KernelSeconds::exact),
               filtered = group.microseconds(&KernelSeconds::filtered);
    if (!exact || !(*exact > 0)) continue;
    plot.points.push_back({group.name, *exact, *filtered, 0});
  }
  const std::string figure =
      plot.points.size() < 2
          ? ""
          : html_figure(svg_plot(plot),
                        fmt::format("Microseconds of {} in the kernel filtered, compared with the "
                                    "kernel exact. Both axes are logarithmic.",
                                    structures ? "a run" : "a search"));
  return figure + table(groups);
}

std::string failing_rows(std::span<const StabilityRow> rows) {
  return table(grouped(rows, [](const StabilityRow& row) { return row.holds() ? "" : name_of(row); }));
}

}  // namespace

std::string name_of(const StabilityRow& row) {
  return fmt::format("{} {}D degree {}, {}", row.subject, row.dimension, row.degree, row.extreme);
}

std::optional<std::string> complaint_about(std::span<const StabilityRow> rows) {
  std::vector<std::string> failing;
  for (const StabilityRow& row : rows)
    if (!row.holds()) failing.push_back(name_of(row));
  if (failing.empty()) return std::nullopt;
  return fmt::format("{} of {} rows do not hold: {}", failing.size(), rows.size(), fmt::join(failing, "; "));
}

std::string stability_json(std::string command, const StabilityOptions& options,
                           std::span<const StabilityRow> rows) {
  Json json;
  json["settings"] = stability_settings(options);
  json["rows"] = Json::array();
  for (const StabilityRow& row : rows) json["rows"].push_back(row_json(row));
  json["holds"] = std::ranges::all_of(rows, &StabilityRow::holds);
  add_provenance(json, std::move(command));
  return text_of(json);
}

std::string stability_csv(std::span<const StabilityRow> rows) {
  std::string text;
  for (const StabilityRow& row : rows) {
    std::vector<std::pair<std::string, std::string>> fields;
    add_fields(fields, "", row_json(row));
    const auto line = [&](auto part) {
      std::vector<std::string> parts;
      for (const auto& field : fields) parts.push_back(field.*part);
      return fmt::format("{}\n", fmt::join(parts, ","));
    };
    using NamedValue = std::pair<std::string, std::string>;
    if (text.empty()) text = line(&NamedValue::first);
    text += line(&NamedValue::second);
  }
  return text;
}

std::string stability_table(std::span<const StabilityRow> rows) {
  std::string text;
  std::uint64_t cases = 0, differing = 0, refused = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const bool first = i == 0 || !same_block(rows[i - 1], rows[i]);
    if (first && i > 0) text += '\n';
    if (first) text += heading_of(rows[i]);
    text += line_of(rows[i]);
    cases += rows[i].cases;
    differing += rows[i].disagreements + rows[i].failed;
    refused += rows[i].refused;
  }
  const auto failing = std::ranges::count_if(rows, [](const StabilityRow& row) { return !row.holds(); });
  text += fmt::format("\n{} rows, {} cases ({} refused); filtered differs from exact in {}: {}\n",
                      rows.size(), with_thousands(cases), with_thousands(refused), with_thousands(differing),
                      failing == 0 ? "all rows hold" : fmt::format("{} rows do not hold", failing));
  for (const StabilityRow& row : rows)
    if (!row.holds()) text += fmt::format("  {}: {}\n", name_of(row), one_line(row.reason));
  return text;
}

std::string stability_page(std::span<const StabilityRow> rows, Page page) {
  page.title = "kds stability";
  page.found = findings(rows);
  page.words =
      "A row of the data is a certificate type or a structure in one extreme of its input. The tables group "
      "the rows by subject and by extreme, and list rows that do not hold one by one. <em>Differ</em>: cases "
      "in which the kernels filtered and exact disagree, or one fails. Microseconds are those of a "
      "certificate's search or of a structure's run: each row has the median of its cases, and a table has "
      "the "
      "median of its rows without those that are refused.";
  page.body = html_section("Rows that do not hold", failing_rows(rows)) +
              html_section("Certificates, all extremes", subjects(rows, false)) +
              html_section("Structures, all extremes", subjects(rows, true)) +
              html_section("Extremes, all subjects",
                           table(grouped(rows, [](const StabilityRow& row) { return row.extreme; })));
  return html_page(page);
}

}  // namespace kds
