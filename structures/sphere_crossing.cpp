#include "structures/sphere_crossing.h"

#include <algorithm>
#include <cmath>

#include "structures/period_lanes.h"
#include "structures/touching_sphere.h"

namespace kds {

namespace {

using detail::BeadLanes;
using detail::beads_of;
using detail::End;
using detail::end_of;
using detail::gather;
using detail::Simplex;
using detail::simplex_of;
using detail::SpherePaths;
using detail::up;
using detail::Vec;

// As in sphere_path.h, where the worst is cubic motion: here it is 40 units of 2^-53, below 2^-47.
constexpr double margin = 0x1p-45;

/// A bound of the slope.
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
template <std::size_t Size>
[[gnu::always_inline]] inline Lanes length(const std::array<Lanes, Size>& v) {
  return root(detail::dot(v, v));
}

/// What vanishes where a point is in the hull, times the volume: of a linear path z.
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
[[KDS_LANES_TARGETS]] void find_paths(const BeadPaths<D>& paths, const BeadLanes<M + 1>& beads,
                                      const PeriodLanes& period, SpherePaths<D>& found) {
  std::array<CurveLanes<1, D>, M> d;
  std::array<PolynomialLanes<1>, M> s;
  std::array<std::array<Vec<D>, M>, 2> d_at;
  std::array<std::array<Lanes, M>, 2> s_at;
  Lanes size(0.0);
  for (int axis = 0; axis <= D; ++axis) {
    const auto place = static_cast<std::size_t>(axis);
    for (std::size_t i = 0; i < M; ++i) {
      std::array<Lanes, 2> control;
      for (std::size_t e = 0; e < 2; ++e) {
        const double* column = paths.column(static_cast<int>(e), axis);
        control[e] = gather(column, beads[i + 1]) - gather(column, beads[0]);
        size = Lanes::max(size, abs(control[e]));
      }
      cut(control, period);
      (axis < D ? d[i][place] : s[i]).scaled = control;
      for (std::size_t e = 0; e < 2; ++e) (axis < D ? d_at[e][i][place] : s_at[e][i]) = control[e];
    }
  }
  size = size * Lanes(detail::root_of[3]);  // no longer curve
  Lanes::Mask proved = (size > Lanes(0x1p-150)) & (size < Lanes(0x1p150));
  const std::array<End<D, M>, 2> end{end_of<false, D, M>(d_at[0], s_at[0]),
                                     end_of<false, D, M>(d_at[1], s_at[1])};
  CurveLanes<1, D> z;
  for (std::size_t axis = 0; axis < D; ++axis) z[axis].scaled = {end[0].z[axis], end[1].z[axis]};
  const PolynomialLanes<1> rho{{end[0].rho, end[1].rho}};
  const Lanes l = Lanes::max(size, Lanes::max(most(z), most(rho)));
  const Lanes rounding = Lanes(margin) * l;

  const Simplex<M> simplex = simplex_of<D, M, 1>(d, z);
  Lanes power(1.0);  // size to the (M - 1)-th
  for (std::size_t i = 1; i < M; ++i) power = power * size;
  const Lanes volume = simplex.volume * Lanes(1 - 0x1p-30) - Lanes(margin) * power * size;
  proved &= volume > Lanes(0.0);
  const Lanes over = Lanes(up) / volume;

  // As in sphere_path.h, for the whole period and for its ends; the slope of the residuals.
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
  Lanes q_error = (q_off + Lanes(margin) * power * size) * over;
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
    q_error += gain[i] * (most(s[i] - dot(d[i], q)) + Lanes(margin) * size);
  }
  q_error = q_error * Lanes(up);
  const Lanes slope = (length(end[0].q) + q_error) * Lanes(up);  // |q|
  const Lanes nearest = least_length(z) - rounding;
  proved &= (nearest > Lanes(0.0)) & (slope < Lanes(0.98));
  Vec<D> step;
  for (std::size_t axis = 0; axis < D; ++axis) step[axis] = end[1].z[axis] - end[0].z[axis];
  const Lanes change = detail::dot(step, step);
  Lanes mismatch(0.0);
  for (const End<D, M>& e : end) mismatch = Lanes::max(mismatch, abs(length(e.z) - e.rho));
  const Lanes steadiness = Lanes(up) / (Lanes(1.0) - slope);
  const Lanes sag = change / (Lanes(8.0) * nearest) * Lanes(up) + mismatch + rounding;
  const Lanes radius_strays = (sag + stray) * steadiness;
  const Lanes strays = (stray + slope * radius_strays) * Lanes(up);
  const Lanes radius_strays_at_ends = (mismatch + rounding + stray_at_ends) * steadiness;
  const Lanes strays_at_ends = (stray_at_ends + slope * radius_strays_at_ends) * Lanes(up);

  // Their slopes.
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
  found.proved = 0;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) found.proved |= proved[lane] != 0 ? 1U << lane : 0U;
}

template <int D>
void find_paths(const BeadPaths<D>& paths, const Basis& basis, const std::array<Period, 4>& periods,
                SpherePaths<D>& found) {
  const PeriodLanes lanes(periods);
  found.period = periods;
  const std::span<const Basis> bases(&basis, 1);
  if (basis.size == 2) return find_paths<D, 1>(paths, beads_of<2>(bases), lanes, found);
  if (D == 2 || basis.size == 3) return find_paths<D, 2>(paths, beads_of<3>(bases), lanes, found);
  if constexpr (D == 3) find_paths<D, 3>(paths, beads_of<4>(bases), lanes, found);
}

/// The gap of a ball in four periods, times 1 or -1: what is positive while its certificate holds.
struct Gaps {
  using Four = std::array<double, 4>;

  std::array<Four, 2> at_end;      // of the chord
  Four loss_at_ends, least;        // and its least value
  Four slowest, fastest;           // slopes, in units of the period
  std::array<Four, 3> square;      // coefficients of (rho' - s)^2 - |p|^2, by powers
  Four loss, clear;                // what |c_b - x| is at least, less the gap
  std::array<Four, 2> lever;       // W at both ends
  Four lever_error, other_factor;  // and 6 |T| / (2 rho), roughly at most
};

template <int D>
[[KDS_LANES_TARGETS]] void find_gaps(const BeadPaths<D>& paths, const SpherePaths<D>& sphere, BeadId base,
                                     BeadId bead, const PeriodLanes& period, double side, Gaps& gaps) {
  const auto get = [](const std::array<double, 4>& from) __attribute__((always_inline)) {
    return Lanes(Lanes::load(from.data()));
  };
  const auto put = [](const Lanes& from, std::array<double, 4>& to) __attribute__((always_inline)) {
    __builtin_memcpy(to.data(), &from.v, sizeof from.v);
  };
  std::array<std::array<Lanes, D + 1>, 2> c;
  for (std::size_t axis = 0; axis <= D; ++axis) {
    std::array<Lanes, 2> control;
    for (std::size_t e = 0; e < 2; ++e) {
      const double* column = paths.column(static_cast<int>(e), static_cast<int>(axis));
      control[e] = Lanes(column[bead] - column[base]);
    }
    cut(control, period);
    for (std::size_t e = 0; e < 2; ++e) c[e][axis] = control[e];
  }
  std::array<Vec<D>, 2> p;
  std::array<Lanes, 2> reach, distance, lever;
  Lanes l = get(sphere.scale);
  for (std::size_t e = 0; e < 2; ++e) {
    lever[e] = -c[e][D];
    for (std::size_t axis = 0; axis < D; ++axis) {
      p[e][axis] = c[e][axis] - get(sphere.center[e][axis]);
      lever[e] += c[e][axis] * get(sphere.q[axis]);
      l = Lanes::max(l, abs(c[e][axis]));
    }
    reach[e] = get(sphere.rho[e]) - c[e][D];
    l = Lanes::max(l, abs(reach[e]));
    distance[e] = length(p[e]);
  }
  const Lanes rounding = Lanes(4 * margin) * l;
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

/// A ball and the side of the sphere where its certificate holds.
template <int D>
struct Crossing {
  const BeadPaths<D>& paths;
  const Basis& basis;
  BeadId bead;
  double side;
  double upper;  // no later than that is now
  int looks = 0;

  static constexpr int most_looks = 12, most_cuts = 2;
  /// Narrow enough; and so wide a bracket would overlap others.
  static constexpr double narrow = 0x1p-31, wide = 0x1p-26;

  [[nodiscard]] Gaps gaps_in(const SpherePaths<D>& sphere) const {
    Gaps gaps;
    find_gaps<D>(paths, sphere, basis.beads[0], bead, PeriodLanes(sphere.period), side, gaps);
    return gaps;
  }

  /// Walks through four periods. `holds`: positive at their start; `soon`: just after now, which is in the
  /// first. Nothing if it cannot tell; `never`: positive to their end.
  [[nodiscard]] std::optional<Failure> walk(const SpherePaths<D>& sphere, bool holds, bool soon, int cuts) {
    const Gaps gaps = gaps_in(sphere);
    for (std::size_t i = 0; i < 4; ++i, soon = false) {
      if ((sphere.proved >> i & 1U) != 0) {
        const bool at_start = gaps.at_end[0][i] > gaps.loss_at_ends[i];
        holds = holds || at_start;
        if (gaps.least[i] > 0 || ((holds || soon) && gaps.slowest[i] > 0)) {
          holds = true;
          continue;
        }
        if (holds && gaps.at_end[1][i] > gaps.loss_at_ends[i] && gaps.fastest[i] < 0) continue;
        if (holds && gaps.at_end[1][i] < -gaps.loss_at_ends[i] && gaps.fastest[i] < 0)
          return locate(sphere.period[i], gaps, i, sphere.proved == 15 ? guess_of(gaps, i) : Guess{});
      }
      if (cuts == most_cuts || ++looks > most_looks || !(holds || soon)) return std::nullopt;
      SpherePaths<D> parts;
      find_paths(paths, basis, quarters_of(sphere.period[i]), parts);
      if (!(parts.period[0].to > upper)) return std::nullopt;
      const auto failure = walk(parts, holds, soon, cuts + 1);
      if (!failure || failure->kind != Failure::Kind::never) return failure;
      holds = true;
    }
    return Failure{};
  }

  [[nodiscard]] static std::array<Period, 4> quarters_of(const Period& period) {
    const double length = period.to - period.from;
    const std::array<double, 5> time{period.from, period.from + 0.25 * length, period.from + 0.5 * length,
                                     period.from + 0.75 * length, period.to};
    return {{{time[0], time[1]}, {time[1], time[2]}, {time[2], time[3]}, {time[3], time[4]}}};
  }

  /// A root in units of a quarter, and about how far off it is; none if negative.
  struct Guess {
    double root = -1, error = 0;
  };
  /// In one of four quarters: of the polynomial through the gap at their ends.
  [[nodiscard]] static Guess guess_of(const Gaps& gaps, std::size_t quarter) {
    const std::array<double, 5> g{gaps.at_end[0][0], gaps.at_end[0][1], gaps.at_end[0][2], gaps.at_end[0][3],
                                  gaps.at_end[1][3]};
    std::array<double, 5> difference = g;  // of rising order, divided by factorials
    for (std::size_t order = 1; order < 5; ++order) {
      for (std::size_t k = 4; k >= order; --k)
        difference[k] = (difference[k] - difference[k - 1]) / static_cast<double>(order);
    }
    const auto value = [&](double at) {
      double sum = difference[4];
      for (std::size_t k = 4; k-- > 0;) sum = sum * (at - static_cast<double>(k)) + difference[k];
      return sum;
    };
    const auto start = static_cast<double>(quarter);
    const double slope = g[quarter + 1] - g[quarter];
    double a = start - g[quarter] / slope, fa = value(a);
    double b = a - fa / slope, fb = value(b);
    for (int round = 0; round < 3 && fb != fa && fb != 0; ++round) {
      const double c = b - fb * (b - a) / (fb - fa);
      a = b;
      fa = fb;
      b = c;
      fb = value(b);
    }
    return {b - start, 0.05 * std::abs(difference[4] / slope)};
  }

  /// The one root in a period where the gap falls, its signs at both ends known: a chord's root, and certain
  /// signs on both sides of it.
  [[nodiscard]] std::optional<Failure> locate(Period bracket, Gaps gaps, std::size_t lane, Guess guess) {
    while (++looks <= most_looks) {
      // The chord's root is off by what is lost over the slope; certain signs take a little more.
      const double length = bracket.to - bracket.from, slope = -gaps.fastest[lane];
      const double c0 = gaps.square[0][lane], c1 = gaps.square[1][lane], c2 = gaps.square[2][lane];
      const double v = c0 / (-c1 + std::copysign(std::sqrt(std::max(c1 * c1 - c0 * c2, 0.0)), c0));
      if (!(v >= 0 && v <= 1 && slope > 0)) return std::nullopt;
      const bool guessed = guess.root > 0 && guess.root < 1;
      const double root = bracket.from + (guessed ? guess.root : v) * length;
      const double least = std::max(3 * gaps.loss_at_ends[lane] / slope * length, 0x1p-38);
      const double reach = std::min(gaps.loss[lane] / slope * length + least, 0.25 * length);
      std::array<Period, 4> periods;
      for (std::size_t i = 0; i < 4; ++i) {
        constexpr std::array<double, 4> share{0.01, 0.1, 1, 4}, errors{1, 16, 256, 0};
        const bool by_guess = guessed && i < 3;
        const double r = std::max(by_guess ? errors[i] * guess.error * length : share[i] * reach, least);
        periods[i] = {std::max(root - r, bracket.from), std::min(root + r, bracket.to)};
        if (!(periods[i].from < periods[i].to)) return std::nullopt;
      }
      SpherePaths<D> sphere;
      find_paths(paths, basis, periods, sphere);
      gaps = gaps_in(sphere);
      guess = {};
      const auto holds_root = [&](std::size_t i) {
        return (sphere.proved >> i & 1U) != 0 && gaps.at_end[0][i] > gaps.loss_at_ends[i] &&
               gaps.at_end[1][i] < -gaps.loss_at_ends[i];
      };
      lane = 0;
      while (lane < 4 && !holds_root(lane)) ++lane;
      if (lane == 4) return std::nullopt;
      bracket = periods[lane];
      const double width = bracket.to - bracket.from;
      if (width > narrow && width < 0.5 * length) continue;
      return width <= wide && names_root_of_norm(gaps, lane) && bracket.from > upper
                 ? std::optional(Failure{Failure::Kind::later, {bracket.from, bracket.to, 0, true}})
                 : std::nullopt;
    }
    return std::nullopt;
  }

  /// Its root is the norm's as well, and no other is.
  [[nodiscard]] static bool names_root_of_norm(const Gaps& gaps, std::size_t lane) {
    const double w0 = gaps.lever[0][lane], w1 = gaps.lever[1][lane];
    const double w = std::min(std::abs(w0), std::abs(w1)) - gaps.lever_error[lane];
    return (w0 > 0) == (w1 > 0) && gaps.other_factor[lane] >= 0 && w > gaps.other_factor[lane] &&
           gaps.clear[lane] > 0;
  }
};

}  // namespace

template <int Dimension>
std::optional<Failure> SphereCrossings<Dimension>::first_failure(const BeadPaths<Dimension>& paths,
                                                                 const Basis& basis, BeadId bead, bool inside,
                                                                 double lower, double upper, bool holds) {
  Crossing<Dimension> crossing{paths, basis, bead, inside ? 1.0 : -1.0, upper};
  if (!(known_ == basis && known_from_ == lower)) {
    known_ = basis;
    known_from_ = lower;
    find_paths(paths, basis, crossing.quarters_of({lower, 1}), from_now_);
  }
  if (!(from_now_.period[0].to > upper)) return std::nullopt;
  return crossing.walk(from_now_, false, holds, 0);
}

template class SphereCrossings<2>;
template class SphereCrossings<3>;

}  // namespace kds
