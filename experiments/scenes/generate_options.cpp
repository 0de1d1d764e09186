#include "experiments/scenes/generate_options.h"

#include <algorithm>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/file_ending.h"
#include "motions/base/text_input.h"

namespace kds {

namespace {

using models::Setting;
using models::Settings;
using models::ShapeMotion;

constexpr std::uint64_t kMostBeads = 10'000'000, kMostFrames = 1'000'000, kMostPositions = 100'000'000;

// An option of some models: what help says, and how the value goes into the settings and out again.
struct ModelOption {
  Setting setting;
  OptionSpec spec;
  void (*read)(std::string_view option, const std::string& text, Settings&);
  std::string (*write)(const Settings&);
};

models::Span parse_span(std::string_view option, const std::string& text, const RealRange& range) {
  const std::vector<std::string> ends = split(text, ':');
  if (ends.size() > 2) throw InputError(fmt::format("{}: '{}' is not a number or FROM:TO", option, text));
  return {parse_real(option, ends.front(), range), parse_real(option, ends.back(), range)};
}

std::string text_of(const models::Span& span) {
  return span.first == span.last ? fmt::format("{}", span.first)
                                 : fmt::format("{}:{}", span.first, span.last);
}

void read_motion(std::string_view option, const std::string& text, Settings& s) {
  s.motion = choice_of<ShapeMotion>(option, text, models::shape_motion_names);
}

std::string motion_name(const Settings& s) { return std::string(name_of(*s.motion)); }

template <std::optional<double> Settings::*member>
std::string write_real(const Settings& s) {
  return fmt::format("{}", *(s.*member));
}

// clang-format off
constexpr std::array kModelOptions{
    ModelOption{Setting::motion, {"--motion", "NAME", "of a shape: rest, rotate (rigidly) or wander (bead by bead, kept apart)"
                                  " (default: rotate; random-chain: wander)"},
                read_motion, motion_name},
    ModelOption{Setting::step, {"--step", "X", "how far beads move in a frame, in radii (default: 0.1)"},
                [](auto o, auto& t, Settings& s) { s.step = parse_real(o, t, {0, 1000}); }, write_real<&Settings::step>},
    ModelOption{Setting::bond, {"--bond", "X", "distance of consecutive beads, in diameters (default: 0.999)"},
                [](auto o, auto& t, Settings& s) { s.bond = parse_real(o, t, {0.5, 1, true}); }, write_real<&Settings::bond>},
    ModelOption{Setting::turns, {"--turns", "X", "turns of a helix or spiral (default: helix 10, spirals 18, fewer where the beads leave no room)"},
                [](auto o, auto& t, Settings& s) { s.turns = parse_real(o, t, {0, 1e6}); }, write_real<&Settings::turns>},
    ModelOption{Setting::pitch, {"--pitch", "X", "distance of the turns of a scaling-helix, in bonds (default: 2)"},
                [](auto o, auto& t, Settings& s) { s.pitch = parse_real(o, t, {0, 1e6, true}); }, write_real<&Settings::pitch>},
    ModelOption{Setting::gap, {"--gap", "X", "between the rows of a grid, in diameters (default: 0.05)"},
                [](auto o, auto& t, Settings& s) { s.gap = parse_real(o, t, {0, 0.9}); }, write_real<&Settings::gap>},
    ModelOption{Setting::dimension, {"--dimension", "D", "of a grid and its motion, 2 or 3 (default: 3)"},
                [](auto o, auto& t, Settings& s) { s.dimension = static_cast<int>(parse_whole_number(o, t, 2, 3)); },
                [](const Settings& s) { return fmt::format("{}", *s.dimension); }},
    ModelOption{Setting::jitter, {"--jitter", "X", "how far the beads of a grid are moved at random, in radii (default: 0)"},
                [](auto o, auto& t, Settings& s) { s.jitter = parse_real(o, t, {0, 1000}); }, write_real<&Settings::jitter>},
    ModelOption{Setting::fill, {"--fill", "X", "share of its cube that a random-chain fills (default: 0.2)"},
                [](auto o, auto& t, Settings& s) { s.fill = parse_real(o, t, {1e-6, 0.5}); }, write_real<&Settings::fill>},
    ModelOption{Setting::rolled, {"--rolled", "FROM:TO", "how far spirals are rolled up in the first and last frame (default: 0:1)"},
                [](auto o, auto& t, Settings& s) { s.rolled = parse_span(o, t, {0, 1}); },
                [](const Settings& s) { return text_of(*s.rolled); }},
    ModelOption{Setting::distance, {"--distance", "FROM:TO", "of two spirals, in chain lengths (default: 1.5)"},
                [](auto o, auto& t, Settings& s) { s.distance = parse_span(o, t, {0, 1e6}); },
                [](const Settings& s) { return text_of(*s.distance); }},
};
// clang-format on

constexpr std::array kFirstOptions{
    OptionSpec{"-o", "FILE",
               "where to write: .xyz (exact) or .pdb, .ent (three decimals); two-spirals: FILE-1 and FILE-2"},
    OptionSpec{"--beads", "N",
               "how many, from 2 (must be given); beads of a grill of 3 to 43 meet, except of 40, and those "
               "of a spline of 7"},
    OptionSpec{"--frames", "F", "how many (default: 50)"},
    OptionSpec{"--seed", "S", "which random numbers (default: 1)"},
};

constexpr std::array kLastOptions{
    OptionSpec{"--out", "DIR", "write generate.json and generate.csv there (default: none)"},
    OptionSpec{"--json", "FILE", "write a summary there; - is standard output (default: none)"},
    OptionSpec{"--quiet", "", "no table, no progress bar"},
};

constexpr std::array<OptionSpec, kModelOptions.size()> model_specs() {
  std::array<OptionSpec, kModelOptions.size()> specs{};
  for (std::size_t i = 0; i < specs.size(); ++i) specs[i] = kModelOptions[i].spec;
  return specs;
}

constexpr auto kGenerateOptions = joined(kFirstOptions, joined(model_specs(), kLastOptions));

std::vector<std::string_view> model_names() {
  std::vector<std::string_view> names;
  for (const models::Model& model : models::all_models()) names.push_back(model.name);
  return names;
}

const CommandSpec& command() {
  static const std::string operands = fmt::format("one of {}", fmt::join(model_names(), ", "));
  static const CommandSpec spec{
      "kds generate",
      "Writes a moving model necklace with beads of radius 1, and tells whether it is a proper one.",
      "MODEL",
      operands,
      kGenerateOptions,
      "kds generate random-chain --beads 10240 --frames 20 --step 0.01 -o chain.xyz\n"
      "kds generate two-spirals --beads 1000 --frames 50 --turns 9 -o spirals.xyz"};
  return spec;
}

const models::Model& model_of(const ParsedArguments& parsed) {
  if (parsed.operands().size() != 1)
    throw InputError(fmt::format("kds generate needs one MODEL, {}", command().operand_help));
  const models::Model* model = models::find_model(parsed.operands().front());
  if (model == nullptr) refuse_unknown("MODEL", parsed.operands().front(), model_names());
  return *model;
}

std::filesystem::path file_of(const ParsedArguments& parsed) {
  const auto path = path_of(parsed, "-o");
  if (!path) throw InputError("-o: give the FILE to write, with the ending .xyz, .pdb or .ent");
  const std::string ending = file_ending(*path);
  if (ending == ".xyz" || ending == ".pdb" || ending == ".ent") return *path;
  throw InputError(
      fmt::format("-o {}: the ending {} tells no format that is written; expected .xyz, .pdb or "
                  ".ent",
                  path->string(), in_quotes(ending)));
}

void check_wandering(const Settings& settings) {
  constexpr double most = 2;
  if (settings.motion == ShapeMotion::wander && *settings.step > most)
    throw InputError(
        fmt::format("--step: {} is not at most {}, as far as beads that keep their bonds can wander",
                    *settings.step, most));
}

}  // namespace

bool GenerateOptions::is_pdb() const { return file_ending(file) != ".xyz"; }

GenerateOptions parse_generate_options(const Arguments& arguments) {
  const ParsedArguments parsed = parse_arguments(command(), arguments);
  GenerateOptions options;
  options.model = &model_of(parsed);
  Settings settings;
  const auto beads = parsed.value("--beads");
  if (!beads) throw InputError("--beads: give the number of beads");
  settings.beads = parse_whole_number("--beads", *beads, 2, kMostBeads);
  settings.frames = parse_whole_number("--frames", parsed.value("--frames").value_or("50"), 1, kMostFrames);
  settings.seed = parse_whole_number("--seed", parsed.value("--seed").value_or("1"), 0, ~std::uint64_t{0});
  if (settings.beads * settings.frames > kMostPositions)
    throw InputError(fmt::format("--frames: {} beads in {} frames are more than {} positions; give less",
                                 settings.beads, settings.frames, kMostPositions));
  for (const ModelOption& option : kModelOptions) {
    const auto text = parsed.value(option.spec.name);
    if (!text) continue;
    if (!options.model->takes(option.setting))
      throw InputError(
          fmt::format("{}: has no meaning for the model {}", option.spec.name, options.model->name));
    option.read(option.spec.name, *text, settings);
  }
  options.settings = completed(*options.model, settings);
  check_wandering(options.settings);
  options.file = file_of(parsed);
  options.out = path_of(parsed, "--out");
  options.json = parsed.value("--json");
  options.quiet = parsed.has("--quiet");
  return options;
}

std::vector<std::pair<std::string, std::string>> model_settings(const GenerateOptions& options) {
  const Settings& s = options.settings;
  std::vector<std::pair<std::string, std::string>> result{{"beads", fmt::format("{}", s.beads)},
                                                          {"frames", fmt::format("{}", s.frames)},
                                                          {"seed", fmt::format("{}", s.seed)}};
  for (const ModelOption& option : kModelOptions)
    if (options.model->takes(option.setting))
      result.emplace_back(option.spec.name.substr(2), option.write(s));
  return result;
}

}  // namespace kds
