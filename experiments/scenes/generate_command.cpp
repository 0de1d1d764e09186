#include "experiments/scenes/generate_command.h"

#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <optional>
#include <utility>

#include "experiments/output/output_files.h"
#include "experiments/output/text.h"
#include "experiments/program/commands.h"
#include "experiments/program/option.h"
#include "experiments/program/option_values.h"
#include "experiments/program/table_command.h"
#include "experiments/scenes/scene_info.h"
#include "motions/base/input_error.h"
#include "motions/base/text_input.h"
#include "motions/models/shapes.h"
#include "motions/readers/write_trajectory.h"

namespace kds {

namespace {

using models::Setting;
using models::Settings;
using models::ShapeMotion;

constexpr std::uint64_t kMostBeads = 10'000'000, kMostFrames = 1'000'000, kMostPositions = 100'000'000;

models::Span parse_span(std::string_view option, const std::string& text, const RealRange& range) {
  const std::vector<std::string> ends = split(text, ':');
  if (ends.size() > 2) throw InputError(option, fmt::format("'{}' is not a number or FROM:TO", text));
  return {parse_real(option, ends.front(), range), parse_real(option, ends.back(), range)};
}

std::string text_of(const models::Span& span) {
  return span.first == span.last ? fmt::format("{}", span.first)
                                 : fmt::format("{}:{}", span.first, span.last);
}

Option<Settings> span_option(OptionSpec spec, std::optional<models::Span> Settings::*member,
                             const RealRange& range) {
  return value_option(
      spec, member, [=](const std::string& text) { return parse_span(spec.name, text, range); }, text_of);
}

/// Returns an option for the models that have this setting.
Option<GenerateOptions> of_models(Setting setting, const Option<Settings>& of_settings) {
  using O = GenerateOptions;
  Option<O> option = OptionList<O>().with(&O::settings, OptionList<Settings>{{of_settings}}).all().front();
  option.read = [setting, name = option.spec.name, read = option.read](O& o, const std::string& text) {
    if (!o.model->takes(setting))
      throw InputError(name, fmt::format("has no meaning for the model {}", o.model->name));
    read(o, text);
  };
  option.text = [setting, show = option.text](const O& o) {
    return o.model->takes(setting) ? show(o) : std::string();
  };
  return option;
}

/// In JSON all settings are text as on the command line, numbers included.
const OptionList<GenerateOptions>& generate_options() {
  using O = GenerateOptions;
  using S = Settings;
  static const OptionList<O> list =
      OptionList<O>()
          .with({of_output(path_option(
              {"-o", "FILE",
               "file to write (required): .xyz (exact) or .pdb, .ent (three decimals). two-spirals writes "
               "two files: for `-o two-spirals.xyz` they are two-spirals-1.xyz and two-spirals-2.xyz"},
              &O::file))})
          .with(
              &O::settings,
              {{whole_option({"--beads", "N",
                              "number of beads, at least 2 (required). A grill of 3 to 43 beads (except 40) "
                              "and a spline of 7 overlap"},
                             &S::beads, 2, kMostBeads),
                whole_option({"--frames", "F", "number of frames (default: 50)"}, &S::frames, 1, kMostFrames),
                whole_option({"--seed", "S", "seed of the random numbers (default: 1)"}, &S::seed, 0,
                             ~std::uint64_t{0})}})
          .with({
              of_models(Setting::motion,
                        choice_option({"--motion", "NAME",
                                       "how a shape moves: rest, rotate (rigidly) or wander (bead by bead, "
                                       "without collisions) (default: rotate; random-chain: wander)"},
                                      &S::motion, models::shape_motion_names)),
              of_models(Setting::step, real_option({"--step", "X",
                                                    "distance that a bead moves in a frame, in radii "
                                                    "(default: 0.1)"},
                                                   &S::step, {0, 1000})),
              of_models(Setting::bond,
                        real_option({"--bond", "X",
                                     "distance between consecutive beads, in diameters (default: 0.999)"},
                                    &S::bond, {0.5, 1, true})),
              of_models(Setting::turns,
                        real_option({"--turns", "X",
                                     "turns of a helix or spiral (default: 10 for a helix, 18 for spirals, "
                                     "fewer if the beads have no room for them)"},
                                    &S::turns, {0, 1e6})),
              of_models(Setting::pitch,
                        real_option({"--pitch", "X",
                                     "distance between the turns of a scaling-helix, in bonds (default: 2)"},
                                    &S::pitch, {0, 1e6, true})),
              of_models(
                  Setting::gap,
                  real_option({"--gap", "X", "gap between the rows of a grid, in diameters (default: 0.05)"},
                              &S::gap, {0, 0.9})),
              of_models(Setting::dimension,
                        whole_option({"--dimension", "D",
                                      "dimension of a grid or spline and of its motion: 2 or 3 (default: 3)"},
                                     &S::dimension, 2, 3)),
              of_models(Setting::jitter,
                        real_option({"--jitter", "X",
                                     "random displacement of the beads of a grid, in radii (default: 0)"},
                                    &S::jitter, {0, 1000})),
              of_models(
                  Setting::fill,
                  real_option({"--fill", "X", "share of its cube that a random-chain fills (default: 0.2)"},
                              &S::fill, {1e-6, 0.5})),
              of_models(Setting::rolled,
                        span_option({"--rolled", "FROM:TO",
                                     "how far spirals are rolled up in the first and in the last frame: 0 is "
                                     "straight, 1 rolled up (default: 0:1)"},
                                    &S::rolled, {0, 1})),
              of_models(
                  Setting::distance,
                  span_option(
                      {"--distance", "FROM:TO",
                       "two-spirals: distance between the centres of the spirals in the first and in the "
                       "last frame, in chain lengths; a single number applies to both frames (default: 1.5)"},
                      &S::distance, {0, 1e6})),
          })
          .with(
              destination_options("write generate.json, generate.csv and report.html to DIR (default: none)",
                                  "write a summary to FILE; - is standard output (default: none)"));
  return list;
}

std::vector<std::string_view> model_names() {
  std::vector<std::string_view> names;
  for (const models::Model& model : models::all_models()) names.push_back(model.name);
  return names;
}

const CommandSpec& command() {
  static const std::string operands = fmt::format("one of {}", fmt::join(model_names(), ", "));
  static const CommandSpec spec{
      "kds generate",
      "Writes a moving model necklace with beads of radius 1, and reports whether it is a proper necklace.",
      "MODEL", operands,
      "kds generate random-chain --beads 10240 --frames 20 --step 0.01 -o chain.xyz\n"
      "kds generate two-spirals --beads 1000 --frames 50 --turns 9 -o spirals.xyz"};
  return spec;
}

const models::Model& model_of(const ParsedArguments& parsed) {
  if (parsed.operands().size() != 1)
    throw InputError(fmt::format("kds generate needs one MODEL, {}", command().operand_help));
  const models::Model* model = models::find_model(parsed.operands().front());
  if (model == nullptr) refuse_unknown(words("MODEL", "model"), parsed.operands().front(), model_names());
  return *model;
}

void check_file(const std::filesystem::path& file) {
  if (file.empty()) throw InputError("-o: give the FILE to write, with the ending .xyz, .pdb or .ent");
  const std::string ending = file_ending(file);
  if (ending == ".xyz" || ending == ".pdb" || ending == ".ent") return;
  throw InputError(fmt::format("-o {}: no format has the ending {}; expected .xyz, .pdb or .ent",
                               file.string(), in_quotes(ending)));
}

void check_wandering(const Settings& settings) {
  constexpr double most = 2;
  if (settings.motion == ShapeMotion::wander && *settings.step > most)
    throw InputError(
        "--step",
        fmt::format("{} is too large; expected at most {}, as far as beads that keep their bonds can wander",
                    *settings.step, most));
}

}  // namespace

bool GenerateOptions::is_pdb() const { return file_ending(file) != ".xyz"; }

GenerateOptions parse_generate_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(command(), generate_options().specs(), arguments);
  GenerateOptions options;
  options.model = &model_of(parsed);
  if (!parsed.has("--beads")) throw InputError("--beads", "give the number of beads");
  generate_options().read(parsed, options);
  const Settings& settings = options.settings;
  if (settings.beads * settings.frames > kMostPositions)
    throw InputError("--frames", fmt::format("{} beads in {} frames are more than {} positions; give less",
                                             settings.beads, settings.frames, kMostPositions));
  options.settings = completed(*options.model, settings);
  if (settings.frames == 1 && parsed.has("--step"))
    throw InputError("--step", "one frame does not move; expected --frames from 2");
  if (settings.motion == ShapeMotion::rest) {
    if (parsed.has("--step"))
      throw InputError(
          "--step", fmt::format("beads at rest do not move; expected {} rotate or wander", "--motion"_arg));
    options.settings.step.reset();
  }
  check_wandering(options.settings);
  check_file(options.file);
  return options;
}

std::vector<std::pair<std::string, std::string>> model_settings(const GenerateOptions& options) {
  auto settings = generate_options().settings(options);
  std::erase_if(settings, [](const auto& setting) { return setting.second.empty(); });
  return settings;
}

namespace {

namespace fs = std::filesystem;

// Returns one file per necklace. For two necklaces, a.xyz becomes a-1.xyz and a-2.xyz.
std::vector<fs::path> files_of(const GenerateOptions& options) {
  if (options.model->name != "two-spirals") return {options.file};
  std::vector<fs::path> files;
  for (const char* suffix : {"-1", "-2"}) {
    fs::path name = options.file.stem();
    name += suffix;
    name += options.file.extension();
    files.push_back(options.file.parent_path() / name);
  }
  return files;
}

std::string command_line(const GenerateOptions& options) {
  std::string text = fmt::format("kds generate {}", options.model->name);
  for (const auto& [name, value] : model_settings(options)) text += fmt::format(" --{} {}", name, value);
  return text;
}

// Refuses to replace a-1.xyz and a-2.xyz, which the user did not name, unless kds generate wrote them.
void refuse_unnamed(const GenerateOptions& options, const fs::path& file) {
  std::error_code error;
  if (file == options.file || !fs::exists(file, error)) return;
  std::ifstream there(file, std::ios::binary);
  std::string start(200, '\0');
  there.read(start.data(), static_cast<std::streamsize>(start.size()));
  if (start.find("kds generate ") == std::string::npos)
    throw InputError(
        fmt::format("-o {}: {} exists and was not written by kds generate; move it or give another FILE",
                    options.file.string(), file.string()));
}

// Completes all files before the first takes its place.
void write_files(const GenerateOptions& options, const std::vector<Trajectory>& necklaces) {
  AtomicFiles files;
  for (const Trajectory& necklace : necklaces) {
    std::ostream& file = files.open(necklace.file);
    if (options.is_pdb()) {
      write_pdb(file, necklace, command_line(options));
    } else {
      write_xyz(file, necklace, command_line(options));
    }
  }
  commit_together({&files});
}

// Returns the necklaces as a reader of the files will get them.
std::vector<Trajectory> necklaces_for(const GenerateOptions& options, const std::vector<fs::path>& files) {
  std::vector<Trajectory> necklaces = generate(*options.model, options.settings);
  for (std::size_t n = 0; n < necklaces.size(); ++n) {
    const std::string file = files[n].string();
    if (options.is_pdb()) necklaces[n] = as_in_pdb(necklaces[n], file);
    necklaces[n].file = file;
  }
  return necklaces;
}

void deliver(const GenerateOptions& options, const SceneInfo& info, const TableCommand& command) {
  Json json;
  json["model"] = options.model->name;
  add_scene(json, info);
  json["settings"] = Json::object();
  std::string table = fmt::format("model     {}", options.model->name);
  for (const auto& [name, value] : model_settings(options)) {
    json["settings"][name] = value;
    table += fmt::format(", {} {}", name, value);
  }
  command.deliver(json, conditions_csv(info), table + "\n" + scene_table(info));
}

}  // namespace

int generate_command(const Arguments& arguments) {
  const GenerateOptions options = parse_generate_options(arguments);
  TableCommand command("generate", arguments, options, "frame");
  const std::vector<fs::path> files = files_of(options);
  TakenPaths taken;
  for (const fs::path& file : files) {
    ensure_writable_file(file, "-o");
    refuse_unnamed(options, file);
    taken.add("-o", file);
  }
  command.check_destinations(taken);

  const std::vector<Trajectory> necklaces = necklaces_for(options, files);
  std::size_t beads = 0;
  for (const Trajectory& necklace : necklaces) beads += necklace.bead_count();
  const std::vector<double> radii(beads, models::radius);
  const SceneInfo info = describe_scene(necklaces, radii, {.most_listed = 5}, command.progress());
  command.bar().erase();
  write_files(options, necklaces);
  deliver(options, info, command);
  return 0;
}

}  // namespace kds
