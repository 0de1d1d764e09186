#include "experiments/stability/stability_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/output/result_json.h"

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
  json["fast"] = {{"wrong_signs", row.wrong_signs}, {"missed", row.fast.missed},
                  {"extra", row.fast.extra},        {"worst_time_error", row.fast.worst_time_error},
                  {"gave_up", row.fast_gave_up},    {"reason", text_or_null(row.fast_reason)}};
  json["stages"] = Json::object();
  for (const Stage& stage : stage_table) json["stages"][stage.name] = row.stages.*stage.count;
  json["seconds"] = {
      {"fast", row.seconds.fast}, {"filtered", row.seconds.filtered}, {"exact", row.seconds.exact}};
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

Json stability_settings(const StabilityOptions& options) {
  return {{"subjects", all_or(options.subjects)},
          {"extremes", all_or(options.extremes)},
          {"cases", options.cases.cases},
          {"seed", options.cases.seed}};
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

}  // namespace kds
