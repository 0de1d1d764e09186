#pragma once
// A run that the user drives through time.
//
// - The motion comes from frames that are pushed one by one, from a scene, or from a motion that the user
//   sets.
// - Structures are chosen by name or by type; each contains all beads or some of them.
// - The run advances step by step, event by event, or to a given time; it can go back to an earlier time by
//   replay.
// - Beads can be inserted, erased and given other curves on the way.
// - Listeners are notified of every event as it happens, in one record (kds/event.h).
//
// Times count steps: 2.25 is u = 0.25 of step 2, and frame k is the time k. Times are not rounded: a time
// given as a double is reached exactly, and a run that stops at an event stands at the event's exact time.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
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

#include "certificates/exact/exact_work.h"
#include "motions/base/require_index.h"
#include "structures/session/structure_spec.h"

namespace kds {

class BeadEdits;

struct KineticRunOptions {
  std::vector<std::string> structures = {};  ///< by name; if empty, see `by_default`
  Kernel kernel = Kernel::filtered;
  AuditMode audits = AuditMode::none;
  StructureSettings settings = {};
  bool by_default = true;  ///< if no name is given: whether the scene's default structures are used
  /// The beads of each structure that contains only some beads, by the structure's name.
  std::map<std::string, std::vector<BeadId>, std::less<>> only = {};
};

/// The beads of a motion that the user sets.
struct BeadsOfMotion {
  std::vector<std::size_t> necklaces = {};  ///< number of beads of each; empty: one necklace
  /// One radius for each bead, or one for all; the motion must have these radii in all steps. If empty, beads
  /// are points, whatever their weights.
  std::vector<double> radii = {};
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

/// A run of structures over one motion. Functions that take an index of a structure, frame or step throw
/// std::invalid_argument if it is too large; the message says how many there are.
class KineticRun {
 public:
  /// A run over frames that are pushed. Throws StructureRefusal, or InputError if the motion is refused.
  KineticRun(PushedFrames frames, const KineticRunOptions& options);
  /// A run over a scene, which must outlive the run.
  KineticRun(const Scene& scene, const KineticRunOptions& options);
  /// Runs over a motion that the caller sets to each step before the step is run. The motion must outlive the
  /// run.
  KineticRun(const SceneMotion::Ref& motion, const BeadsOfMotion& beads, const KineticRunOptions& options);
  KineticRun(const KineticRun&) = delete;
  KineticRun& operator=(const KineticRun&) = delete;
  ~KineticRun();

  /// Adds a structure by its type, constructed from the simulator, the motion and these arguments, which are
  /// kept. Must be called before the first step. Throws StructureRefusal if the structure has no constructor
  /// for motions of this dimension. References to structures remain valid until the run goes back in time.
  template <std::derived_from<KineticStructure> Structure, class... Arguments>
  Structure& add(const Arguments&... arguments);
  /// Restricts a structure, given by its index, to these beads. Must be called before the first step. Throws
  /// StructureRefusal, and changes nothing, if beads of this structure cannot be left out, if a bead does not
  /// exist, or if a bead is left out already.
  void keep_only(std::size_t structure, std::vector<BeadId> beads) {
    plan([this, structure, kept = std::move(beads)] { leave_out_others(structure, kept); });
  }
  /// Returns the structures in the order in which they were added; structures chosen by name come first.
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const { return kinetic_; }
  /// Returns a structure by index and type. Throws std::invalid_argument if there is no structure with this
  /// index or if it has another type.
  template <class Structure>
  [[nodiscard]] Structure& structure(std::size_t index) const {
    require_index("structure", index, structures().size());
    auto* const found = dynamic_cast<Structure*>(structures()[index]);
    if (found == nullptr) throw std::invalid_argument("the run's structure of this index is of another type");
    return *found;
  }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// Returns the simulator. Going back in time replaces it, so references to it are then no longer valid.
  [[nodiscard]] Simulator& simulator() { return *simulator_; }
  /// Returns the motion of the present step, or null if the user sets the motion.
  [[nodiscard]] SceneMotion* motion() { return scene_motion_.get(); }

  /// Adds a listener, which is notified of all events from now on. The listener must outlive the run.
  void listen(EventListener& listener);
  /// Like ExactWork::set_limit and set_watcher, but also valid after the run goes back in time; the work is
  /// then counted from 0 again. Settings made on Simulator::exact_work() itself are lost at that point.
  void limit_work(std::uint64_t most);
  void watch_work(std::function<void()> watcher, std::uint64_t every);

  /// Adds the next frame, and runs all steps whose motion is then known. `cell` is its cell, if it is another
  /// than that of the frame before. Throws InputError, and changes nothing, if the coordinates or the cell
  /// are not those of a frame of these beads.
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt,
            const std::optional<Cell>& cell = std::nullopt);
  /// Adds the next frame like `push`, but leaves the step that becomes known to the calls below. A step left
  /// from before is run first.
  void take(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt,
            const std::optional<Cell>& cell = std::nullopt);
  /// Builds all structures at the first frame. The first step does this if `build` was not called. Throws
  /// std::logic_error if the first step is not known.
  void build();
  /// Sets the motion to the next step, if it is not set yet. The functions below do this themselves; call it
  /// to read a step's frames apart from running the step. Returns false if no step is known.
  bool load_step();
  /// Enters the next step, unless one is under way: the structures make their certificates for it. The run
  /// then stands at u = 0, and Simulator::run_next goes from one time with events to the next without leaving
  /// the step. Returns false if no step is known.
  bool enter_step();
  /// Runs to the end of the present step or, between two steps, runs the whole next step. Returns false if no
  /// step is known.
  bool run_step();
  /// Runs all known steps. Must not be called over a motion that the user sets.
  void run();
  /// Handles all events at the next time at which something happens. If the next time is that of a frame, the
  /// run then stands at u = 0 of the step that begins there. Returns false if nothing more happens until the
  /// end of the known steps or, over a motion that the user sets, until the end of the step.
  bool next_event();
  /// Runs forward to a time, over a live scene as its frames come. A run over a scene that is not live can
  /// also go back: it is then repeated from the start,
  /// including edits, without notifying listeners until that time; listeners are notified again of all later
  /// events. Edits after that time are forgotten. Only edits made by the functions below are repeated, not
  /// changes made directly on structures or simulator. Throws std::invalid_argument if the time is
  /// outside the known steps.
  void go_to(double time);
  /// Returns whether the run stands at a later time than this one.
  [[nodiscard]] bool is_past(double time);
  /// Ends the frames: no step follows.
  void finish();
  /// Audits all structures where the run stands, whatever the option `audits` says (Simulator::audit_now).
  /// Throws AuditError if a structure is wrong, std::logic_error if the run has not begun.
  void audit_now();
  /// Returns whether a step is under way. Otherwise the run stands at a frame or has not begun.
  [[nodiscard]] bool within_step() const { return within_; }

  // Edits within a step while time stands still. Edits take effect exactly now; if the run stands at an
  // event, just after it.

  /// Adds a bead to a structure or removes it. Throws StructureRefusal if the structure does not support
  /// this. Throws std::invalid_argument if it is not possible for this bead.
  void insert(std::size_t structure, BeadId bead);
  void erase(std::size_t structure, BeadId bead);
  /// Gives beads other curves from now on. `set_curves` sets their control points by
  /// SceneMotion::set_coordinate, which throws std::invalid_argument for any other bead. If `set_curves`
  /// throws, nothing has changed.
  ///
  /// A curve is given for the whole step, including the part before now. At the end of the step it must reach
  /// the bead's position in the next frame; otherwise the next step, if there is one, throws InputError. All
  /// structures follow. If a structure cannot follow, std::invalid_argument names it, and nothing is changed.
  /// Over a motion that the user sets, use Simulator::change_motion instead.
  void change_motion(std::vector<BeadId> beads, const std::function<void(SceneMotion&)>& set_curves);
  /// Overload that takes all coordinates of the new curves, ordered by bead, control point and axis.
  void change_motion(std::vector<BeadId> beads, std::vector<double> coordinates);
  /// Runs forward to the time of an edit and makes this edit. The edit comes from another run of these
  /// structures over this scene. Repeat the edits of a run in their order. Throws like the functions above;
  /// if the edit has a `where`, throws InputError with it.
  void repeat(const Edit& edit);

  // Results where the run stands. Structures are given by their indices.

  /// Returns a structure with what runs, dumps and replays know about it.
  [[nodiscard]] const RunningStructure& running(std::size_t structure) const {
    require_index("structure", structure, running_.size());
    return *running_[structure];
  }
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
  /// Follows, from the next step on, how many certificates name each bead (RunningStructure).
  void follow_certificates();
  /// Updates the per_bead_max of a structure after events that named the beads `changed`.
  void count_certificates(std::size_t structure, std::span<const BeadId> changed);
  /// Builds all structures statically at a frame, and adds the time of each to its entry in `seconds`.
  void time_static_builds(std::size_t frame, std::vector<double>& seconds) const;

 private:
  friend class ParallelRun;  // its whole run shows structures that other runs have
  struct MadeEdit;
  struct Bend;

  /// A run over a scene, whose motion is set by another run.
  KineticRun(const Scene& scene, const SceneMotion::Ref& motion, const KineticRunOptions& options);

  void plan(std::function<void()> addition);
  /// Makes the motion, the simulator and the structures, as they are before the first step.
  void make();
  void make_by_name();
  [[nodiscard]] KineticStructure* find_made(std::string_view name) const;
  void add_made(std::unique_ptr<RunningStructure> structure);
  void leave_out_others(std::size_t structure, std::span<const BeadId> beads);
  [[nodiscard]] bool can_enter() const;
  void load();
  void enter();
  void leave();
  [[nodiscard]] std::uint64_t changes_made() const;
  void run_to(std::size_t step);
  void go_on_to(std::size_t step, double u);
  void make_edit(Edit edit);
  [[nodiscard]] BeadEdits& editable(std::size_t structure) const;
  [[nodiscard]] SceneMotion& editable_motion() const;
  void check_bends() const;
  void check_radii() const;

  std::unique_ptr<Scene> own_scene_;
  const Scene& scene_;
  std::optional<SceneMotion::Ref> motion_;  // set by the user
  KineticRunOptions options_;
  std::vector<std::function<void()>> additions_;
  std::vector<EventListener*> listeners_;
  std::uint64_t most_work_ = ExactWork::no_limit, watch_every_ = 0;
  std::function<void()> work_watcher_;
  std::unique_ptr<SceneMotion> scene_motion_;  // null if the user sets the motion
  std::optional<SceneMotion::Ref> ref_;        // the motion in use: the user's or scene_motion_
  std::unique_ptr<Simulator> simulator_;
  std::vector<std::unique_ptr<RunningStructure>> running_;
  std::vector<KineticStructure*> kinetic_;
  bool built_ = false, loaded_ = false, within_ = false, finished_ = false;
  std::vector<MadeEdit> edits_;
  std::vector<Bend> bends_;  // changes of course in this step or the previous one
};

template <std::derived_from<KineticStructure> Structure, class... Arguments>
Structure& KineticRun::add(const Arguments&... arguments) {
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
  plan([=, this] {
    add_made(std::visit(
        [&]<int Dimension>(const MotionRef<Dimension>& motion) -> std::unique_ptr<RunningStructure> {
          if constexpr (std::constructible_from<Structure, Simulator&, const MotionRef<Dimension>&,
                                                const Arguments&...>)
            return std::make_unique<StructureByType<Structure>>(simulator(), motion, arguments...);
          return nullptr;
        },
        *ref_));
  });
  return static_cast<Structure&>(*kinetic_.back());
}

}  // namespace kds
