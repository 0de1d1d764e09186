#pragma once
// The chords of four spheres in lanes (sphere_chord.h), as they are computed.

#include <array>
#include <span>

#include "structures/moving_sphere/period_lanes.h"
#include "structures/moving_sphere/sphere_chord.h"

namespace kds {

template <int Dimension>
struct ChordLanes {
  using Vector = std::array<Lanes, static_cast<std::size_t>(Dimension)>;

  std::array<Vector, 2> center;
  std::array<Lanes, 2> limit;
  Lanes dip = Lanes(0.0);
  Lanes::Mask proved, stays, rises{};

  /// Like SphereChord::enlarge.
  [[gnu::always_inline]] void enlarge(double factor) {
    if (!(factor > 1)) return;
    const Lanes by =
        Lanes::choose((limit[0] > Lanes(0.0)) & (limit[1] > Lanes(0.0)), Lanes(factor), Lanes(1.0));
    for (Lanes& l : limit) l = l * by;
    dip = dip * by;
  }

  /// Writes a lane in place, because copying a chord built elsewhere is slow.
  [[gnu::always_inline]] void give(std::size_t lane, SphereChord<Dimension>& chord) const {
    chord.proved = proved[lane] != 0;
    chord.stays = static_cast<std::uint8_t>(stays[lane]);
    chord.rises = static_cast<std::uint8_t>(rises[lane]);
    chord.dip = dip.v[lane];
    for (std::size_t e = 0; e < 2; ++e) {
      chord.limit[e] = limit[e].v[lane];
      for (std::size_t axis = 0; axis < Dimension; ++axis) chord.center[e][axis] = center[e][axis].v[lane];
    }
  }
};

/// Finds the chords of up to four bases of one size.
template <int Dimension>
void find_chords(const BeadPaths<Dimension>& paths, std::span<const Basis> bases, const PeriodLanes& period,
                 ChordLanes<Dimension>& chords);

}  // namespace kds
