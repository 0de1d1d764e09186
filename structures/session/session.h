#pragma once
// A run of structures, chosen by name, over one scene. A session owns the motion, the structures, and the
// simulator that drives them.

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
#include "motions/base/require_index.h"
#include "structures/session/structure_spec.h"

namespace kds {

struct SessionOptions {
  std::vector<std::string> structures = {};  ///< by name; if empty, see `by_default`
  Kernel kernel = Kernel::filtered;
  AuditMode audits = AuditMode::none;
  StructureSettings settings = {};
  bool by_default = true;  ///< if no name is given: whether the scene's default structures are used
  /// The beads of each structure that contains only some beads, by the structure's name.
  std::map<std::string, std::vector<BeadId>, std::less<>> only = {};
};

/// Thrown if a structure is not known or does not fit the scene.
class StructureRefusal : public InputError {
 public:
  StructureRefusal(const std::string& structure, const std::string& reason)
      : InputError(structure + ": " + reason) {}
};

/// Throws std::invalid_argument for any index of a structure, frame or step that is too large; the message
/// says how many there are.
class Session {
 public:
  /// The scene must outlive the session. Throws StructureRefusal, or InputError if the scene's motion is
  /// refused.
  Session(const Scene& scene, const SessionOptions& options);
  /// A session over a motion that the owner sets from step to step and that must outlive the session. The
  /// scene has the beads and radii, but no frames.
  Session(const Scene& scene, const SceneMotion::Ref& motion, const SessionOptions& options);

  /// Adds a structure by its type, after the existing ones. The structure is constructed from the simulator,
  /// the motion and these arguments. Throws StructureRefusal if the structure has no constructor for motions
  /// of this dimension.
  template <std::derived_from<KineticStructure> Structure, class... Arguments>
  Structure& add(const Arguments&... arguments);
  /// Adds a structure after the existing ones. The structure must belong to this session's simulator.
  void add_running(std::unique_ptr<RunningStructure> structure) { add_made(std::move(structure)); }
  /// Restricts a structure to these beads. Must be called before it is built. Throws StructureRefusal, and
  /// changes nothing, if beads of this structure cannot be left out, if a bead does not exist, or if a bead
  /// is left out already.
  void keep_only(std::size_t structure, std::span<const BeadId> beads);

  /// Sets the motion to that of the step.
  void load(std::size_t step);
  /// Returns the motion, or null if its owner sets it.
  [[nodiscard]] SceneMotion* motion() { return motion_.get(); }
  [[nodiscard]] Simulator& simulator() { return simulator_; }
  /// Returns the structures in the order in which they act.
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const { return kinetic_; }
  /// Returns the dumps of all structures at a frame just reached (frame 0: just built).
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t frame) const;
  /// Returns the changes that build a structure from nothing (RunningStructure::built), as events at the
  /// first frame.
  [[nodiscard]] std::vector<Event> built(std::size_t structure) const;
  /// Returns the spheres of a structure's nodes now, at time u of the step (RunningStructure::spheres_at).
  [[nodiscard]] std::vector<NodeSphere> spheres_at(std::size_t structure, const Dyadic& u) const;
  /// Returns the combinatorial elements of a structure, which can be compared from frame to frame
  /// (RunningStructure::elements).
  [[nodiscard]] std::optional<CombinatorialElements> elements(std::size_t structure, std::size_t frame) const;
  /// Returns a structure with what runs, dumps and replays know about it. Throws std::invalid_argument if
  /// there is no such structure.
  [[nodiscard]] const RunningStructure& running(std::size_t structure) const {
    require_index("structure", structure, running_.size());
    return *running_[structure];
  }
  /// Follows, from the next step on, how many certificates name each bead (RunningStructure).
  void follow_certificates();
  /// Updates the per_bead_max of a structure after events that named the beads `changed`.
  void count_certificates(std::size_t structure, std::span<const BeadId> changed);
  /// Builds all structures statically at a frame, and adds the time of each to its entry in `seconds`.
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

/// A structure for which a run needs nothing beyond the interface to the simulator.
template <class Structure>
class StructureByType final : public RunningStructure {
 public:
  template <class... Arguments>
  explicit StructureByType(Arguments&&... arguments) : structure_(std::forward<Arguments>(arguments)...) {}
  [[nodiscard]] KineticStructure& kinetic() override { return structure_; }
  [[nodiscard]] std::vector<DumpFile> dump(std::size_t) const override { return {}; }
  [[nodiscard]] bool can_be_cut() const override {
    return requires { structure_.state(); };
  }
  [[nodiscard]] std::optional<std::vector<BeadId>> state() const override {
    if constexpr (requires { structure_.state(); }) return structure_.state();
    return std::nullopt;
  }
  [[nodiscard]] std::vector<Change> built() const override {
    if constexpr (requires { structure_.built(); }) return structure_.built();
    return {};
  }
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

/// Returns the names of the structures that the scene has by default.
[[nodiscard]] std::vector<std::string> default_structures(const Scene& scene);

}  // namespace kds
