#pragma once
// A run that its user leads through time: over frames that are pushed one by one, over a scene, or over a
// motion that the user sets; structures by name or by type, all or some of the beads in each; step by step,
// event by event, to a time, or back to one by replay; beads that come, go and change course on the way. Who
// listens hears of every event as it happens, in one record (kds/event_log.h).
//
// Times count steps: 2.25 is u = 0.25 of step 2, and frame k is the time k. Nothing is rounded: a time that
// is a double is met exactly, and where the run stands at an event, it stands at its exact time.

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

/// The beads of a motion that its user sets.
struct BeadsOfMotion {
  std::vector<std::size_t> necklaces = {};  ///< how many beads each has; none: all are of one
  /// One a bead, or one for all, as the motion has them in all steps; none: points, whatever their weights.
  std::vector<double> radii = {};
};

class KineticRun {
 public:
  /// Frames are pushed. Throws InputError, or StructureRefusal (session.h).
  KineticRun(PushedFrames frames, const SessionOptions& options);
  /// The scene must outlive it.
  KineticRun(const Scene& scene, const SessionOptions& options);
  /// The motion must outlive it. Its user sets it to each step before that is run.
  KineticRun(const SceneMotion::Ref& motion, const BeadsOfMotion& beads, const SessionOptions& options);
  KineticRun(const KineticRun&) = delete;
  KineticRun& operator=(const KineticRun&) = delete;
  ~KineticRun();

  /// Adds a structure by its type, made of simulator, motion and these arguments, which are kept. Before the
  /// first step. References to structures are good until the run goes back in time.
  template <std::derived_from<KineticStructure> Structure, class... Arguments>
  Structure& add(const Arguments&... arguments) {
    plan([=](Session& session) { session.add<Structure>(arguments...); });
    return structure<Structure>(structures().size() - 1);
  }
  /// Before the first step: a structure, by its index, is of these beads only.
  void keep_only(std::size_t structure, std::vector<BeadId> beads) {
    plan([structure, kept = std::move(beads)](Session& session) { session.keep_only(structure, kept); });
  }
  /// In the order in which they were added, those by name first.
  [[nodiscard]] const std::vector<KineticStructure*>& structures() const { return session_->structures(); }
  /// Returns a structure by index and type. Throws std::invalid_argument if there is none of this index, or
  /// it is of another type.
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

  /// Hears of all that happens from now on. Must outlive the run.
  void listen(EventListener& listener);
  /// ExactWork::set_limit and set_watcher, also of the run made anew where it goes back: its work is counted
  /// from 0 again. Said to Simulator::exact_work() itself they hold until then.
  void limit_work(std::uint64_t most);
  void watch_work(std::function<void()> watcher, std::uint64_t every);

  /// Hands over the next frame, and runs all steps whose motion is known then. Throws InputError, and nothing
  /// has happened, where it is no frame of these beads.
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt);
  /// The same, but the step that becomes known is left to the calls below; one left before is run first.
  void take(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt);
  /// Runs to the end of the step under way, or, between two, the whole next one. False where none is known.
  bool run_step();
  /// All steps that are known. Not over a motion that the user sets.
  void run();
  /// All that happens at the next time at which something does, a frame's too: then it stands at u = 0 of the
  /// step that begins there. False, at the end of the steps known, or of one over a motion that the user
  /// sets, where nothing does any more.
  bool next_event();
  /// To a time, forward, or, of a scene's, back: then it is run anew from the start, edits included, without
  /// telling who listens; they hear again of what happens after that time. Edits after it are forgotten, and
  /// remade are only those by the functions below: not what was done to structures, session or simulator.
  /// Throws std::invalid_argument where the time is none of those known.
  void go_to(double time);
  /// No step follows: frames have ended.
  void finish();
  /// Audits all structures where the run stands, whatever the option `audits` says (Simulator::audit_now).
  /// Throws AuditError if a structure is wrong, std::logic_error if the run has not begun.
  void audit_now();
  /// Whether a step is under way. Else the run stands at a frame, or has not begun.
  [[nodiscard]] bool within_step() const { return within_; }

  // While time stands still within a step, exactly now, just after an event if the run stands at one.

  /// A bead takes part in a structure, or does not any more. Throws StructureRefusal where its beads cannot
  /// come and go, std::invalid_argument where this one cannot.
  void insert(std::size_t structure, BeadId bead);
  void erase(std::size_t structure, BeadId bead);
  /// Beads go on along other curves: `set_curves` sets their control points (SceneMotion::set_coordinate, of
  /// other beads std::invalid_argument), and is called again if the run goes back and comes here again. Where
  /// it throws nothing has happened. Curves are those of the whole step, also where the bead has never been;
  /// where the step ends they must be where the next frame has the bead, or the next step, if one follows,
  /// throws InputError. All structures follow, or std::invalid_argument says which cannot, and nothing is
  /// changed. Over a motion that the user sets there is Simulator::change_motion.
  void change_motion(std::vector<BeadId> beads, const std::function<void(SceneMotion&)>& set_curves);

 private:
  struct Edit;
  struct Bend;

  void plan(std::function<void(Session&)> addition);
  void make_session();
  [[nodiscard]] bool can_enter() const;
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
  std::optional<SceneMotion::Ref> motion_;  // that the user sets
  SessionOptions options_;
  std::vector<std::function<void(Session&)>> additions_;
  std::vector<EventListener*> listeners_;
  std::uint64_t most_work_ = ExactWork::no_limit, watch_every_ = 0;
  std::function<void()> work_watcher_;
  std::unique_ptr<Session> session_;
  bool built_ = false, within_ = false, finished_ = false;
  std::vector<Edit> edits_;
  std::vector<Bend> bends_;  // of this step or the one before
};

}  // namespace kds
