#pragma once
// Runs all steps over a scene, with the error messages of the program's commands.

#include <cstddef>
#include <functional>
#include <utility>

#include "experiments/run/run_options.h"
#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"

namespace kds {

/// Called with the number of motion steps done, the completed share of the current step, and the total number
/// of steps.
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

}  // namespace kds
