#include "experiments/program/input_options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "experiments/output/text.h"
#include "experiments/program/option_values.h"
#include "motions/base/input_error.h"
#include "motions/base/input_file.h"
#include "motions/frames/periodic.h"
#include "motions/live/live_address.h"
#include "motions/readers/instance.h"
#include "motions/readers/reader_registry.h"

namespace kds {

std::filesystem::path source_data_folder() { return KDS_SOURCE_DATA_DIR; }

namespace {

/// Returns whether a LAMMPS dump says that its units are `lj`.
bool names_reduced_units(const std::filesystem::path& path) {
  constexpr std::size_t most_lines = 12;  // the atoms of the first frame begin before
  LineReader lines(path);
  std::string_view line;
  bool units = false;
  while (lines.number() < most_lines && lines.next(line)) {
    if (units) return line == name_of(LammpsUnits::lj);
    units = line.starts_with("ITEM: UNITS");
  }
  return false;
}

std::string parse_radius(const std::string& rule) {
  // `array` is the rule of positions in memory with a radius for each bead; files refuse it.
  if (rule == "auto" || rule == "element" || rule == "element:fit" || rule == "array") return rule;
  if (constexpr std::string_view prefix = "file:"; rule.starts_with(prefix)) {
    if (rule.size() == prefix.size())
      throw InputError("--radius", "file: needs a path, as in file:radii.txt");
    return rule;
  }
  double number = 0;
  const auto [end, error] = std::from_chars(rule.data(), rule.data() + rule.size(), number);
  if (error == std::errc() && end == rule.data() + rule.size() && std::isfinite(number) && number > 0)
    return rule;
  constexpr std::array<std::string_view, 4> names{"auto", "element", "element:fit", "file:"};
  // Words that other programs use for van der Waals radii.
  constexpr std::array<std::string_view, 7> van_der_waals{"vdw",   "vdwaals",  "van-der-waals", "vanderwaals",
                                                          "bondi", "elements", "atomic"};
  throw InputError(
      "--radius", fmt::format("'{}' is not auto, a positive number, element, element:fit or file:PATH{}",
                              rule, suggestion(nearest_name(rule, van_der_waals) ? "element" : rule, names)));
}

// The user cannot ask for `automatic`.
Selection parse_selection(std::string_view option, const std::string& text) {
  if (const std::optional<Selection> selection = Selection::parse(text, option)) return *selection;
  const auto names = std::span(selection_names).subspan(1);
  const std::vector<std::string> atoms = split(text, ',');
  constexpr std::size_t longest = 4;
  const bool may_be_atoms = std::all_of(atoms.begin(), atoms.end(), [](const std::string& atom) {
    return !atom.empty() && atom.size() <= longest && atom.find_first_of(" \t!*") == std::string::npos;
  });
  throw InputError(option,
                   fmt::format("'{}' is not one of {}, nor an atom selection as in {}{}{}", text,
                               fmt::join(names, ", "), selection_example, suggestion(text, names),
                               may_be_atoms ? fmt::format("; //*//{} chooses atoms by name", text) : ""));
}

// A file whose name has a comma is a file, not a list.
void read_topologies(InputOptions& options, const std::string& text) {
  std::error_code none;
  const std::vector<std::string> files = split(text, ',');
  if (files.size() == 1 || std::filesystem::exists(text, none)) {
    options.reading.topology = parse_path("--topology", text);
    return;
  }
  for (const std::string& file : files)
    options.topologies.push_back(file.empty() ? std::filesystem::path() : parse_path("--topology", file));
}

std::string topologies_text(const InputOptions& options, bool absolute) {
  const auto text_of = [absolute](const std::filesystem::path& path) {
    return (absolute && !path.empty() ? std::filesystem::absolute(path) : path).string();
  };
  if (options.reading.topology) return text_of(*options.reading.topology);
  std::vector<std::string> files;
  for (const std::filesystem::path& path : options.topologies) files.push_back(text_of(path));
  return fmt::format("{}", fmt::join(files, ","));
}

// --chain has one list for all inputs, or one list per input and optionally one more for the obstacle.
void check_chains(const std::string& chains, std::size_t inputs, bool obstacle) {
  const std::vector<std::string> lists = split(chains, '/');
  if (lists.size() > 1 && lists.size() != inputs && !(obstacle && lists.size() == inputs + 1))
    throw InputError("--chain", fmt::format("'{}' is for {} INPUTs, but {} {} given", chains, lists.size(),
                                            inputs, inputs == 1 ? "is" : "are"));
  for (const std::string& list : lists) {
    if (list.empty() && lists.size() > 1) continue;  // this input keeps its default chain
    const std::vector<std::string> names = split(list, ',');
    for (const std::string& name : names) {
      if (name.empty())
        throw InputError("--chain",
                         fmt::format("'{}' leaves a name empty; expected names as in A,B", chains));
      if (std::count(names.begin(), names.end(), name) > 1)
        throw InputError("--chain", fmt::format("{} is listed twice in '{}'", name, list));
    }
  }
}

}  // namespace

void check_exists(const std::filesystem::path& path) {
  refuse_standard_input(path);
  std::error_code error;
  if (!std::filesystem::exists(path, error)) throw InputError(fmt::format("{}: no such file", path.string()));
  if (std::filesystem::is_directory(path, error))
    throw InputError(fmt::format("{}: is a directory, expected a file", path.string()));
  require_regular_file(path);
}

CommandSpec with_inputs(CommandSpec command, bool or_instance, bool or_live) {
  static const std::string trajectories =
      fmt::format("a necklace: {} (also .gz)", reader_registry().endings());
  static const std::string with_instances = trajectories + ", or an instance file";
  static const std::string live = fmt::format(", or {}, a running simulation", live_example);
  static const std::string with_live = trajectories + live, with_both = with_instances + live;
  command.operand = kInputOperand;
  command.operand_help =
      or_live ? (or_instance ? with_both : with_live) : (or_instance ? with_instances : trajectories);
  return command;
}

namespace {

OptionList<InputOptions> make_input_options() {
  static const std::string topology_help = fmt::format(
      "file that names the atoms of the inputs if their format does not: {}. With several INPUTs, a comma "
      "list has one for each: A.pdb,B.pdb (default: none, and every atom is a bead)",
      reader_registry().topology_endings());
  static const std::string format_help =
      fmt::format("format of the inputs: {} (default: by content, otherwise by ending)",
                  fmt::join(reader_registry().names_with_frames(), ", "));
  std::vector<Option<InputOptions>> options{
      {{"--topology", "FILE", topology_help},
       read_topologies,
       [](const InputOptions& o) { return topologies_text(o, false); },
       [](const InputOptions& o) { return topologies_text(o, true); }},
      {{"--select", "NAME",
        "atoms that become beads. NAME is backbone, ca, bb, p, heavy or all; or an atom selection, as in "
        "'//A/10-40/CA,CB'. backbone: N, CA and C of each residue; bb: backbone of Martini; p: phosphorus of "
        "nucleic acids; heavy: all but hydrogens and massless sites (default: backbone, or all if the file "
        "names no residues)"},
       [](InputOptions& o, const std::string& text) {
         o.reading.selection = parse_selection("--select", text);
       },
       [](const InputOptions& o) { return o.reading.selection.text(); },
       [](const InputOptions& o) {
         const bool is_asked_for = o.reading.selection != Selection::automatic;
         return is_asked_for ? o.reading.selection.text() : "";
       }},
      {{"--chain", "IDS",
        "chains to read, each one necklace: A,B. With several INPUTs separate their lists by /: A,B/C. A.2 "
        "is the second molecule of chain A; 2 is the second molecule without a chain name (default: the "
        "first polymer chain)"},
       [](InputOptions& o, const std::string& text) { o.reading.chain = text; },
       [](const InputOptions& o) { return o.reading.chain.value_or(""); }},
      {{"--frames", "RANGE",
        "frames to read: FIRST:LAST:STRIDE, counted from 0; frame LAST itself is not read (default: all)"},
       [](InputOptions& o, const std::string& text) { o.reading.frames = parse_frame_range(text); },
       [](const InputOptions& o) { return name_of(o.reading.frames); }},
      {{"--format", "NAME", format_help},
       [](InputOptions& o, const std::string& text) {
         const std::vector<std::string> names = reader_registry().names_with_frames();
         const std::vector<std::string_view> views(names.begin(), names.end());
         o.reading.format = names[index_among("--format", text, views)];
       },
       [](const InputOptions& o) { return o.reading.format.value_or(""); }},
      {{"--dt", "PS",
        "picoseconds from one frame of the file to the next (default: times as in the file, if it has any)"},
       [](InputOptions& o, const std::string& text) {
         o.reading.time_step = parse_real("--dt", text, {0, 1e12, true});
       },
       [](const InputOptions& o) {
         return o.reading.time_step ? fmt::format("{}", *o.reading.time_step) : "";
       }},
      {{"--units", "NAME",
        "unit style of LAMMPS dumps: real or metal (angstrom), lj (lengths as they are, no times) or nano "
        "(nanometres) (default: as the dump says, otherwise angstrom)"},
       [](InputOptions& o, const std::string& text) {
         o.reading.units = choice_of("--units", text, lammps_units_names, LammpsUnits::real);
       },
       [](const InputOptions& o) { return std::string(o.reading.units ? name_of(*o.reading.units) : ""); }},
      {{"--until-damage", "", "read the frames before a damaged frame instead of refusing the file"},
       [](InputOptions& o, const std::string&) { o.reading.until_damage = true; },
       [](const InputOptions& o) { return o.reading.until_damage ? "yes" : ""; },
       nullptr,
       [](const InputOptions& o) { return Json(o.reading.until_damage); }},
      {{"--unwrap", "HOW",
        "how beads move through the walls of a periodic cell: chains (molecules are made whole and move as a "
        "whole), beads (each bead moves to the image nearest to its place in the frame before) or none (as "
        "the file has them) (default: chains; beads for a file that names no molecules and whose consecutive "
        "beads are not all near each other)"},
       [](InputOptions& o, const std::string& text) {
         o.reading.unwrap = choice_of("--unwrap", text, unwrap_names, Unwrap::none);
       },
       [](const InputOptions& o) { return std::string(o.reading.unwrap ? name_of(*o.reading.unwrap) : ""); }},
      {{"--no-periodic", "", "ignore periodic images of beads"},
       [](InputOptions& o, const std::string&) { o.periodic = false; },
       [](const InputOptions& o) { return o.periodic ? "" : "yes"; },
       nullptr,
       [](const InputOptions& o) { return Json(!o.periodic); }},
      {{"--radius", "RULE",
        "radii of the beads: auto (half of the longest bond in the frames read), a number, element (van der "
        "Waals), element:fit (element times one factor, at most 1, at which only neighbours may touch in the "
        "first frame) or file:PATH (default: auto)"},
       [](InputOptions& o, const std::string& text) { o.radius = parse_radius(text); },
       [](const InputOptions& o) { return o.radius; },
       [](const InputOptions& o) {
         if (!o.radius.starts_with("file:")) return o.radius;
         return "file:" + std::filesystem::absolute(o.radius.substr(5)).string();
       }},
  };
  for (Option<InputOptions>& option : options) option.spec.of_inputs = true;
  return {std::move(options)};
}

}  // namespace

const OptionList<InputOptions>& input_options() {
  static const OptionList<InputOptions> list = make_input_options();
  return list;
}

std::string inputs_help() {
  constexpr CommandSpec command{
      "kds COMMAND",
      "Options that all commands with INPUTs take. The help of a command has its other options.",
      {},
      {},
      "kds run villin.dcd --topology villin.pdb --frames 0:200\n"
      "kds info complex.cif --chain A,B --select '//*/CA'"};
  std::vector<OptionSpec> specs = input_options().specs();
  for (OptionSpec& spec : specs) spec.of_inputs = false;
  return help_text(with_inputs(command, true, true), specs);
}

const Option<InputOptions>& obstacle_option() {
  static const Option<InputOptions> option =
      path_option({"--obstacle", "FILE",
                   fmt::format("file with a necklace of one frame that does not move. In {} its list comes "
                               "last, after a / (default: none)",
                               "--chain"_arg)},
                  &InputOptions::obstacle);
  return option;
}

const Option<InputOptions>& velocities_option() {
  static const Option<InputOptions> option(
      {"--velocities", "NAME",
       "velocities of Hermite curves: file (TRR, AMBER NetCDF, LAMMPS dumps, IMD of version 3) or "
       "differences "
       "(of positions) (default: file if all frames of the file have velocities and times, and these help; "
       "otherwise differences)"},
      [](InputOptions& o, const std::string& text) {
        o.velocities = choice_of("--velocities", text, velocity_source_names, VelocitySource::differences);
      },
      [](const InputOptions& o) { return std::string(o.velocities ? name_of(*o.velocities) : ""); });
  return option;
}

namespace {

Cell parse_cell(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& part : split(text, ','))
    numbers.push_back(parse_real("--cell", part, {0, 1e9, true}));
  if (numbers.size() != 3 && numbers.size() != 6)
    throw InputError(
        "--cell", fmt::format("expected three lengths, or three lengths and three angles, found {}", text));
  numbers.resize(6, 90);
  const CellRead cell = read_cell_from_angles(Eigen::Map<const Eigen::Vector3d>(numbers.data()),
                                              Eigen::Map<const Eigen::Vector3d>(numbers.data() + 3));
  if (!cell.cell)
    throw InputError("--cell", fmt::format("{}: {}", text,
                                           cell.doubt.empty() ? "expected lengths from 1 on" : cell.doubt));
  return *cell.cell;
}

}  // namespace

const OptionList<InputOptions>& live_options() {
  static const std::string rate_help = fmt::format(
      "ask a running simulation to send only every Nth step; {} is then the time of N steps (default: what "
      "it "
      "sends)",
      "--dt"_arg);
  static const OptionList<InputOptions> list = [] {
    std::vector<Option<InputOptions>> options{
        {{"--until", "TIME",
          "with a running simulation: end after this time, in picoseconds if the frames have times, "
          "otherwise "
          "in frames (default: when the simulation ends)"},
         [](InputOptions& o, const std::string& text) {
           o.reading.until = parse_real("--until", text, {-1e12, 1e12});
         },
         [](const InputOptions& o) { return o.reading.until ? fmt::format("{}", *o.reading.until) : ""; }},
        {{"--cell", "A,B,C",
          "periodic cell of a running simulation, if it sends none and the cell does not change: three "
          "lengths in angstrom and, unless all angles are 90 degrees, three angles: A,B,C,ALPHA,BETA,GAMMA "
          "(default: none)"},
         [](InputOptions& o, const std::string& text) {
           o.reading.cell = parse_cell(text);
           o.cell = text;
         },
         [](const InputOptions& o) { return o.cell; }},
        {{"--rate", "N", rate_help},
         [](InputOptions& o, const std::string& text) {
           o.reading.rate = static_cast<unsigned>(parse_whole_number("--rate", text, 1, 1'000'000'000));
         },
         [](const InputOptions& o) { return o.reading.rate ? fmt::format("{}", *o.reading.rate) : ""; }},
        {{"--patience", "SECONDS",
          "with a running simulation: how long to wait for the connection and for each frame (default: 60)"},
         [](InputOptions& o, const std::string& text) {
           o.reading.patience = parse_real("--patience", text, {0, 1e9, true});
         }},
    };
    for (Option<InputOptions>& option : options) option.shown_if_given = true;
    return options;
  }();
  return list;
}

Option<InputOptions> groups_option(const std::string& help) {
  Option<InputOptions> groups({"--groups", "SEL1 SEL2", help, 2});
  groups.read_values = [](InputOptions& o, const std::vector<std::string>& texts) {
    for (const std::string& text : texts) o.reading.groups.push_back(parse_selection("--groups", text));
  };
  groups.values = [](const InputOptions& o) {
    std::vector<std::string> texts;
    for (const Selection& group : o.reading.groups) texts.push_back(group.text());
    return texts;
  };
  groups.text = [values = groups.values](const InputOptions& o) { return shell_words(values(o)); };
  return groups;
}

void take_inputs(const ParsedArguments& parsed, std::string_view command, InputOptions& options) {
  if (parsed.operands().empty())
    throw InputError(fmt::format("{0} needs at least one INPUT (see {0} --help)", command));
  for (const std::string& input : parsed.operands()) {
    if (input.empty()) throw InputError("an INPUT is empty; give the path of a file");
    options.inputs.emplace_back(input);
  }
  check_input_lists(options);
}

void check_input_lists(const InputOptions& options) {
  if (!options.topologies.empty() && options.topologies.size() != options.inputs.size())
    throw InputError("--topology",
                     fmt::format("lists {} files for {} {}{}; expected one file for all, or one for each",
                                 options.topologies.size(), options.inputs.size(),
                                 options.inputs.size() == 1 ? "INPUT" : "INPUTs",
                                 std::ranges::any_of(options.topologies, &std::filesystem::path::empty)
                                     ? " (an empty entry stands for none)"
                                     : ""));
  if (options.reading.chain)
    check_chains(*options.reading.chain, options.inputs.size(), options.obstacle.has_value());
}

ReadOptions reading_of(const InputOptions& options, std::size_t input) {
  ReadOptions reading = options.reading;
  if (input < options.topologies.size() && !options.topologies[input].empty())
    reading.topology = options.topologies[input];
  if (!reading.chain) return reading;
  const std::vector<std::string> lists = split(*reading.chain, '/');
  // A single list holds for all inputs. The obstacle comes after the inputs and has the default chain
  // unless it has a list of its own.
  const bool has_own = lists.size() > 1 || input >= options.inputs.size();
  const std::string own = !has_own                                   ? lists.front()
                          : input < lists.size() && lists.size() > 1 ? lists[input]
                                                                     : "";
  reading.chain = own.empty() ? std::nullopt : std::optional(own);
  return reading;
}

std::string name_of(const FrameRange& frames) {
  return fmt::format("{}:{}:{}", frames.first, frames.last ? std::to_string(*frames.last) : "",
                     frames.stride);
}

std::string input_name(const InputOptions& options, std::size_t input) {
  const std::filesystem::path& path = options.inputs[input];
  return options.reading.format == "memory" ? path.filename().string() : path.string();
}

std::string file_names(const InputOptions& options) {
  std::vector<std::string> names;
  for (const auto& input : options.inputs)
    names.push_back((is_live_address(input) ? input : input.filename()).string());
  return fmt::format("{}", fmt::join(names, ", "));
}

Json files_json(const InputOptions& options) {
  Json files = Json::array();
  for (const auto& input : options.inputs) files.push_back(input.string());
  if (options.obstacle) files.push_back(options.obstacle->string());
  return files;
}

bool in_angstrom(const InputOptions& options) {
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    if (is_instance_file(options.inputs[i])) return false;
    const ReadOptions reading = reading_of(options, i);
    const ReaderSpec* const reader = reader_registry().find(options.inputs[i], reading.format);
    if (reader == nullptr) continue;
    if (reader->name == "xyz") return false;
    if (reader->name != "lammps") continue;
    if (reading.units ? *reading.units == LammpsUnits::lj : names_reduced_units(options.inputs[i]))
      return false;
  }
  return true;
}

InputSize size_of(const Scene& scene) {
  return {scene.bead_count(),
          scene.necklaces().size(),
          scene.frame_count(),
          scene.dimension(),
          scene.is_truncated(),
          scene.velocities(),
          {scene.stamp(0), scene.stamp(scene.frame_count() - 1)}};
}

std::string_view velocities_text(const std::optional<VelocitySource>& velocities) {
  if (!velocities) return "";
  return *velocities == VelocitySource::file ? ", velocities of the file" : ", velocities by differences";
}

void add_ends(Json& input, const std::array<FrameStamp, 2>& ends) {
  const auto& [first, last] = ends;
  input["first_frame"] = first.number;
  input["last_frame"] = last.number;
  if (first.picoseconds && last.picoseconds)
    input["picoseconds"] = std::vector<double>{*first.picoseconds, *last.picoseconds};
}

Json input_json(const InputOptions& options, const InputSize& size, double radius_min, double radius_max) {
  Json json{{"files", files_json(options)}, {"beads", size.beads}};
  if (size.necklaces) json["necklaces"] = *size.necklaces;
  json["frames"] = size.frames;
  json["dimension"] = size.dimension;
  json["truncated"] = size.truncated;
  json["radius_min"] = radius_min;
  json["radius_max"] = radius_max;
  json["length_unit"] = length_unit(options);
  if (size.velocities) json["velocities"] = name_of(*size.velocities);
  add_ends(json, size.ends);
  return json;
}

Json input_json(const InputOptions& options, InputSize size, std::span<const double> radii) {
  const auto [least, most] = std::minmax_element(radii.begin(), radii.end());
  size.beads = radii.size();
  return input_json(options, size, *least, *most);
}

bool is_live(const InputOptions& options) { return std::ranges::any_of(options.inputs, is_live_address); }

void check_inputs_exist(const InputOptions& options) {
  for (const std::filesystem::path& input : options.inputs)
    if (!is_live_address(input)) check_exists(input);
  if (options.reading.topology) check_exists(*options.reading.topology);
  for (const std::filesystem::path& topology : options.topologies)
    if (!topology.empty()) check_exists(topology);
  if (options.obstacle) check_exists(*options.obstacle);
}

}  // namespace kds
