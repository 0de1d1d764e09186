#include "structures/session/session.h"

#include <algorithm>

#include "motions/base/floating_point_guard.h"

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
    : motion_(make_scene_motion(scene)), simulator_(options.audits, options.kernel) {
  const FloatingPointGuard to_nearest;
  const std::vector<std::string> names =
      options.structures.empty() ? default_structures(scene) : options.structures;
  for (const std::string& name : names) {
    const StructureSpec* spec = structure_registry().find(name);
    if (spec == nullptr)
      throw StructureRefusal(name, "there is no such structure; expected " + names_of_all());
    if (const auto reason = spec->refusal(scene)) throw StructureRefusal(name, *reason);
  }
  const SceneMotion::Ref motion = motion_->ref();
  for (const StructureSpec& spec : structure_registry().all()) {  // in their order
    if (std::find(names.begin(), names.end(), spec.name) == names.end()) continue;
    running_.push_back(spec.make(simulator_, scene, motion, options.settings));
    kinetic_.push_back(&running_.back()->kinetic());
  }
}

void Session::load(std::size_t step) {
  const FloatingPointGuard to_nearest;
  motion_->load(step);
}

std::vector<DumpFile> Session::dump(std::size_t frame) const {
  const FloatingPointGuard to_nearest;
  std::vector<DumpFile> files;
  for (const auto& structure : running_) {
    for (DumpFile& file : structure->dump(frame)) files.push_back(std::move(file));
  }
  return files;
}

std::vector<NodeSphere> Session::spheres_at(std::size_t structure, const Dyadic& u) const {
  const FloatingPointGuard to_nearest;
  return running_[structure]->spheres_at(u);
}

std::optional<CombinatorialElements> Session::elements(std::size_t structure, std::size_t frame) const {
  const FloatingPointGuard to_nearest;
  return running_[structure]->elements(frame);
}

void Session::time_static_builds(std::size_t frame, std::vector<double>& seconds) const {
  const FloatingPointGuard to_nearest;
  seconds.resize(running_.size(), 0);
  for (std::size_t s = 0; s < running_.size(); ++s) seconds[s] += running_[s]->static_seconds(frame);
}

}  // namespace kds
