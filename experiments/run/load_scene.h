#pragma once
// From the inputs of a run to its scene.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/run/run_options.h"
#include "experiments/run/session.h"
#include "motions/scene/scene.h"

namespace kds {

/// The only input if it is an instance file, read. Throws InputError where there are more, and where an
/// option has no meaning for it.
[[nodiscard]] std::optional<Instance> read_lone_instance(const InputOptions& options);

/// Reads all inputs, none of them an instance file; warnings, one line each, go to `warn`.
[[nodiscard]] std::vector<Trajectory> read_necklaces(const InputOptions& options,
                                                     const std::function<void(const std::string&)>& warn);

/// Reads all inputs; warnings, one line each, go to `warn`. Throws InputError.
[[nodiscard]] Scene load_scene(const RunOptions& options,
                               const std::function<void(const std::string&)>& warn);

/// What the options ask of a session, --structures' default filled in. Throws InputError.
[[nodiscard]] SessionOptions session_options(const RunOptions& options, const Scene& scene, AuditMode audits);

}  // namespace kds
