#include "experiments/collide/collide_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "experiments/collide/collide_options.h"
#include "experiments/collide/collide_results.h"
#include "experiments/output/text.h"
#include "experiments/program/option_names.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

Json input_json(const CollideOptions& options, const CollideFrames& frames) {
  Json files = Json::array();
  for (const auto& input : options.inputs) files.push_back(input.string());
  if (options.obstacle) files.push_back(options.obstacle->string());
  const auto [least, most] = std::minmax_element(frames.radii().begin(), frames.radii().end());
  return {{"files", files},
          {"beads", frames.radii().size()},
          {"necklaces", frames.necklaces().size()},
          {"frames", frames.frame_count()},
          {"dimension", frames.dimension()},
          {"radius_min", *least},
          {"radius_max", *most}};
}

std::string file_names(const CollideOptions& options) {
  std::vector<std::string> names;
  for (const auto& input : options.inputs) names.push_back(input.filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

CollideTask task_of(const CollideOptions& options, const CollideFrames& frames) {
  if (options.pairs == WhichPairs::between && frames.necklaces().size() < 2)
    throw InputError("--pairs between: expected two necklaces or more, found one");
  CollideTask task;
  for (const Method& method : collision_methods())
    if (std::find(options.methods.begin(), options.methods.end(), method.name) != options.methods.end())
      task.methods.push_back(&method);
  task.query = {{frames.necklaces(), options.pairs != WhichPairs::between, options.apart,
                 options.pairs != WhichPairs::within},
                options.within};
  task.rounds = options.rounds;
  task.leave_out_refusing = options.all_methods;
  return task;
}

}  // namespace

int collide_command(const Arguments& arguments) {
  const CollideOptions options = parse_collide_options(arguments);
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  check_collide_destinations(options.destinations, taken);

  ProgressBar bar(!options.destinations.quiet, "frame");
  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has points, no balls; expected a trajectory");
  Json warnings = Json::array();
  HeldWarnings held;
  const auto warn = held.hold();
  CollideFrames frames(options, warn);
  const CollideTask task = task_of(options, frames);
  CollideResults results(options.destinations);
  results.begin(frames);
  const CollideReport report = compare_detectors(
      frames, task,
      [&](const FrameRead& frame, const FrameFound& found, std::optional<std::span<const BeadPair>> pairs) {
        results.add_frame(frame, found, pairs);
      },
      warn, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });

  const std::string command_line = "kds collide " + shell_words(arguments);
  Json json;
  json["input"] = input_json(options, frames);
  json["settings"] = collide_options().settings_json(options);
  json["rows"] = collide_rows_json(report);
  json["frames"] = Json::array();  // filled in by the results
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  results.deliver(report, json, file_names(options),
                  made_by("collide", command_line, collide_options().settings_json(options)));
  return 0;
}

}  // namespace kds
