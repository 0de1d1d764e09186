#include "experiments/program/commands.h"

#include "experiments/collide/missed_options.h"
#include "experiments/collide/missed_report.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "motions/base/input_error.h"

namespace kds {

int missed_command(const Arguments& arguments) {
  const MissedOptions options = parse_missed_options(arguments);
  const MissedTask& task = options.task;
  TableCommand command("missed", arguments, options.destinations, "step");
  command.check_inputs_and_destinations(task);

  if (const auto instance = read_lone_instance(task))
    throw InputError(instance->file + ": an instance file has points, no balls; expected a trajectory");
  const MissedReport report = count_missed(task, command.warn(), command.progress());

  const MissedInput& input = report.input;
  Json json;
  json["input"] = input_json(task, {input.beads, input.necklaces, input.frames, input.dimension},
                             input.radius_min, input.radius_max);
  json["settings"] = missed_task_options().settings_json(task);
  json["rows"] = missed_columns().json(report.rows);
  json["warnings"] = command.warnings();
  command.deliver(json, missed_columns().csv(report.rows), missed_columns().text(report.rows),
                  [&](Page page) { return missed_page(report.rows, file_names(task), std::move(page)); });
  return 0;
}

}  // namespace kds
