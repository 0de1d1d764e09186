#include "experiments/compare/compare_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/compare/compare_report.h"
#include "experiments/compare/compare_runs.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/live_output.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/run/page_of_run.h"
#include "experiments/run/run_options.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kCompareCommand{
    "kds compare",
    "Compares how often structures change, by stride, motion and input. Each INPUT is a run of its own, in "
    "which all\n"
    "structures run together. Each row is one structure.\n\n"
    "  net changes     what differs between two consecutive frames (kds help structures)\n"
    "  efficiency      all events, internal ones included, per external event\n"
    "  compactness     largest number of certificates at once, at any time\n"
    "  locality        largest number of certificates on one bead, at any time\n"
    "  created, touched  certificates created, and created or ended, per event\n"
    "  responsiveness  seconds per event: mean, and longest at one time\n\n"
    "Means per step have 95% intervals, for runs that do not drift; steps may depend on each other. Several\n"
    "INPUTs are also pooled: means per step, per bead and per picosecond, with intervals from the spread\n"
    "between inputs, for independent inputs of one kind.",
    {},
    {},
    "kds compare villin.dcd --topology villin.pdb --strides 1,2,4,8,16,32 --out report\n"
    "kds compare 300K.dcd 400K.dcd --topology villin.pdb --structures wrapped,contacts --motions "
    "linear,hermite",
};

std::vector<FrameMotion> parse_motions(const std::string& list) {
  std::vector<FrameMotion> motions;
  for (const std::string& name : split(list, ',')) {
    motions.push_back(choice_of<FrameMotion>("--motions", name, frame_motion_names));
    if (std::count(motions.begin(), motions.end(), motions.back()) > 1)
      throw InputError("--motions", fmt::format("{} is listed twice", name));
  }
  std::sort(motions.begin(), motions.end());
  return motions;
}

/// JSON has the distance as text, which is empty if the option is not given.
Option<CompareOptions> compare_apart_option() {
  auto option =
      apart_option("contacts: pairs of beads of one chain must be at least K apart along it (default: 2)",
                   &CompareOptions::apart);
  option.json = nullptr;
  return option;
}

const OptionList<CompareOptions>& compare_options() {
  using O = CompareOptions;
  static const std::string structures_help = kds::structures_help();
  static const std::string motions_help =
      fmt::format("motion of beads between frames: comma list of {} (default: linear)",
                  fmt::join(frame_motion_names, ", "));
  static const auto list =
      OptionList<O>()
          .with(input_options().with({velocities_option()}))
          .with(live_options())
          .with({list_option({"--structures", "LIST", structures_help}, &O::structures, parse_structures),
                 list_option({"--strides", "LIST",
                              "run over every frame, every second, every fourth: 1,2,4 (default: 1)"},
                             &O::strides, parse_strides),
                 list_option({"--motions", "LIST", motions_help}, &O::motions, parse_motions),
                 directions_option(&O::directions), stretch_option(&O::stretch), probe_option(&O::probe),
                 compare_apart_option(),
                 whole_option({"--rounds", "N",
                               "repeat each run N times and report the median time, and the shortest and "
                               "longest (default: 3)"},
                              &O::rounds, 1, 1000),
                 threads_option(&O::threads),
                 view_option(
                     &O::view,
                     "run the first INPUT once more, with the smallest of --strides and the first of "
                     "--motions in the order linear, hermite, lifted, and write a page that shows it in a "
                     "browser to FILE (default: none)")})
          .with(
              destination_options("write compare.json, compare.csv and report.html to DIR (default: none)"));
  return list;
}

}  // namespace

CompareOptions parse_compare_options(const Arguments& arguments) {
  CompareOptions options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kCompareCommand, true, true), compare_options(), arguments, options);
  take_inputs(parsed, kCompareCommand.name, options);
  options.takes_live = true;
  refuse_if_live(options, parsed.has("--rounds") && options.rounds != 1, "--rounds",
                 "repeats the runs, and a simulation runs once; expected 1");
  refuse_if_live(options, options.view.has_value(), "--view",
                 "reads all frames again; expected a trajectory that the simulation has written");
  if (is_live(options)) options.rounds = 1;
  return options;
}

int compare_command(const Arguments& arguments) {
  CompareOptions options = parse_compare_options(arguments);
  TableCommand command("compare", arguments, options, "step");
  check_inputs_exist(options);
  const SignalsEndLiveInput on_signal(options);
  TakenPaths taken;
  taken.read(options);
  if (options.view) taken.write("--view", *options.view);
  command.check_destinations(std::move(taken));
  if (options.view) ensure_writable_file(*options.view, "--view");

  options.reading.on_wait = waiting_note(command.bar(), options);
  const Comparison comparison = compare_runs(options, command.progress(), command.warn());
  if (options.view) {
    const RunOptions run = first_run(options, comparison);
    const Scene scene = load_scene(run, [](const std::string&) {});
    write_page_of_run(run, scene, *options.view, command.add_replay(*options.view), command.progress());
  }

  Json json;
  json["inputs"] = compared_inputs_json(comparison);
  json["settings"] = compare_options().settings_json(options);
  json["pooled"] = pooled_columns().json(pooled_rows(comparison));
  json["rows"] = compare_columns(comparison).json(comparison.rows);
  json["warnings"] = command.warnings();
  if (comparison.live) add_live(json, *comparison.live);
  command.deliver(json, compare_columns(comparison).csv(comparison.rows), compare_table(comparison));
  return comparison.live
             ? end_of_live_run(command.bar(), *comparison.live, comparison.inputs.front().truncated)
             : 0;
}

}  // namespace kds
