#pragma once
// From the inputs of a run to its scene.

#include <functional>
#include <string>

#include "experiments/run_options.h"
#include "motions/scene.h"

namespace kds {

/// Reads all inputs; warnings, one line each, go to `warn`. Throws InputError.
[[nodiscard]] Scene load_scene(const RunOptions& options,
                               const std::function<void(const std::string&)>& warn);

/// What --structures means where it is not given.
[[nodiscard]] std::vector<std::string> structures_to_run(const RunOptions& options, const Scene& scene);

}  // namespace kds
