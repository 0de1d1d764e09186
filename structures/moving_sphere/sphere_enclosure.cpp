#include "structures/moving_sphere/sphere_enclosure.h"

#include <cmath>

#include "motions/numbers/lanes.h"
#include "structures/moving_sphere/chord_lanes.h"

namespace kds {

namespace {

using detail::BeadLanes;
using detail::beads_of;
using detail::End;
using detail::end_of;
using detail::gather;
using detail::length;
using detail::Simplex;
using detail::simplex_of;
using detail::up;
using detail::Vec;

/// Returns a bound of the slope.
template <int N>
[[gnu::always_inline]] inline Lanes steepest(const PolynomialLanes<N>& p) {
  Lanes most(0.0);
  for (std::size_t k = 0; k < N; ++k) most = Lanes::max(most, abs(coefficient(p, k + 1) - coefficient(p, k)));
  return Lanes(static_cast<double>(N)) * most;
}
template <int N, std::size_t Size>
[[gnu::always_inline]] inline Lanes steepest(const std::array<PolynomialLanes<N>, Size>& v) {
  Lanes most(0.0);
  for (std::size_t k = 0; k < N; ++k) {
    Lanes square(0.0);
    for (const auto& p : v) {
      const Lanes step = coefficient(p, k + 1) - coefficient(p, k);
      square += step * step;
    }
    most = Lanes::max(most, square);
  }
  return Lanes(static_cast<double>(N)) * root(most);
}

/// Returns, for a linear path z, the polynomials that vanish if z is in the hull, times the volume.
template <int D, std::size_t M, int N>
[[gnu::always_inline]] inline auto off_hull(const std::array<CurveLanes<1, D>, M>& d,
                                            const CurveLanes<N, D>& z) {
  if constexpr (M == 1 && D == 2) {
    return d[0][0] * z[1] - d[0][1] * z[0];
  } else if constexpr (M == 1) {
    return std::array{d[0][1] * z[2] - d[0][2] * z[1], d[0][2] * z[0] - d[0][0] * z[2],
                      d[0][0] * z[1] - d[0][1] * z[0]};
  } else {
    static_assert(M == 2 && D == 3);
    return dot(kds::cross(d[0], d[1]), z);
  }
}

template <int D, std::size_t M>
void find_motion_in_lanes(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads, const PeriodLanes& period,
                          SphereEnclosure<D>& found) {
  constexpr double margin = SphereEnclosure<D>::margin;
  std::array<CurveLanes<1, D>, M> d;
  std::array<PolynomialLanes<1>, M> s;
  std::array<std::array<Vec<D>, M>, 2> d_at;
  std::array<std::array<Lanes, M>, 2> s_at;
  Lanes size(0.0);
  for (int axis = 0; axis <= D; ++axis) {
    const auto row = static_cast<std::size_t>(axis);
    for (std::size_t i = 0; i < M; ++i) {
      std::array<Lanes, 2> control;
      for (std::size_t e = 0; e < 2; ++e) {
        const double* column = paths.column(static_cast<int>(e), axis);
        control[e] = gather(column, beads[i + 1]) - gather(column, beads[0]);
        size = Lanes::max(size, abs(control[e]));
      }
      cut(control, period);
      (axis < D ? d[i][row] : s[i]).scaled = control;
      for (std::size_t e = 0; e < 2; ++e) (axis < D ? d_at[e][i][row] : s_at[e][i]) = control[e];
    }
  }
  size = size * Lanes(detail::root_of[3]);  // no coordinate curve is longer
  Lanes::Mask proved = (size > Lanes(0x1p-150)) & (size < Lanes(0x1p150));
  const std::array<End<D, M>, 2> end{end_of<false, D, M>(d_at[0], s_at[0]),
                                     end_of<false, D, M>(d_at[1], s_at[1])};
  CurveLanes<1, D> z;
  for (std::size_t axis = 0; axis < D; ++axis) z[axis].scaled = {end[0].z[axis], end[1].z[axis]};
  const PolynomialLanes<1> rho{{end[0].rho, end[1].rho}};
  const Lanes l = Lanes::max(size, Lanes::max(most(z), most(rho)));
  const Lanes rounding = Lanes(margin) * l;

  const Simplex<M> simplex = simplex_of<D, M, 1>(d, z);
  Lanes power(1.0);  // size to the power M - 1
  for (std::size_t i = 1; i < M; ++i) power = power * size;
  const Lanes volume = simplex.volume * Lanes(1 - 0x1p-30) - Lanes(margin) * power * size;
  proved &= volume > Lanes(0.0);
  const Lanes over = Lanes(up) / volume;

  // Bounds residuals as in sphere_chord.h, for the whole period and for its ends, and bounds their slopes.
  const Lanes hull_rounding = power * size * rounding;
  Lanes off_at_ends(0.0), off_rate(0.0), off_turn(0.0), q_off(0.0);
  CurveLanes<0, D> q;
  for (std::size_t axis = 0; axis < D; ++axis) q[axis].scaled = {end[0].q[axis]};
  if constexpr (M < D) {
    const auto off = off_hull<D, M, 1>(d, z);
    const auto at = [](const auto& o, std::size_t k) __attribute__((always_inline)) {
      if constexpr (M == 1 && D == 3) {
        return root(square(o, k));
      } else {
        return abs(coefficient(o, k));
      }
    };
    off_at_ends = Lanes::max(at(off, 0), at(off, M + 1));
    off_rate = steepest(off);
    if constexpr (M == 1) {
      off_turn = steepest(d[0]);
    } else {
      off_turn = steepest(kds::cross(d[0], d[1]));
    }
    q_off = most(off_hull<D, M, 0>(d, q));
  }
  Lanes stray = (simplex.off_hull + hull_rounding) * over;
  Lanes stray_at_ends = (off_at_ends + hull_rounding) * over;
  const Lanes q_length = length(end[0].q), q_rounding = Lanes(margin) * (Lanes(1.0) + q_length);
  Lanes q_error = (q_off + q_rounding * power * size) * over + q_rounding;
  std::array<Lanes, M> gain, residual_rate;
  for (std::size_t i = 0; i < M; ++i) {
    auto product = dot(d[i], z) - s[i] * rho;
    product += product;
    auto twice = dot(d[i], d[i]) - s[i] * s[i];
    twice -= product;
    gain[i] = (simplex.gain[i] + Lanes(margin) * power) * over;
    stray += gain[i] * (Lanes(0.5) * most_between(twice) + l * rounding);
    stray_at_ends +=
        gain[i] * (Lanes(0.5) * Lanes::max(abs(twice.scaled[0]), abs(twice.scaled[2])) + l * rounding);
    residual_rate[i] = Lanes(0.5) * steepest(twice) + l * rounding;
    q_error += gain[i] * (most(s[i] - dot(d[i], q)) + q_rounding * size);
  }
  q_error = q_error * Lanes(up);
  const Lanes slope = (q_length + q_error) * Lanes(up);
  const Lanes nearest = least_length(z) - rounding;
  proved &= nearest > Lanes(0.0);
  Vec<D> step;
  for (std::size_t axis = 0; axis < D; ++axis) step[axis] = end[1].z[axis] - end[0].z[axis];
  const Lanes change = detail::dot(step, step);
  Lanes mismatch(0.0);
  for (const End<D, M>& e : end) mismatch = Lanes::max(mismatch, abs(length(e.z) - e.rho));
  const Lanes sag = change / (Lanes(8.0) * nearest) * Lanes(up) + mismatch + rounding;
  const Lanes ahead = Lanes::max(detail::dot(end[0].z, end[0].q), detail::dot(end[1].z, end[0].q));
  const Lanes lead =
      detail::least_lead({slope, q_length, q_error}, ahead, nearest,
                         Lanes::max(length(end[0].z), length(end[1].z)) + rounding, stray, sag);
  proved &= lead > Lanes(detail::little_lead);
  const Lanes steadiness = Lanes(up) / lead;
  const Lanes radius_strays = (sag + stray) * steadiness;
  const Lanes strays = (stray + slope * radius_strays) * Lanes(up);
  const Lanes radius_strays_at_ends = (mismatch + rounding + stray_at_ends) * steadiness;
  const Lanes strays_at_ends = (stray_at_ends + slope * radius_strays_at_ends) * Lanes(up);

  // Bounds of the slopes.
  Lanes stray_rate = (off_rate + hull_rounding + (off_turn + Lanes(margin) * power * size) * strays) * over;
  for (std::size_t i = 0; i < M; ++i) {
    stray_rate += gain[i] * (residual_rate[i] + (steepest(d[i]) + rounding) * strays +
                             (steepest(s[i]) + rounding) * radius_strays);
  }
  const Lanes turn =
      (change + Lanes(2.0) * strays * root(change)) / nearest + Lanes(2.0) * (mismatch + rounding);
  const Lanes radius_rate = (turn + stray_rate) * steadiness * Lanes(up);
  const Lanes center_rate = (stray_rate + slope * radius_rate) * Lanes(up);

  // Each ball is touched from outside.
  Lanes room = Lanes::min(end[0].rho, end[1].rho);
  for (std::size_t i = 0; i < M; ++i) room = Lanes::min(room, least(rho - s[i]));
  proved &= (room > radius_strays + rounding) & (strays + radius_strays < Lanes(4.0) * l);

  const auto put = [](const Lanes& from, std::array<double, 4>& to) __attribute__((always_inline)) {
    __builtin_memcpy(to.data(), &from.v, sizeof from.v);
  };
  for (std::size_t e = 0; e < 2; ++e) {
    put(end[e].rho, found.rho[e]);
    for (std::size_t axis = 0; axis < D; ++axis) put(end[e].z[axis], found.center[e][axis]);
  }
  put(strays, found.center_strays);
  put((strays + radius_strays) * Lanes(up), found.loss);
  put((strays_at_ends + radius_strays_at_ends) * Lanes(up), found.loss_at_ends);
  put((center_rate + radius_rate) * Lanes(up), found.rate_loss);
  put(l, found.scale);
  for (std::size_t axis = 0; axis < D; ++axis) put(end[0].q[axis], found.q[axis]);
  put(q_error, found.q_error);
  const Lanes one(1.0);
  put(Lanes::choose(slope < one, one, slope * (one + slope) * steadiness), found.other_root);
  found.proved = 0;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) found.proved |= proved[lane] != 0 ? 1U << lane : 0U;
}

}  // namespace

template <int Dimension>
void find_motion(const BeadPaths<Dimension>& paths, const Basis& basis, const std::array<Period, 4>& periods,
                 SphereEnclosure<Dimension>& motion) {
  const PeriodLanes lanes(periods);
  motion.period = periods;
  const std::span<const Basis> bases(&basis, 1);
  if (basis.size == 2)
    return in_long_lanes<&find_motion_in_lanes<Dimension, 1>>(paths, beads_of<2>(bases), lanes, motion);
  if (Dimension == 2 || basis.size == 3)
    return in_long_lanes<&find_motion_in_lanes<Dimension, 2>>(paths, beads_of<3>(bases), lanes, motion);
  if constexpr (Dimension == 3)
    in_long_lanes<&find_motion_in_lanes<Dimension, 3>>(paths, beads_of<4>(bases), lanes, motion);
}

template void find_motion(const BeadPaths<2>&, const Basis&, const std::array<Period, 4>&,
                          SphereEnclosure<2>&);
template void find_motion(const BeadPaths<3>&, const Basis&, const std::array<Period, 4>&,
                          SphereEnclosure<3>&);

}  // namespace kds
