#include "experiments/trade/trade_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "experiments/output/table.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

/// Splits rows into groups. Each group begins with an exact run.
std::vector<std::span<const TradeRow>> groups_of(std::span<const TradeRow> rows) {
  std::vector<std::span<const TradeRow>> groups;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first + 1;
    while (end < rows.size() && !rows[end].is_exact) ++end;
    groups.push_back(rows.subspan(first, end - first));
    first = end;
  }
  return groups;
}

std::string title_of(std::span<const TradeRow> group) {
  const TradeRow& exact = group.front();
  return exact.want == Want::events ? "events of " + exact.setting.structure
                                    : std::string(name_of(exact.want));
}

struct ErrorColumn {
  const char* title;
  std::optional<double> TradeErrors::*value;
  bool share;
};
std::vector<ErrorColumn> columns_for(Want want) {
  using E = TradeErrors;
  const ErrorColumn missed{"missed", &E::events_missed, true},
      invented{"invented", &E::events_invented, true};
  switch (want) {
    case Want::cages:
      return {{"radius", &E::radius_mean, true},
              {"at most", &E::radius_max, true},
              {"at frames", &E::radius_frames_max, true},
              {"outside", &E::beads_outside, false},
              missed,
              invented,
              {"moved", &E::displacement, false}};
    case Want::diagram:
      return {{"wrong", &E::cells_wrong, true},
              {"edges", &E::edges_missed, true},
              missed,
              invented,
              {"moved", &E::displacement, false}};
    case Want::contacts:
      return {{"missed", &E::contacts_missed, true},    {"spurious", &E::contacts_spurious, true},
              {"unsure", &E::contacts_unsure, true},    {"time", &E::contact_time_mean, false},
              {"closest", &E::closest_distance, false}, {"moved", &E::displacement, false}};
    case Want::events:
      return {missed,
              invented,
              {"time", &E::event_time_mean, false},
              {"at most", &E::event_time_max, false},
              {"moved", &E::displacement, false}};
    case Want::scenes:
      return {};
  }
  return {};
}

std::string error_text(const Field& error) {
  const double value = error.number();
  return value == 0 ? "0" : std::isinf(value) ? "all" : fmt::format("{:.3g}", value);
}
std::string share_text(const Field& share) {
  const double value = share.number();
  return value == 0 || std::isinf(value) ? error_text(share) : in_percent(share);
}

Json setting_json(const TradeRow& row) {
  Json setting = Json::object();
  for (const auto& [name, value] : options_of(row.setting)) setting[name] = value;
  if (row.setting.projected) setting["projected"] = "xy";
  return setting;
}

/// JSON and CSV have all errors. Tables for people have only the errors of `want`, and `title` heads their
/// first column.
Table<TradeRow> trade_columns(const std::string& title, Want want) {
  using Row = TradeRow;
  Table<Row> table{{
      {.key = "want", .value = [](const Row& r) { return Field(name_of(r.want)); }},
      {.key = "setting",
       .heading = title,
       .value = [](const Row& r) { return Field(words_of(r.setting)); },
       .words = [](const Row& r) { return (r.on_front ? "* " : "  ") + words_of(r.setting); },
       .json = setting_json},
      {"cost.seconds", "seconds", [](const Row& r) { return Field(r.cost.seconds); }, shortly},
      {.key = "cost.seconds_least", .value = [](const Row& r) { return Field(r.cost.quickest); }},
      {.key = "cost.seconds_most", .value = [](const Row& r) { return Field(r.cost.slowest); }},
      {"cost.ratio", "ratio", [](const Row& r) { return Field(r.cost.ratio); }, with_decimals(3)},
      {"cost.events", "events", [](const Row& r) { return Field(r.cost.events); }},
      {"cost.certificates", "certificates", [](const Row& r) { return Field(r.cost.certificates); }},
      {"cost.tests", "tests", [](const Row& r) { return Field(r.cost.tests); }, error_text},
      {"cost.memory", "MB", [](const Row& r) { return Field(r.cost.memory); },
       [](const Field& bytes) { return fmt::format("{:.2f}", 1e-6 * bytes.number()); }},
  }};
  const auto names = by_name({});
  for (std::size_t e = 0; e < names.size(); ++e)
    table.add({{.key = "error." + names[e].first,
                .value = [e](const Row& r) { return Field(by_name(r.errors)[e].second); }}});
  for (const ErrorColumn& column : columns_for(want))
    table.add({{.heading = column.title,
                .value = [value = column.value](const Row& r) { return Field(r.errors.*value); },
                .format = column.share ? share_text : error_text}});
  return table.add({{.key = "pareto", .value = [](const Row& r) { return Field(r.on_front); }}});
}
Table<TradeRow> trade_columns(std::span<const TradeRow> group) {
  return trade_columns(title_of(group), group.front().want);
}

}  // namespace

Json trade_rows_json(std::span<const TradeRow> rows) { return trade_columns("", Want::scenes).json(rows); }

std::string trade_csv(std::span<const TradeRow> rows) { return trade_columns("", Want::scenes).csv(rows); }

std::string trade_table(std::span<const TradeRow> rows) {
  std::string text;
  for (const auto& group : groups_of(rows)) text += trade_columns(group).text(group) + "\n";
  return text + recommendation(rows) + "\n";
}

namespace {

// The limit of a small error: one percent, and no bead outside.
constexpr double small_error = 0.01;

/// Returns two significant figures, or a whole number without an exponent for larger values.
std::string few_figures(double value) {
  if (!(value >= 99 && value < 1e15)) return fmt::format("{:.2g}", value);
  return with_thousands(static_cast<std::uint64_t>(std::llround(value)));
}

std::string percent(double share) { return few_figures(100 * share) + "%"; }

// Returns the errors in words: "radii 0.02% larger on average, 0.5% at most".
std::string losses_of(const TradeRow& row) {
  const TradeErrors& e = row.errors;
  std::vector<std::string> losses;
  const auto add = [&losses](std::string words) { losses.push_back(std::move(words)); };
  if (row.want == Want::cages) {
    add(fmt::format("radii are {} from the smallest on average, {} at most",
                    percent(e.radius_mean.value_or(0)), percent(e.radius_max.value_or(0))));
    add(e.beads_outside.value_or(0) > 0 ? fmt::format("{:.3g} beads stick out on average", *e.beads_outside)
                                        : "no bead is outside");
    if (!row.setting.has_events()) add("it does not give the times of basis changes");
  }
  if (row.want == Want::diagram)
    add(fmt::format("{} of its cells are wrong, and it misses {} of the short edges",
                    percent(e.cells_wrong.value_or(0)), percent(e.edges_missed.value_or(0))));
  if (row.want == Want::contacts) {
    add(fmt::format("{} of the contacts are missed, {} are spurious", percent(e.contacts_missed.value_or(0)),
                    percent(e.contacts_spurious.value_or(0))));
    if (e.contacts_unsure) add(fmt::format("{} of them are only possible", percent(*e.contacts_unsure)));
    if (row.setting.calpha) add("it is another model, of residues");
  }
  if (row.want == Want::events || ((row.want == Want::diagram || row.want == Want::cages) && e.events_missed))
    add(fmt::format("{} of the events are missed, {} are invented", percent(e.events_missed.value_or(0)),
                    percent(e.events_invented.value_or(0))));
  return fmt::format("{}", fmt::join(losses, "; "));
}

std::string subject_of(const TradeRow& row) {
  switch (row.want) {
    case Want::contacts:
      return "For contacts";
    case Want::cages:
      return "For cages";
    case Want::diagram:
      return "For the diagram";
    case Want::events:
      return "For events of " + row.setting.structure;
    case Want::scenes:
      return "Among these parts of the scene";
  }
  return {};
}

bool is_small(const TradeRow& row) {
  if (row.errors.beads_outside.value_or(0) > 0) return false;
  const std::vector<double> errors = main_errors(row);
  return !errors.empty() &&
         std::all_of(errors.begin(), errors.end(), [](double error) { return error <= small_error; });
}

std::string times_as_fast(double ratio) {
  return ratio < 1 ? few_figures(1 / ratio) + " times as fast as the exact run"
                   : few_figures(ratio) + " times as slow as the exact run";
}

// A sentence for a group, and the setting to take; null if there is nothing to choose.
struct Recommended {
  std::string sentence;
  const TradeRow* taken;
};

Recommended recommended_for_scenes(std::span<const TradeRow> group) {
  const auto [least, most] = std::minmax_element(
      group.begin(), group.end(),
      [](const TradeRow& a, const TradeRow& b) { return a.cost.seconds < b.cost.seconds; });
  return {fmt::format("{}, `{}` costs least, and `{}` {} times as much.", subject_of(group.front()),
                      words_of(least->setting), words_of(most->setting),
                      few_figures(most->cost.seconds / least->cost.seconds)),
          &*least};
}

Recommended recommended_for(std::span<const TradeRow> group) {
  const TradeRow& exact = group.front();
  if (exact.want == Want::scenes) return recommended_for_scenes(group);
  constexpr double hardly_quicker = 0.95;
  const TradeRow* best = nullptr;
  for (const TradeRow& row : group.subspan(1)) {
    if (is_small(row) && row.cost.ratio < hardly_quicker &&
        (best == nullptr || row.cost.ratio < best->cost.ratio))
      best = &row;
  }
  const std::string subject = subject_of(exact);
  if ((exact.want == Want::contacts || exact.want == Want::events) && exact.cost.events == 0)
    return {fmt::format("{}, there is nothing to compare: the exact run has no event{}.", subject,
                        exact.setting.structure == "contacts"
                            ? "; --radius makes balls larger, and a lower --apart allows more pairs"
                            : ""),
            nullptr};
  if (best != nullptr)
    return {fmt::format("{}, `{}` is {}: {}.", subject, words_of(best->setting),
                        times_as_fast(best->cost.ratio), losses_of(*best)),
            best};
  // No setting with small errors is quicker, so choose the quicker setting with the least errors.
  for (const TradeRow& row : group.subspan(1)) {
    const auto worst = [](const TradeRow& r) {
      const std::vector<double> errors = main_errors(r);
      return *std::max_element(errors.begin(), errors.end());
    };
    if (main_errors(row).empty()) continue;
    if (row.cost.ratio < hardly_quicker && (best == nullptr || worst(row) < worst(*best))) best = &row;
  }
  if (best == nullptr)
    return {fmt::format("{}, nothing is quicker than the exact run `{}`.", subject, words_of(exact.setting)),
            &exact};
  return {fmt::format("{}, stay with the exact run: no quicker setting errs by less than {}; `{}` does the "
                      "least harm, {}: {}.",
                      subject, percent(small_error), words_of(best->setting), times_as_fast(best->cost.ratio),
                      losses_of(*best)),
          &exact};
}

// In the order of the groups.
std::vector<Recommended> recommended(std::span<const TradeRow> rows) {
  std::vector<Recommended> all;
  for (std::size_t first = 0; first < rows.size();) {
    std::size_t end = first + 1;
    while (end < rows.size() && !rows[end].is_exact) ++end;
    all.push_back(recommended_for(rows.subspan(first, end - first)));
    first = end;
  }
  return all;
}

}  // namespace

std::string recommendation(std::span<const TradeRow> rows) {
  std::string text;
  for (const Recommended& one : recommended(rows)) text += (text.empty() ? "" : " ") + one.sentence;
  return text;
}

Json recommendations_json(std::span<const TradeRow> rows) {
  Json all = Json::array();
  for (const auto& [sentence, taken] : recommended(rows))
    all.push_back({{"sentence", sentence}, {"row", taken != nullptr ? Json(taken - rows.data()) : Json()}});
  return all;
}

}  // namespace kds
