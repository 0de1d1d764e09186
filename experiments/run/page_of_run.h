#pragma once
// Writes the replay page of a command that keeps no run. The command runs once more for the page.

#include <cstddef>
#include <filesystem>
#include <functional>

#include "experiments/output/output_files.h"
#include "experiments/run/run_options.h"
#include "motions/scene/scene.h"

namespace kds {

/// Runs the structures of `options` over the scene and writes the replay page to `page`, a file that appears
/// with `files`. Calls `progress` with the number of steps done and the number of all.
void write_page_of_run(const RunOptions& options, const Scene& scene, const std::filesystem::path& page,
                       AtomicFiles& files, const std::function<void(std::size_t, std::size_t)>& progress);

}  // namespace kds
