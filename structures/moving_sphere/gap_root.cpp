#include "structures/moving_sphere/gap_root.h"

#include <algorithm>
#include <cmath>

#include "structures/moving_sphere/gap_bounds.h"

namespace kds {

namespace {

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

  /// Walks through four periods. `holds` tells that the gap is positive at their start, `soon` that it is
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
    if (!(guess.root > 0 && guess.root < 1)) {  // the chord's root, with its error
      const double c0 = gaps.square[0][lane], c1 = gaps.square[1][lane], c2 = gaps.square[2][lane];
      guess.root = c0 / (-c1 + std::copysign(std::sqrt(std::max(c1 * c1 - c0 * c2, 0.0)), c0));
      if (!(guess.root >= 0 && guess.root <= 1)) return std::nullopt;
      guess.error = std::min(gaps.loss[lane] / (slope * length), 0.25);
    }
    double root = part.from + guess.root * length, error = guess.error * length;
    while (++looks <= most_looks) {
      // A certain sign needs slightly more than the rounding error. The wider of two valid brackets is
      // preferred, because it says more about the time just after.
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
    return Failure{Failure::Kind::later, {bracket.from, bracket.to, 0, true}};
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
