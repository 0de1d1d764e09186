#include "experiments/scenes/info_command.h"

#include <fmt/format.h>

#include <limits>
#include <optional>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/run/count_crossings.h"
#include "experiments/run/load_scene.h"
#include "experiments/scenes/scene_info.h"
#include "motions/base/input_error.h"
#include "motions/scene/radii.h"

namespace kds {

namespace {

/// The residue and atom of a bead. Residue and atom identify the beads that results name by number.
struct BeadRow {
  BeadId bead = 0;
  std::size_t necklace = 0;  ///< from 0, in the order of the scene
  BeadName name;             ///< empty if the file has no names
  double radius = 0;
};

constexpr CommandSpec kInfoCommand{
    "kds info",
    "Describes trajectories, and decides exactly which conditions of a proper necklace they violate.",
    {},
    {},
    "kds info villin.dcd --topology villin.pdb --frames ::10\n"
    "kds info 1a4y.pdb --radius element:fit --rho 2 --json -\n"
    "kds info 1a4y.pdb --beads",
};

const OptionList<InfoOptions>& info_options() {
  using O = InfoOptions;
  static const auto list =
      OptionList<O>()
          .with(input_options())
          .with(&O::validate,
                {{real_option(
                      {"--rho", "NUMBER",
                       "largest ratio of two radii, or of two bonds, that counts as uniform (default: any)"},
                      &ValidateOptions::rho, {1, std::numeric_limits<double>::max()}),
                  of_output(whole_option(
                      {"--list", "N", "number of violations to list for each condition (default: 5)"},
                      &ValidateOptions::most_listed, 0, 1'000'000))}})
          .with({of_output(flag_option(
              "--beads", "list the beads instead, one per row: necklace, chain, residue, atom and radius",
              &O::beads))})
          .with(destination_options("write info.json, info.csv and report.html to DIR (default: none)",
                                    "write the results to FILE; - is standard output (default: none)"));
  return list;
}

}  // namespace

InfoOptions parse_info_options(const Arguments& arguments) {
  InfoOptions options;
  const ParsedArguments parsed =
      read_arguments(with_inputs(kInfoCommand, true), info_options(), arguments, options);
  take_inputs(parsed, kInfoCommand.name, options);
  for (const char* const option : {"--beads", "--rho", "--list"})
    if (parsed.has(option)) options.of_trajectories = option;
  if (options.beads && (parsed.has("--rho") || parsed.has("--list")))
    throw InputError("--beads",
                     fmt::format("lists no conditions; expected no {} and no {}", "--rho"_arg, "--list"_arg));
  return options;
}

namespace {

// Returns the rows. `radii` has one radius per bead in scene order.
std::vector<BeadRow> bead_rows(std::span<const Trajectory> necklaces, std::span<const double> radii) {
  std::vector<BeadRow> rows;
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    const std::vector<std::string>& names = necklaces[n].bead_names;
    for (std::size_t b = 0; b < necklaces[n].bead_count(); ++b) {
      const auto bead = static_cast<BeadId>(rows.size());
      BeadRow& row = rows.emplace_back(BeadRow{bead, n, {}, radii[bead]});
      if (b < names.size()) row.name = bead_name_of(names[b]).value_or(BeadName());
    }
  }
  return rows;
}

// Returns the columns of JSON, CSV and the terminal.
const Table<BeadRow>& bead_columns() {
  using Row = BeadRow;
  const auto digits = [](const Field& number) { return number.csv(); };
  const auto part = [](const char* key, std::string BeadName::*name) {
    return Column<Row>{key, key, [name](const Row& r) { return text_or_nothing(r.name.*name); }};
  };
  static const Table<Row> table{{
      {"bead", "bead", [](const Row& r) { return Field(r.bead); }, digits},
      {"necklace", "necklace", [](const Row& r) { return Field(r.necklace); }, digits},
      part("chain", &BeadName::chain),
      part("residue", &BeadName::residue),
      part("number", &BeadName::number),
      part("atom", &BeadName::atom),
      {"radius", "radius", [](const Row& r) { return Field(r.radius); }, with_figures(6)},
  }};
  return table;
}

// An instance file has weighted points rather than balls in a chain, so there are no conditions to check.
void describe(const Instance& instance, const InfoOptions& options, const TableCommand& command) {
  if (options.of_trajectories)
    throw InputError(*options.of_trajectories,
                     fmt::format("has no meaning for an instance file ({})", instance.file));
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
  const SceneInfo info = describe_input(options, command.progress(), command.warn());
  Json json;
  add_scene(json, info);
  json["settings"] = info_options().settings_json(options);
  json["warnings"] = command.warnings();
  command.deliver(json, conditions_csv(info), scene_table(info));
}

// Counts crossings once more through all frames. A run may refuse an input that can be described.
void add_crossings(SceneInfo& info, const InfoOptions& options, std::unique_ptr<FrameSource> frames,
                   FrameSurvey survey, const std::vector<double>& radii,
                   const std::function<void(std::size_t, std::size_t)>& progress,
                   const std::function<void(const std::string&)>& warn) {
  if (survey.frame_count < 2) return;
  frames->seek(0);
  survey.periodic = survey.periodic && options.periodic;
  try {
    const Scene scene(std::move(frames), survey, radii);
    if (scene.dimension() == 3 && scene.bonds().empty())
      info.why_no_crossings = "no beads are known to be bonded";
    if (!has_crossings(scene)) return;
    warn_of_cells("crossings", scene.lacks_images(), options, warn);
    info.crossings = count_crossings(scene, progress);
  } catch (const InputError& refusal) {
    info.why_no_crossings = refusal.what();
  }
}

}  // namespace

SceneInfo describe_input(const InfoOptions& options,
                         const std::function<void(std::size_t, std::size_t)>& progress,
                         const std::function<void(const std::string&)>& warn) {
  auto frames = open_frames(options, warn);
  const FrameSurvey survey = survey_frames(*frames, options.radius == "auto", warn);
  const std::vector<double> radii = bead_radii(options.radius, frames->necklaces(), survey);
  SceneInfo info =
      describe_frames(frames->heads(), frames->frame_counts(), *frames, radii, options.validate, progress);
  info.first_time = survey.first.picoseconds;
  info.last_time = survey.last.picoseconds;
  info.truncated = survey.truncated;
  info.length_unit = length_unit(options);
  add_crossings(info, options, std::move(frames), survey, radii, progress, warn);
  return info;
}

int info_command(const Arguments& arguments) {
  const InfoOptions options = parse_info_options(arguments);
  TableCommand command("info", arguments, options, "frame");
  check_inputs_exist(options);
  TakenPaths taken;
  taken.read(options);
  command.check_destinations(taken);

  if (const std::optional<Instance> instance = read_lone_instance(options)) {
    describe(*instance, options, command);
  } else if (options.beads) {
    describe_beads(options, command);
  } else {
    describe(options, command);
  }
  return 0;
}

}  // namespace kds
