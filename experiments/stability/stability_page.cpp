#include "experiments/stability/stability_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/output/page/svg_plot.h"
#include "experiments/output/page/table.h"
#include "experiments/output/text.h"
#include "experiments/stability/stability_report.h"

namespace kds {

namespace {

std::string findings(std::span<const StabilityRow> rows) {
  std::uint64_t cases = 0, refused = 0, differing = 0, missed = 0, extra = 0, audits = 0, failed_audits = 0;
  for (const StabilityRow& row : rows) {
    cases += row.cases;
    refused += row.refused;
    differing += row.disagreements + row.failed;
    missed += row.fast.missed;
    extra += row.fast.extra;
    audits += row.audits_run;
    failed_audits += row.audits_failed;
  }
  return fmt::format(
      "<p>In {0} cases of {1} rows, of which both kernels refuse {2}, <strong>filtered differs from exact in "
      "{3}</strong>.</p>\n<p><strong>{5} of {4} audits failed</strong>. The kernel fast, which promises "
      "nothing, missed {6} events and invented {7}.</p>\n",
      with_thousands(cases), with_thousands(rows.size()), with_thousands(refused), with_thousands(differing),
      with_thousands(audits), with_thousands(failed_audits), with_thousands(missed), with_thousands(extra));
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
    kds::add(sum.fast, row.fast);
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
      count("fast missed", [](const Row& g) { return g.sum.fast.missed; }),
      count("fast extra", [](const Row& g) { return g.sum.fast.extra; }),
      micros("us fast", &KernelSeconds::fast),
      micros("us filtered", &KernelSeconds::filtered),
      micros("us exact", &KernelSeconds::exact),
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
  PointPlot plot{"us exact", "us", {"filtered", "fast"}, {}};
  const std::vector<RowGroup> groups = grouped(rows, name);
  for (const RowGroup& group : groups) {
    const auto exact = group.microseconds(&KernelSeconds::exact),
               filtered = group.microseconds(&KernelSeconds::filtered),
               fast = group.microseconds(&KernelSeconds::fast);
    if (!exact || !(*exact > 0)) continue;
    plot.points.push_back({group.name, *exact, *filtered, 0});
    plot.points.push_back({group.name, *exact, *fast, 1});
  }
  const std::string figure =
      plot.points.size() < 4
          ? ""
          : html_figure(svg_plot(plot),
                        fmt::format("Microseconds of {} in the kernels filtered and fast, compared with "
                                    "the kernel exact. Both axes are logarithmic.",
                                    structures ? "a run" : "a search"));
  return figure + table(groups);
}

std::string failing_rows(std::span<const StabilityRow> rows) {
  return table(grouped(rows, [](const StabilityRow& row) { return row.holds() ? "" : name_of(row); }));
}

}  // namespace

std::string stability_page(std::span<const StabilityRow> rows, Page page) {
  page.title = "kds stability";
  page.found = findings(rows);
  page.words =
      "A row of the data is a certificate type or a structure in one extreme of its input. The tables group "
      "the rows by subject and by extreme, and list rows that do not hold one by one. <em>Differ</em>: cases "
      "in which the kernels filtered and exact disagree, or one fails. <em>Missed</em> and <em>extra</em>: "
      "events of the kernel fast compared with the exact ones. Microseconds are those of a certificate's "
      "search or of a structure's run: each row has the median of its cases, and a table has the median of "
      "its rows without those that are refused.";
  page.body = html_section("Rows that do not hold", failing_rows(rows)) +
              html_section("Certificates, all extremes", subjects(rows, false)) +
              html_section("Structures, all extremes", subjects(rows, true)) +
              html_section("Extremes, all subjects",
                           table(grouped(rows, [](const StabilityRow& row) { return row.extreme; })));
  return html_page(page);
}

}  // namespace kds
