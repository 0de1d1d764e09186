#include "motions/curves/rounded_positions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

namespace kds {

namespace {

/// A time u and its distance 1 - u from the end.
struct RoundedTime {
  explicit RoundedTime(const Dyadic& time)
      : later{time.round_down(), time.round_up() - time.round_down()},
        earlier(TrackedDouble{1.0, 0.0} - later) {}
  TrackedDouble later, earlier;
};

/// Evaluates a Bezier curve at a time by de Casteljau's algorithm. `row` provides room for its control
/// points.
template <class Control>
TrackedDouble curve_at(const RoundedTime& time, std::vector<TrackedDouble>& row, Control control) {
  for (std::size_t k = 0; k < row.size(); ++k) row[k] = {control(static_cast<int>(k)), 0.0};
  for (std::size_t left = row.size() - 1; left > 0; --left) {
    for (std::size_t i = 0; i < left; ++i) row[i] = time.earlier * row[i] + time.later * row[i + 1];
  }
  return row[0];
}

void raise(double& bound, const TrackedDouble& number) {
  const bool is_finite = std::isfinite(number.value) && std::isfinite(number.error);
  bound = std::max(bound, is_finite ? number.error : std::numeric_limits<double>::infinity());
}

}  // namespace

template <int D>
RoundedPositions<D>::RoundedPositions(const MotionRef<D>& motion, const Dyadic& time) {
  const RoundedTime at(time);
  motion.visit([&]<class Some>(const Some& curves) {
    std::vector<TrackedDouble> room(static_cast<std::size_t>(curves.own_degree()) + 1);
    rows_.resize(curves.bead_count());
    radii_.resize(curves.bead_count());
    for (BeadId b = 0; b < rows_.size(); ++b) {
      rows_[b] = {};
      for (int axis = 0; axis < D; ++axis) {
        const TrackedDouble x = curve_at(at, room, [&](int k) { return curves.coordinate(b, k, axis); });
        rows_[b][static_cast<std::size_t>(axis)] = x.value;
        raise(coordinate_error_, x);
      }
      TrackedDouble weight = curve_at(at, room, [&](int k) { return curves.weight(b, k); });
      if constexpr (lifted<Some>) {  // subtract u (1-u) |D|^2 (lifted_motion.h)
        for (int axis = 0; axis < D; ++axis) {
          const TrackedDouble moved = TrackedDouble{curves.coordinate(b, 1, axis), 0.0} -
                                      TrackedDouble{curves.coordinate(b, 0, axis), 0.0} -
                                      TrackedDouble{curves.drift(axis), 0.0};
          weight -= at.later * at.earlier * (moved * moved);
        }
      }
      rows_[b][D] = weight.value;
      raise(weight_error_, weight);
      radii_[b] = curve_at(at, room, [&](int k) { return curves.radius(b, k); });
    }
  });
}

template class RoundedPositions<2>;
template class RoundedPositions<3>;

}  // namespace kds
