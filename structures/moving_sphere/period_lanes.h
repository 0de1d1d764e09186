#pragma once
// Parts of a step in lanes, and the data that the chords of four spheres need of them.

#include <algorithm>
#include <array>
#include <span>

#include "certificates/filters/lanes_polynomial.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

/// The shares to cut off before and then after.
struct PeriodLanes {
  Lanes from, to;
  Lanes sure;  // as a share of the part
  bool whole;  // nothing is cut off

  /// Takes up to four periods; the last one fills the remaining lanes.
  explicit PeriodLanes(std::span<const Period> periods) {
    const std::size_t last = periods.size() - 1;
    const Period &a = periods[0], &b = periods[std::min<std::size_t>(1, last)],
                 &c = periods[std::min<std::size_t>(2, last)], &d = periods[std::min<std::size_t>(3, last)];
    from = Lanes::Vector{a.from, b.from, c.from, d.from};
    const Lanes until = Lanes::Vector{a.to, b.to, c.to, d.to};
    const Lanes until_sure = Lanes::Vector{a.sure, b.sure, c.sure, d.sure};
    to = (until - from) / (Lanes(1.0) - from);
    sure = Lanes::max(until_sure - from, Lanes(0.0)) / (until - from);
    whole = Lanes::all((from <= Lanes(0.0)) & (until >= Lanes(1.0)));
  }
};

/// Computes the control points of the part from those of the step.
template <std::size_t N>
[[gnu::always_inline]] inline void cut(std::array<Lanes, N>& control, const PeriodLanes& period) {
  if (period.whole) return;
  casteljau(control, period.from);
  casteljau_left(control, period.to);
}

/// Returns the lanes where all distances, given by their squares, are within the available room.
template <std::size_t N>
[[gnu::always_inline]] inline Lanes::Mask are_within(const std::array<Lanes, N>& square,
                                                     const std::array<Lanes, N>& room) {
  Lanes::Mask within = (room[0] >= Lanes(0.0)) & (square[0] <= room[0] * room[0]);
  for (std::size_t k = 1; k < N; ++k) within &= (room[k] >= Lanes(0.0)) & (square[k] <= room[k] * room[k]);
  return within;
}

}  // namespace kds
