#include "experiments/compare/compare_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "experiments/output/text.h"
#include "experiments/program/timing.h"

namespace kds {

namespace {

// Returns the kinds of all structures in the order of the rows.
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

Field count_of(const CompareRow& row, const std::string& kind) {
  const NamedCounts& counts = row.structure.events_by_kind;
  const auto count = std::ranges::find(counts, kind, &NamedCounts::value_type::first);
  return count == counts.end() ? Field() : Field(count->second);
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

Table<CompareRow> compare_columns(const Comparison& comparison) {
  using Row = CompareRow;
  Table<Row> table{{
      {.key = "structure",
       .heading = "structure",
       .value = [](const Row& r) { return Field(r.structure.name); },
       .shown = Shown::in_text},
      {.heading = "structure",
       .value =
           [](const Row& r) {
             return Field(fmt::format("{}, stride {}", r.structure.name, with_thousands(r.stride)));
           },
       .shown = Shown::on_pages},
      {.key = "input", .value = [](const Row& r) { return Field(r.input); }},
      {"stride", "stride", [](const Row& r) { return Field(r.stride); }, plainly, Shown::in_text},
      {.key = "motion", .value = [](const Row& r) { return Field(name_of(r.motion)); }},
      {"steps", "steps", [](const Row& r) { return Field(r.steps); }},
      {"events", "events", [](const Row& r) { return Field(r.events()); }},
  }};
  for (const std::string& kind : kinds_of(comparison))
    table.add({{.key = kind, .value = [kind](const Row& r) { return count_of(r, kind); }, .optional = true}});
  table.add({
      {"internal", "internal", [](const Row& r) { return Field(r.internal()); }},
      {"net_changes", "net changes", [](const Row& r) { return Field(r.net_changes); }},
      {"efficiency", "efficiency", [](const Row& r) { return Field(r.efficiency()); }, shortly},
      {"events_per_step", "a step", [](const Row& r) { return Field(r.events_per_step()); }, shortly},
      {"events_per_ps", "a ps", [](const Row& r) { return Field(r.events_per_picosecond()); }, shortly},
      {"compactness", "compactness", [](const Row& r) { return Field(r.structure.peak); }},
      {"locality", "locality", [](const Row& r) { return Field(r.structure.per_bead_max); }},
      {"responsiveness", "us an event", [](const Row& r) { return Field(r.seconds_per_event()); },
       [](const Field& seconds) { return short_decimal(1e6 * seconds.number()); }},
  });
  table.add(spread_columns<Row>("seconds", "seconds", [](const Row& r) { return r.seconds; }));
  table.add({{.key = "by_level",
              .json =
                  [](const Row& r) {
                    const auto& levels = r.structure.places.by_level;
                    return levels.empty() ? Json() : Json(levels);
                  }},
             {.key = "by_bead", .json = [](const Row& r) { return Json(r.structure.places.by_bead); }},
             {.heading = "by kind", .value = [](const Row& r) { return Field(kinds_text(r)); }}});
  return table;
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
  const std::vector<std::string> lines = compare_columns(comparison).lines(comparison.rows);
  std::string text, input, motion;
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    const CompareRow& row = comparison.rows[r];
    if (row.input != input || name_of(row.motion) != motion) {
      input = row.input;
      motion = name_of(row.motion);
      text += fmt::format("{}{}, {} motion\n  {}\n", text.empty() ? "" : "\n", one_line(input), motion,
                          lines.front());
    }
    text += "  " + lines[r + 1] + "\n";
  }
  return text;
}

}  // namespace kds
