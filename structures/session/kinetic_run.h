#pragma once
// A run that the user drives through time.
//
// - The motion comes from frames that are pushed one by one, from a scene, or from a motion that the user
//   sets.
// - Structures are chosen by name or by type; each contains all beads or some of them.
// - The run advances step by step, event by event, or to a given time; it can go back to an earlier time by
//   replay.
// - Beads can be inserted, erased and given other curves on the way.
// - Listeners are notified of every event as it happens, in one record (kds/event_log.h).
//
// Times count steps: 2.25 is u = 0.25 of step 2, and frame k is the time k. Times are not rounded: a time
// given as a double is reached exactly, and a run that stops at an event stands at the event's exact time.

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

#include "certificates/exact/exact_work.h"
#include "motions/base/require_index.h"
#include "structures/session/session.h"

namespace kds {

class BeadEdits;

/// The beads of a motion that the user sets.
struct BeadsOfMotion {
  std::vector<std::size_t> necklaces = {};  ///< number of beads of each; empty: one necklace
  /// One radius for each bead, or one for all; the motion must have these radii in all steps. If empty, beads
  /// are points, whatever their weights.
  std::vector<double> radii = {};
};

class KineticRun {
 public:
  /// A run over frames that are pushed. Throws InputError or StructureRefusal (session.h).
  KineticRun(PushedFrames frames, const SessionOptions& options);
  /// A run over a scene, which must outlive the run.
  KineticRun(const Scene& scene, const SessionOptions& options);
  /// Runs over a motion that the caller sets to each step before the step is run. The motion must outlive the
  /// run.
  KineticRun(const SceneMotion::Ref& motion, const BeadsOfMotion& beads, const SessionOptions& options);
  KineticRun(const KineticRun&) = delete;
  KineticRun& operator=(const KineticRun&) = delete;
  ~KineticRun();

  /// Adds a structure by its type, constructed from the simulator, the motion and these arguments, which are
  /// kept. Must be called before the first step. References to structures remain valid until the run goes
  /// back in time.
  template <std::derived_from<KineticStructure> Structure, class... Arguments>
  Structure& add(const Arguments&... arguments) {
    plan([=](Session& session) { session.add<Structure>(arguments...); });
    return structure<Structure>(structures().size() - 1);
  }
  /// Restricts a structure, given by its index, to these beads. Must be called before the first step.
  void keep_only(std::size_t structure, std::vector<BeadId> beads) {
    plan([structure, kept = std::move(beads)](Session& session) { session.keep_only(structure, kept); });
  }
  /// Returns the structures in the order in which they were added; structures chosen by name come first.
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const { return session_->structures(); }
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
  [[nodiscard]] Simulator& simulator() { return session_->simulator(); }
  [[nodiscard]] Session& session() { return *session_; }

  /// Adds a listener, which is notified of all events from now on. The listener must outlive the run.
  void listen(EventListener& listener);
  /// Like ExactWork::set_limit and set_watcher, but also valid after the run goes back in time; the work is
  /// then counted from 0 again. Settings made on Simulator::exact_work() itself are lost at that point.
  void limit_work(std::uint64_t most);
  void watch_work(std::function<void()> watcher, std::uint64_t every);

  /// Adds the next frame, and runs all steps whose motion is then known. Throws InputError, and changes
  /// nothing, if the coordinates are not a frame of these beads.
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt);
  /// Adds the next frame like `push`, but leaves the step that becomes known to the calls below. A step left
  /// from before is run first.
  void take(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt);
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
  /// Runs forward to a time. A run over a scene can also go back: it is then repeated from the start,
  /// including edits, without notifying listeners until that time; listeners are notified again of all later
  /// events. Edits after that time are forgotten. Only edits made by the functions below are repeated, not
  /// changes made directly on structures, session or simulator. Throws std::invalid_argument if the time is
  /// outside the known steps.
  void go_to(double time);
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
  /// SceneMotion::set_coordinate, which throws std::invalid_argument for any other bead. `set_curves` is
  /// called again if the run goes back and reaches this time again. If `set_curves` throws, nothing has
  /// changed.
  ///
  /// A curve is given for the whole step, including the part before now. At the end of the step it must reach
  /// the bead's position in the next frame; otherwise the next step, if there is one, throws InputError. All
  /// structures follow. If a structure cannot follow, std::invalid_argument names it, and nothing is changed.
  /// Over a motion that the user sets, use Simulator::change_motion instead.
  void change_motion(std::vector<BeadId> beads, const std::function<void(SceneMotion&)>& set_curves);

 private:
  struct Edit;
  struct Bend;

  void plan(std::function<void(Session&)> addition);
  void make_session();
  [[nodiscard]] bool can_enter() const;
  void load();
  void enter();
  void leave();
  [[nodiscard]] std::uint64_t changes_made() const;
  void run_to(std::size_t step);
  void go_on_to(std::size_t step, double u);
  void edit(std::function<void()> make);
  void redo(const Edit& edit);
  [[nodiscard]] BeadEdits& editable(std::size_t structure) const;
  void check_bends() const;
  void check_radii() const;

  std::unique_ptr<Scene> own_scene_;
  const Scene& scene_;
  std::optional<SceneMotion::Ref> motion_;  // set by the user
  SessionOptions options_;
  std::vector<std::function<void(Session&)>> additions_;
  std::vector<EventListener*> listeners_;
  std::uint64_t most_work_ = ExactWork::no_limit, watch_every_ = 0;
  std::function<void()> work_watcher_;
  std::unique_ptr<Session> session_;
  bool built_ = false, loaded_ = false, within_ = false, finished_ = false;
  std::vector<Edit> edits_;
  std::vector<Bend> bends_;  // in this step or the previous one
};

}  // namespace kds
