#pragma once
// Runs the kinetic structures over the inputs of one `kds run` and reports what happened.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/events/closest_approach.h"
#include "experiments/events/event_distribution.h"
#include "experiments/program/live_output.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_report.h"
#include "experiments/run/run_results.h"
#include "kds/event.h"
#include "kds/simulator.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"

namespace kds {

/// Number of limb operations at one time of the run that triggers a warning. So many operations take seconds.
inline constexpr std::uint64_t extraordinary_work = 300'000'000;

/// Passes one line to `warn` if the run spends `extraordinary` limb operations at one time: it says where and
/// on what. Warns again only when the total work of the run has doubled.
void watch_exact_work(Simulator& simulator, const Scene& scene,
                      const std::function<void(const std::string&)>& warn,
                      std::uint64_t extraordinary = extraordinary_work);

/// Watches the exact work in each part of a run. Call it before the run. `warn` is called on the threads of
/// the run, by one thread at a time.
void watch_exact_work(ParallelRun& run, const std::function<void(const std::string&)>& warn);

/// Moves the counts of each step out of the structures, so that memory does not grow with the number of
/// steps.
class StepCounts {
 public:
  /// `run` and `scene` must outlive this object.
  StepCounts(KineticRun& run, const Scene& scene);

  /// Counts the contacts at the first frame. Call it once the structures have been built.
  void begin();
  /// Folds the events of a finished step, and writes them to `results` if a file takes them.
  void end_step(std::size_t step, RunResults* results);
  /// In the order of the run's structures.
  [[nodiscard]] const std::vector<EventCourse>& courses() const { return courses_; }
  /// Return the number of steps and of external events so far.
  [[nodiscard]] std::size_t steps() const { return steps_; }
  [[nodiscard]] std::uint64_t events() const { return events_; }
  /// Returns the number of pairs in contact at the first frame, or nothing if the run has no contacts.
  [[nodiscard]] std::optional<std::uint64_t> contacts_at_start() const { return contacts_at_start_; }

 private:
  KineticRun& run_;
  const Scene& scene_;
  std::vector<EventCourse> courses_;
  std::size_t steps_ = 0;
  std::uint64_t events_ = 0;
  std::optional<std::uint64_t> contacts_at_start_;
};

/// Called with the number of motion steps done, the completed share of the current step, and the total number
/// of steps, which is 0 if it is unknown.
using Progress = std::function<void(std::size_t done, double within, std::size_t total)>;

/// Reports the progress within a step. A step takes long if the structures are audited between all events.
class ProgressWithinSteps final : public EventListener {
 public:
  ProgressWithinSteps(Progress progress, std::size_t total) : progress_(std::move(progress)), total_(total) {}
  void on_event(const Event& event) override { progress_(event.step, event.lower, total_); }

 private:
  Progress progress_;
  std::size_t total_;
};

/// Builds the structures, runs all steps and finishes the run. Calls `at_frame` at each frame reached,
/// including the first. The message of an exception thrown in a step names the two frames of the file around
/// the step.
void run_steps(KineticRun& run, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame);

/// Like `run_steps` of a KineticRun, on the threads of the run. `at_frame` is called on the caller's thread.
void run_steps(ParallelRun& run, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame);

/// Follows the closest approach while the run goes on, if the run has the closest pair. Must be called before
/// the run.
void follow_approach(ParallelRun& run);
/// Returns the closest approach after the run, or nothing if it was not followed.
[[nodiscard]] std::optional<ClosestApproach> followed_approach(const ParallelRun& run);

/// Adds to the report of a run what needs the whole run: the certificate of --certify, the closest approach,
/// and its bounds over all frames. Passes a hint to `warn` if the run has no contacts.
void complete_report(const RunOptions& options, const Scene& scene,
                     const std::optional<ClosestApproach>& approach,
                     const std::function<void(const std::string&)>& warn, RunReport& report);

/// Runs the structures. Each warning about the input goes to `warn` as one line. The output goes to
/// `results`, which the caller delivers. Throws InputError for errors that the user can fix. Throws
/// AuditError (kds/kinetic_structure.h) if a structure disagrees with its static rebuild.
[[nodiscard]] RunReport run_scene(const RunOptions& options, const Progress& progress,
                                  const std::function<void(const std::string&)>& warn, RunResults& results,
                                  const LiveHooks<RunReport>& hooks = {});
/// Runs over a loaded scene, as run_scene does. `warnings` are passed on once the structures accept the
/// scene.
[[nodiscard]] RunReport run_over(const Scene& scene, HeldWarnings& warnings, const RunOptions& options,
                                 const Progress& progress,
                                 const std::function<void(const std::string&)>& warn, RunResults& results,
                                 const LiveHooks<RunReport>& hooks = {});

}  // namespace kds
