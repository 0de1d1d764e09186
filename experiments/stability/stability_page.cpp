#include "experiments/stability/stability_page.h"

#include <fmt/format.h>

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

std::string micros(double seconds) { return short_decimal(1e6 * seconds); }

std::string table(std::span<const StabilityRow> rows, bool structures) {
  std::vector<HtmlRow> lines;
  for (const StabilityRow& row : rows) {
    if (row.structure != structures) continue;
    lines.push_back(
        {{name_of(row), with_thousands(row.cases), with_thousands(row.events),
          with_thousands(row.disagreements + row.failed), with_thousands(row.refused),
          with_thousands(row.fast.missed), with_thousands(row.fast.extra), micros(row.seconds.fast),
          micros(row.seconds.filtered), micros(row.seconds.exact), row.holds() ? "yes" : "NO"}});
  }
  if (lines.empty()) return "";
  return html_table({"", "cases", "events", "differ", "refused", "fast missed", "fast extra", "us fast",
                     "us filtered", "us exact", "holds"},
                    lines);
}

}  // namespace

std::string stability_page(std::span<const StabilityRow> rows, Page page) {
  page.title = "kds stability";
  page.found = findings(rows);
  page.words =
      "A row is a certificate type or a structure in one extreme of its input. <em>Differ</em>: cases in "
      "which "
      "the kernels filtered and exact do not tell the same, or one fails. <em>Missed</em> and "
      "<em>extra</em>: "
      "events of the kernel fast beside the exact ones. Times are medians over the cases, of a search or of "
      "a "
      "run.";
  page.body =
      html_section("Certificates", table(rows, false)) + html_section("Structures", table(rows, true));
  return html_page(page);
}

}  // namespace kds
