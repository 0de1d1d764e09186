#include "experiments/update/update_command.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/update/compare_updates.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

constexpr CommandSpec kUpdateCommand{
    "kds update",
    "Compares techniques that update the power diagram from frame to frame: their work and their time.\n\n"
    "  rebuild   builds the diagram anew with CGAL; the others are compared with it\n"
    "  reinsert  takes out one bead of each certificate (sign condition) that fails in the next frame, and "
    "inserts\n"
    "            these beads again at their new positions\n"
    "  greedy    like reinsert, but takes out the beads of the most failed certificates first\n"
    "  kinetic   moves all beads on straight lines and makes every change in order\n"
    "  hermite   like kinetic, on cubic curves\n"
    "  lifted    like kinetic, with radii that change between frames so that certificates have a lower "
    "degree\n"
    "  activate  moves only the beads of failed certificates, until no certificate fails\n"
    "  auto      chooses rebuild, kinetic or activate by the share of certificates that fail in a sample",
    {},
    {},
    "kds update villin.dcd --topology villin.pdb --frames 0:200 --strides 1,2,4,8 --out report\n"
    "kds update 1l2y.pdb --select all --radius element --techniques kinetic,lifted --audit frames --json -",
};

std::vector<std::string> parse_techniques(const std::string& list) {
  const std::vector<std::string> names = split(list, ',');
  for (const std::string& name : names) {
    if (std::find(kTechniques.begin(), kTechniques.end(), name) == kTechniques.end())
      refuse_unknown("--techniques", name, kTechniques);
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError("--techniques", fmt::format("{} is listed twice", name));
  }
  std::vector<std::string> ordered;
  for (const std::string_view name : kTechniques) {
    if (name == kTechniques.front() || std::find(names.begin(), names.end(), name) != names.end())
      ordered.emplace_back(name);
  }
  return ordered;
}

}  // namespace

const OptionList<UpdateOptions>& update_options() {
  using O = UpdateOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with({list_option({"--techniques", "LIST",
                              "comma list of rebuild, reinsert, greedy, kinetic, hermite, lifted, activate, "
                              "auto; rebuild always runs (default: all)"},
                             &O::techniques, parse_techniques),
                 list_option({"--strides", "LIST",
                              "update the diagram at every frame, every second, ...: 1,2 (default: 1)"},
                             &O::strides, parse_strides),
                 whole_option(
                     {"--rounds", "N",
                      "run each technique N times, alternating, and report the median time (default: 3)"},
                     &O::rounds, 1, 1000),
                 choice_option({"--audit", "WHEN",
                                "when to compare with the static diagram: none or frames (default: none)"},
                               &O::audit, std::span(audit_mode_names).first(2))})
          .with(destination_options("write update.json, update.csv and report.html to DIR (default: none)"));
  return list;
}

UpdateOptions parse_update_options(const Arguments& arguments) {
  UpdateOptions options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kUpdateCommand), update_options(), arguments, options);
  take_inputs(parsed, kUpdateCommand.name, options);
  return options;
}

namespace {

double per_step(const UpdateRow& row, double sum) {
  return row.task.steps == 0 ? 0 : sum / static_cast<double>(row.task.steps);
}

std::string task_line(const UpdateTask& task) {
  const double steps = static_cast<double>(std::max<std::size_t>(1, task.steps));
  return fmt::format(
      "stride {}: {} step{}, {:.1f} cells, {:.1f} of them changed per step, {:.3g}% of {:.1f} certificates "
      "failed, {:.1f} beads hidden",
      task.stride, with_thousands(task.steps), task.steps == 1 ? "" : "s",
      static_cast<double>(task.cells) / steps, static_cast<double>(task.cells_changed) / steps,
      100 * task.failed_share(), static_cast<double>(task.certificates) / steps,
      static_cast<double>(task.hidden) / steps);
}

/// Groups the rows by stride. Rows of one stride are adjacent.
std::vector<std::span<const UpdateRow>> by_stride(std::span<const UpdateRow> rows) {
  std::vector<std::span<const UpdateRow>> groups;
  while (!rows.empty()) {
    const auto end = std::ranges::find_if(
        rows, [&](const UpdateRow& row) { return row.task.stride != rows.front().task.stride; });
    groups.push_back(rows.first(static_cast<std::size_t>(end - rows.begin())));
    rows = rows.subspan(groups.back().size());
  }
  return groups;
}

}  // namespace

const Table<UpdateRow>& update_columns() {
  using Row = UpdateRow;
  static const Table<Row> table{{
      {.key = "stride", .value = [](const Row& r) { return Field(r.task.stride); }},
      {"technique", "technique", [](const Row& r) { return Field(r.technique); }},
      {.key = "steps", .value = [](const Row& r) { return Field(r.task.steps); }},
      {.key = "cells", .value = [](const Row& r) { return Field(r.task.cells); }},
      {.key = "hidden", .value = [](const Row& r) { return Field(r.task.hidden); }},
      {.key = "cells_changed", .value = [](const Row& r) { return Field(r.task.cells_changed); }},
      {.key = "certificates", .value = [](const Row& r) { return Field(r.task.certificates); }},
      {.key = "certificates_failed", .value = [](const Row& r) { return Field(r.task.failed); }},
      {"activated", "activated", [](const Row& r) { return Field(r.activated); }},
      {"removed", "removed", [](const Row& r) { return Field(r.removed); }},
      {"events", "events", [](const Row& r) { return Field(r.events); }},
      {"efficiency", "events per change", [](const Row& r) { return Field(r.efficiency()); },
       with_decimals(3)},
      {"rebuilds", "rebuilds", [](const Row& r) { return Field(r.rebuilds); }},
      {.key = "audits", .value = [](const Row& r) { return Field(r.audits); }},
      {.heading = "us per step",
       .value = [](const Row& r) { return Field(1e6 * per_step(r, r.seconds.median)); },
       .format = shortly},
      {.key = "seconds", .value = [](const Row& r) { return Field(r.seconds.median); }},
      {"ratio", "ratio", [](const Row& r) { return Field(r.ratio); }, with_decimals(3)},
      {.key = "seconds_least", .value = [](const Row& r) { return Field(r.seconds.least); }},
      {.key = "seconds_most", .value = [](const Row& r) { return Field(r.seconds.most); }},
  }};
  return table;
}

std::string update_table(std::span<const UpdateRow> rows) {
  std::string text;
  for (const auto& group : by_stride(rows))
    text += fmt::format("{}{}\n{}", text.empty() ? "" : "\n", task_line(group.front().task),
                        update_columns().text(group, "  "));
  std::uint64_t audits = 0;  // a failed audit ends the program
  for (const UpdateRow& row : rows) audits += row.audits;
  if (audits > 0)
    text += fmt::format("\n{} audits against the static diagram, none failed\n", with_thousands(audits));
  return text;
}

std::vector<UpdateRow> measure_updates(const UpdateOptions& options,
                                       const std::function<void(std::size_t, std::size_t)>& progress,
                                       const std::function<void(const std::string&)>& warn,
                                       const std::function<void(const Scene& all)>& look_at) {
  refuse_instance(options);
  std::map<std::size_t, FrameSurvey> surveys;  // by stride
  const std::unique_ptr<FrameSource> all = open_frames(options, warn);
  surveys.emplace(1, survey_frames(*all, options.radius == "auto", warn));
  const std::vector<double> radii = bead_radii(options.radius, all->necklaces(), surveys.at(1));
  const SceneAtStride scene_at = [&](std::size_t stride, FrameMotion motion) {
    auto frames = open_frames(
        options, [](const std::string&) {}, stride);
    if (!surveys.contains(stride)) surveys.emplace(stride, survey_frames(*frames, false));
    return Scene(std::move(frames), surveys.at(stride), radii, motion);
  };
  if (look_at) look_at(scene_at(1, FrameMotion::linear));
  return compare_updates(scene_at, options, progress);
}

int update_command(const Arguments& arguments) {
  const UpdateOptions options = parse_update_options(arguments);
  TableCommand command("update", arguments, options, "round");
  command.check_inputs_and_destinations(options);

  Json input;
  const std::vector<UpdateRow> rows =
      measure_updates(options, command.progress(), command.warn(),
                      [&](const Scene& all) { input = input_json(options, size_of(all), all.radii()); });

  Json json;
  json["input"] = std::move(input);
  json["settings"] = update_options().settings_json(options);
  json["rows"] = update_columns().json(rows);
  json["warnings"] = command.warnings();
  command.deliver(json, update_columns().csv(rows), update_table(rows));
  return 0;
}

}  // namespace kds
