#include "structures/session/session.h"

#include <algorithm>

#include "kds/kinetic_structure.h"
#include "motions/base/floating_point_guard.h"
#include "motions/base/require_index.h"

namespace kds {

namespace {

std::string names_of_all() {
  std::string names;
  for (const StructureSpec& spec : structure_registry().all())
    names += (names.empty() ? "" : ", ") + spec.name;
  return names;
}

}  // namespace

std::vector<std::string> default_structures(const Scene& scene) {
  std::vector<std::string> names;
  for (const StructureSpec& spec : structure_registry().all())
    if (spec.by_default(scene)) names.push_back(spec.name);
  return names;
}

Session::Session(const Scene& scene, const SessionOptions& options)
    : scene_(scene),
      motion_(make_scene_motion(scene)),
      ref_(motion_->ref()),
      simulator_(options.audits, options.kernel) {
  make_by_name(options);
}

Session::Session(const Scene& scene, const SceneMotion::Ref& motion, const SessionOptions& options)
    : scene_(scene), ref_(motion), simulator_(options.audits, options.kernel) {
  make_by_name(options);
}

void Session::make_by_name(const SessionOptions& options) {
  const FloatingPointGuard to_nearest;
  const std::vector<std::string> names =
      options.structures.empty() && options.by_default ? default_structures(scene_) : options.structures;
  for (const std::string& name : names) {
    const StructureSpec* spec = structure_registry().find(name);
    if (spec == nullptr)
      throw StructureRefusal(name, "there is no such structure; expected " + names_of_all());
    if (const auto reason = spec->refusal(scene_)) throw StructureRefusal(name, *reason);
  }
  const auto is_named = [&](const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  for (const auto& [name, beads] : options.only)
    if (!is_named(name)) throw StructureRefusal(name, "is to be of some beads only, and is not in the run");
  for (const StructureSpec& spec : structure_registry().all()) {  // in the registry's order
    if (!is_named(spec.name)) continue;
    add_made(spec.make(simulator_, scene_, ref_, options.settings));
    if (const auto only = options.only.find(spec.name); only != options.only.end())
      keep_only(running_.size() - 1, only->second);
  }
}

void Session::add_made(std::unique_ptr<RunningStructure> structure) {
  if (structure == nullptr)
    throw StructureRefusal("a structure", "its type is not made for motions in " +
                                              std::to_string(scene_.dimension()) + " dimensions");
  running_.push_back(std::move(structure));
  kinetic_.push_back(&running_.back()->kinetic());
}

void Session::keep_only(std::size_t structure, std::span<const BeadId> beads) {
  require_index("structure", structure, kinetic_.size());
  KineticStructure& kept = *kinetic_[structure];
  const std::string name(kept.name());
  BeadEdits* const edits = edits_of(kept);
  if (edits == nullptr) throw StructureRefusal(name, "is of all beads; it cannot be of some only");
  std::vector<char> among(scene_.bead_count(), 0);
  for (const BeadId bead : beads) {
    if (bead >= among.size()) throw StructureRefusal(name, no_such_index("bead", bead, among.size()));
    if (edits->is_absent(bead))
      throw StructureRefusal(name, "bead " + std::to_string(bead) + " is left out already");
    among[bead] = 1;
  }
  for (BeadId bead = 0; bead < among.size(); ++bead)
    if (among[bead] == 0 && !edits->is_absent(bead)) edits->leave_out(bead);
}

void Session::load(std::size_t step) {
  const FloatingPointGuard to_nearest;
  if (!motion_) return;
  motion_->load(step);
  simulator_.set_frames(scene_.stamp(step), scene_.stamp(step + 1));
}

std::vector<Event> Session::built(std::size_t structure) const {
  require_index("structure", structure, kinetic_.size());
  std::vector<Event> events;
  const KineticStructure& of = *kinetic_[structure];
  const FrameStamp first = scene_.stamp(0);
  for (const Change& change : running_[structure]->built())
    events.push_back({0, 0, 0, structure, change, of.name(), of.kinds()[change.kind], first, first, {}});
  return events;
}

std::vector<DumpFile> Session::dump(std::size_t frame) const {
  const FloatingPointGuard to_nearest;
  require_index("frame", frame, scene_.frame_count());
  std::vector<DumpFile> files;
  for (const auto& structure : running_) {
    for (DumpFile& file : structure->dump(frame)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<NodeSphere> Session::spheres_at(std::size_t structure, const Dyadic& u) const {
  const FloatingPointGuard to_nearest;
  require_index("structure", structure, running_.size());
  return running_[structure]->spheres_at(u);
}

std::optional<CombinatorialElements> Session::elements(std::size_t structure, std::size_t frame) const {
  const FloatingPointGuard to_nearest;
  require_index("structure", structure, running_.size());
  require_index("frame", frame, scene_.frame_count());
  return running_[structure]->elements(frame);
}

void Session::follow_certificates() {
  for (const auto& structure : running_) structure->follow_certificates();
}

void Session::count_certificates(std::size_t structure, std::span<const BeadId> changed) {
  require_index("structure", structure, running_.size());
  running_[structure]->count_certificates(changed);
}

void Session::time_static_builds(std::size_t frame, std::vector<double>& seconds) const {
  const FloatingPointGuard to_nearest;
  require_index("frame", frame, scene_.frame_count());
  seconds.resize(running_.size(), 0);
  for (std::size_t s = 0; s < running_.size(); ++s) seconds[s] += running_[s]->static_seconds(frame);
}

}  // namespace kds
