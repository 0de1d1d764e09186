#include "structures/sphere_crossing.h"

#include <algorithm>
#include <cmath>

#include "structures/sphere_gaps.h"

namespace kds {

namespace {

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
  static constexpr double narrow = 0x1p-27, wide = 0x1p-26;

  [[nodiscard]] SphereGaps gaps_in(const SphereMotion<D>& sphere) const {
    SphereGaps gaps;
    find_gaps(paths, sphere, basis.beads[0], bead, side, gaps);
    return gaps;
  }

  /// Walks through four periods. `holds`: positive at their start; `soon`: just after now, which is in the
  /// first. Nothing if it cannot tell; `never`: positive to their end.
  [[nodiscard]] std::optional<Failure> walk(const SphereMotion<D>& sphere, bool holds, bool soon, int cuts) {
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
      SphereMotion<D> parts;
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

  /// A root in units of a quarter, and about how far off it is; none if negative.
  struct Guess {
    double root = -1, error = 0;
  };
  /// In one of four quarters: of the polynomial through the gap at their ends.
  [[nodiscard]] static Guess guess_of(const SphereGaps& gaps, std::size_t quarter) {
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
  [[nodiscard]] std::optional<Failure> locate(Period bracket, SphereGaps gaps, std::size_t lane,
                                              Guess guess) {
    while (++looks <= most_looks) {
      // The chord's root is off by what is lost over the slope; certain signs take a little more.
      const double length = bracket.to - bracket.from, slope = -gaps.fastest[lane];
      const double c0 = gaps.square[0][lane], c1 = gaps.square[1][lane], c2 = gaps.square[2][lane];
      const double v = c0 / (-c1 + std::copysign(std::sqrt(std::max(c1 * c1 - c0 * c2, 0.0)), c0));
      if (!(v >= 0 && v <= 1 && slope > 0)) return std::nullopt;
      const bool guessed = guess.root > 0 && guess.root < 1;
      const double root = bracket.from + (guessed ? guess.root : v) * length;
      const double least = std::max(3 * gaps.loss_at_ends[lane] / slope * length, 0x1p-33);
      const double reach = std::min(gaps.loss[lane] / slope * length + least, 0.25 * length);
      std::array<Period, 4> periods;
      for (std::size_t i = 0; i < 4; ++i) {
        constexpr std::array<double, 4> share{0.01, 0.1, 1, 4}, errors{0.0625, 1, 64, 0};
        const bool by_guess = guessed && i < 3;
        const double r = std::max(by_guess ? errors[i] * guess.error * length : share[i] * reach, least);
        periods[i] = {std::max(root - r, bracket.from), std::min(root + r, bracket.to)};
        if (!(periods[i].from < periods[i].to)) return std::nullopt;
      }
      SphereMotion<D> sphere;
      find_motion(paths, basis, periods, sphere);
      gaps = gaps_in(sphere);
      guess = {};
      const auto holds_root = [&](std::size_t i) {
        return (sphere.proved >> i & 1U) != 0 && gaps.at_end[0][i] > gaps.loss_at_ends[i] &&
               gaps.at_end[1][i] < -gaps.loss_at_ends[i];
      };
      // The widest that will do: it tells most of what comes just after.
      const auto length_of = [&](std::size_t i) { return periods[i].to - periods[i].from; };
      lane = 4;
      for (std::size_t i = 0; i < 4; ++i)
        if (holds_root(i) && (lane == 4 || (length_of(i) <= narrow && length_of(i) > length_of(lane))))
          lane = i;
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
  [[nodiscard]] static bool names_root_of_norm(const SphereGaps& gaps, std::size_t lane) {
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
    find_motion(paths, basis, crossing.quarters_of({lower, 1}), from_now_);
  }
  if (!(from_now_.period[0].to > upper)) return std::nullopt;
  return crossing.walk(from_now_, false, holds, 0);
}

template class SphereCrossings<2>;
template class SphereCrossings<3>;

}  // namespace kds
