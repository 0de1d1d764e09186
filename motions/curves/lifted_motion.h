#pragma once
// The lifted motion: each bead's centre x and its lift l = |x|^2 - w move linearly, so that each sphere moves
// on a straight line in lifted space. At both ends of the step, power diagrams are those of the frames. In
// between the weights are fictitious,
//   w(u) = (1-u) w(0) + u w(1) - u(1-u) |D|^2,   D the bead's displacement less the drift,
// beads may become hidden, and spheres are meaningless, so the motion serves only power diagrams. A power
// test has degree 4 (5 in linear motion). A drift common to all beads would enter through cross terms, so it
// is removed: |x|^2 is taken in a frame of reference that moves with it.
//
// Exact: the motion is given by its control points and the drift, all doubles.

#include <array>

#include "motions/curves/bezier_motion.h"
#include "motions/numbers/bernstein.h"

namespace kds {

template <int DimensionValue>
class LiftedMotion : public BezierMotion<DimensionValue, 1> {
 public:
  static constexpr bool is_lifted = true;
  using Vector = std::array<double, static_cast<std::size_t>(DimensionValue)>;

  using BezierMotion<DimensionValue, 1>::BezierMotion;

  [[nodiscard]] double drift(int axis) const { return drift_[static_cast<std::size_t>(axis)]; }
  void set_drift(const Vector& drift) {
    for (std::size_t axis = 0; axis < drift.size(); ++axis) drift_[axis] = finite(drift[axis]);
  }

 private:
  Vector drift_{};
};

/// Returns l of bead i minus l of bead j, with all lengths relative to the start of j. Adding a multiple of
/// the centres to l changes no power test, so this is equivalent to the lift:
///   u = 0:  |d(0)|^2 - w                        d = centre of i minus centre of j
///   u = 1:  |d(1)|^2 + 2 D.d(1) - w             w = weight of i minus weight of j, D of j
template <class View>
[[nodiscard, gnu::always_inline]] inline auto lift_of(const View& view, BeadId i, BeadId j) {
  static_assert(View::degree == 1);
  const auto d = view.difference(i, j);
  const auto w = view.weight_difference(i, j);
  const auto displacement = view.displacement(j);
  typename View::Number start = -w.scaled[0];
  typename View::Number end = -w.scaled[1];
  for (std::size_t axis = 0; axis < d.size(); ++axis) {
    start += d[axis].scaled[0] * d[axis].scaled[0];
    end += d[axis].scaled[1] * (d[axis].scaled[1] + displacement[axis] + displacement[axis]);
  }
  Bernstein<typename View::Number, 1> lift;
  lift.scaled = {start, end};
  return lift;
}

static_assert(Motion<LiftedMotion<3>> && lifted<LiftedMotion<3>>);

}  // namespace kds
