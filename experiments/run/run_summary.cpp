#include "experiments/run/run_summary.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

#include "certificates/base/kernel.h"
#include "experiments/events/event_distribution.h"
#include "experiments/output/text.h"

namespace kds {

namespace {

// Returns the text that shows a kind of event. Internal kinds, which the total excludes, are marked as
// internal.
std::string kind_label(const RunReport& report, const std::string& kind) {
  for (const StructureReport& structure : report.structures)
    if (const std::string label = structure.label_of(kind); label != kind) return label;
  return kind;
}

using Figure = std::function<std::string(const StructureReport&)>;

SummaryRow row(const RunReport& report, std::string label, bool detail, const Figure& figure) {
  SummaryRow line{std::move(label), detail, {}};
  for (const StructureReport& structure : report.structures) line.cells.push_back(figure(structure));
  return line;
}

Figure count(std::uint64_t StructureReport::*member) {
  return [member](const StructureReport& structure) { return with_thousands(structure.*member); };
}

Figure time(double StructureReport::*member) {
  return [member](const StructureReport& structure) { return short_decimal(structure.*member); };
}

// Returns the union of all structures' kinds or stages, in order of appearance. Each structure counts only
// its own kinds and stages.
std::vector<std::string> names_of_any(const RunReport& report, NamedCounts StructureReport::*member) {
  std::vector<std::string> names;
  for (const StructureReport& structure : report.structures)
    for (const auto& [name, value] : structure.*member)
      if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  return names;
}

Figure count_named(NamedCounts StructureReport::*member, const std::string& name) {
  return [member, name](const StructureReport& structure) {
    for (const auto& [key, value] : structure.*member)
      if (key == name) return with_thousands(value);
    return std::string("-");
  };
}

void add_kinds(std::vector<SummaryRow>& rows, const RunReport& report) {
  constexpr auto member = &StructureReport::events_by_kind;
  for (const std::string& name : names_of_any(report, member))
    rows.push_back(row(report, kind_label(report, name), true, count_named(member, name)));
}

// Adds rows only if a structure has contacts.
void add_contacts(std::vector<SummaryRow>& rows, const RunReport& report) {
  const auto add = [&](const char* label, std::optional<std::uint64_t> StructureReport::*member) {
    rows.push_back(row(report, label, false, [member](const StructureReport& structure) {
      return structure.*member ? with_thousands(*(structure.*member)) : std::string("-");
    }));
  };
  if (std::ranges::none_of(report.structures,
                           [](const StructureReport& s) { return s.contacts_at_start.has_value(); }))
    return;
  add("contacts at the start", &StructureReport::contacts_at_start);
  add("contacts at the end", &StructureReport::contacts_at_end);
}

// Returns the heading above a stage of the summary. A size has no heading.
std::string_view heading_of(Stage::Of of) {
  switch (of) {
    case Stage::Of::failure_time:
      return "failure times settled by";
    case Stage::Of::sign:
      return "signs just after settled by";
    case Stage::Of::size:
      break;
  }
  return "";
}

void add_stages(std::vector<SummaryRow>& rows, const RunReport& report) {
  constexpr auto member = &StructureReport::stages;
  std::string_view heading;
  for (const std::string& name : names_of_any(report, member)) {
    const auto* const stage = std::ranges::find(stage_table, name, &Stage::name);
    const bool known = stage != stage_table.end();
    const std::string_view above = heading_of(known ? stage->of : Stage::Of::failure_time);
    if (above != heading && !above.empty()) rows.push_back({std::string(above), false, {}});
    heading = above;
    rows.push_back(
        row(report, known ? std::string(stage->label) : name, !heading.empty(), count_named(member, name)));
  }
}

std::string per_step(const StructureReport& structure) {
  const std::size_t steps = structure.course.steps();
  return steps == 0 ? "-"
                    : short_decimal(static_cast<double>(structure.events_total) / static_cast<double>(steps));
}

// The time of several rounds is shown with its spread.
Figure time(double StructureReport::*member, Spread StructureReport::*spread, std::size_t rounds) {
  if (rounds == 1) return time(member);
  return [spread](const StructureReport& structure) { return spread_text(structure.*spread); };
}

Figure ratio(std::size_t rounds) {
  return [rounds](const StructureReport& structure) {
    if (!(structure.static_seconds > 0)) return std::string("-");
    return rounds == 1 ? short_decimal(structure.seconds / structure.static_seconds)
                       : spread_text(structure.of_ratio);
  };
}

// Describes the frames if they are not the first frames of a file, or if their times are known.
std::string which_frames(const RunReport& report) {
  if (!report.first_frame || !report.last_frame) return "";
  const auto& [first, first_time] = *report.first_frame;
  const auto& [last, last_time] = *report.last_frame;
  std::string text;
  if (last + 1 != report.frames) text = fmt::format("{} to {}", first, last);
  if (first_time && last_time)
    text += fmt::format("{}{:.6g} to {:.6g} ps", text.empty() ? "" : ", ", *first_time, *last_time);
  return text.empty() ? text : fmt::format(" ({})", text);
}

// Returns the number of a bead with its name, if the input has names.
std::string name_of(const RunReport& report, std::size_t bead) {
  return bead_text(bead, bead < report.bead_names.size() ? report.bead_names[bead] : "");
}

void add_stride(std::vector<std::pair<std::string, std::string>>& lines, const RunReport& report) {
  const StrideCertificate& stride = *report.stride;
  const StrideDeviation& deviation = stride.deviation;
  lines.emplace_back(
      "stride",
      fmt::format("{} frames left out, in which beads are at most {:.6g} from their positions in the run "
                  "({}, frame {}): spheres enlarged by this length hold their beads at all times",
                  with_thousands(deviation.skipped), deviation.largest, name_of(report, deviation.bead),
                  deviation.frame));
  if (!stride.contacts) return;
  const auto& [found, sure, possible] = *stride.contacts;
  lines.emplace_back(
      "contacts",
      fmt::format("{} pairs found, {} of them sure; {} possible: at most {} are missed",
                  with_thousands(found.size()), with_thousands(sure.size()), with_thousands(possible.size()),
                  with_thousands(possible.size() - found.size())));
}

void add_approach(std::vector<std::pair<std::string, std::string>>& lines, const RunReport& report) {
  const ClosestApproach& approach = *report.approach;
  std::string text = fmt::format("{} and {} come nearest, to {:.6g}, at u = {:.3g} of the step from frame {}",
                                 name_of(report, approach.beads[0]), name_of(report, approach.beads[1]),
                                 approach.distance.upper, approach.u, approach.frame);
  if (const auto& range = report.approach_in_all_frames)
    text += fmt::format("; over all frames the least distance is between {:.6g} and {:.6g}", range->lower,
                        range->upper);
  lines.emplace_back("closest", text);
}

}  // namespace

std::vector<SummaryRow> summary_rows(const RunReport& report) {
  std::vector<SummaryRow> rows;
  rows.push_back(row(report, "events", false, count(&StructureReport::events_total)));
  add_kinds(rows, report);
  add_contacts(rows, report);
  rows.push_back(row(report, "events per step", false, per_step));
  rows.push_back(row(report, "certificates created", false, count(&StructureReport::created)));
  rows.push_back(row(report, "never failing", true, count(&StructureReport::never_failing)));
  rows.push_back(row(report, "cancelled", true, count(&StructureReport::cancelled)));
  rows.push_back(row(report, "failed", true, count(&StructureReport::failed)));
  rows.push_back(row(report, "most at once", true, count(&StructureReport::peak)));
  rows.push_back(row(report, "most on one bead", true, count(&StructureReport::per_bead_max)));
  add_stages(rows, report);
  rows.push_back(row(report, "seconds", false,
                     time(&StructureReport::seconds, &StructureReport::of_seconds, report.rounds)));
  rows.push_back(row(report, "first build", true, time(&StructureReport::build_seconds)));
  if (!report.live) {
    rows.push_back(
        row(report, "static build at every frame", true,
            time(&StructureReport::static_seconds, &StructureReport::of_static_seconds, report.rounds)));
    rows.push_back(row(report, "kinetic / static", true, ratio(report.rounds)));
  }
  rows.push_back(row(report, "rebuilds", false, count(&StructureReport::rebuilds)));
  rows.push_back(row(report, "audits", false, count(&StructureReport::audits_run)));
  rows.push_back(row(report, "failed", true, count(&StructureReport::audits_failed)));
  return rows;
}

std::vector<std::pair<std::string, std::string>> input_lines(const RunReport& report) {
  std::string scene = fmt::format("{} beads, {} frames{}, dimension {}", with_thousands(report.beads),
                                  with_thousands(report.frames), which_frames(report), report.dimension);
  scene += report.radius_min == report.radius_max
               ? fmt::format(", radius {:.6g}", report.radius_min)
               : fmt::format(", radii {:.6g} to {:.6g}", report.radius_min, report.radius_max);
  scene += velocities_text(report.velocities);
  std::vector<std::string> settings;
  for (const auto& [name, value] : report.settings)
    if (!value.empty()) settings.push_back(name + " " + value);
  std::vector<std::pair<std::string, std::string>> lines{
      {"input", fmt::format("{}", fmt::join(report.files, ", "))},
      {"scene", scene},
      {"settings", fmt::format("{}", fmt::join(settings, ", "))}};
  if (report.stride) add_stride(lines, report);
  if (report.approach) add_approach(lines, report);
  return lines;
}

}  // namespace kds
