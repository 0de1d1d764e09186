#pragma once
// Builds the scene of a run from its inputs.

#include <csignal>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "experiments/program/input_options.h"
#include "experiments/run/run_options.h"
#include "motions/scene/file_frames.h"
#include "motions/scene/live_frames.h"
#include "motions/scene/scene.h"
#include "structures/session/kinetic_run.h"
#include "structures/session/parallel_run.h"

namespace kds {

/// Reads the only input if it is an instance file, else returns nothing. Throws InputError if an instance
/// file comes with other inputs, or with an option that has no meaning for it.
[[nodiscard]] std::optional<Instance> read_lone_instance(const InputOptions& options);
/// Throws InputError for an instance file, which has `what`.
void refuse_instance(const InputOptions& options, std::string_view what = "no frames");

/// While this object lives, Ctrl-C and the signal TERM end a live input of these options, so that the results
/// of the frames seen are written. A second signal ends the program. Signals that are ignored stay so.
class SignalsEndLiveInput {
 public:
  explicit SignalsEndLiveInput(const InputOptions& options);
  ~SignalsEndLiveInput();
  SignalsEndLiveInput(const SignalsEndLiveInput&) = delete;
  SignalsEndLiveInput& operator=(const SignalsEndLiveInput&) = delete;

 private:
  std::vector<std::pair<int, struct sigaction>> before_;  // the signals set, and what they did before
};

/// Opens all inputs and then the obstacle, to be read frame by frame. Reads every `stride`-th frame of the
/// frames that the options ask for. No input may be an instance file.
///
/// Throws InputError if an input with one frame has the atoms of an input with more frames: an option must
/// say whether that input names atoms or is an obstacle. Any other input with one frame is at rest, and a
/// line to `warn` says so.
[[nodiscard]] std::unique_ptr<FileFrames> open_frames(const InputOptions& options,
                                                      const std::function<void(const std::string&)>& warn,
                                                      std::size_t stride = 1);

/// Reads all inputs once, then opens them for the run, which reads frames as it proceeds. Each warning goes
/// to `warn` as one line. Throws InputError for any fault of an input. If `lone_frame` is given, an input of
/// one frame is accepted: the frame is repeated, and `lone_frame` becomes true. A live input is not read
/// before the run: the scene waits for its first two frames, and Scene::live_warnings has the warnings after
/// the last frame.
[[nodiscard]] Scene load_necklaces(const InputOptions& input, FrameMotion motion, double radius_factor,
                                   const std::function<void(const std::string&)>& warn,
                                   const std::optional<MotionTolerance>& tolerance = {},
                                   bool* lone_frame = nullptr);
/// A running simulation whose first frame has come, and what the frame says about the scene.
struct LiveInput {
  std::unique_ptr<LiveFrames> frames;
  FrameSurvey survey;  ///< with velocities only if --velocities asks for those of the file
  std::vector<double> radii;
};
/// Opens the live input of the options. Throws InputError also for options that need all frames.
[[nodiscard]] LiveInput open_live(const InputOptions& input,
                                  const std::function<void(const std::string&)>& warn);
/// Makes the scene of a run, with its probe, from frames with this survey and these radii. Warns about
/// structures as `load_scene` does.
[[nodiscard]] Scene scene_of_run(const RunOptions& options, std::unique_ptr<FrameSource> frames,
                                 const FrameSurvey& survey, std::vector<double> radii,
                                 const std::function<void(const std::string&)>& warn);
/// Throws InputError if lengths of time have no meaning, because a frame is not later than the one before.
void require_ascending_times(const InputOptions& input, const Scene& scene);
/// Says to `warn` that `what` leaves out the images of beads across the walls of a periodic cell.
void warn_of_images(std::string_view what, const std::function<void(const std::string&)>& warn);
/// Says to `warn` why `what` of images are not found although frames have cells, if that is so.
/// `lacks_images`: FrameSurvey::lacks_images.
void warn_of_cells(std::string_view what, const std::string& lacks_images, const InputOptions& input,
                   const std::function<void(const std::string&)>& warn);
/// Loads the scene of a `kds run`, whose input may also be an instance file. `lone_frame` is as in
/// load_necklaces.
[[nodiscard]] Scene load_scene(const RunOptions& options, const std::function<void(const std::string&)>& warn,
                               bool* lone_frame = nullptr);

/// Returns the library's options for a run over the scene with these options of the command line. If the
/// options name no structures, the run has the input's default structures. Throws InputError.
[[nodiscard]] KineticRunOptions kinetic_run_options(const RunOptions& options, const Scene& scene,
                                                    AuditMode audits);
/// Opens the run with `kinetic_run_options`. Throws InputError, also for a structure that refuses the scene.
[[nodiscard]] std::unique_ptr<KineticRun> open_run(const RunOptions& options, const Scene& scene,
                                                   AuditMode audits);
/// Opens the run on as many threads as --threads asks for, otherwise like `open_run`. If --threads asks for
/// several threads and the run cannot be cut, or is too short for so many, a line to `warn` says why.
[[nodiscard]] std::unique_ptr<ParallelRun> open_parallel_run(
    const RunOptions& options, const Scene& scene, AuditMode audits, ParallelOptions parallel,
    const std::function<void(const std::string&)>& warn);

/// If --threads is given and a run of so many steps and beads takes fewer threads, a line to `warn` says how
/// many. The line begins with `subject`.
void hint_at_threads(std::optional<std::size_t> threads, std::size_t steps, std::size_t beads,
                     const std::function<void(const std::string&)>& warn, const std::string& subject = "");

}  // namespace kds
