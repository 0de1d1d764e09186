#include "experiments/run/table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/run/summary_rows.h"

namespace kds {

std::string comparison_table(const RunReport& report) {
  std::string text;
  for (const auto& [label, value] : input_lines(report))
    text += one_line(fmt::format("{:<10}{}", label, value)) + "\n";
  text += "\n";

  const std::vector<SummaryRow> rows = summary_rows(report);
  const auto label_of = [](const SummaryRow& row) { return (row.detail ? "  " : "") + row.label; };
  std::size_t label_width = 0;
  std::vector<std::size_t> widths;
  for (const StructureReport& structure : report.structures) widths.push_back(structure.name.size());
  for (const SummaryRow& row : rows) {
    label_width = std::max(label_width, label_of(row).size());
    for (std::size_t i = 0; i < row.cells.size(); ++i) widths[i] = std::max(widths[i], row.cells[i].size());
  }

  text += std::string(label_width, ' ');
  for (std::size_t i = 0; i < widths.size(); ++i)
    text += fmt::format("  {:>{}}", report.structures[i].name, widths[i]);
  text += "\n";
  for (const SummaryRow& row : rows) {
    text += row.cells.empty() ? label_of(row) : fmt::format("{:<{}}", label_of(row), label_width);
    for (std::size_t i = 0; i < row.cells.size(); ++i)
      text += fmt::format("  {:>{}}", row.cells[i], widths[i]);
    text += "\n";
  }
  text += fmt::format("\nengine {} s\nfingerprint {}\n", short_decimal(report.engine_seconds),
                      hex_digits(report.fingerprint));
  return text;
}

}  // namespace kds
