#include "experiments/scenes/info_command.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/program/option_names.h"
#include "experiments/program/progress_bar.h"
#include "experiments/program/table_results.h"
#include "experiments/program/warnings.h"
#include "experiments/run/load_scene.h"
#include "experiments/scenes/bead_rows.h"
#include "experiments/scenes/info_options.h"
#include "experiments/scenes/info_report.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

constexpr std::string_view kInfoName = "info";

// Points with weights, not balls in a chain: there is nothing to judge.
TableResults describe(const Instance& instance, bool beads, const std::string& command_line) {
  if (beads)
    throw InputError(fmt::format("--beads: has no meaning for an instance file ({})", instance.file));
  Json json;
  json["input"] = {{"files", std::vector{instance.file}},
                   {"beads", instance.point_count()},
                   {"frames", 2},
                   {"dimension", instance.dimension()},
                   {"degree", instance.degree},
                   {"weighted", instance.weighted()}};
  json["settings"] = Json::object();  // none of them has a meaning here
  json["rows"] = Json::array();
  json["warnings"] = Json::array();
  add_provenance(json, command_line);
  const std::string row = fmt::format("{},{},{},{}", instance.point_count(), instance.dimension(),
                                      instance.degree, instance.weighted());
  return {text_of(json), "beads,dimension,degree,weighted\n" + row + "\n",
          fmt::format("input     {}\ninstance  {} moving points, dimension {}, degree {}, {}\n",
                      one_line(instance.file), with_thousands(instance.point_count()), instance.dimension(),
                      instance.degree, instance.weighted() ? "weighted" : "without weights")};
}

TableResults describe_beads(const InfoOptions& options, const std::string& command_line, ProgressBar& bar) {
  HeldWarnings held;
  const SceneSurvey survey = open_frames(options, held.hold()).survey(options.radius == "auto", held.hold());
  const std::vector<BeadRow> rows =
      bead_rows(survey.necklaces, bead_radii(options.radius, survey.necklaces, survey.bonds));
  Json json, files = Json::array(), warnings = Json::array();
  for (const auto& input : options.inputs) files.push_back(input.string());
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });
  json["input"] = {{"files", files}, {"beads", rows.size()}};
  json["settings"] = info_options().settings_json(options);
  json["rows"] = bead_rows_json(rows);
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  return {text_of(json), bead_rows_csv(rows), bead_rows_table(rows)};
}

TableResults describe(const InfoOptions& options, const std::string& command_line, ProgressBar& bar) {
  if (options.beads) return describe_beads(options, command_line, bar);
  Json warnings = Json::array();
  HeldWarnings held;
  SceneStream frames = open_frames(options, held.hold());
  const SceneSurvey survey = frames.survey(options.radius == "auto", held.hold());
  const std::vector<double> radii = bead_radii(options.radius, survey.necklaces, survey.bonds);
  const SceneInfo info = describe_frames(
      survey.necklaces, survey.frames_of_necklaces,
      [&frames](FrameRead& frame) { return frames.next(frame); }, radii, options.validate,
      [&bar](std::size_t done, std::size_t total) { bar.update(done, total); });
  bar.erase();
  held.release([&](const std::string& warning) {
    warnings.push_back(warning);
    print_warning(bar, warning);
  });
  Json json;
  add_scene(json, info);
  json["settings"] = info_options().settings_json(options);
  json["warnings"] = warnings;
  add_provenance(json, command_line);
  return {text_of(json), conditions_csv(info), scene_table(info)};
}

}  // namespace

int info_command(const Arguments& arguments) {
  const InfoOptions options = parse_info_options(arguments);
  const Destinations& destinations = options;
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  check_table_destinations(destinations, std::string(kInfoName), taken);

  const std::string command_line = "kds info " + shell_words(arguments);
  ProgressBar bar(!options.quiet, "frame");
  const std::optional<Instance> instance = read_lone_instance(options);
  deliver_table(
      destinations, std::string(kInfoName),
      instance ? describe(*instance, options.beads, command_line) : describe(options, command_line, bar));
  return 0;
}

}  // namespace kds
