#pragma once
// A linear motion some steps ahead, each bead taken to go straight on: what is proved of it holds step after
// step for as long as the beads do. That a bead goes on is seen where the next step begins, exactly: it
// starts where the step before ended, and moves by the very same double in each coordinate. Motions within a
// tolerance (straightened_frames.h) are made so, and beads at rest go on, too.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "motions/curves/curves.h"
#include "motions/numbers/lanes.h"

namespace kds {

/// Itself a motion: of the step looked at last and those behind it in one. Exact for the beads that are
/// known.
template <int DimensionValue>
class MotionAhead {
 public:
  static constexpr int dimension = DimensionValue;
  static constexpr int degree = 1;
  /// As many as that: a power of two, so that products are exact.
  static constexpr unsigned steps = 8;

  /// At the start of a step of a linear motion. Beads that were not looked at in the step before have turned,
  /// and all of them where there are more or fewer.
  void look_at(const Curves<DimensionValue>& curves) { look_at(curves, 1); }
  /// The same of a few beads alone, for those who want to know the share of those that went straight on:
  /// nothing else may be asked then, and little memory is taken.
  void look_at_some(const Curves<DimensionValue>& curves) { look_at(curves, 1 + curves.bead_count() / 16); }

  /// Of those looked at last.
  [[nodiscard]] double share_straight() const {
    return static_cast<double>(straight_) / static_cast<double>(courses_.size());
  }
  /// -1 where the bead did not go straight on into the step looked at last, else 0; of the infinite bead 0.
  [[nodiscard, gnu::always_inline]] std::int32_t turned(BeadId bead) const {
    return turned_.data()[std::ptrdiff_t{static_cast<std::int32_t>(bead)} + 1];
  }
  /// Whether that is so of all beads.
  [[nodiscard]] bool all_known() const { return all_known_; }
  /// Whether all that the bead does ahead is exact. If not, it is far away from all others.
  [[nodiscard]] bool is_known(BeadId bead) const { return courses_[bead].known_in == step_; }

  [[nodiscard]] std::size_t bead_count() const { return records_.size(); }
  [[nodiscard]] const double* control_point(BeadId bead, int k) const { return records_[bead].control[k]; }
  [[nodiscard]] double coordinate(BeadId bead, int k, int axis) const { return control_point(bead, k)[axis]; }
  [[nodiscard]] double weight(BeadId bead, int k) const { return control_point(bead, k)[dimension]; }
  [[nodiscard]] double radius(BeadId, int) const { return 0; }
  [[nodiscard]] const double* radii(BeadId) const { return none_.data(); }

 private:
  // As in BezierMotion: those of a bead in space fill one cache line.
  struct alignas(dimension == 3 ? 64 : 8) Record {
    double control[2][dimension + 1] = {};
  };
  struct Course {
    Lanes::Vector end{}, step{};
    std::uint32_t known_in = 0;  ///< which step
  };
  void look_at(const Curves<DimensionValue>& curves, std::size_t every);

  std::vector<Record> records_;
  std::uint32_t step_ = 2;
  std::size_t every_ = 0;        // which beads were looked at last
  std::vector<Course> courses_;  // theirs
  std::vector<std::int32_t> turned_;
  std::size_t straight_ = 0;
  bool all_known_ = false;
  std::array<double, 2> none_{};
};

static_assert(Motion<MotionAhead<3>>);

extern template class MotionAhead<2>;
extern template class MotionAhead<3>;

}  // namespace kds
