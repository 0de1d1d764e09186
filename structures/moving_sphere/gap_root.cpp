#include "structures/moving_sphere/gap_root.h"

#include <algorithm>
#include <cmath>

#include "motions/numbers/lanes.h"
#include "structures/moving_sphere/chord_lanes.h"

namespace kds {

namespace {

using detail::length;
using detail::up;
using detail::Vec;

template <int D>
void find_gaps_in_lanes(const BeadPaths<D>& paths, const SphereEnclosure<D>& sphere, BeadId base, BeadId bead,
                        const PeriodLanes& period, double side, SphereGaps& gaps) {
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
      // Computed before the cut: times are rounded, and a part of a long path is as uncertain as the whole.
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
  const Lanes rounding = Lanes(4 * SphereEnclosure<D>::margin) * l;
  Vec<D> step;
  for (std::size_t axis = 0; axis < D; ++axis) step[axis] = p[1][axis] - p[0][axis];
  const Lanes sum = distance[0] + distance[1], change = detail::dot(step, step);
  // A lower bound of |p| is its component along the sum of both ends.
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
  put(nearest - loss, gaps.apart);
  put(reach[0] * reach[0] - distance[0] * distance[0], gaps.square[0]);
  put(reach[0] * reach_rate - detail::dot(p[0], step), gaps.square[1]);
  put(reach_rate * reach_rate - change, gaps.square[2]);
  put(get(sphere.q_error) * Lanes(2.0) * l + Lanes(4.0) * rounding, gaps.lever_error);
  // Uses |T| <= |G| (rho - s + |c_b - x|) / 2.
  const Lanes factor = Lanes(0.5) * (Lanes::max(reach[0], reach[1]) + sum) + loss + l;
  const Lanes radius = Lanes::min(get(sphere.rho[0]), get(sphere.rho[1])) - loss;
  put((Lanes(1.0) + Lanes(0.5) * get(sphere.other_root)) * factor * Lanes(up) / radius, gaps.other_factor);
}

/// Computes at single times the quantities that find_motion_in_lanes and find_gaps_in_lanes compute at the
/// ends of a period.
template <int D, std::size_t M>
void find_gaps_at_times(const BeadPaths<D>& paths, const detail::BeadLanes<M + 1>& beads, BeadId bead,
                        double side, const Lanes& time, GapsAt& gaps) {
  constexpr double margin = SphereEnclosure<D>::margin;
  const Lanes one(1.0), half(0.5);
  std::array<Vec<D>, M> d;
  std::array<Lanes, M> s;
  Vec<D> of_bead;
  Lanes radius_of_bead, size(0.0), size_with_bead(0.0);
  for (int axis = 0; axis <= D; ++axis) {
    const auto row = static_cast<std::size_t>(axis);
    const double *const from = paths.column(0, axis), *const to = paths.column(1, axis);
    const auto at_time = [&](BeadId b, Lanes & longest) __attribute__((always_inline)) {
      const Lanes first(from[b] - from[beads[0][0]]), last(to[b] - to[beads[0][0]]);
      longest = Lanes::max(longest, Lanes::max(abs(first), abs(last)));
      return (one - time) * first + time * last;
    };
    for (std::size_t i = 0; i < M; ++i) (axis < D ? d[i][row] : s[i]) = at_time(beads[i + 1][0], size);
    (axis < D ? of_bead[row] : radius_of_bead) = at_time(bead, size_with_bead);
  }
  size = size * Lanes(detail::root_of[3]);  // no coordinate curve is longer
  const detail::End<D, M> end = detail::end_of<false, D, M>(d, s);
  const Lanes distance = length(end.z);
  Lanes l = Lanes::max(size, Lanes::max(distance, abs(end.rho)));

  std::array<Lanes, M> gain;
  Lanes volume, power(1.0), off(0.0), q_off(0.0);
  if constexpr (M == 1) {
    gain[0] = one;
    volume = length(d[0]);
    if constexpr (D == 2) {
      off = abs(d[0][0] * end.z[1] - d[0][1] * end.z[0]);
      q_off = abs(d[0][0] * end.q[1] - d[0][1] * end.q[0]);
    } else {
      off = length(detail::cross(d[0], end.z));
      q_off = length(detail::cross(d[0], end.q));
    }
  } else if constexpr (M == 2) {
    gain = {length(d[1]), length(d[0])};
    power = size;
    if constexpr (D == 2) {
      volume = abs(d[0][0] * d[1][1] - d[0][1] * d[1][0]);
    } else {
      const Vec<3> normal = detail::cross(d[0], d[1]);
      volume = length(normal);
      off = abs(detail::dot(normal, end.z));
      q_off = abs(detail::dot(normal, end.q));
    }
  } else {
    const std::array<Vec<3>, 3> normals{detail::cross(d[1], d[2]), detail::cross(d[2], d[0]),
                                        detail::cross(d[0], d[1])};
    for (std::size_t i = 0; i < 3; ++i) gain[i] = length(normals[i]);
    power = size * size;
    volume = abs(detail::dot(d[0], normals[0]));
  }
  Lanes::Mask proved = (size > Lanes(0x1p-150)) & (size < Lanes(0x1p150));
  volume = volume * Lanes(1 - 0x1p-30) - Lanes(margin) * power * size;
  proved &= volume > Lanes(0.0);
  const Lanes over = Lanes(up) / volume, rounding = Lanes(margin) * l;
  const Lanes q_length = length(end.q), q_rounding = Lanes(margin) * (one + q_length);
  Lanes stray = (off + power * size * rounding) * over;
  Lanes q_error = (q_off + q_rounding * power * size) * over + q_rounding;
  for (std::size_t i = 0; i < M; ++i) {
    const Lanes residual =
        half * (detail::dot(d[i], d[i]) - s[i] * s[i]) - (detail::dot(d[i], end.z) - s[i] * end.rho);
    const Lanes by_height = (gain[i] + Lanes(margin) * power) * over;
    stray += by_height * (abs(residual) + l * rounding);
    q_error += by_height * (abs(s[i] - detail::dot(d[i], end.q)) + q_rounding * size);
  }
  const Lanes slope = (q_length + q_error) * Lanes(up), sag = abs(distance - end.rho) + rounding;
  const Lanes lead = detail::least_lead({slope, q_length, q_error}, detail::dot(end.z, end.q),
                                        distance - rounding, distance + rounding, stray, sag);
  proved &= lead > Lanes(detail::little_lead);
  const Lanes radius_strays = (sag + stray) * (Lanes(up) / lead);
  const Lanes strays = (stray + slope * radius_strays) * Lanes(up);
  proved &= strays + radius_strays < Lanes(4.0) * l;

  const Lanes reach = end.rho - radius_of_bead;
  l = Lanes::max(Lanes::max(l, size_with_bead), abs(reach));
  const Lanes value = Lanes(side) * (reach - length(detail::minus(of_bead, end.z)));
  const Lanes loss = (strays + radius_strays) * Lanes(up) + Lanes(4 * margin) * l;
  __builtin_memcpy(gaps.value.data(), &value.v, sizeof value.v);
  __builtin_memcpy(gaps.loss.data(), &loss.v, sizeof loss.v);
  gaps.proved = 0;
  for (std::size_t lane = 0; lane < Lanes::width; ++lane) gaps.proved |= proved[lane] != 0 ? 1U << lane : 0U;
}

/// A ball and the side of the sphere on which its certificate holds.
template <int D>
struct Crossing {
  const BeadPaths<D>& paths;
  const Basis& basis;
  BeadId bead;
  double side;
  double upper;  // the present time is at most this
  int looks = 0;

  static constexpr int most_looks = 12, most_cuts = 2;
  /// A bracket of width `narrow` suffices. A bracket of width `wide` might overlap others, but is accepted if
  /// doubles cannot narrow it.
  static constexpr double narrow = 0x1p-27, wide = 0x1p-26;

  [[nodiscard]] SphereGaps gaps_in(const SphereEnclosure<D>& sphere) const {
    SphereGaps gaps;
    find_gaps(paths, sphere, basis.beads[0], bead, side, gaps);
    return gaps;
  }

  /// Walks through four periods. `holds` means that the gap is positive at their start, and `soon` that it is
  /// positive just after now, which lies in the first period. Returns none if it cannot decide, and a failure
  /// of kind `never` if the gap stays positive to the end.
  [[nodiscard]] std::optional<Failure> walk(const SphereEnclosure<D>& sphere, bool holds, bool soon,
                                            int cuts) {
    const SphereGaps gaps = gaps_in(sphere);
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
      SphereEnclosure<D> parts;
      find_motion(paths, basis, quarters_of(sphere.period[i]), parts);
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

  /// An estimated root in units of a quarter, and its approximate error. A negative root means none.
  struct Guess {
    double root = -1, error = 0;
  };
  /// Estimates the root in one of four quarters by the polynomial through the gap at their ends.
  [[nodiscard]] static Guess guess_of(const SphereGaps& gaps, std::size_t quarter) {
    const std::array<double, 5> g{gaps.at_end[0][0], gaps.at_end[0][1], gaps.at_end[0][2], gaps.at_end[0][3],
                                  gaps.at_end[1][3]};
    std::array<double, 5> difference = g;  // divided differences of rising order
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

  /// Locates the only root in a period where the gap falls and its signs at both ends are known. Repeatedly
  /// evaluates the gap at four times around an estimate until the signs of a narrow bracket are certain.
  [[nodiscard]] std::optional<Failure> locate(const Period& part, const SphereGaps& gaps, std::size_t lane,
                                              Guess guess) {
    const double length = part.to - part.from, slope = -gaps.fastest[lane] / length;
    if (!(slope > 0)) return std::nullopt;
    double from = part.from, to = part.to;
    double gap_from = gaps.at_end[0][lane], gap_to = gaps.at_end[1][lane];
    double loss = gaps.loss_at_ends[lane];
    if (!(guess.root > 0 && guess.root < 1)) {  // guess the root of the sphere's chord instead
      const double c0 = gaps.square[0][lane], c1 = gaps.square[1][lane], c2 = gaps.square[2][lane];
      guess.root = c0 / (-c1 + std::copysign(std::sqrt(std::max(c1 * c1 - c0 * c2, 0.0)), c0));
      if (!(guess.root >= 0 && guess.root <= 1)) return std::nullopt;
      guess.error = std::min(gaps.loss[lane] / (slope * length), 0.25);
    }
    double root = part.from + guess.root * length, error = guess.error * length;
    while (++looks <= most_looks) {
      // A certain sign needs a distance slightly larger than the rounding error. If two brackets are valid,
      // the wider one is taken, because its signs also hold for a longer time after the root.
      const double before = to - from, least = std::max(3 * loss / slope, 0x1p-33);
      const bool sharp = 4 * error < 0.49 * narrow;
      const double near = std::max(sharp ? error : std::max(0.49 * narrow, 0.0625 * error), least);
      const double far = std::max(sharp ? 0.49 * narrow : 4 * error, near + near);
      const std::array<double, 4> times{std::max(root - far, from), std::max(root - near, from),
                                        std::min(root + near, to), std::min(root + far, to)};
      GapsAt at;
      find_gaps_at(paths, basis, bead, side, times, at);
      const auto sign = [&](std::size_t i) {
        const bool known = (at.proved >> i & 1U) != 0 && std::abs(at.value[i]) > at.loss[i];
        return !known ? 0 : at.value[i] > 0 ? 1 : -1;
      };
      for (const std::size_t i : {0U, 1U}) {
        if (sign(i) > 0 && sign(3 - i) < 0 && times[3 - i] - times[i] <= narrow)
          return found({times[i], times[3 - i]}, gaps, lane,
                       std::max(at.value[i] + at.loss[i], at.loss[3 - i] - at.value[3 - i]));
      }
      for (std::size_t i = 0; i < 4; ++i) {
        if (sign(i) > 0) {
          from = times[i];
          gap_from = at.value[i];
        } else if (sign(i) < 0) {
          to = times[i];
          gap_to = at.value[i];
          break;
        }
      }
      loss = *std::max_element(at.loss.begin(), at.loss.end());
      const double width = to - from;
      if (width <= (near > least ? narrow : wide))
        return found({from, to}, gaps, lane, std::max(gap_from, -gap_to) + loss);
      if (!(width < 0.75 * before)) return std::nullopt;
      root = from + width * gap_from / (gap_from - gap_to);
      error = width * std::min(0.05, width / length);
    }
    return std::nullopt;
  }

  /// Returns the root in a bracket where the gap is at most `most`, in a part with these gaps.
  [[nodiscard]] std::optional<Failure> found(const Period& bracket, const SphereGaps& gaps, std::size_t lane,
                                             double most) const {
    if (!(bracket.from > upper)) return std::nullopt;
    if (!names_root_of_norm(gaps, lane, most)) {
      SphereEnclosure<D> sphere;
      find_motion(paths, basis, {bracket, bracket, bracket, bracket}, sphere);
      if ((sphere.proved & 1U) == 0 || !names_root_of_norm(gaps_in(sphere), 0, most)) return std::nullopt;
    }
    return Failure{Failure::Kind::later,
                   {bracket.from, bracket.to, 0, true, false, false, DecidedBy::isolation}};
  }

  /// Returns whether the norm has this root too, and no other.
  [[nodiscard]] static bool names_root_of_norm(const SphereGaps& gaps, std::size_t lane, double most) {
    const double w0 = gaps.lever[0][lane], w1 = gaps.lever[1][lane];
    const double w = std::min(std::abs(w0), std::abs(w1)) - gaps.lever_error[lane];
    return (w0 > 0) == (w1 > 0) && gaps.other_factor[lane] >= 0 && w > gaps.other_factor[lane] * most &&
           gaps.apart[lane] > most;
  }
};

}  // namespace

template <int Dimension>
void find_gaps(const BeadPaths<Dimension>& paths, const SphereEnclosure<Dimension>& sphere, BeadId base,
               BeadId bead, double side, SphereGaps& gaps) {
  in_long_lanes<&find_gaps_in_lanes<Dimension>>(paths, sphere, base, bead, PeriodLanes(sphere.period), side,
                                                gaps);
}

template <int Dimension>
void find_gaps_at(const BeadPaths<Dimension>& paths, const Basis& basis, BeadId bead, double side,
                  const std::array<double, 4>& times, GapsAt& gaps) {
  const Lanes time = Lanes::load(times.data());
  const std::span<const Basis> bases(&basis, 1);
  if (basis.size == 2)
    return in_long_lanes<&find_gaps_at_times<Dimension, 1>>(paths, detail::beads_of<2>(bases), bead, side,
                                                            time, gaps);
  if (Dimension == 2 || basis.size == 3)
    return in_long_lanes<&find_gaps_at_times<Dimension, 2>>(paths, detail::beads_of<3>(bases), bead, side,
                                                            time, gaps);
  if constexpr (Dimension == 3)
    in_long_lanes<&find_gaps_at_times<Dimension, 3>>(paths, detail::beads_of<4>(bases), bead, side, time,
                                                     gaps);
}

template void find_gaps_at(const BeadPaths<2>&, const Basis&, BeadId, double, const std::array<double, 4>&,
                           GapsAt&);
template void find_gaps_at(const BeadPaths<3>&, const Basis&, BeadId, double, const std::array<double, 4>&,
                           GapsAt&);
template void find_gaps(const BeadPaths<2>&, const SphereEnclosure<2>&, BeadId, BeadId, double, SphereGaps&);
template void find_gaps(const BeadPaths<3>&, const SphereEnclosure<3>&, BeadId, BeadId, double, SphereGaps&);

template <int Dimension>
std::optional<Failure> GapRoots<Dimension>::first_failure(const BeadPaths<Dimension>& paths,
                                                          const Basis& basis, BeadId bead, bool inside,
                                                          double lower, double upper, bool holds) {
  Crossing<Dimension> crossing{paths, basis, bead, inside ? 1.0 : -1.0, upper};
  if (!(known_ == basis && known_from_ == lower)) {
    known_ = basis;
    known_from_ = lower;
    find_motion(paths, basis, crossing.quarters_of({lower, 1}), from_now_);
  }
  if (!(from_now_.period[0].to > upper)) return std::nullopt;
  return crossing.walk(from_now_, false, holds, 0);
}

template class GapRoots<2>;
template class GapRoots<3>;

}  // namespace kds
