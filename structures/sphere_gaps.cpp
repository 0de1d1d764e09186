#include "structures/sphere_gaps.h"

#include <cmath>

#include "structures/period_lanes.h"
#include "structures/touching_sphere.h"

namespace kds {

namespace {

using detail::up;
using detail::Vec;

template <std::size_t Size>
[[gnu::always_inline]] inline Lanes length(const std::array<Lanes, Size>& v) {
  return root(detail::dot(v, v));
}

template <int D>
[[KDS_LONG_LANES_TARGETS]] void find_gaps_in_lanes(const BeadPaths<D>& paths, const SphereMotion<D>& sphere,
                                                   BeadId base, BeadId bead, const PeriodLanes& period,
                                                   double side, SphereGaps& gaps) {
  const auto get = [](const std::array<double, 4>& from) __attribute__((always_inline)) {
    return Lanes(Lanes::load(from.data()));
  };
  const auto put = [](const Lanes& from, std::array<double, 4>& to) __attribute__((always_inline)) {
    __builtin_memcpy(to.data(), &from.v, sizeof from.v);
  };
  std::array<std::array<Lanes, D + 1>, 2> c;
  Lanes l = get(sphere.scale);
  for (std::size_t axis = 0; axis <= D; ++axis) {
    std::array<Lanes, 2> control;
    for (std::size_t e = 0; e < 2; ++e) {
      const double* column = paths.column(static_cast<int>(e), static_cast<int>(axis));
      control[e] = Lanes(column[bead] - column[base]);
      // Before it is cut: times are rounded, and a part of a long path is as uncertain as the whole.
      l = Lanes::max(l, abs(control[e]));
    }
    cut(control, period);
    for (std::size_t e = 0; e < 2; ++e) c[e][axis] = control[e];
  }
  std::array<Vec<D>, 2> p;
  std::array<Lanes, 2> reach, distance, lever;
  for (std::size_t e = 0; e < 2; ++e) {
    lever[e] = -c[e][D];
    for (std::size_t axis = 0; axis < D; ++axis) {
      p[e][axis] = c[e][axis] - get(sphere.center[e][axis]);
      lever[e] += c[e][axis] * get(sphere.q[axis]);
    }
    reach[e] = get(sphere.rho[e]) - c[e][D];
    l = Lanes::max(l, abs(reach[e]));
    distance[e] = length(p[e]);
  }
  const Lanes rounding = Lanes(4 * SphereMotion<D>::margin) * l;
  Vec<D> step;
  for (std::size_t axis = 0; axis < D; ++axis) step[axis] = p[1][axis] - p[0][axis];
  const Lanes sum = distance[0] + distance[1], change = detail::dot(step, step);
  // |p| is at least its part along the sum of both.
  Vec<D> along;
  for (std::size_t axis = 0; axis < D; ++axis) along[axis] = p[0][axis] + p[1][axis];
  const Lanes nearest =
      Lanes::min(detail::dot(along, p[0]), detail::dot(along, p[1])) / length(along) - rounding;
  const Lanes reach_rate = reach[1] - reach[0];
  const Lanes slope0 = reach_rate - detail::dot(p[0], step) / distance[0];
  const Lanes slope1 = reach_rate - detail::dot(p[1], step) / distance[1];
  const Lanes rate_loss = get(sphere.rate_loss) + rounding +
                          Lanes(2.0) * get(sphere.center_strays) * root(change) / nearest * Lanes(up);
  const Lanes loss = get(sphere.loss) + rounding;
  const Lanes loss_at_ends = get(sphere.loss_at_ends) + rounding;
  const std::array<Lanes, 2> gap{reach[0] - distance[0], reach[1] - distance[1]};
  const Lanes::Mask known = nearest > Lanes(0.0);
  const Lanes nothing(-HUGE_VAL);
  const Lanes sign(side);
  if (side > 0) {
    put(Lanes::min(gap[0], gap[1]) - loss, gaps.least);
    put(Lanes::choose(known, slope1 - rate_loss, nothing), gaps.slowest);
    put(Lanes::choose(known, slope0 + rate_loss, -nothing), gaps.fastest);
  } else {
    const Lanes sag = change / (Lanes(8.0) * nearest) * Lanes(up);
    put(Lanes::choose(known, -(Lanes::max(gap[0], gap[1]) + sag + loss), nothing), gaps.least);
    put(Lanes::choose(known, -slope0 - rate_loss, nothing), gaps.slowest);
    put(Lanes::choose(known, -slope1 + rate_loss, -nothing), gaps.fastest);
  }
  for (std::size_t e = 0; e < 2; ++e) {
    put(sign * gap[e], gaps.at_end[e]);
    put(lever[e], gaps.lever[e]);
  }
  put(loss_at_ends, gaps.loss_at_ends);
  put(loss, gaps.loss);
  put(nearest - loss - abs(gap[0]) - abs(gap[1]), gaps.clear);
  put(reach[0] * reach[0] - distance[0] * distance[0], gaps.square[0]);
  put(reach[0] * reach_rate - detail::dot(p[0], step), gaps.square[1]);
  put(reach_rate * reach_rate - change, gaps.square[2]);
  put(get(sphere.q_error) * Lanes(2.0) * l + Lanes(4.0) * rounding, gaps.lever_error);
  // |T| <= |G| (rho - s + |p|) / 2; the gap between two ends of different signs is no larger than there.
  const Lanes factor = Lanes(0.5) * (Lanes::max(reach[0], reach[1]) + sum) + l;
  const Lanes radius = Lanes::min(get(sphere.rho[0]), get(sphere.rho[1])) - loss;
  put(Lanes(3.0) * (Lanes::max(abs(gap[0]), abs(gap[1])) + loss_at_ends) * factor / radius,
      gaps.other_factor);
}

}  // namespace

template <int Dimension>
void find_gaps(const BeadPaths<Dimension>& paths, const SphereMotion<Dimension>& sphere, BeadId base,
               BeadId bead, double side, SphereGaps& gaps) {
  find_gaps_in_lanes<Dimension>(paths, sphere, base, bead, PeriodLanes(sphere.period), side, gaps);
}

template void find_gaps(const BeadPaths<2>&, const SphereMotion<2>&, BeadId, BeadId, double, SphereGaps&);
template void find_gaps(const BeadPaths<3>&, const SphereMotion<3>&, BeadId, BeadId, double, SphereGaps&);

}  // namespace kds
