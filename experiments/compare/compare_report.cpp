#include "experiments/compare/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/output/text.h"
#include "motions/base/csv_field.h"

namespace kds {

namespace {

std::string decimal_or_dash(const std::optional<double>& value) {
  return value ? short_decimal(*value) : "-";
}

// Of all structures, in the order in which rows have them.
std::vector<std::string> kinds_of(const Comparison& comparison) {
  std::vector<std::string> kinds;
  for (const CompareRow& row : comparison.rows)
    for (const auto& [kind, count] : row.structure.events_by_kind)
      if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) kinds.push_back(kind);
  return kinds;
}

std::string kinds_text(const CompareRow& row) {
  std::string text;
  for (const auto& [kind, count] : row.structure.events_by_kind)
    if (count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", row.structure.label_of(kind),
                          with_thousands(count));
  return text.empty() ? "-" : text;
}

std::string csv_line(const CompareRow& row, const std::vector<std::string>& kinds) {
  std::string line = fmt::format("{},{},{},{},{},{}", row.structure.name, csv_field(row.input), row.stride,
                                 name_of(row.motion), row.steps, row.events());
  const NamedCounts& counts = row.structure.events_by_kind;
  for (const std::string& kind : kinds) {
    const auto count =
        std::find_if(counts.begin(), counts.end(), [&](const auto& c) { return c.first == kind; });
    line += count == counts.end() ? "," : fmt::format(",{}", count->second);
  }
  return line + fmt::format(",{},{},{},{},{},{},{},{},{},{},{}\n", row.internal(),
                            value_or_empty(row.net_changes), value_or_empty(row.efficiency()),
                            row.events_per_step(), value_or_empty(row.events_per_picosecond()),
                            row.structure.peak, row.structure.per_bead_max,
                            value_or_empty(row.seconds_per_event()), row.seconds.median, row.seconds.least,
                            row.seconds.most);
}

}  // namespace

Json compared_inputs_json(const Comparison& comparison) {
  Json json = Json::array();
  for (const ComparedInput& input : comparison.inputs)
    json.push_back({{"file", input.file},
                    {"beads", input.beads},
                    {"frames", input.frames},
                    {"dimension", input.dimension},
                    {"radius_min", input.radius_min},
                    {"radius_max", input.radius_max}});
  return json;
}

Json compare_rows_json(const Comparison& comparison) {
  Json json = Json::array();
  for (const CompareRow& row : comparison.rows) {
    Json of_row{{"structure", row.structure.name}, {"input", row.input}, {"stride", row.stride},
                {"motion", name_of(row.motion)},   {"steps", row.steps}, {"events", row.events()}};
    for (const auto& [kind, count] : row.structure.events_by_kind) of_row[kind] = count;
    of_row["internal"] = row.internal();
    of_row["net_changes"] = row.net_changes;
    of_row["efficiency"] = row.efficiency();
    of_row["events_per_step"] = row.events_per_step();
    of_row["events_per_ps"] = row.events_per_picosecond();
    of_row["compactness"] = row.structure.peak;
    of_row["locality"] = row.structure.per_bead_max;
    of_row["responsiveness"] = row.seconds_per_event();
    of_row["seconds"] = row.seconds.median;
    of_row["seconds_least"] = row.seconds.least;
    of_row["seconds_most"] = row.seconds.most;
    of_row["by_level"] =
        row.structure.places.by_level.empty() ? Json(nullptr) : Json(row.structure.places.by_level);
    of_row["by_bead"] = row.structure.places.by_bead;
    json.push_back(of_row);
  }
  return json;
}

std::string compare_csv(const Comparison& comparison) {
  const std::vector<std::string> kinds = kinds_of(comparison);
  std::string text = "structure,input,stride,motion,steps,events";
  for (const std::string& kind : kinds) text += "," + csv_field(kind);
  text +=
      ",internal,net_changes,efficiency,events_per_step,events_per_ps,compactness,locality,responsiveness,"
      "seconds,seconds_least,seconds_most\n";
  for (const CompareRow& row : comparison.rows) text += csv_line(row, kinds);
  return text;
}

std::vector<std::string> compare_cells(const CompareRow& row) {
  const auto seconds = row.seconds_per_event();
  return {row.structure.name,
          with_thousands(row.stride),
          with_thousands(row.steps),
          with_thousands(row.events()),
          short_decimal(row.events_per_step()),
          decimal_or_dash(row.events_per_picosecond()),
          row.net_changes ? with_thousands(*row.net_changes) : "-",
          with_thousands(row.internal()),
          decimal_or_dash(row.efficiency()),
          with_thousands(row.structure.peak),
          with_thousands(row.structure.per_bead_max),
          seconds ? short_decimal(1e6 * *seconds) : "-",
          spread_text(row.seconds),
          kinds_text(row)};
}

std::string distinction(const Comparison& comparison, const CompareRow& row) {
  std::string text;
  if (std::ranges::any_of(comparison.rows,
                          [&](const CompareRow& other) { return other.motion != row.motion; }))
    text = name_of(row.motion);
  if (comparison.inputs.size() > 1)
    text += (text.empty() ? "" : ", ") + std::filesystem::path(row.input).filename().string();
  return text;
}

std::string compare_table(const Comparison& comparison) {
  std::vector<std::vector<std::string>> lines{{"structure", "stride", "steps", "events", "a step", "a ps",
                                               "net changes", "internal", "a net change", "peak", "on bead",
                                               "us an event", "seconds", "by kind"}};
  for (const CompareRow& row : comparison.rows) lines.push_back(compare_cells(row));
  const std::string numbers(lines.front().size() - 2, '>');
  const std::vector<std::string> aligned = in_columns(lines, "<" + numbers + "<");
  std::string text, input, motion;
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    const CompareRow& row = comparison.rows[r];
    if (row.input != input || name_of(row.motion) != motion) {
      input = row.input;
      motion = name_of(row.motion);
      text += fmt::format("{}{}, {} motion\n  {}\n", text.empty() ? "" : "\n", one_line(input), motion,
                          aligned.front());
    }
    text += "  " + aligned[r + 1] + "\n";
  }
  return text;
}

}  // namespace kds
