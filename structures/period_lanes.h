#pragma once
// Parts of a step side by side, and what the chords of four spheres need of them.

#include <algorithm>
#include <array>
#include <span>

#include "certificates/isolate_lanes.h"
#include "structures/sphere_path.h"

namespace kds {

/// What is cut off before, and then after.
struct PeriodLanes {
  Lanes from, to;
  Lanes sure = Lanes(0.0);  // as a share of the part
  bool whole = true;        // nothing at all

  /// Up to four, the last one as often as there are lanes left.
  explicit PeriodLanes(std::span<const Period> periods) {
    for (std::size_t lane = 0; lane < Lanes::width; ++lane) {
      const Period& period = periods[std::min(lane, periods.size() - 1)];
      from.v[lane] = period.from;
      to.v[lane] = (period.to - period.from) / (1 - period.from);
      if (period.sure > period.from) sure.v[lane] = (period.sure - period.from) / (period.to - period.from);
      whole &= period.from == 0 && period.to == 1;
    }
  }
};

/// Control points of the part from those of the step.
template <std::size_t N>
[[gnu::always_inline]] inline void cut(std::array<Lanes, N>& control, const PeriodLanes& period) {
  if (period.whole) return;
  casteljau(control, period.from);
  casteljau_left(control, period.to);
}

/// Where all distances, given by their squares, are within what there is room for.
template <std::size_t N>
[[gnu::always_inline]] inline Lanes::Mask are_within(const std::array<Lanes, N>& square,
                                                     const std::array<Lanes, N>& room) {
  Lanes::Mask within = (room[0] >= Lanes(0.0)) & (square[0] <= room[0] * room[0]);
  for (std::size_t k = 1; k < N; ++k) within &= (room[k] >= Lanes(0.0)) & (square[k] <= room[k] * room[k]);
  return within;
}

}  // namespace kds
