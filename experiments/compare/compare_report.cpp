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
    json.push_back(
        {{"file", input.file},
         {"name", input.name},
         {"beads", input.beads},
         {"frames", input.frames},
         {"dimension", input.dimension},
         {"truncated", input.truncated},
         {"radius_min", input.radius_min},
         {"radius_max", input.radius_max},
         {"frame_picoseconds", input.frame_picoseconds ? Json(*input.frame_picoseconds) : Json()}});
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

std::string microseconds(const Field& seconds) { return short_decimal(1e6 * seconds.number()); }

Table<Compared> identity_columns() {
  return {{
      {.key = "structure",
       .heading = "structure",
       .value = [](const Compared& r) { return Field(r.structure.name); },
       .shown = Shown::in_text},
      {.heading = "structure",
       .value =
           [](const Compared& r) {
             return Field(fmt::format("{}, stride {}", r.structure.name, with_thousands(r.stride)));
           },
       .shown = Shown::on_pages},
      {.key = "input", .value = [](const Compared& r) { return Field(r.input); }},
      {"stride", "stride", [](const Compared& r) { return Field(r.stride); }, plainly, Shown::in_text},
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
      {"internal", "internal", [](const Compared& r) { return Field(r.internal()); }, plainly,
       Shown::on_pages},
      {"efficiency", "efficiency", [](const Compared& r) { return Field(r.efficiency()); }, shortly,
       Shown::on_pages},
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
      {"events_per_step_first", "first quarter",
       [](const Compared& r) { return Field(r.events_per_step_in_first_quarter()); }, shortly,
       Shown::on_pages},
      {"events_per_step_last", "last quarter",
       [](const Compared& r) { return Field(r.events_per_step_in_last_quarter()); }, shortly,
       Shown::on_pages},
      {"events_per_ps", "events per ps", [](const Compared& r) { return Field(r.events_per_picosecond()); },
       shortly, has_times ? Shown::everywhere : Shown::on_pages},
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
      {"locality", "locality", [](const Compared& r) { return Field(r.costs.per_bead_most); }, plainly,
       Shown::on_pages},
      {"created_per_event", "created per event",
       [](const Compared& r) { return Field(r.created_per_event()); }, shortly, Shown::on_pages},
      {"touched_per_event", "touched per event",
       [](const Compared& r) { return Field(r.touched_per_event()); }, shortly, Shown::on_pages},
      {"touched_most", "at most", [](const Compared& r) { return Field(r.costs.touched_most); }, plainly,
       Shown::on_pages},
      {"responsiveness", "us per event", [](const Compared& r) { return Field(r.responsiveness()); },
       microseconds, Shown::on_pages},
      {"responsiveness_worst", "worst us",
       [](const Compared& r) { return r.costs.events == 0 ? Field() : Field(r.costs.seconds_most); },
       microseconds, Shown::on_pages},
  };
}

Table<Compared> event_table(const Comparison& comparison) {
  return identity_columns()
      .add(event_columns(comparison))
      .add({{.heading = "by kind", .value = [](const Compared& r) { return Field(kinds_text(r)); }}});
}

Table<Compared> cost_table() {
  return identity_columns()
      .add(cost_columns())
      .add(spread_columns<Compared>("seconds", "seconds", [](const Compared& r) { return r.seconds; }));
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
       {.key = "over_time", .json = [](const Compared& r) {
          Json events = Json::array();
          for (const EventBin& bin : r.structure.course.bins()) events.push_back(bin.events);
          return Json{{"steps", r.structure.course.width()}, {"events", events}};
        }}});
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

std::string distinction(const Comparison& comparison, const CompareRow& row) {
  std::string text;
  if (std::ranges::any_of(comparison.rows,
                          [&](const CompareRow& other) { return other.motion != row.motion; }))
    text = row.motion_name();
  if (comparison.inputs.size() > 1) text += (text.empty() ? "" : ", ") + input_of(comparison, row).short_name;
  return text;
}

std::string compare_table(const Comparison& comparison) {
  const std::vector<std::string> lines = compare_columns(comparison).lines(comparison.rows);
  std::string text, input, motion;
  for (std::size_t r = 0; r < comparison.rows.size(); ++r) {
    const CompareRow& row = comparison.rows[r];
    if (row.input != input || row.motion_name() != motion) {
      input = row.input;
      motion = row.motion_name();
      text += fmt::format("{}{}, {} motion ({})\n  {}\n", text.empty() ? "" : "\n", one_line(input), motion,
                          size_text(input_of(comparison, row)), lines.front());
    }
    text += "  " + lines[r + 1] + "\n";
  }
  if (const std::vector<PooledRow> pooled = pooled_rows(comparison); !pooled.empty())
    text += fmt::format("\nmeans over the {} inputs\n{}", comparison.inputs.size(),
                        pooled_columns().text(pooled, "  "));
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
      {"efficiency",
       "all events, internal ones included, divided by the external events: 1 if the structure needs no "
       "bookkeeping of its own"},
      {"events per step (95%)",
       "events from one frame to the next, with the confidence interval of the mean, on a logarithmic scale, "
       "from batch means that may depend on each other; without one for fewer than 50 steps, or if all steps "
       "have equally many events. The interval is for runs of these beads that do not drift: compare the "
       "first quarter of "
       "the steps with the last. Events per net change have such an interval, too"},
      {"net change",
       "a difference between one frame and the next, whatever happened in between: a node of the wrapped "
       "hierarchy with another basis, a cell in the power diagram of one frame only, a pair that meets in "
       "one frame only, a rank of the sorted list with another bead"},
      {"events per net change",
       "if every change happens once, 1 for nodes and pairs, 0.5 for interchanges, and for flips 0.2 in "
       "space "
       "and 0.25 in the plane, because a flip exchanges five or four cells. A larger number means that "
       "changes "
       "were undone before the next frame"},
      {"compactness", "the most certificates at once, at any time"},
      {"locality", "the most certificates on one bead, at any time"},
      {"created, touched per event",
       "certificates that the structure creates at an event, and that it creates or ends; at most: at one "
       "time. "
       "The certificates that a step begins with do not count"},
      {"us per event, worst us (responsiveness)",
       "microseconds that the structure spends at the times of events, divided by its events, internal ones "
       "included; and the longest time that it spends at one time, the least of the rounds"},
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
std::optional<double> a_net_change(const CompareRow& row) { return row.events_per_net_change(); }

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

// Returns the frames and inputs that the first findings are about.
std::string scope(const Comparison& comparison) {
  const CompareRow& first = comparison.rows.front();
  const std::string steps =
      first.stride == 1 ? "From one frame to the next"
                        : fmt::format("From every frame in {} to the next", with_thousands(first.stride));
  const std::size_t inputs = comparison.inputs.size(), cases = cases_of(comparison).size();
  if (cases == 1)
    return fmt::format("{} of {} ({})", steps, html_escaped(comparison.inputs.front().short_name),
                       count_text(first.steps, "step"));
  return fmt::format("{} of {} on {}", steps, count_text(inputs, "input"),
                     count_text(cases / inputs, "motion"));
}

// Returns the structures that have events, in descending order of their changes.
std::vector<std::string> structures_of(const Comparison& comparison) {
  std::vector<std::pair<double, std::string>> found;
  for (const CompareRow& row : comparison.rows) {
    if (row.stride != comparison.rows.front().stride || !row.has_events()) continue;
    const auto same = std::ranges::find(found, row.structure.name, &std::pair<double, std::string>::second);
    double& most = (same != found.end() ? *same : found.emplace_back(0, row.structure.name)).first;
    most = std::max(most, row.events_per_step());
  }
  std::ranges::stable_sort(found, std::ranges::greater{}, &std::pair<double, std::string>::first);
  std::vector<std::string> names;
  for (auto& [most, name] : found) names.push_back(std::move(name));
  return names;
}

// Returns the structures that have no events, in the order of the rows.
std::vector<std::string> eventless_structures(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const CompareRow& row : comparison.rows)
    if (!row.has_events() && std::ranges::find(names, row.structure.name) == names.end())
      names.push_back(row.structure.name);
  return names;
}

std::string findings(const Comparison& comparison) {
  const std::size_t first = comparison.rows.front().stride, last = comparison.rows.back().stride;
  const std::vector<std::string> names = structures_of(comparison);
  std::string html = "<p>", list;
  if (!names.empty()) html += scope(comparison);
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
    if (const std::string of_first = text(first, a_net_change); !of_first.empty())
      line += fmt::format("{} {} events a net change", line.empty() ? " takes" : ";", of_first);
    if (const std::string of_last = text(last, a_net_change); last != first && !of_last.empty())
      line += fmt::format(", {} at stride {}", of_last, with_thousands(last));
    if (!line.empty()) list += fmt::format("<li>{}{}.</li>\n", name, line);
  }
  if (!names.empty()) html += ".";
  for (const std::string& name : eventless_structures(comparison))
    html += fmt::format("{}<strong>{}</strong> has no events.", html == "<p>" ? "" : " ", html_escaped(name));
  return html + "</p>\n" + (list.empty() ? "" : "<ul>\n" + list + "</ul>\n");
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
  const auto group = [&](const CompareRow& row) { return distinction(comparison, row); };
  return "<p>Events:</p>\n" + event_table(comparison).html(rows, group) + "<p>Certificates and time:</p>\n" +
         cost_table().html(rows, group);
}

std::string inputs_html(const Comparison& comparison) {
  std::string html = "<ul>\n";
  for (const ComparedInput& input : comparison.inputs)
    html += fmt::format("<li>{}: {}</li>\n", html_escaped(input.short_name), size_text(input));
  return html + "</ul>\n";
}

std::string title(const Comparison& comparison) {
  std::vector<std::string> names;
  for (const ComparedInput& input : comparison.inputs) names.push_back(input.short_name);
  return fmt::format("kds compare: {}", fmt::join(names, ", "));
}

}  // namespace

std::string compare_page(const Comparison& comparison, Page page) {
  page.title = title(comparison);
  page.found = findings(comparison);
  page.words = kWords;
  page.terms = terms();
  page.body = html_section("Inputs", inputs_html(comparison));
  if (const std::vector<PooledRow> pooled = pooled_rows(comparison); !pooled.empty())
    page.body +=
        html_section("Means over the inputs",
                     "<p>Each input counts alike. Intervals of 95% come from the spread between "
                     "inputs, on a logarithmic scale, so they are wide for few inputs and stay above "
                     "0. They are for independent inputs of one kind, whose values spread by less than "
                     "their mean.</p>\n" +
                         pooled_columns().html(pooled));
  page.body += html_section("By stride", plots_over_strides(comparison));
  page.body += html_section("Over time", plots_over_time(comparison));
  page.body += html_section("Along the chain", plots_along_chain(comparison));
  page.body += html_section("By level", plots_by_level(comparison));
  page.body += html_section("By kind", plots_by_kind(comparison));
  page.body += html_section("Numbers", figures(comparison));
  return html_page(page);
}

}  // namespace kds
