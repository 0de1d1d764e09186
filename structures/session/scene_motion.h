#pragma once
// The motion of a scene's present step, of whatever dimension, degree and kind the scene has.

#include <cstddef>
#include <memory>
#include <variant>

#include "motions/curves/motion_ref.h"
#include "motions/scene/scene.h"

namespace kds {

/// Above this degree functions are too long for double's range of binomials.
inline constexpr int highest_degree = 10;

class SceneMotion {
 public:
  using Ref = std::variant<MotionRef<1>, MotionRef<2>, MotionRef<3>>;

  virtual ~SceneMotion() = default;
  /// Sets the motion to that of the step.
  virtual void load(std::size_t step) = 0;
  [[nodiscard]] virtual Ref ref() const = 0;
  /// Sets one number of a bead's k-th control point, until a step is loaded. Throws std::invalid_argument
  /// where there is no such number, or the value is not finite, and the motion is as before.
  virtual void set_coordinate(BeadId bead, int k, int axis, double value) = 0;
};

/// The scene must outlive it. Throws InputError where the degree is above highest_degree.
[[nodiscard]] std::unique_ptr<SceneMotion> make_scene_motion(const Scene& scene);

}  // namespace kds
