#include "experiments/program/commands.h"

#include <fmt/format.h>

#include <optional>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/program/table_command.h"
#include "experiments/run/load_scene.h"
#include "experiments/scenes/bead_rows.h"
#include "experiments/scenes/info_options.h"
#include "experiments/scenes/info_report.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

// An instance file has weighted points rather than balls in a chain, so there are no conditions to check.
void describe(const Instance& instance, bool beads, const TableCommand& command) {
  if (beads)
    throw InputError(fmt::format("--beads: has no meaning for an instance file ({})", instance.file));
  Json json;
  json["input"] = {{"files", std::vector{instance.file}},
                   {"beads", instance.point_count()},
                   {"frames", 2},
                   {"dimension", instance.dimension()},
                   {"degree", instance.degree},
                   {"weighted", instance.weighted()}};
  json["settings"] = Json::object();  // no setting applies here
  json["rows"] = Json::array();
  json["warnings"] = Json::array();
  const std::string row = fmt::format("{},{},{},{}", instance.point_count(), instance.dimension(),
                                      instance.degree, instance.weighted());
  command.deliver(
      json, "beads,dimension,degree,weighted\n" + row + "\n",
      fmt::format("input     {}\ninstance  {} moving points, dimension {}, degree {}, {}\n",
                  one_line(instance.file), with_thousands(instance.point_count()), instance.dimension(),
                  instance.degree, instance.weighted() ? "weighted" : "without weights"));
}

void describe_beads(const InfoOptions& options, TableCommand& command) {
  const auto frames = open_frames(options, command.warn());
  const FrameSurvey survey = survey_frames(*frames, options.radius == "auto", command.warn());
  const std::vector<BeadRow> rows =
      bead_rows(frames->heads(), bead_radii(options.radius, frames->necklaces(), survey));
  Json json;
  json["input"] = {{"files", files_json(options)}, {"beads", rows.size()}};
  json["settings"] = info_options().settings_json(options);
  json["rows"] = bead_columns().json(rows);
  json["warnings"] = command.warnings();
  command.deliver(json, bead_columns().csv(rows), bead_columns().text(rows));
}

void describe(const InfoOptions& options, TableCommand& command) {
  const auto frames = open_frames(options, command.warn());
  const FrameSurvey survey = survey_frames(*frames, options.radius == "auto", command.warn());
  const std::vector<double> radii = bead_radii(options.radius, frames->necklaces(), survey);
  const SceneInfo info = describe_frames(frames->heads(), frames->frame_counts(), *frames, radii,
                                         options.validate, command.progress());
  Json json;
  add_scene(json, info);
  json["settings"] = info_options().settings_json(options);
  json["warnings"] = command.warnings();
  command.deliver(json, conditions_csv(info), scene_table(info));
}

}  // namespace

int info_command(const Arguments& arguments) {
  const InfoOptions options = parse_info_options(arguments);
  TableCommand command("info", arguments, options, "frame");
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  command.check_destinations(taken, {"info.json", "info.csv"});

  if (const std::optional<Instance> instance = read_lone_instance(options)) {
    describe(*instance, options.beads, command);
  } else if (options.beads) {
    describe_beads(options, command);
  } else {
    describe(options, command);
  }
  return 0;
}

}  // namespace kds
