#include "experiments/compare/compare_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <iterator>

#include "experiments/output/text.h"
#include "experiments/program/spread_columns.h"
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
                    {"name", input.name},
                    {"beads", input.beads},
                    {"frames", input.frames},
                    {"dimension", input.dimension},
                    {"truncated", input.truncated},
                    {"radius_min", input.radius_min},
                    {"radius_max", input.radius_max},
                    {"frame_picoseconds", input.frame_picoseconds ? Json(*input.frame_picoseconds) : Json()},
                    {"velocities", input.velocities ? Json(name_of(*input.velocities)) : Json()}});
  return json;
}

namespace {

using Compared = CompareRow;

Field end_of_interval(const std::optional<MeanInterval>& interval, double MeanInterval::*end) {
  return interval ? Field((*interval).*end) : Field();
}

// Returns the columns KEY, KEY_lower and KEY_upper of a mean that may lack an interval.
template <class Of>
std::vector<Column<Of>> interval_columns(
    const std::string& key, const std::string& heading,
    const std::function<std::optional<double>(const Of&)>& mean,
    const std::function<std::optional<MeanInterval>(const Of&)>& interval) {
  return {{.key = key,
           .heading = heading,
           .value = [mean](const Of& r) { return Field(mean(r)); },
           .words =
               [mean, interval](const Of& r) {
                 const auto known = interval(r);
                 return known ? fmt::format("{} ({} to {})", short_decimal(known->mean),
                                            short_decimal(known->lower), short_decimal(known->upper))
                              : short_decimal(*mean(r));
               }},
          {.key = key + "_lower",
           .value = [interval](const Of& r) { return end_of_interval(interval(r), &MeanInterval::lower); }},
          {.key = key + "_upper",
           .value = [interval](const Of& r) { return end_of_interval(interval(r), &MeanInterval::upper); }}};
}

Table<Compared> identity_columns() {
  return {{
      {"structure", "structure", [](const Compared& r) { return Field(r.structure.name); }},
      {.key = "input", .value = [](const Compared& r) { return Field(r.input); }},
      {"stride", "stride", [](const Compared& r) { return Field(r.stride); }},
      {.key = "motion", .value = [](const Compared& r) { return Field(r.motion_name()); }},
      {.key = "beads", .value = [](const Compared& r) { return Field(r.beads); }},
      {"steps", "steps", [](const Compared& r) { return Field(r.steps); }},
  }};
}

std::vector<Column<Compared>> event_columns(const Comparison& comparison) {
  const bool has_times = std::ranges::any_of(
      comparison.rows, [](const Compared& row) { return row.events_per_picosecond().has_value(); });
  std::vector<Column<Compared>> columns{
      {"events", "events", [](const Compared& r) { return Field(r.events()); }}};
  const auto add = [&](std::vector<Column<Compared>> more) {
    for (auto& column : more) columns.push_back(std::move(column));
  };
  for (const std::string& kind : kinds_of(comparison))
    add({{.key = kind, .value = [kind](const Compared& r) { return count_of(r, kind); }, .optional = true}});
  add({
      {.key = "internal", .value = [](const Compared& r) { return Field(r.internal()); }},
      {.key = "efficiency", .value = [](const Compared& r) { return Field(r.efficiency()); }},
      {"net_changes", "net changes", [](const Compared& r) { return Field(r.net_changes); }},
  });
  add(interval_columns<Compared>(
      "events_per_net_change", "events per net change (95%)",
      [](const Compared& r) { return r.events_per_net_change(); },
      [](const Compared& r) { return r.events_per_net_change_interval(); }));
  add(interval_columns<Compared>(
      "events_per_step", "events per step (95%)", [](const Compared& r) { return r.events_per_step(); },
      [](const Compared& r) { return r.events_per_step_interval(); }));
  add({
      {.key = "events_per_step_first",
       .value = [](const Compared& r) { return Field(r.events_per_step_in_first_quarter()); }},
      {.key = "events_per_step_last",
       .value = [](const Compared& r) { return Field(r.events_per_step_in_last_quarter()); }},
      {"events_per_ps", has_times ? "events per ps" : "",
       [](const Compared& r) { return Field(r.events_per_picosecond()); }, shortly},
      {.key = "events_per_bead_step",
       .value = [](const Compared& r) { return Field(r.events_per_bead_and_step()); }},
      {.key = "events_per_bead_ps",
       .value = [](const Compared& r) { return Field(r.events_per_bead_and_picosecond()); }},
  });
  return columns;
}

std::vector<Column<Compared>> cost_columns() {
  return {
      {"compactness", "compactness", [](const Compared& r) { return Field(r.structure.peak); }},
      {.key = "locality", .value = [](const Compared& r) { return Field(r.costs.per_bead_most); }},
      {.key = "created_per_event", .value = [](const Compared& r) { return Field(r.created_per_event()); }},
      {.key = "touched_per_event", .value = [](const Compared& r) { return Field(r.touched_per_event()); }},
      {.key = "touched_most", .value = [](const Compared& r) { return Field(r.costs.touched_most); }},
      {.key = "responsiveness", .value = [](const Compared& r) { return Field(r.responsiveness()); }},
      {.key = "responsiveness_worst",
       .value =
           [](const Compared& r) { return r.costs.events == 0 ? Field() : Field(r.costs.seconds_most); }},
  };
}

}  // namespace

Table<CompareRow> compare_columns(const Comparison& comparison) {
  Table<Compared> table = identity_columns();
  table.add(event_columns(comparison)).add(cost_columns());
  table.add(spread_columns<Compared>("seconds", "seconds", [](const Compared& r) { return r.seconds; }));
  table.add(
      {{.key = "by_level",
        .json =
            [](const Compared& r) {
              const auto& levels = r.structure.distribution.by_level;
              return levels.empty() ? Json() : Json(levels);
            }},
       {.key = "by_bead", .json = [](const Compared& r) { return Json(r.structure.distribution.by_bead); }},
       {.key = "over_time", .json = [](const Compared& r) { return over_time_json(r.structure.course); }}});
  return table;
}

Table<PooledRow> pooled_columns() {
  using Pooled = PooledRow;
  Table<Pooled> table{{
      {"structure", "structure", [](const Pooled& r) { return Field(r.structure); }},
      {"stride", "stride", [](const Pooled& r) { return Field(r.stride); }},
      {"motion", "motion", [](const Pooled& r) { return Field(r.motion); }},
      {"inputs", "inputs", [](const Pooled& r) { return Field(r.inputs); }},
  }};
  const auto add = [&](const std::string& key, const std::string& heading,
                       std::optional<PooledMean> Pooled::*pooled) {
    table.add(interval_columns<Pooled>(
        key, heading,
        [pooled](const Pooled& r) { return r.*pooled ? std::optional((r.*pooled)->mean) : std::nullopt; },
        [pooled](const Pooled& r) { return r.*pooled ? (r.*pooled)->interval : std::nullopt; }));
  };
  add("events_per_step", "events per step (95%)", &Pooled::events_per_step);
  add("events_per_bead_step", "per bead and step", &Pooled::events_per_bead_and_step);
  add("events_per_bead_ps", "per bead and ps", &Pooled::events_per_bead_and_picosecond);
  add("events_per_net_change", "per net change", &Pooled::events_per_net_change);
  return table;
}

const ComparedInput& input_of(const Comparison& comparison, const CompareRow& row) {
  return *std::ranges::find(comparison.inputs, row.input, &ComparedInput::name);
}

std::string compare_table(const Comparison& comparison) {
  const std::vector<std::string> lines = compare_columns(comparison).lines(comparison.rows);
  std::string text, input, motion;
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    const CompareRow& row = comparison.rows[r];
    if (row.input != input || row.motion_name() != motion) {
      input = row.input;
      motion = row.motion_name();
      const ComparedInput& compared = input_of(comparison, row);
      const std::string_view velocities =
          row.motion == FrameMotion::hermite ? velocities_text(compared.velocities) : "";
      text += fmt::format("{}{}, {} motion{} ({})\n  {}\n", text.empty() ? "" : "\n", one_line(input), motion,
                          velocities, size_text(compared), lines.front());
    }
    text += "  " + lines[r + 1] + "\n";
  }
  if (const std::vector<PooledRow> pooled = pooled_rows(comparison); !pooled.empty())
    text += fmt::format("\nmeans over the {} inputs\n{}", comparison.inputs.size(),
                        pooled_columns().text(pooled, "  "));
  return text;
}

}  // namespace kds
