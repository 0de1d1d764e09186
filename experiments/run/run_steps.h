#pragma once
// The loop over a scene's steps, as runs and replays have it.

#include <cstddef>
#include <functional>

#include "experiments/run/run_options.h"
#include "motions/scene/scene.h"
#include "structures/session/session.h"

namespace kds {

/// Called after each motion step with the steps done and the steps in all.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

/// Builds the structures, runs all steps and finishes; `at_frame` is called at each frame reached, the first
/// too. What is thrown in a step names the frames of the file that it lies between.
void run_steps(Session& session, const Scene& scene, const RunOptions& options,
               const std::function<void(std::size_t frame)>& at_frame);

}  // namespace kds
