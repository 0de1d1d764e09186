#pragma once
// A view of a step's motion through which a user gives some beads other curves. The new curves are tried
// first: if any exception is thrown meanwhile, nothing has changed.

#include <cstddef>
#include <vector>

#include "structures/session/scene_motion.h"

namespace kds {

class NewCourses final : public SceneMotion {
 public:
  /// The motion must outlive this object. Throws std::invalid_argument if a bead does not exist.
  NewCourses(SceneMotion& motion, std::vector<BeadId> beads);
  NewCourses(const NewCourses&) = delete;
  NewCourses& operator=(const NewCourses&) = delete;
  /// Restores the old curves unless set_for_good was called.
  ~NewCourses() override;

  /// Throws std::logic_error, because no other step may be loaded now.
  void load(std::size_t step) override;
  [[nodiscard]] Ref ref() const override { return motion_.ref(); }
  /// Like SceneMotion::set_coordinate, but also throws std::invalid_argument for beads other than those
  /// given.
  void set_coordinate(BeadId bead, int k, int axis, double value) override;

  /// Takes the curves set so far as the new curves, and restores the old ones in the motion until
  /// set_for_good.
  void hold_back();
  void set_for_good();

 private:
  /// Returns the coordinates of these beads, ordered by bead, control point and axis.
  [[nodiscard]] std::vector<double> now() const;
  void set(const std::vector<double>& numbers);

  SceneMotion& motion_;
  std::vector<BeadId> beads_;
  std::vector<double> old_, new_;
  bool for_good_ = false;
};

}  // namespace kds
