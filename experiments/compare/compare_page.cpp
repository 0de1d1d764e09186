#include "experiments/compare/compare_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <functional>

#include "experiments/compare/compare_plots.h"
#include "experiments/compare/compare_report.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

constexpr std::string_view kWords =
    "A row is one structure in the run of one input, at one stride, on one motion. What is shown by kind, by "
    "level and along the chain is of the smallest stride.";

std::vector<std::pair<std::string, std::string>> terms() {
  return {
      {"event", "the structure itself changes, at an exact time between two frames (an external event)"},
      {"internal", "events of the structure's bookkeeping, which are not counted among the events"},
      {"a step, a ps", "events from one frame to the next, and for a picosecond where the file has times"},
      {"net change",
       "what is not the same at one frame and the next, whatever happened in between: nodes of the wrapped "
       "hierarchy with another basis, cells of one power diagram alone, pairs that meet in one frame alone, "
       "ranks of the sorted list with another bead"},
      {"efficiency",
       "events a net change. Where all that changes changes once it is 1 for nodes and pairs, 0.5 for "
       "interchanges, and for flips 0.2 in space, 0.25 in the plane, as they exchange five or four cells; "
       "what "
       "is above was undone before the next frame"},
      {"compactness", "the most certificates at once"},
      {"locality", "the most certificates on one bead, at the start of a step"},
      {"responsiveness (µs an event)",
       "the time an event takes, internal ones and certificates that never fail included"},
      {"seconds",
       "spent on this structure: the median of the rounds, and in brackets the least and the most"},
      {"share of a bead",
       "of the events those that name it, of the wrapped hierarchy those whose new basis has it; an event "
       "names "
       "several beads, so that shares add up to more than 100%"}};
}

using Figure = std::function<std::optional<double>(const CompareRow&)>;

// Of one structure at one stride, over inputs and motions: "8.333", or "9.202 to 12.49"; empty if unknown.
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

// Beside the same structure, input and motion at the smallest stride.
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

// From which frames to which, and of what.
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

// Those that change most first.
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
      line = fmt::format(" changes {} times a step at stride {}", text(last, a_step), with_thousands(last));
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

// The strides of a structure one below the other, for each input and motion.
std::string figures(const Comparison& comparison) {
  const std::vector<std::string> cases = cases_of(comparison);
  std::vector<std::pair<std::string, HtmlRow>> lines;
  for (const std::string& of_case : cases) {
    if (cases.size() > 1) lines.emplace_back("", HtmlRow{{of_case}});
    const std::size_t heading = lines.size();
    for (const CompareRow& row : comparison.rows) {
      if (distinction(comparison, row) != of_case) continue;
      HtmlRow line{compare_cells(row), cases.size() > 1};
      line.cells.erase(line.cells.begin() + 1);  // the stride, which stands in the first column
      line.cells.front() = fmt::format("{}, stride {}", row.structure.name, with_thousands(row.stride));
      const auto behind = std::find_if(lines.rbegin(), lines.rend() - static_cast<std::ptrdiff_t>(heading),
                                       [&](const auto& other) { return other.first == row.structure.name; })
                              .base();
      const bool known = behind != lines.begin() + static_cast<std::ptrdiff_t>(heading);
      lines.insert(known ? behind : lines.end(), {row.structure.name, std::move(line)});
    }
  }
  std::vector<HtmlRow> rows;
  for (auto& [name, row] : lines) rows.push_back(std::move(row));
  return html_table({"structure", "steps", "events", "a step", "a ps", "net changes", "internal",
                     "efficiency", "compactness", "locality", "µs an event", "seconds", "by kind"},
                    rows);
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
