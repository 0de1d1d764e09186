#include "experiments/program/commands.h"

#include <algorithm>

#include "experiments/collide/collide_options.h"
#include "experiments/collide/collide_results.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

namespace {

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
  TableCommand command("collide", arguments, options.destinations, "frame");
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  command.check_destinations(taken,
                             {"collide.json", "collide.csv", "pairs.csv", "frames.csv", "report.html"});

  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has points, no balls; expected a trajectory");
  const auto warn = command.warn();
  CollideFrames frames(options, warn);
  const CollideTask task = task_of(options, frames);
  CollideResults results(options.destinations);
  results.begin(frames);
  const CollideReport report = compare_detectors(
      frames, task,
      [&](const FrameRead& frame, const FrameFound& found, std::optional<std::span<const BeadPair>> pairs) {
        results.add_frame(frame, found, pairs);
      },
      warn, command.progress());

  Json json;
  json["input"] = input_json(options,
                             {.necklaces = frames.necklaces().size(),
                              .frames = frames.frame_count(),
                              .dimension = frames.dimension()},
                             frames.radii());
  json["settings"] = collide_options().settings_json(options);
  json["rows"] = collide_columns().json(report.rows);
  json["frames"] = Json::array();  // the results fill it in
  json["warnings"] = command.warnings();
  add_provenance(json, command.command_line());
  results.deliver(report, json, file_names(options), command.page(json["settings"]));
  return 0;
}

}  // namespace kds
