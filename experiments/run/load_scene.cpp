#include "experiments/run/load_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "motions/base/input_error.h"
#include "motions/scene/radii.h"
#include "structures/necklace/necklace_tree.h"

namespace kds {

std::optional<Instance> read_lone_instance(const InputOptions& options) {
  const auto instance = std::find_if(options.inputs.begin(), options.inputs.end(),
                                     [](const auto& path) { return is_instance_file(path); });
  if (instance == options.inputs.end()) return std::nullopt;
  const std::string file = instance->string();
  if (options.inputs.size() > 1)
    throw InputError(file + ": an instance file runs alone, without further inputs");
  const auto refuse = [&](bool given, const char* option) {
    if (given) throw InputError(fmt::format("{}: has no meaning for an instance file ({})", option, file));
  };
  const ReadOptions& reading = options.reading;
  refuse(reading.topology.has_value(), "--topology");
  refuse(reading.chain.has_value(), "--chain");
  refuse(reading.selection != Selection::automatic, "--select");
  refuse(reading.frames.first != 0 || reading.frames.last || reading.frames.stride != 1, "--frames");
  refuse(options.radius != "auto", "--radius");
  return read_instance(*instance);
}

std::vector<Trajectory> read_necklaces(const InputOptions& options,
                                       const std::function<void(const std::string&)>& warn) {
  std::vector<Trajectory> necklaces;
  for (std::size_t i = 0; i < options.inputs.size(); ++i)
    for (Trajectory& necklace : read_trajectories(options.inputs[i], reading_of(options, i))) {
      for (const std::string& warning : necklace.warnings) warn(warning);
      necklaces.push_back(std::move(necklace));
    }
  return necklaces;
}

Scene load_necklaces(const InputOptions& input, FrameMotion motion, double radius_factor,
                     const std::function<void(const std::string&)>& warn,
                     const std::optional<MotionTolerance>& tolerance) {
  std::vector<NecklaceStream> files;
  for (std::size_t i = 0; i < input.inputs.size(); ++i)
    files.emplace_back(input.inputs[i], reading_of(input, i));
  auto frames = std::make_unique<SceneStream>(std::move(files));
  const SceneSurvey survey = frames->survey(input.radius == "auto", warn);
  std::vector<double> radii = bead_radii(input.radius, survey.necklaces, survey.bonds);
  for (double& radius : radii) radius *= radius_factor;
  if (tolerance) frames->straighten(tolerance->length(radii));
  return {std::move(frames), survey, std::move(radii), motion};
}

Scene load_scene(const RunOptions& options, const std::function<void(const std::string&)>& warn) {
  const InputOptions input{options.inputs, options.reading, options.radius};
  if (std::optional<Instance> instance = read_lone_instance(input)) {
    if (options.motion != FrameMotion::linear)
      throw InputError(
          fmt::format("--motion: has no meaning for an instance file ({})", options.inputs.front().string()));
    if (options.tolerance)
      throw InputError(fmt::format("--tolerance: has no meaning for an instance file ({})",
                                   options.inputs.front().string()));
    return Scene(std::move(*instance));
  }
  return load_necklaces(input, options.motion, 1, warn, options.tolerance);
}

namespace {

// Between frames there is nothing to log or to audit.
void refuse_events_of_chords(const RunOptions& options, const SessionOptions& session) {
  const char* const asked = options.log                           ? "--log"
                            : options.events                      ? "--events"
                            : session.audits == AuditMode::events ? "--audit events"
                                                                  : nullptr;
  if (asked == nullptr) return;
  for (const std::string& name : session.structures) {
    const StructureSpec* const spec = structure_registry().find(name);
    if (spec == nullptr || spec->has_events(session.settings)) continue;
    throw InputError(fmt::format("{}: {} is of chord cages, which have no events; expected {}", asked, name,
                                 name == "wrapped" ? "--between events" : "--structures without it"));
  }
}

// The end that --nodes FIRST: leaves open is the largest number. Where no bead is left, no node is.
void refuse_nodes_behind_the_beads(const RunOptions& options, const Scene& scene) {
  if (!options.nodes.beads) return;
  const auto [first, last] = *options.nodes.beads;
  const std::size_t beads = scene.bead_count();
  if (last == std::numeric_limits<BeadId>::max() || last < beads || first >= beads) return;
  throw InputError(fmt::format("--nodes {}:{}: expected beads of the input, which has {} beads", first,
                               std::uint64_t{last} + 1, beads));
}

}  // namespace

std::unique_ptr<Session> open_session(const RunOptions& options, const Scene& scene, AuditMode audits) {
  SessionOptions session{options.structures, options.kernel, audits, {.nodes = options.nodes}};
  session.settings.apart = options.apart.value_or(session.settings.apart);
  session.settings.between = options.between.value_or(session.settings.between);
  session.settings.tightness = options.tightness;
  session.settings.relax = Relaxation::of(options.relax.value_or(0));
  if (session.structures.empty()) session.structures = default_structures(scene);
  const auto& names = session.structures;
  if (options.apart && std::find(names.begin(), names.end(), "contacts") == names.end())
    throw InputError("--apart: it chooses pairs of contacts, which is not among the structures");
  const auto has = [&names](const char* name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  if (options.relax && !has("wrapped"))
    throw InputError("--relax: it relaxes the spheres of wrapped, which is not among the structures");
  if (options.relax && scene.degree() > highest_relaxed_degree)
    throw InputError(
        fmt::format("--relax: functions of relaxed spheres have too high a degree over motions of degree {}; "
                    "expected {} at most",
                    scene.degree(), highest_relaxed_degree));
  if (options.relax && session.settings.between != Between::events)
    throw InputError("--relax: it is about events; expected --between events");
  if (options.nodes.restricts() && !has("wrapped") && !has("layered"))
    throw InputError(
        "--levels, --nodes: they choose nodes of wrapped and layered, neither of which is among the "
        "structures");
  if (options.between && !has("wrapped"))
    throw InputError("--between: it is about wrapped, which is not among the structures");
  if (options.tightness && session.settings.between != Between::chord)
    throw InputError("--tightness: it bounds chord cages of wrapped; expected --between chord");
  refuse_events_of_chords(options, session);
  refuse_nodes_behind_the_beads(options, scene);
  if (options.nodes.restricts()) {
    const NecklaceTree tree(scene.necklaces());
    const std::vector<std::uint8_t> kept = select_nodes(tree, options.nodes);
    if (std::find(kept.begin(), kept.end(), 1) == kept.end())
      throw InputError(
          fmt::format("--levels, --nodes: no node is left of {}; expected levels and beads of the input, "
                      "which has {} beads",
                      tree.node_count(), scene.bead_count()));
  }
  if (options.kernel == Kernel::fast && scene.degree() > highest_fast_degree)
    throw InputError(
        fmt::format("--kernel fast: motions of degree {} (above {}) have no lanes to be fast in; "
                    "expected filtered or exact",
                    scene.degree(), highest_fast_degree));
  try {
    return std::make_unique<Session>(scene, session);
  } catch (const StructureRefusal& refusal) {
    if (scene.is_lifted())
      throw InputError(fmt::format("--motion lifted: {}; expected --structures power", refusal.what()));
    throw InputError(fmt::format("--structures {}", refusal.what()));
  }
}

}  // namespace kds
