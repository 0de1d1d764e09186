#pragma once
// A run of structures, chosen by name, over one scene: its motion, the structures, and the simulator that
// drives them.

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "motions/base/input_error.h"
#include "structures/session/structure_spec.h"

namespace kds {

struct SessionOptions {
  std::vector<std::string> structures;  ///< by name; none: those the scene has by default
  Kernel kernel = Kernel::filtered;
  AuditMode audits = AuditMode::none;
  StructureSettings settings;
};

/// A structure that does not go with a scene or is not known.
class StructureRefusal : public InputError {
 public:
  StructureRefusal(const std::string& structure, const std::string& reason)
      : InputError(structure + ": " + reason) {}
};

class Session {
 public:
  /// The scene must outlive it. Throws StructureRefusal, or InputError where the scene's motion is refused.
  Session(const Scene& scene, const SessionOptions& options);

  /// Sets the motion to that of the step.
  void load(std::size_t step);
  [[nodiscard]] Simulator& simulator() { return simulator_; }
  /// In the order in which they act.
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const { return kinetic_; }
  /// All structures at a frame that has just been reached (or, frame 0, built).
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const;
  /// What a structure was built as, as changes (RunningStructure::built).
  [[nodiscard]] std::vector<Change> built(std::size_t structure) const {
    return running_[structure]->built();
  }
  /// The spheres of a structure's nodes now, at time u of the step (RunningStructure::spheres_at).
  [[nodiscard]] std::vector<NodeSphere> spheres_at(std::size_t structure, const Dyadic& u) const;
  /// What a structure is there, to be compared from frame to frame (RunningStructure::elements).
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t structure, std::size_t frame) const;
  /// Builds the same structures statically at a frame; adds the seconds, one entry a structure.
  void time_static_builds(std::size_t frame, std::vector<double>& seconds) const;

 private:
  std::unique_ptr<SceneMotion> motion_;
  Simulator simulator_;
  std::vector<std::unique_ptr<RunningStructure>> running_;
  std::vector<KineticStructure*> kinetic_;
};

/// The names of those the scene has by default.
[[nodiscard]] std::vector<std::string> default_structures(const Scene& scene);

}  // namespace kds
