#include "experiments/update/update_command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>

#include "experiments/output/output_files.h"
#include "experiments/output/page/result_page.h"
#include "experiments/output/text.h"
#include "experiments/program/option_names.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"
#include "experiments/run/load_scene.h"
#include "experiments/update/update_report.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

constexpr const char* kUpdateName = "update";

std::string file_names(const UpdateOptions& options) {
  std::vector<std::string> names;
  for (const auto& input : options.inputs) names.push_back(input.filename().string());
  return fmt::format("{}", fmt::join(names, ", "));
}

Json input_json(const UpdateOptions& options, const Scene& scene) {
  Json files = Json::array();
  for (const auto& input : options.inputs) files.push_back(input.string());
  const auto [least, most] = std::minmax_element(scene.radii().begin(), scene.radii().end());
  return {{"files", files},
          {"beads", scene.bead_count()},
          {"frames", scene.frame_count()},
          {"dimension", scene.dimension()},
          {"radius_min", *least},
          {"radius_max", *most}};
}

}  // namespace

int update_command(const Arguments& arguments) {
  const UpdateOptions options = parse_update_options(arguments);
  const Destinations& destinations = options;
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  if (options.out) taken.write_into("--out", *options.out, {"report.html"});
  check_table_destinations(destinations, kUpdateName, taken);
  if (options.out) {
    check_page(*options.out, "update");
  }

  ProgressBar bar(!options.quiet, "round");
  if (const auto instance = read_lone_instance(options))
    throw InputError(instance->file + ": an instance file has no frames; expected a trajectory");
  Json warnings = Json::array();
  HeldWarnings held;
  std::map<std::size_t, SceneSurvey> surveys;  // by stride
  surveys.emplace(1, open_frames(options, held.hold()).survey(options.radius == "auto", held.hold()));
  const std::vector<double> radii = bead_radii(options.radius, surveys.at(1).necklaces, surveys.at(1).bonds);
  const SceneAtStride scene_at = [&](std::size_t stride, FrameMotion motion) {
    auto frames = std::make_unique<SceneStream>(open_frames(
        options, [](const std::string&) {}, stride));
    if (!surveys.contains(stride)) surveys.emplace(stride, frames->survey(false, [](const std::string&) {}));
    return Scene(std::move(frames), surveys.at(stride), radii, motion);
  };
  const std::vector<UpdateRow> rows = compare_updates(
      scene_at, options, [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });

  const std::string command_line = "kds update " + shell_words(arguments);
  Json json;
  json["input"] = input_json(options, scene_at(1, FrameMotion::linear));
  json["settings"] = update_options().settings_json(options);
  json["rows"] = update_columns().json(rows);
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  deliver_table(destinations, kUpdateName,
                {text_of(json), update_columns().csv(rows), update_table(rows), [&] {
                   return update_page(
                       rows, file_names(options),
                       made_by(kUpdateName, command_line, update_options().settings_json(options)));
                 }});
  return 0;
}

}  // namespace kds
