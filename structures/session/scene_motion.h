#pragma once
// The motion of a scene's present step, for scenes of any dimension, degree and kind of motion.

#include <cstddef>
#include <memory>
#include <variant>

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

}  // namespace kds
