#pragma once
// The motion of a scene's present step, for scenes of any dimension, degree and kind of motion.

#include <cstddef>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "motions/curves/motion_ref.h"
#include "motions/scene/scene.h"

namespace kds {

/// With a higher degree, the binomials in certificate functions exceed the range of doubles.
inline constexpr int highest_degree = 10;

class SceneMotion {
 public:
  using Ref = std::variant<MotionRef<1>, MotionRef<2>, MotionRef<3>>;

  virtual ~SceneMotion() = default;
  /// Sets the motion to that of the step.
  virtual void load(std::size_t step) = 0;
  [[nodiscard]] virtual Ref ref() const = 0;
  /// Sets one number of a bead's k-th control point, until a step is loaded. Throws std::invalid_argument,
  /// and changes nothing, if there is no such number or the value is not finite.
  virtual void set_coordinate(BeadId bead, int k, int axis, double value) = 0;
};

/// The scene must outlive the motion. Throws InputError if the degree is above highest_degree.
[[nodiscard]] std::unique_ptr<SceneMotion> make_scene_motion(const Scene& scene);

/// Returns the coordinates of these beads, ordered by bead, control point and axis. Throws
/// std::invalid_argument if a bead does not exist.
[[nodiscard]] std::vector<double> coordinates_of(const SceneMotion& motion, std::span<const BeadId> beads);
/// Sets the coordinates of these beads, in the order of coordinates_of. Throws std::invalid_argument if a
/// bead does not exist, the count is wrong, or a number is not finite; the numbers before that one stay set.
void set_coordinates(SceneMotion& motion, std::span<const BeadId> beads, std::span<const double> numbers);

/// A view of a step's motion, in which some beads are given other curves as a trial. The old curves are
/// restored when the trial ends.
class TrialCourses final : public SceneMotion {
 public:
  /// The motion must outlive this object. Throws std::invalid_argument if a bead does not exist.
  TrialCourses(SceneMotion& motion, std::vector<BeadId> beads);
  TrialCourses(const TrialCourses&) = delete;
  TrialCourses& operator=(const TrialCourses&) = delete;
  ~TrialCourses() override;

  /// Throws std::logic_error, because no other step may be loaded now.
  void load(std::size_t step) override;
  [[nodiscard]] Ref ref() const override { return motion_.ref(); }
  /// Like SceneMotion::set_coordinate, but also throws std::invalid_argument for beads other than those
  /// given.
  void set_coordinate(BeadId bead, int k, int axis, double value) override;

 private:
  SceneMotion& motion_;
  std::vector<BeadId> beads_;
  std::vector<double> old_;
};

}  // namespace kds
