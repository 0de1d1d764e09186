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
                    {"truncated", input.truncated},
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
      {"events_per_step", "events per step", [](const Row& r) { return Field(r.events_per_step()); },
       shortly},
      {"events_per_ps", "events per ps", [](const Row& r) { return Field(r.events_per_picosecond()); },
       shortly},
      {"compactness", "compactness", [](const Row& r) { return Field(r.structure.peak); }},
      {"locality", "locality", [](const Row& r) { return Field(r.structure.per_bead_max); }},
      {"responsiveness", "us per event", [](const Row& r) { return Field(r.seconds_per_event()); },
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

namespace {

constexpr std::string_view kWords =
    "A row is one structure in the run of one input, at one stride, on one motion. The plots by kind, by "
    "level and along the chain show the smallest stride.";

std::vector<std::pair<std::string, std::string>> terms() {
  return {
      {"event", "a change of the structure itself, at an exact time between two frames (an external event)"},
      {"internal", "events of the structure's bookkeeping, which are not counted among the events"},
      {"events per step, per ps",
       "events from one frame to the next, and for a picosecond if the file has times"},
      {"net change",
       "a difference between one frame and the next, whatever happened in between: a node of the wrapped "
       "hierarchy with another basis, a cell in the power diagram of one frame only, a pair that meets in "
       "one frame only, a rank of the sorted list with another bead"},
      {"efficiency",
       "events divided by net changes. If every change happens once, the efficiency is 1 for nodes and "
       "pairs, 0.5 for interchanges, and for flips 0.2 in space and 0.25 in the plane, because a flip "
       "exchanges five or four cells. A larger efficiency means that changes were undone before the next "
       "frame"},
      {"compactness", "the most certificates at once"},
      {"locality", "the most certificates on one bead, at the start of a step"},
      {"us per event (responsiveness)",
       "microseconds divided by events; the time includes internal events and certificates that never fail"},
      {"seconds",
       "time spent on this structure: the median of the rounds, with the least and the most in brackets"},
      {"share of a bead",
       "the share of the events that name the bead; for the wrapped hierarchy, of the events whose new basis "
       "has it. An event names several beads, so the shares add up to more than 100%"}};
}

using Figure = std::function<std::optional<double>(const CompareRow&)>;

// Returns the range of a figure of one structure at one stride over all inputs and motions, as in "8.333" or
// "9.202 to 12.49". Returns an empty text if the figure is unknown.
std::string figure_text(const Comparison& comparison, const std::string& structure, std::size_t stride,
                        const Figure& figure) {
  std::vector<double> values;
  for (const CompareRow& row : comparison.rows)
    if (row.structure.name == structure && row.stride == stride)
      if (const std::optional<double> value = figure(row)) values.push_back(*value);
  if (values.empty()) return "";
  const auto [least, most] = std::ranges::minmax(values);
  const std::string from = short_decimal(least), to = short_decimal(most);
  return from == to ? from : from + " to " + to;
}

std::optional<double> a_step(const CompareRow& row) { return row.events_per_step(); }
std::optional<double> efficiency(const CompareRow& row) { return row.efficiency(); }

// Returns the events per step divided by the events per step at the smallest stride, for one structure, input
// and motion.
std::optional<double> growth(const Comparison& comparison, const CompareRow& row) {
  const auto first = std::ranges::find_if(comparison.rows, [&](const CompareRow& other) {
    return other.stride == comparison.rows.front().stride && other.structure.name == row.structure.name &&
           other.input == row.input && other.motion == row.motion;
  });
  if (first->events() == 0) return std::nullopt;
  return row.events_per_step() / first->events_per_step();
}

std::string count_text(std::size_t count, const char* one) {
  return fmt::format("{} {}{}", with_thousands(count), one, count == 1 ? "" : "s");
}

std::string file_name(const ComparedInput& input) {
  return std::filesystem::path(input.file).filename().string();
}

// Returns the frames and inputs that the first findings are about.
std::string scope(const Comparison& comparison) {
  const CompareRow& first = comparison.rows.front();
  const std::string steps =
      first.stride == 1 ? "From one frame to the next"
                        : fmt::format("From every frame in {} to the next", with_thousands(first.stride));
  const std::size_t inputs = comparison.inputs.size(), cases = cases_of(comparison).size();
  if (cases == 1)
    return fmt::format("{} of {} ({})", steps, html_escaped(file_name(comparison.inputs.front())),
                       count_text(first.steps, "step"));
  return fmt::format("{} of {} on {}", steps, count_text(inputs, "input"),
                     count_text(cases / inputs, "motion"));
}

// Returns the structures in descending order of their changes.
std::vector<std::string> structures_of(const Comparison& comparison) {
  std::vector<std::pair<double, std::string>> found;
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != comparison.rows.front().stride) continue;
    const auto same = std::ranges::find(found, row.structure.name, &std::pair<double, std::string>::second);
    double& most = (same != found.end() ? *same : found.emplace_back(0, row.structure.name)).first;
    most = std::max(most, row.events_per_step());
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &std::pair<double, std::string>::first);
  std::vector<std::string> names;
  for (auto& [most, name] : found) names.push_back(std::move(name));
  return names;
}

std::string findings(const Comparison& comparison) {
  const std::size_t first = comparison.rows.front().stride, last = comparison.rows.back().stride;
  const std::vector<std::string> names = structures_of(comparison);
  std::string html = "<p>" + scope(comparison), list;
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto text = [&](std::size_t stride, const Figure& figure) {
      return figure_text(comparison, names[k], stride, figure);
    };
    const std::string name = "<strong>" + html_escaped(names[k]) + "</strong>";
    html += fmt::format("{} {}{} {} times",
                        k == 0                  ? ""
                        : k + 1 == names.size() ? " and"
                                                : ",",
                        name, k == 0 ? " changes" : "", text(first, a_step));
    std::string line;
    if (last != first) {
      line = fmt::format(" changes {} times per step at stride {}", text(last, a_step), with_thousands(last));
      if (const std::string times =
              text(last, [&](const CompareRow& row) { return growth(comparison, row); });
          !times.empty())
        line += fmt::format(", {} times as often", times);
    }
    if (const std::string of_first = text(first, efficiency); !of_first.empty())
      line += fmt::format("{} {} events a net change", line.empty() ? " takes" : ";", of_first);
    if (const std::string of_last = text(last, efficiency); last != first && !of_last.empty())
      line += fmt::format(", {} at stride {}", of_last, with_thousands(last));
    if (!line.empty()) list += fmt::format("<li>{}{}.</li>\n", name, line);
  }
  return html + ".</p>\n" + (list.empty() ? "" : "<ul>\n" + list + "</ul>\n");
}

// In this table the strides of a structure are adjacent, for each input and motion.
std::string figures(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const CompareRow& row : comparison.rows) names.push_back(row.structure.name);
  std::vector<CompareRow> rows;
  for (const std::string& of_case : cases_of(comparison)) {
    const auto in_case = [&](const CompareRow& row) { return distinction(comparison, row) == of_case; };
    const auto first = static_cast<std::ptrdiff_t>(rows.size());
    std::ranges::copy_if(comparison.rows, std::back_inserter(rows), in_case);
    std::stable_sort(rows.begin() + first, rows.end(), [&](const CompareRow& a, const CompareRow& b) {
      return std::ranges::find(names, a.structure.name) < std::ranges::find(names, b.structure.name);
    });
  }
  return compare_columns(comparison).html(rows, [&](const CompareRow& row) {
    return distinction(comparison, row);
  });
}

std::string title(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const ComparedInput& input : comparison.inputs) names.push_back(file_name(input));
  return fmt::format("kds compare: {}", fmt::join(names, ", "));
}

}  // namespace

std::string compare_page(const Comparison& comparison, Page page) {
  page.title = title(comparison);
  page.found = findings(comparison);
  page.words = kWords;
  page.terms = terms();
  page.body = html_section("By stride", plots_over_strides(comparison));
  page.body += html_section("Along the chain", plots_along_chain(comparison));
  page.body += html_section("By level", plots_by_level(comparison));
  page.body += html_section("By kind", plots_by_kind(comparison));
  page.body += html_section("Figures", figures(comparison));
  return html_page(page);
}

}  // namespace kds
