#pragma once
// All beads of a run on one clock: names, radii, weights and frames. Beads are numbered necklace after
// necklace. The motion of a step comes from the discrete-step adapter (discrete_step_adapter.h), or from an
// instance file, which gives a single step.
//
// Functions that take a frame or a step may read files, although they do not change the scene. Therefore only
// one thread at a time may use a scene.

#include <Eigen/Core>
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "motions/base/bead.h"
#include "motions/base/require_index.h"
#include "motions/curves/bezier_motion.h"
#include "motions/curves/lifted_motion.h"
#include "motions/frames/frame_source.h"
#include "motions/frames/trajectory.h"
#include "motions/readers/instance.h"
#include "motions/scene/discrete_step_adapter.h"
#include "motions/scene/frame_survey.h"
#include "motions/scene/step_source.h"

namespace kds {

/// The properties of a scene that are known before its first frame is pushed.
struct PushedFrames {
  int dimension = 3;                        ///< 1 to 3
  std::vector<std::size_t> necklaces = {};  ///< number of beads in each necklace
  std::vector<double> radii = {};           ///< one per bead, or one for all; empty: points
  FrameMotion motion = FrameMotion::linear;
  /// The cell of the first frame, in two or three dimensions, if beads are in a periodic cell, as read_cell
  /// accepts it. Necklaces are made whole in the first frame, unless consecutive beads are as far apart as in
  /// a fluid. Each bead then moves to the image nearest to its place in the frame before.
  std::optional<Cell> cell = std::nullopt;
  double probe = 0;  ///< Scene::set_probe
};

class Scene {
 public:
  /// Makes a scene of necklaces with equal numbers of frames; a necklace with a single frame is at rest.
  /// `radii`: one per bead in scene order. Throws InputError if the numbers of frames differ, if there are
  /// more or fewer radii than beads, or if a number is not finite. If all beads stay in one plane x, y or z =
  /// constant in all frames, the scene is planar: two-dimensional, in that plane's coordinates. This requires
  /// at least four beads, because fewer beads always lie in some plane.
  Scene(std::span<const Trajectory> necklaces, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// Makes a scene of frames from any source. `survey` must be that of the source (frame_survey.h, or
  /// LiveFrames::survey if the source is open; the call then waits for the first step). Only the
  /// frames that one step needs are in memory, unless the source itself keeps frames. Loading steps and
  /// accessing frames is fast in ascending order; going back may read files again from the start. Throws
  /// InputError like the first constructor.
  Scene(std::unique_ptr<FrameSource> frames, const FrameSurvey& survey, std::vector<double> radii,
        FrameMotion motion = FrameMotion::linear);
  /// Makes a scene of points, or of balls if `radii` has one radius per point. Throws InputError like the
  /// first constructor.
  explicit Scene(Instance instance, std::vector<double> radii = {});
  /// Makes a scene whose frames are pushed one by one. Only the frames of the latest step are in memory.
  /// Throws InputError if there are no beads, or if a radius or the dimension is invalid.
  explicit Scene(PushedFrames frames);

  /// Makes the weight of each bead the square of its radius plus `length`, a finite number that is not
  /// negative: power diagrams then use balls enlarged by a probe. Radii stay as they are. Must be called
  /// before motions are loaded. Throws InputError if a radius is too large.
  void set_probe(double length);
  [[nodiscard]] double probe() const { return probe_; }

  /// Appends a frame: the coordinates of bead 0, then those of bead 1 and so on, `dimension` numbers each.
  /// `cell` is its cell, if it has another one than the frame before. Throws InputError, and ignores the
  /// frame, like FrameQueue::push. Throws std::logic_error if the scene has frames of its own or has ended.
  void push(std::span<const double> coordinates, std::optional<double> picoseconds = std::nullopt,
            const std::optional<Cell>& cell = std::nullopt);
  /// Declares that no further frame follows. A live scene disconnects from the simulation.
  void end_frames();
  /// Returns the number of steps whose motion is known. The motion of every step is known, except in a scene
  /// of frames that are pushed or live. There, Hermite curves with differences are known one frame later, or
  /// when the frames end.
  [[nodiscard]] std::size_t known_steps() const { return steps_->known_steps(); }
  /// Returns whether the motion of step k is known. A live scene waits for its frames, and drops those before
  /// step k: ask in ascending order.
  [[nodiscard]] bool has_step(std::size_t k) const { return steps_->has_step(k); }
  /// Returns whether frames come from a simulation that runs, each only once. The numbers of frames and steps
  /// then grow, and frames before the latest step are gone, except for the stamp of frame 0.
  [[nodiscard]] bool is_live() const { return live_ != nullptr; }
  /// Returns how long the run and the simulation waited for each other, or nothing if the scene is not live.
  [[nodiscard]] std::optional<LiveState> live() const {
    return live_ == nullptr ? std::nullopt : live_->live();
  }
  /// Returns lines about the frames of a live scene. Complete once the last frame has been read.
  [[nodiscard]] std::vector<std::string> live_warnings() const {
    return live_ == nullptr ? std::vector<std::string>() : live_->warnings();
  }

  [[nodiscard]] int dimension() const { return steps_->dimension(); }
  [[nodiscard]] int degree() const { return steps_->degree(); }
  [[nodiscard]] bool is_lifted() const { return steps_->is_lifted(); }
  /// Returns where the velocities of Hermite curves come from, or nothing for another motion or an instance.
  [[nodiscard]] std::optional<VelocitySource> velocities() const { return steps_->velocities(); }
  [[nodiscard]] std::size_t bead_count() const { return radii_.size(); }
  /// Returns the number of frames. An instance has two, u = 0 and u = 1. For frames that are pushed or live,
  /// returns how many have come.
  [[nodiscard]] std::size_t frame_count() const { return steps_->frame_count(); }
  [[nodiscard]] std::size_t step_count() const { return frame_count() == 0 ? 0 : frame_count() - 1; }

  // A run on several threads reads frames ahead, and makes a scene for each of its parts.

  /// Returns the buffer through which the scene reads its frames, or null if its frames cannot be read ahead
  /// (an instance, frames that are pushed or live). The first call makes the buffer.
  [[nodiscard]] FrameBuffer* frames() const {
    return pushed_ == nullptr && live_ == nullptr ? steps_->buffer() : nullptr;
  }
  /// Returns the number of frames beyond each end of a step that the step needs.
  [[nodiscard]] std::size_t reach() const { return steps_->reach(); }
  /// Returns a scene with the same beads, steps and numbers of frames that reads its frames from `frames`.
  /// Only steps whose frames are there may be loaded. Another thread may use the scene. Must not be called
  /// for an instance.
  [[nodiscard]] std::unique_ptr<const Scene> over(std::unique_ptr<FrameSource> frames) const;

  // Functions with an index of a frame, step or bead throw std::invalid_argument if it is too large. The
  // message gives the number of elements.

  /// Returns whether all beads lie in a periodic cell, so that they have images in each step
  /// (FrameSurvey::periodic).
  [[nodiscard]] bool is_periodic() const { return periodic_; }
  /// Returns why beads have no images although frames have cells (FrameSurvey::lacks_images).
  [[nodiscard]] const std::string& lacks_images() const { return lacks_images_; }
  /// Returns whether frames are missing at the end of the input (FrameSource::is_truncated).
  [[nodiscard]] bool is_truncated() const { return live_ == nullptr ? truncated_ : live_->is_truncated(); }
  /// Returns a frame's number in the file and its time, for messages and results.
  [[nodiscard]] FrameStamp stamp(std::size_t frame) const;
  [[nodiscard]] std::size_t frame_number(std::size_t frame) const { return stamp(frame).number; }
  [[nodiscard]] const std::vector<BeadRange>& necklaces() const { return necklaces_; }
  /// Returns the first bead of each bond (bonds_of). An instance has none.
  [[nodiscard]] const std::vector<BeadId>& bonds() const { return bonds_; }
  /// Returns whether each necklace is at rest, or an empty vector if none is: obstacles, and necklaces of one
  /// frame beside others that move.
  [[nodiscard]] const std::vector<bool>& at_rest() const { return at_rest_; }
  /// Returns the bead's name in the file, as in "CA of ALA 12 in chain A", or an empty text if it has none.
  [[nodiscard]] const std::string& bead_name(BeadId bead) const {
    static const std::string unnamed;
    require_index("bead", bead, bead_count());
    return bead < bead_names_.size() ? bead_names_[bead] : unnamed;
  }
  /// Returns the groups of each bead, or an empty vector if none were asked for.
  [[nodiscard]] const BeadGroups& bead_groups() const { return bead_groups_; }
  [[nodiscard]] const std::vector<double>& radii() const { return radii_; }
  [[nodiscard]] bool equal_radii() const;
  /// Returns whether any bead has a name.
  [[nodiscard]] bool names_beads() const { return !bead_names_.empty(); }
  /// Returns whether beads have radii. Beads of an instance file have at most weights.
  [[nodiscard]] bool has_radii() const { return has_radii_; }
  /// Checks weights for code that compares them. Throws InputError if a weight, a radius squared, is too
  /// small to be accurate, unless all weights are equal.
  void require_weights() const;

  /// Sets the motion of step k, between frames k and k+1. Every kind of motion matches both frames exactly.
  /// Radii are constant during a step; points of an instance have only weights.
  template <Motion M>
  void load(std::size_t step, M& motion) const {
    require_index("step", step, step_count());
    steps_->go_to(step);
    set_control_points(motion);
    if (const std::optional<CellEnds> cells = steps_->cells()) {
      motion.own_cell().set(cells->start, cells->end, degree());
    } else {
      motion.own_cell().clear();
    }
    if constexpr (lifted<M>) motion.set_drift(drift<M>());
  }
  /// Returns centres and weights at a frame. Coordinates beyond the dimension are zero.
  [[nodiscard]] Eigen::Matrix3Xd centers(std::size_t frame) const;
  [[nodiscard]] std::vector<double> weights(std::size_t frame) const;
  /// Converts a point of a planar scene to the input's coordinates. In other scenes the point is returned
  /// unchanged.
  [[nodiscard]] Eigen::Vector3d in_input(const Eigen::Vector3d& point) const;

 private:
  Scene() = default;
  void take(std::unique_ptr<FrameSource> frames, const FrameSurvey& survey, FrameMotion motion);
  [[nodiscard]] double weight(BeadId bead, int k) const;
  template <Motion M>
  void set_control_points(M& motion) const {
    if constexpr (M::degree == 1) {
      if (const std::optional<LinearEnds> ends = steps_->ends()) {
        motion.set_ends(ends->start, ends->end, radii_.data());
        for (BeadId b = 0; b < bead_count() && probe_ > 0; ++b)
          for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weight(b, k));
        return;
      }
    }
    const int last = degree();
    for (BeadId b = 0; b < bead_count(); ++b) {
      for (int k = 0; k <= last; ++k) {
        for (int axis = 0; axis < M::dimension; ++axis)
          motion.set_coordinate(b, k, axis, steps_->coordinate(b, k, axis));
        motion.set_weight(b, k, weight(b, k));
        motion.set_radius(b, k, has_radii_ ? radii_[b] : 0);
      }
    }
  }
  /// Returns the drift: the mean displacement. Any vector gives a valid motion; this one lowers weights the
  /// least on average.
  template <Motion M>
  [[nodiscard]] typename M::Vector drift() const {
    const Eigen::Vector3d mean = steps_->mean_displacement();
    typename M::Vector drift{};
    for (std::size_t axis = 0; axis < drift.size(); ++axis) {
      const double x = mean[static_cast<Eigen::Index>(axis)];
      drift[axis] = std::isfinite(x) ? x : 0;
    }
    return drift;
  }

  std::vector<BeadRange> necklaces_;
  std::vector<BeadId> bonds_;
  std::vector<bool> at_rest_;            // empty, or one per necklace
  std::vector<std::string> bead_names_;  // empty, or one per bead
  BeadGroups bead_groups_;               // empty, or one per bead
  std::vector<double> radii_;
  bool has_radii_ = true;
  double probe_ = 0;
  bool truncated_ = false;
  bool periodic_ = false;
  std::string lacks_images_;
  AxisPlane plane_;  // the plane of a planar scene; else the input's own axes
  std::unique_ptr<StepSource> steps_;
  FrameQueue* pushed_ = nullptr;  // the source of frames that are pushed; owned by `steps_`
  FrameSource* live_ = nullptr;   // the source of frames that are live; owned by `steps_`
};

}  // namespace kds
