#include "structures/moving_sphere/sphere_chord.h"

#include <algorithm>
#include <cmath>

#include "certificates/base/determinant.h"
#include "motions/numbers/lanes.h"
#include "structures/moving_sphere/chord_lanes.h"
#include "structures/moving_sphere/linear_chords.h"

namespace kds {

namespace {

using detail::BeadLanes;
using detail::beads_of;
using detail::End;
using detail::end_of;
using detail::gather;
using detail::least_lead;
using detail::little_lead;
using detail::margin;
using detail::Simplex;
using detail::simplex_of;
using detail::SlopeBound;
using detail::up;
using detail::Vec;

template <int D, std::size_t M, int K>
[[KDS_LANES_TARGETS]] void find_curved_chords(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads,
                                              const PeriodLanes& period, ChordLanes<D>& chords) {
  // Curves relative to the first ball, and their ends.
  std::array<CurveLanes<K, D>, M> d;
  std::array<PolynomialLanes<K>, M> s;
  std::array<std::array<Vec<D>, M>, 2> d_at;
  std::array<std::array<Lanes, M>, 2> s_at;
  Lanes size(0.0);
  for (int axis = 0; axis <= D; ++axis) {
    const auto row = static_cast<std::size_t>(axis);
    std::array<std::array<Lanes, K + 1>, M> control;
    for (std::size_t k = 0; k <= K; ++k) {
      const double* column = paths.column(static_cast<int>(k), axis);
      const Lanes base = gather(column, beads[0]);
      for (std::size_t i = 0; i < M; ++i) {
        control[i][k] = gather(column, beads[i + 1]) - base;
        size = Lanes::max(size, abs(control[i][k]));
      }
    }
    for (std::size_t i = 0; i < M; ++i) {
      cut(control[i], period);
      auto& curve = axis < D ? d[i][row] : s[i];
      for (std::size_t k = 0; k <= K; ++k)
        curve.scaled[k] = control[i][k] * Lanes(static_cast<double>(binomial(K, static_cast<int>(k))));
      for (std::size_t e = 0; e < 2; ++e) (axis < D ? d_at[e][i][row] : s_at[e][i]) = control[i][e * K];
    }
  }
  size = size * Lanes(detail::root_of[3]);  // no coordinate curve is longer
  // Within these limits, products neither overflow nor become subnormal.
  Lanes::Mask proved = (size > Lanes(0x1p-150)) & (Lanes(paths.extent()) < Lanes(0x1p150));
  const std::array<End<D, M>, 2> end{end_of<false, D, M>(d_at[0], s_at[0]),
                                     end_of<false, D, M>(d_at[1], s_at[1])};
  CurveLanes<1, D> z;
  for (std::size_t axis = 0; axis < D; ++axis) z[axis].scaled = {end[0].z[axis], end[1].z[axis]};
  const PolynomialLanes<1> rho{{end[0].rho, end[1].rho}};
  const Lanes l = Lanes::max(size, most(z));
  const Lanes rounding = Lanes(margin) * l;

  const Simplex<M> simplex = simplex_of<D, M, K>(d, z);
  Lanes power(1.0);  // size to the power M - 1
  for (std::size_t i = 1; i < M; ++i) power = power * size;
  const Lanes volume = simplex.volume * Lanes(1 - 0x1p-30) - Lanes(margin) * power * size;
  proved &= volume > Lanes(0.0);
  const Lanes over = Lanes(up) / volume;

  // Uses x = z' + (term from the residuals) + (slope of the radii) * (rho - rho').
  Lanes stray = (simplex.off_hull + power * size * rounding) * over;
  SlopeBound slope{Lanes(0.0), root(detail::dot(end[0].q, end[0].q)), Lanes(0.0)};
  CurveLanes<0, D> q;
  for (std::size_t axis = 0; axis < D; ++axis) q[axis].scaled = {end[0].q[axis]};
  for (std::size_t i = 0; i < M; ++i) {
    // Twice the residual is 2 r_i = |c_i|^2 - s_i^2 + 2 s_i rho' - 2 c_i.z'.
    auto product = dot(d[i], z);
    product -= s[i] * rho;
    product += product;
    auto twice = dot(d[i], d[i]);
    twice -= s[i] * s[i];
    twice -= elevate<2 * K>(product);
    const Lanes gain = (simplex.gain[i] + Lanes(margin) * power) * over;
    stray += gain * (Lanes(0.5) * most_between(twice) + l * rounding);
    slope.most += gain * (most(s[i]) + Lanes(margin) * size);
    slope.wander += gain * (most(s[i] - dot(d[i], q)) + Lanes(margin) * size * (Lanes(1.0) + slope.at_start));
  }
  slope.most = Lanes::min(slope.most, (slope.at_start + slope.wander) * Lanes(up));
  const Lanes nearest = least_length(z) - rounding;
  proved &= nearest > Lanes(0.0);
  // Bounds the difference of |z'| and rho'. The length of z' sags below its chord.
  Lanes change(0.0), mismatch(0.0);
  for (std::size_t axis = 0; axis < D; ++axis) {
    const Lanes step = end[1].z[axis] - end[0].z[axis];
    change += step * step;
  }
  for (const End<D, M>& e : end) mismatch = Lanes::max(mismatch, abs(root(detail::dot(e.z, e.z)) - e.rho));
  const Lanes sag = change / (Lanes(8.0) * nearest) * Lanes(up) + mismatch + rounding;
  const Lanes ahead = Lanes::max(detail::dot(end[0].z, end[0].q), detail::dot(end[1].z, end[0].q));
  const Lanes lead = least_lead(slope, ahead, nearest, most(z) + rounding, stray, sag);
  proved &= lead > Lanes(little_lead);
  const Lanes radius_strays = (sag + stray) * (Lanes(up) / lead);
  const Lanes strays = (stray + slope.most * radius_strays) * Lanes(up);

  // Bounds the distance of z' from sum w_i c_i.
  CurveLanes<K + 1, D> bend;
  for (std::size_t axis = 0; axis < D; ++axis) {
    bend[axis] = elevate<K + 1>(z[axis]);
    for (std::size_t i = 0; i < M; ++i)
      bend[axis] -= PolynomialLanes<1>{{end[0].weight[i + 1], end[1].weight[i + 1]}} * d[i][axis];
  }
  Lanes heaviest(1.0);
  for (const End<D, M>& e : end)
    for (const Lanes& w : e.weight) heaviest = Lanes::max(heaviest, abs(w));
  const Lanes apart = (strays + most_between(bend) + heaviest * rounding) * Lanes(up) * over;
  chords.stays = Lanes::Mask{};
  for (std::size_t i = 0; i <= M; ++i) {
    const Lanes weight = Lanes::min(end[0].weight[i], end[1].weight[i]) - heaviest * Lanes(margin);
    const Lanes gain = (i == 0 ? simplex.gain_of_first : simplex.gain[i - 1]) + Lanes(margin) * power;
    chords.stays |= (weight > apart * gain) & (Lanes::Mask{} + (1L << i));
  }
  // Each ball is touched from outside.
  Lanes room = Lanes::min(end[0].rho, end[1].rho);
  for (std::size_t i = 0; i < M; ++i) room = Lanes::min(room, least(elevate<K>(rho) - s[i]));
  proved &= room > radius_strays + rounding;
  const Lanes loss = strays + radius_strays + Lanes(margin) * (Lanes(paths.extent()) + l);
  for (std::size_t e = 0; e < 2; ++e) {
    chords.center[e] = end[e].z;
    chords.limit[e] = end[e].rho - loss;
  }
  chords.proved = proved & (loss < Lanes(4.0) * l);  // false too if a bound is NaN
}

/// Handles two balls of equal radius in linear motion: the midpoint moves linearly, and the two never part.
template <int D>
[[KDS_LANES_TARGETS]] void find_chords_of_pairs(const BeadPaths<D>& paths, const BeadLanes<2>& beads,
                                                const PeriodLanes& period, ChordLanes<D>& chords) {
  std::array<Lanes, 2> square{Lanes(0.0), Lanes(0.0)};
  Lanes change(0.0), size(0.0);
  for (int axis = 0; axis < D; ++axis) {
    std::array<Lanes, 2> d;
    for (std::size_t e = 0; e < 2; ++e) {
      const double* column = paths.column(static_cast<int>(e), axis);
      d[e] = gather(column, beads[1]) - gather(column, beads[0]);
      size = Lanes::max(size, abs(d[e]));
    }
    cut(d, period);
    for (std::size_t e = 0; e < 2; ++e) {
      chords.center[e][static_cast<std::size_t>(axis)] = Lanes(0.5) * d[e];
      square[e] += d[e] * d[e];
    }
    change += (d[1] - d[0]) * (d[1] - d[0]);
  }
  const std::array<Lanes, 2> length{root(square[0]), root(square[1])};
  const Lanes longest = size * Lanes(detail::root_of[3]);  // an upper bound
  // Half the lower bound of the length.
  const Lanes nearest = Lanes(0.25) * (length[0] + length[1] - root(change)) - Lanes(margin) * longest;
  chords.proved =
      (longest > Lanes(0x1p-150)) & (Lanes(paths.extent()) < Lanes(0x1p150)) & (nearest > Lanes(0.0));
  chords.stays = Lanes::Mask{} + 3;
  chords.dip = Lanes(0.03125) * change / nearest * Lanes(up);
  const Lanes loss = chords.dip + Lanes(margin) * (Lanes(paths.extent()) + longest);
  // If the balls nearly meet, a limit's rounding exceeds its value.
  chords.proved &= loss < Lanes(4.0) * longest;
  for (std::size_t e = 0; e < 2; ++e) chords.limit[e] = Lanes(0.5) * length[e] - loss;
}

/// Handles a ball that holds the others.
template <int D>
void find_chords_of_one(const BeadPaths<D>& paths, ChordLanes<D>& chords) {
  for (std::size_t e = 0; e < 2; ++e) {
    chords.center[e].fill(Lanes(0.0));
    chords.limit[e] = Lanes(-margin * paths.extent());
  }
  chords.proved = Lanes::Mask{} - (paths.extent() > 0x1p-150 && paths.extent() < 0x1p150 ? 1L : 0L);
  chords.stays = Lanes::Mask{} + 1;
}

template <int D, std::size_t M, int K, bool equal>
void find_chords(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads, const PeriodLanes& period,
                 ChordLanes<D>& chords) {
  if constexpr (K == 1) {
    in_long_lanes<&detail::find_linear_chords<D, M, equal>>(paths, beads, period, chords);
  } else {
    find_curved_chords<D, M, K>(paths, beads, period, chords);
  }
}

template <int D, int K, bool equal>
void find_chords_of_degree(const BeadPaths<D>& paths, std::span<const Basis> bases, const PeriodLanes& period,
                           ChordLanes<D>& chords) {
  const std::size_t size = bases.front().size;
  if (size == 1) {
    find_chords_of_one(paths, chords);
  } else if (size == 2) {
    if constexpr (equal) {
      find_chords_of_pairs(paths, beads_of<2>(bases), period, chords);
    } else {
      find_chords<D, 1, K, equal>(paths, beads_of<2>(bases), period, chords);
    }
  } else if (D == 2 || size == 3) {
    find_chords<D, 2, K, equal>(paths, beads_of<3>(bases), period, chords);
  } else if constexpr (D == 3) {
    find_chords<D, 3, K, equal>(paths, beads_of<4>(bases), period, chords);
  }
}

template <int D, int K>
void find_chords_of_degree(const BeadPaths<D>& paths, std::span<const Basis> bases, const PeriodLanes& period,
                           ChordLanes<D>& chords) {
  // The most frequent case has a specialization of its own.
  return K == 1 && paths.equal_radii() ? find_chords_of_degree<D, K, K == 1>(paths, bases, period, chords)
                                       : find_chords_of_degree<D, K, false>(paths, bases, period, chords);
}

}  // namespace

template <int Dimension>
void find_chords(const BeadPaths<Dimension>& paths, std::span<const Basis> bases, const PeriodLanes& period,
                 ChordLanes<Dimension>& chords) {
  switch (paths.degree()) {
    case 1:
      return find_chords_of_degree<Dimension, 1>(paths, bases, period, chords);
    case 2:
      return find_chords_of_degree<Dimension, 2>(paths, bases, period, chords);
    default:
      return find_chords_of_degree<Dimension, 3>(paths, bases, period, chords);
  }
}

template <int Dimension>
void sphere_chords(const BeadPaths<Dimension>& paths, std::span<const Basis> bases,
                   std::span<const Period> periods, std::span<SphereChord<Dimension>> chords) {
  ChordLanes<Dimension> lanes;
  find_chords(paths, bases, PeriodLanes(periods), lanes);
  for (std::size_t lane = 0; lane < chords.size(); ++lane) lanes.give(lane, chords[lane]);
}

template void find_chords(const BeadPaths<2>&, std::span<const Basis>, const PeriodLanes&, ChordLanes<2>&);
template void find_chords(const BeadPaths<3>&, std::span<const Basis>, const PeriodLanes&, ChordLanes<3>&);

template void sphere_chords(const BeadPaths<2>&, std::span<const Basis>, std::span<const Period>,
                            std::span<SphereChord<2>>);
template void sphere_chords(const BeadPaths<3>&, std::span<const Basis>, std::span<const Period>,
                            std::span<SphereChord<3>>);

}  // namespace kds
