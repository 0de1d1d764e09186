#pragma once
// From the inputs of a run to its scene.

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/run/run_options.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"

namespace kds {

/// The only input if it is an instance file, read. Throws InputError where there are more, and where an
/// option has no meaning for it.
[[nodiscard]] std::optional<Instance> read_lone_instance(const InputOptions& options);

/// Opens all inputs, then the obstacle, to be read frame by frame: every `stride`-th of the frames that the
/// options ask for. No input may be an instance file.
///
/// Throws InputError if an input of one frame has the atoms of an input with more frames: an option must
/// say whether that input names atoms or is an obstacle. Any other input of one frame rests, and a line to
/// `warn` says so.
[[nodiscard]] SceneStream open_frames(const InputOptions& options,
                                      const std::function<void(const std::string&)>& warn,
                                      std::size_t stride = 1);

/// Reads all inputs, none of them an instance file; warnings, one line each, go to `warn`. Throws InputError
/// for inputs of one frame likewise.
[[nodiscard]] std::vector<Trajectory> read_necklaces(const InputOptions& options,
                                                     const std::function<void(const std::string&)>& warn);

/// Reads all inputs once, and opens them for the run: frames are read as it goes on. Warnings, one line each,
/// go to `warn`. Throws InputError for whatever is wrong with an input.
[[nodiscard]] Scene load_necklaces(const InputOptions& input, FrameMotion motion, double radius_factor,
                                   const std::function<void(const std::string&)>& warn,
                                   const std::optional<MotionTolerance>& tolerance = {});
/// The same as `kds run` has it, of an instance file too.
[[nodiscard]] Scene load_scene(const RunOptions& options,
                               const std::function<void(const std::string&)>& warn);

/// Above this degree functions of relaxed spheres have too high a degree.
inline constexpr int highest_relaxed_degree = 7;
/// Above this degree nothing is compiled for lanes.
inline constexpr int highest_fast_degree = 3;

/// The run of structures that the options ask for, the input's default filled in. Throws InputError.
[[nodiscard]] std::unique_ptr<KineticRun> open_run(const RunOptions& options, const Scene& scene,
                                                   AuditMode audits);

}  // namespace kds
