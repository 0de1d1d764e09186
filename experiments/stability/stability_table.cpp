#include "experiments/stability/stability_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/stability/stability_report.h"

namespace kds {
namespace {

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
std::string error(double value) { return value == 0 ? "0" : fmt::format("{:.0e}", value); }

constexpr TextColumn kCases{"cases", 6, [](const StabilityRow& row) { return count(row.cases); }};
constexpr TextColumn kEvents{"events", 7, [](const StabilityRow& row) { return count(row.events); }};
constexpr TextColumn kDiffer{"differ", 7,
                             [](const StabilityRow& row) { return count(row.disagreements + row.failed); }};
constexpr TextColumn kSigns{"signs", 6, [](const StabilityRow& row) { return count(row.wrong_signs); }};
constexpr TextColumn kMissed{"missed", 7, [](const StabilityRow& row) { return count(row.fast.missed); }};
constexpr TextColumn kExtra{"extra", 6, [](const StabilityRow& row) { return count(row.fast.extra); }};
constexpr TextColumn kError{"error", 6,
                            [](const StabilityRow& row) { return error(row.fast.worst_time_error); }};
constexpr TextColumn kDouble{"double", 7, [](const StabilityRow& row) {
                               return count(row.stages.coefficients + row.stages.isolation);
                             }};
constexpr TextColumn kTracked{"tracked", 8,
                              [](const StabilityRow& row) { return count(row.stages.refined); }};
constexpr TextColumn kIntegers{"integer", 8, [](const StabilityRow& row) {
                                 return count(row.stages.exact + row.stages.identically_zero);
                               }};
constexpr TextColumn kBits{"bits", 5, [](const StabilityRow& row) { return count(row.stages.largest_bits); }};
constexpr TextColumn kFastTime{"fast", 6,
                               [](const StabilityRow& row) { return microseconds(row.seconds.fast); }};
constexpr TextColumn kFilteredTime{
    "filtered", 9, [](const StabilityRow& row) { return microseconds(row.seconds.filtered); }};
constexpr TextColumn kExactTime{"exact", 8,
                                [](const StabilityRow& row) { return microseconds(row.seconds.exact); }};
constexpr TextColumn kAudits{"audits", 7, [](const StabilityRow& row) { return count(row.audits_run); }};

struct Group {
  std::string_view heading;
  std::vector<TextColumn> columns;
};

const std::vector<Group>& groups(bool structure) {
  static const std::vector<Group> certificate{{"", {kCases, kEvents, kDiffer}},
                                              {"wrong in fast", {kSigns, kMissed, kExtra, kError}},
                                              {"settled by", {kDouble, kTracked, kIntegers, kBits}},
                                              {"us a search", {kFastTime, kFilteredTime, kExactTime}}};
  static const std::vector<Group> kinetic{{"", {kCases, kEvents, kDiffer, kAudits}},
                                          {"wrong in fast", {kMissed, kExtra, kError}},
                                          {"settled by", {kDouble, kTracked, kIntegers, kBits}},
                                          {"us a run", {kFastTime, kFilteredTime, kExactTime}}};
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
  if (row.fast_gave_up > 0)
    text += fmt::format("\n{:{}} fast gave up in {}", "", kNameWidth, row.fast_gave_up);
  if (!row.holds()) text += fmt::format("\n  DOES NOT HOLD: {}", one_line(row.reason));
  return text + "\n";
}

bool same_block(const StabilityRow& a, const StabilityRow& b) {
  return a.subject == b.subject && a.dimension == b.dimension && a.degree == b.degree;
}

}  // namespace

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

}  // namespace kds
