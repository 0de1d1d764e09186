#include "experiments/collide/collide_command.h"

#include <algorithm>
#include <limits>

#include "experiments/collide/collide_report.h"
#include "experiments/collide/compare_detectors.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

std::vector<std::string> method_names() {
  std::vector<std::string> names;
  for (const Method& method : collision_methods()) names.emplace_back(method.name);
  return names;
}

std::string method_help() {
  std::vector<std::string> methods;
  for (const Method& method : collision_methods())
    methods.push_back(fmt::format("{} ({})", method.name, method.about));
  return fmt::format("comma list of {}, or all (default: all)", fmt::join(methods, ", "));
}

constexpr CommandSpec kCollideCommand{
    "kds collide",
    "Finds exactly which beads collide in each frame, and compares methods. Balls that just touch collide.",
    {},
    {},
    "kds collide 1l2y.pdb --select all --radius element --apart 4\n"
    "kds collide a.xyz b.xyz --pairs between --method wrapped,layered --json -\n"
    "kds collide 1l2y.pdb --radius 0.1 --within 4.5 --apart 9 --method auto\n"
    "kds collide villin.dcd --topology villin.pdb --radius 1.9 --apart 5 --out report"};

std::vector<std::string> parse_methods(const std::string& list) {
  const std::vector<std::string> all = method_names(), names = split(list, ',');
  for (const std::string& name : names) {
    if (std::find(all.begin(), all.end(), name) == all.end())
      refuse_unknown("--method", name, std::vector<std::string_view>(all.begin(), all.end()),
                     fmt::format("one of {} or, alone, all", fmt::join(all, ", ")));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError("--method", fmt::format("{} is listed twice", name));
  }
  std::vector<std::string> ordered;
  for (const std::string& name : all)
    if (std::find(names.begin(), names.end(), name) != names.end()) ordered.push_back(name);
  return ordered;
}

const OptionList<CollideOptions>& collide_options() {
  using O = CollideOptions;
  static const std::string method_help = kds::method_help();
  static const auto list =
      OptionList<O>()
          .with(input_options().with({obstacle_option()}))
          .with(
              {Option<O>(
                   {"--method", "LIST", method_help},
                   [](O& o, const std::string& text) {
                     o.all_methods = text == "all";
                     o.methods = o.all_methods ? method_names() : parse_methods(text);
                   },
                   [](const O& o) { return fmt::format("{}", fmt::join(o.methods, ",")); }, nullptr,
                   [](const O& o) { return Json(o.methods); }),
               choice_option({"--pairs", "NAME",
                              "pairs to examine: within (one necklace), between (two) or all (default: all)"},
                             &O::pairs, which_pairs_names),
               apart_option("pairs of beads of one necklace must be at least K apart along it (default: 2)",
                            &O::apart),
               real_option({"--within", "X",
                            "find pairs whose surfaces are at most X apart (default: 0, pairs that meet)"},
                           &O::within, {0, std::numeric_limits<double>::max()}),
               whole_option({"--rounds", "N",
                             "repeat each method N times and report the median time, and the shortest and "
                             "longest (default: 3 if methods are compared, else 1)"},
                            &O::rounds, 1, 1000)})
          .with(OptionList<InputOptions>({groups_option(
              fmt::format("one bead of a pair must be in SEL1 and the other in SEL2, each as {} takes it, "
                          "among the beads that are read; only brute and cells take it (default: all pairs)",
                          "--select"_arg))}))
          .with(&O::destinations,
                destination_options("write collide.json, collide.csv, pairs.csv, frames.csv and report.html "
                                    "to DIR (default: none)"));
  return list;
}

}  // namespace

CollideOptions parse_collide_options(const Arguments& arguments) {
  CollideOptions options;
  options.methods = method_names();
  const ParsedArguments parsed =
      read_arguments(with_inputs(kCollideCommand), collide_options(), arguments, options);
  take_inputs(parsed, kCollideCommand.name, options);
  if (options.pairs == WhichPairs::between && parsed.has("--apart"))
    throw InputError(
        "--apart",
        fmt::format("applies to pairs of one necklace, and {} between examines pairs of two", "--pairs"_arg));
  if (!parsed.has("--rounds")) options.rounds = options.methods.size() > 1 ? 3 : 1;
  return options;
}

CollideTask collide_task(const CollideOptions& options, const CollideFrames& frames) {
  if (options.pairs == WhichPairs::between && frames.necklaces().size() < 2)
    throw InputError("--pairs"_arg + " between: expected two necklaces or more, found one");
  CollideTask task;
  for (const Method& method : collision_methods())
    if (std::find(options.methods.begin(), options.methods.end(), method.name) != options.methods.end())
      task.methods.push_back(&method);
  task.query = {{frames.necklaces(), options.pairs != WhichPairs::between, options.apart,
                 options.pairs != WhichPairs::within, frames.bead_groups(), frames.at_rest()},
                options.within};
  task.rounds = options.rounds;
  task.leave_out_refusing = options.all_methods;
  return task;
}

int collide_command(const Arguments& arguments) {
  const CollideOptions options = parse_collide_options(arguments);
  TableCommand command("collide", arguments, options.destinations, "frame");
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  command.check_destinations(taken);

  refuse_instance(options, "points, no balls");
  const auto warn = command.warn();
  CollideFrames frames(options, warn);
  const CollideTask task = collide_task(options, frames);
  CollideResults results(options.destinations, command.take_files());
  results.begin(frames);
  const CollideReport report = compare_detectors(
      frames, task,
      [&](const FrameRead& frame, const FrameFound& found, std::span<const BeadPair> pairs) {
        results.add_frame(frame, found, pairs);
      },
      warn, command.progress());

  Json json;
  json["input"] = input_json(options,
                             {.necklaces = frames.necklaces().size(),
                              .frames = frames.frame_count(),
                              .dimension = frames.dimension(),
                              .truncated = frames.is_truncated(),
                              .ends = {frames.first_frame(), frames.last_frame()}},
                             frames.radii());
  json["settings"] = collide_options().settings_json(options);
  json["rows"] = collide_columns(report.timed).json(report.rows);
  json["frames"] = Json::array();  // the results fill it in
  json["warnings"] = command.warnings();
  add_provenance(json, command.command_line());
  results.deliver(report, std::move(json));
  return 0;
}

}  // namespace kds
