#include "experiments/bench/bench_report.h"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "experiments/output/text.h"

namespace kds {

namespace {

Json number_or_null(const std::optional<double>& x) { return x ? Json(*x) : Json(nullptr); }
std::string number_or_empty(const std::optional<double>& x) { return x ? fmt::format("{}", *x) : ""; }
std::string figure(const std::optional<double>& x) { return x ? fmt::format("{:.4g}", *x) : "-"; }

}  // namespace

std::string bench_json(std::string command, Json settings, std::span<const BenchRow> rows) {
  Json json;
  json["settings"] = std::move(settings);
  json["rows"] = Json::array();
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    json["rows"].push_back({{"name", row.name},
                            {"input", row.input},
                            {"n", row.n},
                            {"value", row.value},
                            {"unit", row.unit},
                            {"peer", row.peer.empty() ? Json(nullptr) : Json(row.peer)},
                            {"peer_value", number_or_null(row.peer_value)},
                            {"ratio", number_or_null(row.ratio())},
                            {"goal", number_or_null(row.goal)},
                            {"holds", holds ? Json(*holds) : Json(nullptr)}});
  }
  add_provenance(json, std::move(command));
  return text_of(json);
}

std::string bench_csv(std::span<const BenchRow> rows) {
  std::string text = "name,input,n,value,unit,peer,peer_value,ratio,goal,holds\n";
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    text += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", row.name, row.input, row.n, row.value, row.unit,
                        row.peer, number_or_empty(row.peer_value), number_or_empty(row.ratio()),
                        number_or_empty(row.goal), holds ? (*holds ? "true" : "false") : "");
  }
  return text;
}

std::string bench_table(std::span<const BenchRow> rows) {
  std::vector<std::vector<std::string>> lines{
      {"name", "input", "n", "value", "unit", "peer", "ratio", "goal", "holds", "peer is"}};
  for (const BenchRow& row : rows) {
    const auto holds = row.holds();
    lines.push_back({row.name, row.input, fmt::format("{}", row.n), figure(row.value), row.unit,
                     figure(row.peer_value), figure(row.ratio()), figure(row.goal),
                     holds ? (*holds ? "yes" : "no") : "-", row.peer});
  }
  std::string text;
  for (const std::string& line : in_columns(lines, "<<>><>>><<")) text += line + "\n";
  return text;
}

}  // namespace kds
