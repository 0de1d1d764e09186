#pragma once
// All steps of a run over a scene, as the program's commands run them.

#include <cstddef>
#include <functional>
#include <utility>

#include "experiments/run/run_options.h"
#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"

namespace kds {

/// Called with the motion steps done, the share of the present one that is done, and the steps in all.
using Progress = std::function<void(std::size_t done, double within, std::size_t total)>;

/// Reports the progress within steps, which audits between all events make long.
class ProgressWithinSteps final : public EventListener {
 public:
  ProgressWithinSteps(Progress progress, std::size_t total) : progress_(std::move(progress)), total_(total) {}
  void on_event(const Event& event) override { progress_(event.step, event.lower, total_); }

 private:
  Progress progress_;
  std::size_t total_;
};

/// Builds the structures, runs all steps and finishes. Calls `at_frame` at each frame reached, including the
/// first. The message of an exception thrown in a step names the frames of the file between which the step
/// lies.
void run_steps(KineticRun& run, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame);

}  // namespace kds
