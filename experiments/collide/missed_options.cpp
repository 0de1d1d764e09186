#include "experiments/collide/missed_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

constexpr CommandSpec kMissedCommand{
    "kds missed",
    "Measures which share of all contacts you miss if you look only at the frames, or only at every second, "
    "fourth ... frame.",
    kInputOperand, kTrajectoryHelp,
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

}  // namespace

const OptionList<MissedTask>& missed_task_options() {
  using O = MissedTask;
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option()}))
          .with({of_output(list_option({"--strides", "LIST",
                                        "examine every frame, every second, ... (default: 1,2,4,8,16,32,64, "
                                        "as far as at least two frames remain)"},
                                       &O::strides, parse_strides)),
                 list_option({"--factors", "LIST",
                              "multiply the radii by each factor, one run each. With --radius auto, contacts "
                              "appear from 2.2 to 2.5 on (default: 1)"},
                             &O::factors, parse_factors),
                 apart_option("pairs of beads of one chain must be at least K apart along it; with factors "
                              "above 2 take 5, or near neighbours are always in contact (default: 2)",
                              &O::apart),
                 // Lifted motion is excluded because it has no radii between frames.
                 choice_option({"--motion", "NAME",
                                "motion of beads between frames: linear or hermite (default: linear)"},
                               &O::motion, std::span(frame_motion_names).first(2))});
  return list;
}

MissedOptions parse_missed_options(const Arguments& arguments) {
  using O = MissedOptions;
  static const auto list =
      OptionList<O>()
          .with(&O::task, missed_task_options())
          .with(&O::destinations,
                destination_options("write missed.json, missed.csv and report.html to DIR (default: none)"));
  O options;
  const ParsedArguments parsed = read_arguments(kMissedCommand, list, arguments, options);
  take_inputs(parsed, kMissedCommand.name, options.task);
  return options;
}

}  // namespace kds
