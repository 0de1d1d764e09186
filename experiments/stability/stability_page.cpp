#include "experiments/stability/stability_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

#include "experiments/output/page/svg_plot.h"
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
      "<p>In {} cases of {} rows, of which both kernels refuse {}, <strong>filtered differs from exact in "
      "{}</strong>.</p>\n<p>Of {} audits <strong>{} failed</strong>. The kernel fast, which promises "
      "nothing, missed {} events "
      "and "
      "invented {}.</p>\n",
      with_thousands(cases), with_thousands(rows.size()), with_thousands(refused), with_thousands(differing),
      with_thousands(audits), with_thousands(failed_audits), with_thousands(missed), with_thousands(extra));
}

// Rows together: the sums of their cases, medians of their times.
class Together {
 public:
  void add(const StabilityRow& row) {
    ++rows_;
    sum_.cases += row.cases;
    sum_.events += row.events;
    sum_.disagreements += row.disagreements + row.failed;
    sum_.refused += row.refused;
    kds::add(sum_.fast, row.fast);
    if (row.refused < row.cases) seconds_.push_back(row.seconds);
    if (!row.holds()) ++failing_;
  }

  [[nodiscard]] HtmlRow line(const std::string& name) const {
    return {{name, with_thousands(rows_), with_thousands(sum_.cases), with_thousands(sum_.events),
             with_thousands(sum_.disagreements), with_thousands(sum_.refused),
             with_thousands(sum_.fast.missed), with_thousands(sum_.fast.extra), micros(&KernelSeconds::fast),
             micros(&KernelSeconds::filtered), micros(&KernelSeconds::exact), failing_ == 0 ? "yes" : "NO"}};
  }

  /// Median over the rows that are not refused; none where all are.
  [[nodiscard]] std::optional<double> microseconds(double KernelSeconds::*kernel) const {
    std::vector<double> values;
    for (const KernelSeconds& seconds : seconds_) values.push_back(1e6 * (seconds.*kernel));
    return values.empty() ? std::nullopt : std::optional(median(std::move(values)));
  }

 private:
  [[nodiscard]] std::string micros(double KernelSeconds::*kernel) const {
    const std::optional<double> value = microseconds(kernel);
    return value ? short_decimal(*value) : "-";
  }

  std::size_t rows_ = 0, failing_ = 0;
  StabilityRow sum_;
  std::vector<KernelSeconds> seconds_;
};

// A line for all rows that `name` calls the same, in the order of their first.
template <class Name>
std::vector<std::pair<std::string, Together>> grouped(std::span<const StabilityRow> rows, const Name& name) {
  std::vector<std::pair<std::string, Together>> groups;
  for (const StabilityRow& row : rows) {
    const std::string group = name(row);
    if (group.empty()) continue;
    auto place = std::ranges::find(groups, group, &std::pair<std::string, Together>::first);
    if (place == groups.end()) place = groups.insert(place, {group, {}});
    place->second.add(row);
  }
  return groups;
}

template <class Name>
std::string table(std::span<const StabilityRow> rows, const Name& name) {
  const auto groups = grouped(rows, name);
  if (groups.empty()) return "";
  std::vector<HtmlRow> lines;
  for (const auto& [group, together] : groups) lines.push_back(together.line(group));
  return html_table({"", "rows", "cases", "events", "differ", "refused", "fast missed", "fast extra",
                     "us fast", "us filtered", "us exact", "holds"},
                    lines);
}

std::string subject_of(const StabilityRow& row) {
  return fmt::format("{} {}D, degree {}", row.subject, row.dimension, row.degree);
}

std::string subjects(std::span<const StabilityRow> rows, bool structures) {
  const auto name = [&](const StabilityRow& row) {
    return row.structure == structures ? subject_of(row) : "";
  };
  PointPlot plot{"us exact", "us", {"filtered", "fast"}, {}};
  for (const auto& [subject, together] : grouped(rows, name)) {
    const auto exact = together.microseconds(&KernelSeconds::exact),
               filtered = together.microseconds(&KernelSeconds::filtered),
               fast = together.microseconds(&KernelSeconds::fast);
    if (!exact || !(*exact > 0)) continue;
    plot.points.push_back({subject, *exact, *filtered, 0});
    plot.points.push_back({subject, *exact, *fast, 1});
  }
  const std::string figure =
      plot.points.size() < 4
          ? ""
          : html_figure(svg_plot(plot),
                        fmt::format("Microseconds of {} in the kernels filtered and fast, beside those "
                                    "in the kernel exact; both axes are logarithmic.",
                                    structures ? "a run" : "a search"));
  return figure + table(rows, name);
}

std::string failing_rows(std::span<const StabilityRow> rows) {
  return table(rows, [](const StabilityRow& row) { return row.holds() ? "" : name_of(row); });
}

}  // namespace

std::string stability_page(std::span<const StabilityRow> rows, Page page) {
  page.title = "kds stability";
  page.found = findings(rows);
  page.words =
      "A row of the data is a certificate type or a structure in one extreme of its input; here they stand "
      "together by subject and by extreme, and those that do not hold one by one. <em>Differ</em>: cases in "
      "which the kernels filtered and exact do not tell the same, or one fails. <em>Missed</em> and "
      "<em>extra</em>: events of the kernel fast beside the exact ones. Microseconds are of a certificate's "
      "search, or of a structure's run: the median over the rows of each row's median over its cases, "
      "without rows that are refused.";
  page.body = html_section("Rows that do not hold", failing_rows(rows)) +
              html_section("Certificates, all extremes", subjects(rows, false)) +
              html_section("Structures, all extremes", subjects(rows, true)) +
              html_section("Extremes, all subjects",
                           table(rows, [](const StabilityRow& row) { return row.extreme; }));
  return html_page(page);
}

}  // namespace kds
