#pragma once
// Extrapolates a linear motion several steps ahead, assuming that each bead goes straight on. Facts proved
// about the extrapolation hold step after step while the beads do go straight on. Whether a bead does is
// decided exactly at the start of the next step: it must start where it ended the step before and move by the
// very same double in each coordinate. Motions within a tolerance (straightened_frames.h) are made that way,
// and beads at rest also go straight on.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/numbers/lanes.h"

namespace kds {

/// Is itself a motion, which covers the step examined last and the following steps as one. This motion is
/// exact for the beads that are known.
template <int DimensionValue>
class MotionAhead {
 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = 1;
  /// The number of steps covered: a power of two, so that products are exact.
  static constexpr unsigned steps = 8;

  /// Examines the start of a step of a linear motion. Beads that were not examined in the step before
  /// count as turned. If the number of beads has changed, all of them count as turned.
  void look_at(const Curves<DimensionValue>& curves) { look_at(curves, 1); }
  /// Examines at most sixteen beads, to estimate the share that went straight on. Takes little memory, but
  /// only share_straight may be called afterwards.
  void look_at_some(const Curves<DimensionValue>& curves) { look_at(curves, 1 + curves.bead_count() / 16); }

  /// Returns the share of beads that went straight on, among those examined last.
  [[nodiscard]] double share_straight() const {
    return static_cast<double>(straight_) / static_cast<double>(courses_.size());
  }
  /// Returns -1 if the bead did not go straight on into the step examined last, else 0; for the infinite
  /// bead 0.
  [[nodiscard, gnu::always_inline]] std::int32_t turned(BeadId bead) const {
    return turned_.data()[std::ptrdiff_t{static_cast<std::int32_t>(bead)} + 1];
  }
  /// Returns whether is_known() holds for all beads.
  [[nodiscard]] bool all_known() const { return all_known_; }
  /// Returns whether the extrapolation of the bead is exact. If not, the bead is placed far away from all
  /// others.
  [[nodiscard]] bool is_known(BeadId bead) const { return courses_[bead].known_in == step_; }

  [[nodiscard]] std::size_t bead_count() const { return records_.size(); }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const { return records_[bead].control[k]; }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] double radius(BeadId, int) const { return 0; }
  [[nodiscard]] const double* radii(BeadId) const { return none_.data(); }

 private:
  // Stores a bead's control points together, as in BezierMotion; in space they fill one cache line.
  struct alignas(dimension == 3 ? 64 : 8) Record {
    double control[2][dimension + 1] = {};
  };
  struct Course {
    Lanes::Vector end{}, step{};
    std::uint32_t known_in = 0;  ///< the step in which the bead was known
  };
  void look_at(const Curves<DimensionValue>& curves, std::size_t every);

  std::vector<Record> records_;
  std::uint32_t step_ = 2;
  std::size_t every_ = 0;        // the stride of the beads examined last
  std::vector<Course> courses_;  // the courses of those beads
  std::vector<std::int32_t> turned_;
  std::size_t straight_ = 0;
  bool all_known_ = false;
  std::array<double, 2> none_{};
};

static_assert(Motion<MotionAhead<3>>);

extern template class MotionAhead<2>;
extern template class MotionAhead<3>;

}  // namespace kds
