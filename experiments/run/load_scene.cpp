#include "experiments/run/load_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <utility>

#include "experiments/output/text.h"
#include "motions/base/input_error.h"
#include "motions/base/interruption.h"
#include "motions/base/text_input.h"
#include "motions/live/live_address.h"
#include "motions/readers/bead_name.h"
#include "motions/readers/pdb_reader.h"
#include "motions/readers/reader_registry.h"
#include "motions/scene/length_unit.h"
#include "motions/scene/radii.h"
#include "motions/scene/straightened_frames.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

namespace {

// Throws InputError if the command cannot follow a running simulation, or if options for one are given
// without one.
void check_live_options(const InputOptions& options) {
  if (is_live(options)) {
    if (!options.takes_live)
      throw InputError(fmt::format(
          "{}: only {} follow a running simulation, which gives each frame once; "
          "expected a file",
          file_names(options),
          words("kds run, contacts and compare", "kds.run, kds.contacts, kds.compare and kds.stream")));
    if (std::ranges::count_if(options.inputs, is_live_address) > 1)
      throw InputError("two inputs are running simulations; expected one, and files of one frame beside it");
    const FrameRange& frames = options.reading.frames;
    if (frames.last && *frames.last <= frames.first + frames.stride)
      throw InputError(frames_argument(), fmt::format("{} is one frame; a run needs two", name_of(frames)));
    if (options.reading.cell && !options.periodic)
      throw InputError("--cell", fmt::format("has no meaning with {}", "--no-periodic"_arg));
    return;
  }
  const ReadOptions& reading = options.reading;
  const std::string_view given = reading.until      ? "--until"
                                 : reading.patience ? "--patience"
                                 : reading.cell     ? "--cell"
                                 : reading.rate     ? "--rate"
                                                    : "";
  if (!given.empty())
    throw InputError(given, fmt::format("is for a running simulation; expected its address, {}, as an input",
                                        live_example));
}

}  // namespace

std::optional<Instance> read_lone_instance(const InputOptions& options) {
  check_live_options(options);
  const auto instance = std::find_if(options.inputs.begin(), options.inputs.end(),
                                     [](const auto& path) { return is_instance_file(path); });
  if (instance == options.inputs.end()) return std::nullopt;
  const std::string file = instance->string();
  if (options.inputs.size() > 1)
    throw InputError(file + ": an instance file runs alone, without further inputs");
  const auto refuse = [&](bool given, std::string_view option) {
    if (given) throw InputError(option, fmt::format("has no meaning for an instance file ({})", file));
  };
  const ReadOptions& reading = options.reading;
  refuse(reading.topology.has_value() || !options.topologies.empty(), "--topology");
  refuse(reading.chain.has_value(), "--chain");
  refuse(reading.selection != Selection::automatic, "--select");
  refuse(reading.frames.first != 0 || reading.frames.last || reading.frames.stride != 1, frames_argument());
  refuse(reading.format.has_value(), "--format");
  refuse(!reading.groups.empty(), "--groups");
  refuse(reading.time_step.has_value(), "--dt");
  refuse(reading.units.has_value(), "--units");
  refuse(reading.until_damage, "--until-damage");
  refuse(options.velocities.has_value(), "--velocities");
  refuse(reading.unwrap.has_value(), "--unwrap");
  refuse(!options.periodic, "--no-periodic");
  refuse(options.radius != "auto", "--radius");
  refuse(options.obstacle.has_value(), "--obstacle");
  return read_instance(*instance);
}

SignalsEndLiveInput::SignalsEndLiveInput(const InputOptions& options) {
  if (!is_live(options)) return;
  withdraw_live_end();
  struct sigaction action {};
  action.sa_handler = [](int) { request_live_end(); };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) != 0 || before.sa_handler == SIG_IGN) continue;
    if (::sigaction(signal, &action, nullptr) == 0) before_.emplace_back(signal, before);
  }
}

SignalsEndLiveInput::~SignalsEndLiveInput() {
  for (const auto& [signal, before] : before_) static_cast<void>(::sigaction(signal, &before, nullptr));
}

void require_ascending_times(const InputOptions& input, const Scene& scene) {
  if (scene.is_live()) return;  // LiveFrames checks each frame
  for (std::size_t frame = 1; frame < scene.frame_count(); ++frame) {
    const FrameStamp before = scene.stamp(frame - 1), now = scene.stamp(frame);
    if (!before.picoseconds || !now.picoseconds || *before.picoseconds < *now.picoseconds) continue;
    throw InputError(
        fmt::format("{}: the time does not advance from frame {}, {} ps, to frame {}, {} ps; lengths of time "
                    "need ascending times, expected {} PS or other {}",
                    file_names(input), before.number, *before.picoseconds, now.number, *now.picoseconds,
                    "--dt"_arg, frames_argument()));
  }
}

void refuse_instance(const InputOptions& options, std::string_view what) {
  if (const auto instance = read_lone_instance(options))
    throw InputError(fmt::format("{}: an instance file has {}; expected a trajectory", instance->file, what));
}

namespace {

/// The atoms of an input, used to decide whether two inputs have the same atoms.
struct InputAtoms {
  std::filesystem::path file;
  std::vector<std::string> names;  // bead names; empty if the file has none
  std::size_t beads = 0;
  bool one_frame = false;
};

InputAtoms atoms_of(const std::filesystem::path& file, const std::vector<Trajectory>& necklaces,
                    bool one_frame) {
  InputAtoms atoms{file, {}, 0, one_frame};
  for (const Trajectory& necklace : necklaces) {
    atoms.names.insert(atoms.names.end(), necklace.bead_names.begin(), necklace.bead_names.end());
    atoms.beads += necklace.bead_count();
  }
  return atoms;
}

bool takes_topology(const std::filesystem::path& file) {
  const ReaderSpec* const reader = reader_registry().find_by_ending(file);
  return reader != nullptr && reader->takes_topology;
}

// Returns whether a file with one frame has the atoms of `other`: their bead names agree or, if `other` has
// no names, their numbers of beads or atoms agree.
bool has_atoms_of(const InputAtoms& one, const InputAtoms& other, const ReadOptions& reading) {
  if (one.names.empty()) return false;
  if (!other.names.empty()) return one.names == other.names;
  return one.beads == other.beads || read_topology(one.file, reading).atom_count == other.beads;
}

// Throws InputError if a structure file with several models accompanies a trajectory of its atoms that has no
// names. The file is more likely meant to name the atoms than to be a second necklace.
void check_models_are_no_topology(const std::vector<InputAtoms>& inputs, const InputOptions& options) {
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    for (const InputAtoms& other : inputs) {
      if (inputs[i].one_frame || !other.names.empty() || !takes_topology(other.file) ||
          !has_atoms_of(inputs[i], other, reading_of(options, i)))
        continue;
      throw InputError(fmt::format("{}: has the atoms of {}, which has no names; expected {} {} in its place",
                                   inputs[i].file.string(), other.file.string(), "--topology"_arg,
                                   inputs[i].file.string()));
    }
  }
}

void check_inputs_of_one_frame(const std::vector<InputAtoms>& inputs, const InputOptions& options,
                               const std::function<void(const std::string&)>& warn) {
  check_models_are_no_topology(inputs, options);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const InputAtoms& one = inputs[i];
    const auto moves =
        std::find_if(inputs.begin(), inputs.end(), [](const InputAtoms& input) { return !input.one_frame; });
    if (!one.one_frame || moves == inputs.end()) continue;
    for (const InputAtoms& other : inputs) {
      if (other.one_frame || !has_atoms_of(one, other, reading_of(options, i))) continue;
      const std::string file = one.file.string(), moving = other.file.string();
      const bool may_name =
          takes_topology(other.file) && !options.reading.topology && options.topologies.empty();
      throw InputError(fmt::format(
          "{}: has one frame and the atoms of {}; {} ({} {} makes it a necklace at rest)", file, moving,
          may_name ? fmt::format("expected {} {}, which names them", "--topology"_arg, file)
                   : "expected one of the two",
          "--obstacle"_arg, file));
    }
    warn(fmt::format("{}: has one frame and rests while {} moves ({} avoids this warning)", one.file.string(),
                     moves->file.string(), "--obstacle"_arg));
  }
}

// Throws InputError if all files hold one frame and it is not the range of --frames. Beside a moving file,
// such a file is at rest, whatever the range.
void check_range_of_one_frame(const std::vector<NecklaceStream>& files, const FrameRange& range) {
  const bool all_at_rest = std::all_of(files.begin(), files.end(),
                                       [](const NecklaceStream& file) { return file.holds_one_frame(); });
  const std::size_t last = range.last.value_or(range.first + 1) - 1;  // the last frame asked for
  if (!all_at_rest || last == 0) return;
  throw InputError(frames_argument(),
                   fmt::format("frame {} is asked for, {} holds 1 frame",
                               range.first > 0 ? range.first : last, files.front().heads().front().file));
}

// Describes the beads by the names of their atoms, the first and the last bead.
std::string described(const std::vector<std::string>& names) {
  constexpr std::size_t most = 6;
  std::vector<std::string> atoms;
  for (const std::string& name : names) {
    const std::optional<BeadName> parts = bead_name_of(name);
    if (!parts || std::find(atoms.begin(), atoms.end(), parts->atom) != atoms.end()) continue;
    atoms.push_back(atoms.size() < most ? parts->atom : "...");
    if (atoms.size() > most) break;
  }
  if (atoms.empty()) return counted(names.size(), "bead");
  return fmt::format("{} ({}), from {} to {}", counted(names.size(), "bead"), fmt::join(atoms, ", "),
                     names.front(), names.back());
}

// Throws InputError if a group of --groups has no bead.
void check_groups_have_beads(const std::vector<Selection>& groups,
                             const std::vector<NecklaceBeads>& necklaces) {
  const BeadGroups of_beads = bead_groups(necklaces);
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (std::any_of(of_beads.begin(), of_beads.end(),
                    [k](std::uint8_t of_bead) { return (of_bead >> k & 1U) != 0; }))
      continue;
    std::vector<std::string> names;
    for (const NecklaceBeads& necklace : necklaces)
      names.insert(names.end(), necklace.names.begin(), necklace.names.end());
    throw InputError("--groups", fmt::format("{} chooses none of the beads that are read: {}",
                                             in_quotes(groups[k].text()), described(names)));
  }
}

// Returns whether the selection takes atoms that are not bonded to the ones before them.
bool takes_side_chains(const std::vector<NecklaceStream>& files, const Selection& selection) {
  return selection == Selection::all ||
         std::any_of(files.begin(), files.end(),
                     [](const NecklaceStream& file) { return !file.chain_like(); });
}

}  // namespace

std::unique_ptr<FileFrames> open_frames(const InputOptions& options,
                                        const std::function<void(const std::string&)>& warn,
                                        std::size_t stride) {
  check_live_options(options);
  std::vector<NecklaceStream> files;
  std::vector<InputAtoms> atoms;
  for (std::size_t i = 0; i < options.inputs.size(); ++i) {
    ReadOptions reading = reading_of(options, i);
    reading.frames.stride *= stride;
    NecklaceStream& file = files.emplace_back(options.inputs[i], reading);
    if (options.inputs.size() > 1)
      atoms.push_back(atoms_of(options.inputs[i], file.heads(), file.holds_one_frame()));
  }
  check_inputs_of_one_frame(atoms, options, warn);
  check_range_of_one_frame(files, options.reading.frames);
  if (takes_side_chains(files, options.reading.selection) && options.radius == "auto")
    warn(
        fmt::format("{} {} with {} auto: consecutive atoms need not be bonded, and the radius is half of "
                    "their longest distance; {} element takes van der Waals radii",
                    "--select"_arg, options.reading.selection.text(), "--radius"_arg, "--radius"_arg));
  if (options.obstacle) {
    ReadOptions reading = reading_of(options, options.inputs.size());
    reading.topology = std::nullopt;
    reading.frames = {};
    reading.format = std::nullopt;     // --format is that of the inputs
    reading.time_step = std::nullopt;  // it has no time of its own
    NecklaceStream& obstacle = files.emplace_back(*options.obstacle, reading);
    if (!obstacle.holds_one_frame())
      throw InputError("--obstacle",
                       fmt::format("{} has several frames, expected one", options.obstacle->string()));
  }
  auto frames = std::make_unique<FileFrames>(std::move(files), options.obstacle.has_value());
  check_groups_have_beads(options.reading.groups, frames->necklaces());
  return frames;
}

namespace {

/// The only frame of a source, twice.
class LoneFrameTwice final : public FrameSource {
 public:
  explicit LoneFrameTwice(std::unique_ptr<FrameSource> source) : source_(std::move(source)) {}

  [[nodiscard]] const std::vector<NecklaceBeads>& necklaces() const override { return source_->necklaces(); }
  [[nodiscard]] bool next(FrameRead& frame) override {
    if (next_ == 2) return false;
    source_->seek(0);
    if (!source_->next(frame)) return false;
    frame.stamp.number += next_++;
    if (frame.stamp.picoseconds && next_ == 2) ++*frame.stamp.picoseconds;  // times must ascend
    return true;
  }
  void seek(std::size_t k) override { next_ = k; }

 private:
  std::unique_ptr<FrameSource> source_;
  std::size_t next_ = 0;
};

}  // namespace

LiveInput open_live(const InputOptions& input, const std::function<void(const std::string&)>& warn) {
  if (input.radius == "auto")
    throw InputError("--radius", fmt::format("auto is half of the longest bond of all frames, and {} is a "
                                             "running simulation; expected a length, element or file:PATH",
                                             file_names(input)));
  if (input.radius.starts_with("element") && !input.reading.topology && input.topologies.empty())
    throw InputError("--radius",
                     fmt::format("{}: {} names no elements; expected {} FILE, which does, or a length",
                                 input.radius, file_names(input), "--topology"_arg));
  InputOptions opened = input;
  opened.reading.velocities = input.velocities == VelocitySource::file;
  auto frames = std::make_unique<LiveFrames>(open_frames(opened, warn));
  FrameSurvey survey = frames->survey();
  if (opened.reading.velocities && !survey.velocities)
    throw InputError(
        "--velocities",
        fmt::format("file: {} sends no velocities with times; expected differences", file_names(input)));
  if (!input.periodic) {
    survey.periodic = false;
    frames->leave_cells();
  }
  Eigen::Index begin = 0;
  for (const NecklaceBeads& necklace : frames->necklaces()) {
    const auto beads = static_cast<Eigen::Index>(necklace.count);
    const std::string doubt =
        nanometres_doubt(survey.first_positions.middleCols(begin, beads), necklace.breaks);
    if (!doubt.empty()) warn(fmt::format("{}: {}", necklace.file, doubt));
    begin += beads;
  }
  std::vector<double> radii = bead_radii(input.radius, frames->necklaces(), survey);
  return {std::move(frames), std::move(survey), std::move(radii)};
}

Scene load_necklaces(const InputOptions& input, FrameMotion motion, double radius_factor,
                     const std::function<void(const std::string&)>& warn,
                     const std::optional<MotionTolerance>& tolerance, bool* lone_frame) {
  for (const std::filesystem::path& path : input.inputs)
    if (input.radius == "array" && std::filesystem::exists(path))
      throw InputError("--radius",
                       "array is for positions in memory; expected file:PATH, with a line a bead");
  if (input.velocities && motion != FrameMotion::hermite)
    throw InputError("--velocities",
                     fmt::format("is of Hermite curves; expected {} hermite", "--motion"_arg));
  InputOptions opened = input;
  opened.reading.velocities =
      motion == FrameMotion::hermite && input.velocities != VelocitySource::differences;
  if (is_live(input)) {
    if (tolerance)
      throw InputError("--tolerance",
                       "needs frames ahead of time; expected a file, not a running simulation");
    LiveInput live = open_live(input, warn);
    for (double& radius : live.radii) radius *= radius_factor;
    return {std::move(live.frames), live.survey, std::move(live.radii), motion};
  }
  std::unique_ptr<FileFrames> files = open_frames(opened, warn);
  FrameSurvey survey = survey_frames(*files, input.radius == "auto", warn);
  survey.periodic = survey.periodic && input.periodic;
  const bool repeats = lone_frame != nullptr && survey.frame_count == 1;
  if (survey.frame_count < 2 && !repeats && !files->early_end().empty())
    throw InputError(fmt::format("{}; a run needs at least two frames", files->early_end()));
  if (survey.velocities && survey.error_with_velocities > 1) {
    const std::string worse = fmt::format(
        "with the velocities of the file, curves through every other frame miss the frames in "
        "between by {:.3g} times the error of differences",
        survey.error_with_velocities);
    if (input.velocities) {
      warn(fmt::format("{}: {}", file_names(input), worse));
    } else {
      survey.leave_velocities(worse);
    }
  }
  if (opened.reading.velocities && !survey.velocities && (!repeats || input.velocities)) {
    if (input.velocities)
      throw InputError(
          "--velocities",
          fmt::format("file: {}; expected velocities and ascending times in all frames",
                      survey.lacks_velocities.empty() ? "no frame has velocities" : survey.lacks_velocities));
    if (!survey.lacks_velocities.empty())
      warn(fmt::format("{}: velocities are differences of frames, because {}", file_names(input),
                       survey.lacks_velocities));
  }
  std::unique_ptr<FrameSource> frames = std::move(files);
  if (repeats) {
    frames = std::make_unique<LoneFrameTwice>(std::move(frames));
    survey.frame_count = 2;
    *lone_frame = true;
  }
  std::vector<double> radii = bead_radii(input.radius, frames->necklaces(), survey);
  for (double& radius : radii) radius *= radius_factor;
  if (tolerance) frames = std::make_unique<StraightenedFrames>(std::move(frames), tolerance->length(radii));
  return {std::move(frames), survey, std::move(radii), motion};
}

void warn_of_images(std::string_view what, const std::function<void(const std::string&)>& warn) {
  warn(fmt::format("{} ignores the images of beads across the walls of the periodic cell", what));
}

void warn_of_cells(std::string_view what, const std::string& lacks_images, const InputOptions& input,
                   const std::function<void(const std::string&)>& warn) {
  if (input.periodic && !lacks_images.empty())
    warn(fmt::format("{} across the walls of the cell are not found, because {}", what, lacks_images));
}

namespace {

// Sets the probe of a run, and warns about its structures.
void complete(Scene& scene, const RunOptions& options, const std::function<void(const std::string&)>& warn) {
  scene.set_probe(options.probe_length());
  for (const std::string& name :
       options.structures.empty() ? default_structures(scene) : options.structures) {
    const StructureSpec* const spec = structure_registry().find(name);
    if (spec == nullptr) continue;
    if (spec->lacks_images && scene.is_periodic()) warn_of_images(name, warn);
    if ((name == "dual" || name == "voids") && options.radius == "auto" && scene.probe() == 0)
      warn(
          fmt::format("{}: with {} auto the balls of a chain just touch, so their complex hardly changes; "
                      "expected {} element, or a number",
                      name, "--radius"_arg, "--radius"_arg));
    if (!spec->across_walls.empty()) warn_of_cells(spec->across_walls, scene.lacks_images(), options, warn);
  }
}

}  // namespace

Scene scene_of_run(const RunOptions& options, std::unique_ptr<FrameSource> frames, const FrameSurvey& survey,
                   std::vector<double> radii, const std::function<void(const std::string&)>& warn) {
  Scene scene(std::move(frames), survey, std::move(radii), options.motion);
  complete(scene, options, warn);
  return scene;
}

Scene load_scene(const RunOptions& options, const std::function<void(const std::string&)>& warn,
                 bool* lone_frame) {
  const InputOptions& input = options;
  if (std::optional<Instance> instance = read_lone_instance(input)) {
    if (options.motion != FrameMotion::linear)
      throw InputError("--motion", fmt::format("has no meaning for an instance file ({})",
                                               options.inputs.front().string()));
    if (options.tolerance)
      throw InputError("--tolerance", fmt::format("has no meaning for an instance file ({})",
                                                  options.inputs.front().string()));
    if (options.probe)
      throw InputError("--probe", fmt::format("has no meaning for an instance file, whose weights are given "
                                              "({})",
                                              options.inputs.front().string()));
    return Scene(std::move(*instance));
  }
  InputOptions opened = input;
  // Contacts of centres need no radii.
  if (is_live(input) && input.radius == "auto" && options.distances.first() &&
      !options.distances.between_surfaces && options.structures == std::vector<std::string>{"contacts"})
    opened.radius = "1";
  Scene scene = load_necklaces(opened, options.motion, 1, warn, options.tolerance, lone_frame);
  complete(scene, options, warn);
  return scene;
}

namespace {

// Throws InputError if --log, --events or --audit events is given for chord cages, which have no events.
void refuse_events_of_chords(const RunOptions& options, const KineticRunOptions& kinetic) {
  const std::string asked = options.log                           ? "--log"
                            : options.events                      ? "--events"
                            : kinetic.audits == AuditMode::events ? "--audit"_arg + " events"
                                                                  : "";
  if (asked.empty()) return;
  for (const std::string& name : kinetic.structures) {
    const StructureSpec* const spec = structure_registry().find(name);
    if (spec == nullptr || spec->has_events(kinetic.settings)) continue;
    throw InputError(
        fmt::format("{}: {} has {}, which have no events; expected {}", asked, name,
                    name == "wrapped" ? "chord cages" : "spheres of each frame",
                    name == "wrapped" ? "--between"_arg + " events" : "--structures"_arg + " without it"));
  }
}

// Throws InputError if the range of --nodes ends beyond the last bead. The open end of --nodes FIRST: is
// stored as the largest number and is accepted. A range that starts beyond the last bead selects no node and
// is refused later.
void refuse_nodes_behind_the_beads(const RunOptions& options, const Scene& scene) {
  if (!options.nodes.beads) return;
  const auto [first, last] = *options.nodes.beads;
  const std::size_t beads = scene.bead_count();
  if (last == std::numeric_limits<BeadId>::max() || last < beads || first >= beads) return;
  throw InputError(fmt::format("{} {}:{}: expected beads of the input, which has {} beads", "--nodes"_arg,
                               first, std::uint64_t{last} + 1, beads));
}

}  // namespace

KineticRunOptions kinetic_run_options(const RunOptions& options, const Scene& scene, AuditMode audits) {
  KineticRunOptions kinetic{options.structures, options.kernel, audits, {.nodes = options.nodes}};
  kinetic.settings.apart = options.apart.value_or(kinetic.settings.apart);
  kinetic.settings.between = options.between.value_or(kinetic.settings.between);
  kinetic.settings.tightness = options.tightness;
  kinetic.settings.directions = options.directions;
  kinetic.settings.stretch = options.stretch.value_or(kinetic.settings.stretch);
  kinetic.settings.contact_distance = options.distances.first();
  kinetic.settings.groups = scene.bead_groups();
  if (kinetic.structures.empty()) kinetic.structures = default_structures(scene);
  if (std::ranges::count(kinetic.structures, "closest") > 0) {
    if (options.apart)
      throw InputError("--apart", fmt::format("closest looks at all pairs of beads; run it without {}, or "
                                              "let {} find the closest pair of each frame",
                                              "--apart"_arg, words("kds collide --apart", "kds.collide")));
    if (!options.reading.groups.empty())
      throw InputError("--groups",
                       fmt::format("closest looks at all pairs of beads; run it without {}", "--groups"_arg));
  }
  motion_and_structure_options().refuse_needless(
      kinetic.structures, "among the structures",
      [&](const Option<RunOptions>& option) { return !option.text(options).empty(); });
  if (options.tightness && kinetic.settings.between != Between::chord)
    throw InputError("--tightness", fmt::format("applies only to chord cages of wrapped; expected {} chord",
                                                "--between"_arg));
  refuse_events_of_chords(options, kinetic);
  refuse_nodes_behind_the_beads(options, scene);
  if (options.nodes.restricts()) {
    const NecklaceTree tree(scene.necklaces());
    const std::vector<std::uint8_t> kept = select_nodes(tree, options.nodes);
    if (std::find(kept.begin(), kept.end(), 1) == kept.end())
      throw InputError(fmt::format(
          "{}, {}: no node is left of {}; expected levels and beads of the input, which has {} beads",
          "--levels"_arg, "--nodes"_arg, tree.node_count(), scene.bead_count()));
  }
  return kinetic;
}

namespace {

// Constructs a run. Turns a refusal of a structure into an error of the option.
template <class Run, class... Arguments>
std::unique_ptr<Run> open(const Scene& scene, const Arguments&... arguments) {
  try {
    return std::make_unique<Run>(scene, arguments...);
  } catch (const StructureRefusal& refusal) {
    if (scene.is_lifted())
      throw InputError(fmt::format("{} lifted: {}; expected {} power", "--motion"_arg, refusal.what(),
                                   "--structures"_arg));
    throw InputError(fmt::format("{} {}", "--structures"_arg, refusal.what()));
  }
}

}  // namespace

std::unique_ptr<KineticRun> open_run(const RunOptions& options, const Scene& scene, AuditMode audits) {
  return open<KineticRun>(scene, kinetic_run_options(options, scene, audits));
}

std::unique_ptr<ParallelRun> open_parallel_run(const RunOptions& options, const Scene& scene,
                                               AuditMode audits, ParallelOptions parallel,
                                               const std::function<void(const std::string&)>& warn) {
  const bool is_recorded = options.view.has_value();  // a replay reads the structures while the run goes on
  parallel.threads = is_recorded ? 1 : options.threads.value_or(all_threads());
  auto run = open<ParallelRun>(scene, kinetic_run_options(options, scene, audits), parallel);
  if (options.work) run->limit_work(*options.work);
  const std::optional<std::string> reason =
      is_recorded ? std::optional<std::string>("--view"_arg + " records the structures as it goes on")
                  : run->uncut();
  if (options.threads.value_or(1) > 1 && reason)
    warn(fmt::format("{} {}: the run is not cut and takes one thread, because {}", "--threads"_arg,
                     *options.threads, *reason));
  if (!reason) hint_at_threads(options.threads, scene.step_count(), scene.bead_count(), warn);
  return run;
}

void hint_at_threads(std::optional<std::size_t> threads, std::size_t steps, std::size_t beads,
                     const std::function<void(const std::string&)>& warn, const std::string& subject) {
  if (!threads) return;
  const std::size_t taken = threads_worth(steps, beads, *threads);
  if (taken < *threads)
    warn(fmt::format("{}{} {}: the run takes {}, because {} threads need at least {} steps and it has {}",
                     subject, "--threads"_arg, *threads, taken, taken + 1,
                     with_thousands((taken + 1) * least_steps_of_thread(beads)), with_thousands(steps)));
}

}  // namespace kds
