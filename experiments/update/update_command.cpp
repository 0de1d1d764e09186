#include "experiments/program/commands.h"

#include <map>
#include <memory>

#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/update/update_report.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

int update_command(const Arguments& arguments) {
  const UpdateOptions options = parse_update_options(arguments);
  TableCommand command("update", arguments, options, "round");
  command.check_inputs_and_destinations(options);

  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has no frames; expected a trajectory");
  std::map<std::size_t, FrameSurvey> surveys;  // by stride
  const std::unique_ptr<FrameSource> all = open_frames(options, command.warn());
  surveys.emplace(1, survey_frames(*all, options.radius == "auto", command.warn()));
  const std::vector<double> radii = bead_radii(options.radius, all->necklaces(), surveys.at(1));
  const SceneAtStride scene_at = [&](std::size_t stride, FrameMotion motion) {
    auto frames = open_frames(
        options, [](const std::string&) {}, stride);
    if (!surveys.contains(stride)) surveys.emplace(stride, survey_frames(*frames, false));
    return Scene(std::move(frames), surveys.at(stride), radii, motion);
  };
  const std::vector<UpdateRow> rows = compare_updates(scene_at, options, command.progress());

  const Scene scene = scene_at(1, FrameMotion::linear);
  Json json;
  json["input"] =
      input_json(options, {.frames = scene.frame_count(), .dimension = scene.dimension()}, scene.radii());
  json["settings"] = update_options().settings_json(options);
  json["rows"] = update_columns().json(rows);
  json["warnings"] = command.warnings();
  command.deliver(json, update_columns().csv(rows), update_table(rows),
                  [&](Page page) { return update_page(rows, file_names(options), std::move(page)); });
  return 0;
}

}  // namespace kds
