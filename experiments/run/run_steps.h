#pragma once
// The loop over a scene's steps, as runs and replays have it.

#include <cstddef>
#include <functional>
#include <utility>

#include "experiments/run/run_options.h"
#include "kds/event_log.h"
#include "motions/scene/scene.h"
#include "structures/session/session.h"

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

/// Builds the structures, runs all steps and finishes; `at_frame` is called at each frame reached, the first
/// too. What is thrown in a step names the frames of the file that it lies between.
void run_steps(Session& session, const Scene& scene, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame);

}  // namespace kds
