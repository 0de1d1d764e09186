#pragma once
// A run over a scene on several threads. The scene is cut at frames into parts. Each part starts from a
// static build at its first frame, because a kinetic structure at a frame is what a static build there is.
// The caller's thread reads each frame once and joins the parts in order, so its listeners see one run.
//
// Law of splits: wherever a run is cut, its events, their beads and order, its fingerprint, and the
// structures at the frames are the same. Each part records the state of its structures at its first frame
// (RunningStructure::state). If this is not the state at the end of the part before, or if more than
// positions decided that state (cells that are flat, ties), the part is run again from the true state, and
// PartCounts counts it.
//
// A part goes on from the part before, on the caller's thread, if a bead was inserted or erased earlier or if
// beads changed course in the step before. Other parts may contain edits.
//
// Counts of work (certificates never searched because of slack, stages, comparisons, peaks) depend on the
// cuts.

#include <atomic>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "kds/event_log.h"
#include "kds/known_events.h"
#include "structures/session/kinetic_run.h"

namespace kds {

/// Returns the number of processors that this process may use, at least 1.
[[nodiscard]] std::size_t all_threads();

/// Returns the least number of steps for each thread of a run. With fewer steps, a further thread would cost
/// more than it gains.
[[nodiscard]] std::size_t least_steps_of_thread(std::size_t beads);
/// Returns how many threads, from 1 to `threads`, a run takes that can be cut (ParallelRun::uncut). Short
/// runs take fewer than `threads`.
[[nodiscard]] std::size_t threads_worth(std::size_t steps, std::size_t beads, std::size_t threads);

struct ParallelOptions {
  /// The largest number of threads that work, including the caller's. Short runs use fewer.
  std::size_t threads = 1;
  /// Number of steps in a part; 0: chosen by the steps that are left and the number of beads.
  std::size_t steps_per_part = 0;
  bool dumps = false;     ///< whether KineticRun::dump is called at frames
  bool elements = false;  ///< whether KineticRun::elements is called at all frames, not only at both ends
  bool static_builds = false;  ///< whether `static_seconds` is called
};

/// How a run was cut.
struct PartCounts {
  std::size_t parts = 1;
  std::size_t run_again = 0;  ///< parts that were run again from the true state
};

/// Looks at a part of a run at its frames, on the thread that runs the part, while the motion of the step
/// that led there is still loaded.
class FrameObserver {
 public:
  virtual ~FrameObserver() = default;
  /// Called at the first frame of the part, whose structures have just been built, and at each further one.
  virtual void at_frame(std::size_t frame) = 0;
  /// Called before each step is run, when its motion is loaded. May run the part to times within the step
  /// (KineticRun::go_to).
  virtual void in_step(std::size_t step) { static_cast<void>(step); }
};

class ParallelRun {
 public:
  /// Makes the observer of a part before its structures are built. The part outlives the observer's calls,
  /// but not the observer. Is called on other threads, also several times at once.
  using Observe = std::function<std::unique_ptr<FrameObserver>(KineticRun& part)>;
  /// Does the work of a build (no step), of one step, or, after the last step, of the end of a part or run.
  /// Is called on the thread that does the work, and must call `work` once. It may add to exceptions that
  /// escape.
  using Around = std::function<void(KineticRun& part, std::optional<std::size_t> step,
                                    const std::function<void()>& work)>;

  /// The scene must outlive the run. Throws InputError or StructureRefusal.
  ParallelRun(const Scene& scene, const KineticRunOptions& options, const ParallelOptions& parallel);
  ParallelRun(const ParallelRun&) = delete;
  ParallelRun& operator=(const ParallelRun&) = delete;
  ~ParallelRun();

  /// Adds a structure by its type, like KineticRun::add. The run can be cut if the structure has a function
  /// `state` (RunningStructure::state).
  template <std::derived_from<KineticStructure> Structure, class... Arguments>
  void add(const Arguments&... arguments) {
    plan([=](KineticRun& run) { static_cast<void>(run.add<Structure>(arguments...)); });
  }

  /// Returns the run as a whole: its structures have the names, kinds and, after the run, the statistics of
  /// all parts together. `dump`, `elements` and `built` are those of the frame just reached, if the options
  /// asked for them. If the run is not cut, this is the run itself. Only `run` may run it.
  [[nodiscard]] KineticRun& whole();
  [[nodiscard]] Simulator& simulator() { return whole().simulator(); }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  /// Returns why the run cannot be cut, as the end of a sentence, or nothing if it can.
  [[nodiscard]] const std::optional<std::string>& uncut();
  /// Returns the number of threads that work, 1 if the run is not cut. `run` lowers the number if the system
  /// has no more threads.
  [[nodiscard]] std::size_t threads();
  [[nodiscard]] const PartCounts& parts() const { return counts_; }

  /// Adds a listener, which is notified of all events in order on the thread that calls `run`. Its
  /// `prints_time_of` and `reads_exact_time_of` are called on other threads, also several at once.
  void listen(EventListener& listener);
  /// Sets a function that prepares each part before its structures are built, on the thread that runs the
  /// part.
  void prepare(std::function<void(KineticRun& part)> prepare) { prepare_ = std::move(prepare); }
  void observe(Observe observe) { observe_ = std::move(observe); }
  /// Returns the observers after the run, in the order of time.
  [[nodiscard]] const std::vector<std::unique_ptr<FrameObserver>>& observers() const { return observers_; }
  /// Returns the observer of the part whose frame was just reached, or null. Call it from `at_frame` of
  /// `run`.
  [[nodiscard]] FrameObserver* observer() const { return observer_; }
  /// Limits exact work (ExactWork::set_limit). The limit counts the work of all steps in their order, so the
  /// run is then not cut.
  void limit_work(std::uint64_t most);

  /// Makes edits of another run again (KineticRun::repeat), given in their order. Call it before `run`.
  void repeat(std::vector<Edit> edits) { edits_ = std::move(edits); }

  /// Runs all steps and finishes. Calls `at_frame` at each frame reached, including the first, on this
  /// thread. If a step throws, all events before the exception are told first. Asks this thread's checks
  /// (motions/base/interruption.h) while it waits; if one throws, all parts end first. Call it once.
  void run(const std::function<void(std::size_t frame)>& at_frame, Around around = {});
  /// Returns the seconds that static builds at all frames take, for each structure. Call it after the run.
  [[nodiscard]] std::vector<double> static_seconds();

 private:
  class Joined;
  class Recorder;
  struct Frame;
  struct Part;
  struct Worker;
  class Workers;
  using States = std::vector<std::vector<BeadId>>;

  void plan(std::function<void(KineticRun&)> addition);
  void decide();
  void run_uncut(const std::function<void(std::size_t)>& at_frame);
  void run_in_parts(const std::function<void(std::size_t)>& at_frame);
  void run_step(KineticRun& run, std::size_t step) const;
  [[nodiscard]] bool must_continue(std::size_t first) const;
  [[nodiscard]] std::unique_ptr<Part> read_part(std::size_t first) const;
  void run_part(Part& part, std::unique_ptr<Worker> worker) const;
  void note_frame(Part& part, Worker& worker, std::size_t number) const;
  [[nodiscard]] bool continues(const Part& part) const;
  void join(Part& part, const std::function<void(std::size_t)>& at_frame);
  void show(Frame& frame, std::size_t number, const std::function<void(std::size_t)>& at_frame);
  void tell(std::size_t step, const std::vector<RelayedEvent>& events, const std::vector<LoggedEdit>& edits);
  void retire(std::unique_ptr<Worker> worker);
  [[nodiscard]] static std::optional<States> states_of(const KineticRun& run);

  const Scene& scene_;
  KineticRunOptions options_;
  ParallelOptions parallel_;
  std::unique_ptr<KineticRun> own_;     // the run itself if uncut, otherwise the model of its structures
  std::unique_ptr<KineticRun> joined_;  // null if uncut
  std::vector<Joined*> structures_;     // the structures of `joined_`
  std::vector<std::function<void(KineticRun&)>> additions_;
  bool is_decided_ = false;  // whether the run is cut
  std::optional<std::string> uncut_;
  std::size_t threads_ = 1;
  std::vector<EventListener*> listeners_;
  std::function<void(KineticRun&)> prepare_;
  Observe observe_;
  std::vector<std::unique_ptr<FrameObserver>> observers_;
  FrameObserver* observer_ = nullptr;  // the observer of the part that is shown
  Around around_;
  std::unique_ptr<Worker> truth_;  // whose structures are at the end of the last part that was joined
  std::vector<double> static_seconds_;
  mutable std::atomic<bool> is_stopped_ = false;  // set when the run ends early
  PartCounts counts_;
  std::vector<Edit> edits_;
};

}  // namespace kds
