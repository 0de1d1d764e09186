#include "experiments/sweep/result_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "experiments/output/text.h"

namespace kds {

namespace {

// Members that say how a result was made, or that the row's task says.
constexpr std::array<std::string_view, 8> kLeftOut{"command",     "version",  "machine", "settings",
                                                   "length_unit", "warnings", "file",    "files"};
constexpr std::array<std::string_view, 7> kKeys{"stride", "factor", "n", "frame", "i", "j", "seed"};

bool is_left_out(std::string_view name) { return std::ranges::find(kLeftOut, name) != kLeftOut.end(); }

void flatten(const Json& json, const std::string& prefix, RowFields& fields) {
  for (const auto& [name, value] : *json.members()) {
    if (is_left_out(name) || value.items() != nullptr || value.is_null()) continue;
    if (name == "input" && value.members() == nullptr) continue;  // the task names its input
    if (value.members() != nullptr)
      flatten(value, prefix + name + ".", fields);
    else
      fields.emplace_back(prefix + name, value);
  }
}

// The row's own fields come first, then those of the whole result.
ResultRow row_of(const RowFields& of_result, const Json& json, const std::string& name = {}) {
  RowFields all;
  if (!name.empty()) all.emplace_back("structure", name);
  flatten(json, "", all);
  all.insert(all.end(), of_result.begin(), of_result.end());
  // Long tables name their measure in a row.
  bool of_times = false;
  for (const auto& [key, value] : all)
    of_times = of_times || (key == "measure" && value.text() != nullptr && is_time(*value.text()));
  ResultRow row;
  for (auto& [key, value] : all) {
    const bool time = is_time(key) || (of_times && value.number() && !is_identity(key, value));
    (time ? row.times : row.fields).emplace_back(std::move(key), std::move(value));
  }
  return row;
}

}  // namespace

bool is_time(std::string_view name) {
  const std::string_view last = name.substr(name.rfind('.') + 1);  // npos + 1 is 0
  if (last == "ratio" || last.starts_with("ratio_")) return true;
  if (name == "recommendation" || name == "pareto") return true;  // follow from times
  for (const std::string& level : split(name, '.'))
    for (const std::string& word : split(level, '_'))
      if (word == "seconds" || word == "responsiveness" || word == "memory" || word == "speedup") return true;
  return false;
}

std::vector<ResultRow> rows_of_result(const Json& result) {
  const Json *const structures = result.find("structures"), *const all = result.find("all"),
                    *const items = result.find("rows");
  Json rest = Json::object();
  for (const auto& [name, value] : *result.members())
    if (&value != structures && &value != all) rest[name] = value;
  RowFields of_result;
  flatten(rest, "", of_result);
  std::vector<ResultRow> rows;
  if (structures != nullptr && structures->members() != nullptr) {
    for (const auto& [name, value] : *structures->members()) rows.push_back(row_of(of_result, value, name));
  } else if (all != nullptr && all->members() != nullptr) {
    rows.push_back(row_of(of_result, *all));
  } else if (items != nullptr && items->items() != nullptr) {
    for (const Json& item : *items->items())
      if (item.members() != nullptr) rows.push_back(row_of(of_result, item));
  } else {
    rows.push_back(row_of(of_result, Json::object()));
  }
  return rows;
}

bool is_identity(const std::string& name, const Json& value) {
  if (name == "fingerprint") return false;
  return value.text() != nullptr || std::ranges::find(kKeys, name) != kKeys.end();
}

std::string identity_of(const ResultRow& row, const std::vector<std::string>& others) {
  std::string identity;
  for (const auto& [name, value] : row.fields)
    if (is_identity(name, value) && std::ranges::find(others, name) == others.end())
      identity += fmt::format("{}{} {}", identity.empty() ? "" : ", ", name,
                              value.text() != nullptr ? *value.text() : line_of(value).value_or(""));
  return identity;
}

}  // namespace kds
