#pragma once
// Sources of motion steps: each gives the control points of one step at a time. DiscreteStepAdapter
// (discrete_step_adapter.h) makes steps from frames. InstanceStep is the single step of an instance file.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>

#include "motions/base/bead.h"
#include "motions/frames/frame_buffer.h"
#include "motions/frames/frame_stamp.h"
#include "motions/frames/periodic.h"
#include "motions/readers/instance.h"

namespace kds {

/// The first and last frame of a linear step: three numbers per bead.
struct LinearEnds {
  const double* start = nullptr;
  const double* end = nullptr;
};

/// The cells of the first and last frame of a step, in the scene's coordinates.
struct CellEnds {
  Cell start, end;
};

/// The source of the velocities of Hermite curves.
enum class VelocitySource {
  differences,  ///< of the frames around
  file,
};
/// Names, in the order of the enumerators.
inline constexpr std::array<std::string_view, 2> velocity_source_names{"differences", "file"};
[[nodiscard]] constexpr std::string_view name_of(VelocitySource source) {
  return velocity_source_names[static_cast<std::size_t>(source)];
}

class StepSource {
 public:
  virtual ~StepSource() = default;

  [[nodiscard]] virtual int dimension() const = 0;
  [[nodiscard]] virtual int degree() const = 0;
  [[nodiscard]] virtual bool is_lifted() const { return false; }
  /// Returns the number of frames so far. Step k lies between frames k and k+1.
  [[nodiscard]] virtual std::size_t frame_count() const = 0;
  /// Returns the number of steps whose motion is known.
  [[nodiscard]] virtual std::size_t known_steps() const = 0;
  /// Returns whether the motion of step k is known. Waits for its frames if they come from a simulation that
  /// runs.
  [[nodiscard]] virtual bool has_step(std::size_t k) { return k < known_steps(); }

  /// Reads the frames that have been pushed to the source of frames.
  virtual void read_on() {}
  /// Returns the buffer through which the source reads frames, or null if its frames cannot be read ahead.
  /// The first call makes the buffer.
  [[nodiscard]] virtual FrameBuffer* buffer() { return nullptr; }
  /// Returns the number of frames beyond each end of a step that the step needs.
  [[nodiscard]] virtual std::size_t reach() const { return 0; }
  /// Returns a source of the same steps that reads its frames from `frames`, or null if it has no frames.
  [[nodiscard]] virtual std::unique_ptr<StepSource> over(std::unique_ptr<FrameSource> frames) const {
    static_cast<void>(frames);
    return nullptr;
  }
  [[nodiscard]] virtual FrameStamp stamp(std::size_t frame) = 0;
  /// Returns the centres at a frame. Coordinates beyond the dimension are zero.
  [[nodiscard]] virtual Eigen::Matrix3Xd centers(std::size_t frame) = 0;

  /// Makes step k the present one. The functions below are about the present step.
  virtual void go_to(std::size_t k) = 0;
  /// Returns coordinate `axis` of control point k.
  [[nodiscard]] virtual double coordinate(BeadId bead, int k, int axis) const = 0;
  /// Returns the ends of a linear step between two frames, or nothing if the step is another one.
  [[nodiscard]] virtual std::optional<LinearEnds> ends() const { return std::nullopt; }
  /// Returns the cells of the step if the scene is periodic.
  [[nodiscard]] virtual std::optional<CellEnds> cells() const { return std::nullopt; }
  /// Returns the mean displacement of all beads.
  [[nodiscard]] virtual Eigen::Vector3d mean_displacement() const = 0;
  /// Returns whether the source has weights of its own, which no radii give.
  [[nodiscard]] virtual bool has_weights() const { return false; }
  /// Returns control point k of the bead's weight, if the source has weights.
  [[nodiscard]] virtual double weight(BeadId /*bead*/, int /*k*/) const { return 0; }
  /// Returns where the velocities of Hermite curves come from, or nothing for other curves.
  [[nodiscard]] virtual std::optional<VelocitySource> velocities() const { return std::nullopt; }
};

/// The step of an instance. The frames of the step are u = 0 and u = 1.
class InstanceStep final : public StepSource {
 public:
  /// Throws InputError if a control point is not finite.
  explicit InstanceStep(Instance instance);

  [[nodiscard]] const Instance& instance() const { return instance_; }
  [[nodiscard]] int dimension() const override { return instance_.dimension(); }
  [[nodiscard]] int degree() const override { return instance_.degree; }
  [[nodiscard]] std::size_t frame_count() const override { return 2; }
  [[nodiscard]] std::size_t known_steps() const override { return 1; }
  [[nodiscard]] FrameStamp stamp(std::size_t frame) override { return {frame, std::nullopt}; }
  [[nodiscard]] Eigen::Matrix3Xd centers(std::size_t frame) override { return points(frame); }
  void go_to(std::size_t /*k*/) override {}
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const override {
    return instance_.control_point(bead, axis, k);
  }
  [[nodiscard]] Eigen::Vector3d mean_displacement() const override {
    return (points(1) - points(0)).rowwise().mean();
  }
  [[nodiscard]] bool has_weights() const override { return instance_.weighted(); }
  [[nodiscard]] double weight(BeadId bead, int k) const override {
    return instance_.control_point(bead, 3, k);
  }

 private:
  [[nodiscard]] Eigen::Matrix3Xd points(std::size_t frame) const;

  Instance instance_;
};

}  // namespace kds
