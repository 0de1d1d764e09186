#pragma once
// The motion of a step for who gives some of its beads other curves. These are tried first: where that fails,
// by whatever exception, nothing has happened to anybody.

#include <cstddef>
#include <vector>

#include "structures/session/scene_motion.h"

namespace kds {

class NewCourses final : public SceneMotion {
 public:
  /// The motion must outlive it. Throws std::invalid_argument where there is no such bead.
  NewCourses(SceneMotion& motion, std::vector<BeadId> beads);
  NewCourses(const NewCourses&) = delete;
  NewCourses& operator=(const NewCourses&) = delete;
  /// The old curves are back, unless the new ones were set for good.
  ~NewCourses() override;

  /// Throws std::logic_error: this is no time for another step.
  void load(std::size_t step) override;
  [[nodiscard]] Ref ref() const override { return motion_.ref(); }
  /// Throws std::invalid_argument for other beads, too.
  void set_coordinate(BeadId bead, int k, int axis, double value) override;

  /// What was set until now are the new curves; the motion has the old ones until they are set for good.
  void hold_back();
  void set_for_good();

 private:
  /// Of these beads, in the order of beads, control points and axes.
  [[nodiscard]] std::vector<double> now() const;
  void set(const std::vector<double>& numbers);

  SceneMotion& motion_;
  std::vector<BeadId> beads_;
  std::vector<double> old_, new_;
  bool for_good_ = false;
};

}  // namespace kds
