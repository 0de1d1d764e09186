#include "experiments/run/table.h"

#include <fmt/format.h>

#include <vector>

#include "experiments/output/text.h"
#include "experiments/run/summary_rows.h"

namespace kds {

std::string comparison_table(const RunReport& report) {
  std::string text;
  for (const auto& [label, value] : input_lines(report))
    text += one_line(fmt::format("{:<10}{}", label, value)) + "\n";
  text += "\n";

  std::vector<std::vector<std::string>> lines(1, {""});
  for (const StructureReport& structure : report.structures) lines[0].push_back(structure.name);
  for (const SummaryRow& row : summary_rows(report)) {
    std::vector<std::string>& line = lines.emplace_back(1, (row.detail ? "  " : "") + row.label);
    line.insert(line.end(), row.cells.begin(), row.cells.end());
    line.resize(lines[0].size());
  }
  for (const std::string& line : in_columns(lines, "<>")) text += line + "\n";
  text += fmt::format("\nengine {} s\nfingerprint {}\n", short_decimal(report.engine_seconds),
                      hex_digits(report.fingerprint));
  return text;
}

}  // namespace kds
