#include "experiments/collide/missed_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/collide/missed_report.h"
#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/option_lists.h"
#include "experiments/program/option_names.h"
#include "experiments/program/option_values.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr const char* kMissedName = "missed";

constexpr CommandSpec kMissedCommand{
    "kds missed",
    "Which share of contacts, whose times are exact, is missed by looking at every stride-th frame only.",
    kInputOperand,
    kTrajectoryHelp,
    {},
    "kds missed villin.dcd --topology villin.pdb --factors 2.2,2.5 --apart 5 --out report\n"
    "kds missed a.xyz b.xyz --radius 1.9 --strides 1,10,100 --json -"};

std::vector<double> parse_factors(const std::string& list) {
  std::vector<double> factors;
  for (const std::string& text : split(list, ','))
    factors.push_back(parse_real("--factors", text, {0, 1e6, true}));
  std::sort(factors.begin(), factors.end());
  if (const auto twice = std::adjacent_find(factors.begin(), factors.end()); twice != factors.end())
    throw InputError(fmt::format("--factors: {} is listed twice", *twice));
  return factors;
}

Json input_json(const MissedTask& task, const MissedInput& input) {
  Json files = Json::array();
  for (const auto& file : task.inputs) files.push_back(file.string());
  if (task.obstacle) files.push_back(task.obstacle->string());
  return {{"files", files},
          {"beads", input.beads},
          {"necklaces", input.necklaces},
          {"frames", input.frames},
          {"dimension", input.dimension},
          {"radius_min", input.radius_min},
          {"radius_max", input.radius_max}};
}

const OptionList<MissedTask>& task_options() {
  using O = MissedTask;
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option()}))
          .with(
              {of_output(list_option(
                   {"--strides", "LIST",
                    "every how many frames beads are looked at (default: 1,2,4,8,16,32,64, as far as "
                    "that is two frames or more)"},
                   &O::strides, parse_strides)),
               list_option({"--factors", "LIST",
                            "radii are those of --radius times this, a run each; where beads of a chain just "
                            "touch, those that are no neighbours meet from 2.2 to 2.5 on (default: 1)"},
                           &O::factors, parse_factors),
               apart_option("of beads of one chain, those at least K apart along it; with factors above 2 "
                            "others are always near, and 5 leaves those out (default: 2)",
                            &O::apart),
               // Lifted motion has no radii between frames.
               choice_option({"--motion", "NAME", "linear or hermite (default: linear)"}, &O::motion,
                             std::span(frame_motion_names).first(2))});
  return list;
}

std::string file_names(const MissedTask& task) {
  std::vector<std::string> names;
  for (const auto& input : task.inputs) names.push_back(input.filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

void check_destinations(const MissedOptions& options) {
  const Destinations& destinations = options.destinations;
  TakenPaths taken;
  taken.read(options.task);
  if (destinations.out) {
    taken.write_into("--out", *destinations.out, {"report.html"});
  }
  check_table_destinations(destinations, kMissedName, taken);
  if (!destinations.out) return;
  check_page(*destinations.out, "missed");
}

}  // namespace

MissedOptions parse_missed_options(const Arguments& arguments) {
  using O = MissedOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, task_options())
          .with(&O::destinations,
                destination_options("write missed.json, missed.csv and report.html there (default: none)"));
  O options;
  const ParsedArguments parsed = read_arguments(kMissedCommand, list, arguments, options);
  take_inputs(parsed, kMissedCommand.name, options.task);
  return options;
}

int missed_command(const Arguments& arguments) {
  const MissedOptions options = parse_missed_options(arguments);
  const MissedTask& task = options.task;
  check_inputs_exist(task);
  check_destinations(options);

  ProgressBar bar(!options.destinations.quiet, "step");
  if (const auto instance = read_lone_instance(task))
    throw InputError(instance->file + ": an instance file has points, no balls; expected a trajectory");
  Json warnings = Json::array();
  HeldWarnings held;
  const MissedReport report = count_missed(
      task, held.hold(), [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });

  const std::string command_line = "kds missed " + shell_words(arguments);
  Json json;
  json["input"] = input_json(task, report.input);
  json["settings"] = task_options().settings_json(task);
  json["rows"] = missed_rows_json(report.rows);
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  deliver_table(options.destinations, kMissedName,
                {text_of(json), missed_csv(report.rows), missed_table(report.rows), [&] {
                   return missed_page(report.rows, file_names(task),
                                      made_by(kMissedName, command_line, task_options().settings_json(task)));
                 }});
  return 0;
}

}  // namespace kds
