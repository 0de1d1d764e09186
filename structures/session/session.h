#pragma once
// A run of structures, chosen by name, over one scene: its motion, the structures, and the simulator that
// drives them.

#include <concepts>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "motions/base/input_error.h"
#include "structures/session/structure_spec.h"

namespace kds {

struct SessionOptions {
  std::vector<std::string> structures = {};  ///< by name; none: as `by_default` says
  Kernel kernel = Kernel::filtered;
  AuditMode audits = AuditMode::none;
  StructureSettings settings = {};
  bool by_default = true;  ///< whether there are those that the scene has by default where none is named
  /// Structures that are of some beads only, by their names.
  std::map<std::string, std::vector<BeadId>, std::less<>> only = {};
};

/// A structure that does not go with a scene or is not known.
class StructureRefusal : public InputError {
 public:
  StructureRefusal(const std::string& structure, const std::string& reason)
      : InputError(structure + ": " + reason) {}
};

/// Indices of structures, frames and steps that are too large are refused by std::invalid_argument, which
/// says how many there are.
class Session {
 public:
  /// The scene must outlive it. Throws StructureRefusal, or InputError where the scene's motion is refused.
  Session(const Scene& scene, const SessionOptions& options);
  /// Over a motion that its owner sets from step to step, and that must outlive it: the scene has its beads
  /// and radii, and no frames.
  Session(const Scene& scene, const SceneMotion::Ref& motion, const SessionOptions& options);

  /// Adds a structure by its type, made of the simulator, the motion and these arguments, behind those there
  /// are. Throws StructureRefusal where it is none of motions in this dimension.
  template <std::derived_from<KineticStructure> Structure, class... Arguments>
  Structure& add(const Arguments&... arguments);
  /// Before it is built: the structure is of these beads only. Throws StructureRefusal where its beads cannot
  /// come and go, or there is no such bead, or it is left out already; then nothing is changed.
  void keep_only(std::size_t structure, std::span<const BeadId> beads);

  /// Sets the motion to that of the step.
  void load(std::size_t step);
  /// The motion; null where its owner sets it.
  [[nodiscard]] SceneMotion* motion() { return motion_.get(); }
  [[nodiscard]] Simulator& simulator() { return simulator_; }
  /// In the order in which they act.
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const { return kinetic_; }
  /// All structures at a frame that has just been reached (or, frame 0, built).
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const;
  /// What a structure was built as: the changes that would make it of nothing (RunningStructure::built), as
  /// events at the first frame.
  [[nodiscard]] std::vector<Event> built(std::size_t structure) const;
  /// The spheres of a structure's nodes now, at time u of the step (RunningStructure::spheres_at).
  [[nodiscard]] std::vector<NodeSphere> spheres_at(std::size_t structure, const Dyadic& u) const;
  /// What a structure is there, to be compared from frame to frame (RunningStructure::elements).
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t structure, std::size_t frame) const;
  /// Builds the same structures statically at a frame; adds the seconds, one entry a structure.
  void time_static_builds(std::size_t frame, std::vector<double>& seconds) const;

 private:
  void make_by_name(const SessionOptions& options);
  void add_made(std::unique_ptr<RunningStructure> structure);

  const Scene& scene_;
  std::unique_ptr<SceneMotion> motion_;
  SceneMotion::Ref ref_;
  Simulator simulator_;
  std::vector<std::unique_ptr<RunningStructure>> running_;
  std::vector<KineticStructure*> kinetic_;
};

/// A structure that is no more to a run than what the simulator drives.
template <class Structure>
class StructureByType final : public RunningStructure {
 public:
  template <class... Arguments>
  explicit StructureByType(Arguments&&... arguments) : structure_(std::forward<Arguments>(arguments)...) {}
  [[nodiscard]] KineticStructure& kinetic() override { return structure_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {}; }
  [[nodiscard]] double static_seconds(std::size_t) const override { return 0; }

 private:
  Structure structure_;
};

template <std::derived_from<KineticStructure> Structure, class... Arguments>
Structure& Session::add(const Arguments&... arguments) {
  static_assert(
      !std::is_abstract_v<Structure>,
      "the structure lacks a function of kds::KineticStructure that has to be its own: it is abstract");
  static_assert(
      std::is_abstract_v<Structure> ||
          std::constructible_from<Structure, Simulator&, const MotionRef<1>&, const Arguments&...> ||
          std::constructible_from<Structure, Simulator&, const MotionRef<2>&, const Arguments&...> ||
          std::constructible_from<Structure, Simulator&, const MotionRef<3>&, const Arguments&...>,
      "the structure needs a constructor from (kds::Simulator&, const kds::MotionRef<D>&, and the "
      "arguments of `add`)");
  add_made(std::visit(
      [&]<int Dimension>(const MotionRef<Dimension>& motion) -> std::unique_ptr<RunningStructure> {
        if constexpr (std::constructible_from<Structure, Simulator&, const MotionRef<Dimension>&,
                                              const Arguments&...>)
          return std::make_unique<StructureByType<Structure>>(simulator_, motion, arguments...);
        return nullptr;
      },
      ref_));
  return static_cast<Structure&>(*kinetic_.back());
}

/// The names of those the scene has by default.
[[nodiscard]] std::vector<std::string> default_structures(const Scene& scene);

}  // namespace kds
