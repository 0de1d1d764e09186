#include "structures/moving_sphere/beads_beyond.h"

#include <algorithm>
#include <cmath>

#include "structures/moving_sphere/scan_beyond.h"

namespace kds {

namespace {

using detail::below;

template <int D, int K, bool equal>
[[KDS_LANES_TARGETS]] void beyond_of(const BeadPaths<D>& paths, const BeadRange& range, const Basis& basis,
                                     const SphereChord<D>& chord, double from, std::vector<BeadId>& beyond) {
  detail::scan_beyond<D, K, equal>(
      paths, range, basis, chord.center, chord.limit,
      from, [&](BeadId b) __attribute__((always_inline)) { beyond.push_back(b); });
}

/// Four chords and their periods, in lanes.
template <int D>
struct Parts {
  std::array<std::array<Lanes, D>, 2> center;
  std::array<Lanes, 2> limit;
  PeriodLanes period;

  Parts(std::span<const SphereChord<D>, 4> chords, std::span<const Period, 4> periods) : period(periods) {
    for (std::size_t part = 0; part < 4; ++part) {
      for (std::size_t e = 0; e < 2; ++e) {
        limit[e].v[part] = chords[part].limit[e];
        for (std::size_t axis = 0; axis < D; ++axis) center[e][axis].v[part] = chords[part].center[e][axis];
      }
    }
  }
};

template <int D, int K>
[[KDS_LANES_TARGETS]] void keep_beyond_of(const BeadPaths<D>& paths, const Basis& basis,
                                          const Parts<D>& parts, std::vector<BeadId>& beyond) {
  std::size_t kept = 0;
  for (const BeadId b : beyond) {
    std::array<Lanes, K + 1> square, room;
    for (std::size_t axis = 0; axis <= D; ++axis) {
      std::array<Lanes, K + 1> control;
      for (std::size_t k = 0; k <= K; ++k) {
        const double* column = paths.column(static_cast<int>(k), static_cast<int>(axis));
        control[k] = Lanes(column[b] - column[basis.beads[0]]);
      }
      cut(control, parts.period);
      for (std::size_t k = 0; k <= K; ++k) {
        const double t = static_cast<double>(k) / K;
        if (axis < D) {
          const Lanes v =
              control[k] - (Lanes(1 - t) * parts.center[0][axis] + Lanes(t) * parts.center[1][axis]);
          square[k] = axis == 0 ? v * v : square[k] + v * v;
        } else {
          room[k] = (Lanes(1 - t) * parts.limit[0] + Lanes(t) * parts.limit[1]) * Lanes(below) - control[k];
        }
      }
    }
    beyond[kept] = b;
    kept += Lanes::all(are_within(square, room)) ? 0 : 1;
  }
  beyond.resize(kept);
}

template <int D, int K>
void beyond_of_degree(const BeadPaths<D>& paths, const BeadRange& range, const Basis& basis,
                      const SphereChord<D>& chord, double from, std::vector<BeadId>& beyond) {
  return paths.equal_radii() ? beyond_of<D, K, true>(paths, range, basis, chord, from, beyond)
                             : beyond_of<D, K, false>(paths, range, basis, chord, from, beyond);
}

}  // namespace

template <int Dimension>
void find_beyond(const BeadPaths<Dimension>& paths, const BeadRange& range, const Basis& basis,
                 const SphereChord<Dimension>& chord, double from, std::vector<BeadId>& beyond) {
  beyond.clear();
  switch (paths.degree()) {
    case 1:
      return beyond_of_degree<Dimension, 1>(paths, range, basis, chord, from, beyond);
    case 2:
      return beyond_of_degree<Dimension, 2>(paths, range, basis, chord, from, beyond);
    default:
      return beyond_of_degree<Dimension, 3>(paths, range, basis, chord, from, beyond);
  }
}

// A bead's distance from the chord's centre is below the linear interpolation of its end values; see
// linear_chords.h.
template <int Dimension>
void take_out_dipping(const BeadPaths<Dimension>& paths, const Basis& basis,
                      const SphereChord<Dimension>& chord, const Period& period, BeadId risen,
                      std::vector<BeadId>& beyond) {
  if (!(chord.dip > 0) || paths.degree() != 1) return;
  const double sure = std::max(0.0, (period.sure - period.from) / (1 - period.from));
  const double lost = 4 * chord.dip;
  std::size_t kept = 0;
  for (const BeadId b : beyond) {
    std::array<double, 2> square{}, room;
    for (std::size_t e = 0; e < 2; ++e) room[e] = (chord.limit[e] + chord.dip) * below;
    for (std::size_t axis = 0; axis <= Dimension; ++axis) {
      const double* const first = paths.column(0, static_cast<int>(axis));
      const double* const last = paths.column(1, static_cast<int>(axis));
      std::array<double, 2> control{first[b] - first[basis.beads[0]], last[b] - last[basis.beads[0]]};
      control[0] = (1 - period.from) * control[0] + period.from * control[1];
      for (std::size_t e = 0; e < 2; ++e) {
        if (axis == Dimension) {
          room[e] -= control[e];
        } else {
          const double v = control[e] - chord.center[e][axis];
          square[e] += v * v;
        }
      }
    }
    const double a = room[0] - std::sqrt(square[0]), z = room[1] - std::sqrt(square[1]);
    const double least = std::min(a, z);
    const bool inside = (least > 0) & (a + z + 2 * least > lost);
    const bool stays_so = (b == risen) & (a + sure * (z - a) > sure * lost) & (z - a > lost);
    beyond[kept] = b;
    kept += (inside | stays_so) ? 0 : 1;
  }
  beyond.resize(kept);
}

template <int Dimension>
void keep_beyond(const BeadPaths<Dimension>& paths, const Basis& basis,
                 std::span<const SphereChord<Dimension>, 4> chords, std::span<const Period, 4> periods,
                 std::vector<BeadId>& beyond) {
  const Parts<Dimension> parts(chords, periods);
  switch (paths.degree()) {
    case 1:
      return keep_beyond_of<Dimension, 1>(paths, basis, parts, beyond);
    case 2:
      return keep_beyond_of<Dimension, 2>(paths, basis, parts, beyond);
    default:
      return keep_beyond_of<Dimension, 3>(paths, basis, parts, beyond);
  }
}

template void find_beyond(const BeadPaths<2>&, const BeadRange&, const Basis&, const SphereChord<2>&, double,
                          std::vector<BeadId>&);
template void find_beyond(const BeadPaths<3>&, const BeadRange&, const Basis&, const SphereChord<3>&, double,
                          std::vector<BeadId>&);
template void take_out_dipping(const BeadPaths<2>&, const Basis&, const SphereChord<2>&, const Period&,
                               BeadId, std::vector<BeadId>&);
template void keep_beyond(const BeadPaths<2>&, const Basis&, std::span<const SphereChord<2>, 4>,
                          std::span<const Period, 4>, std::vector<BeadId>&);
template void take_out_dipping(const BeadPaths<3>&, const Basis&, const SphereChord<3>&, const Period&,
                               BeadId, std::vector<BeadId>&);
template void keep_beyond(const BeadPaths<3>&, const Basis&, std::span<const SphereChord<3>, 4>,
                          std::span<const Period, 4>, std::vector<BeadId>&);

}  // namespace kds
