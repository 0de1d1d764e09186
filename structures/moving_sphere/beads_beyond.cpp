#include "structures/moving_sphere/beads_beyond.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "motions/numbers/lanes.h"
#include "structures/moving_sphere/chord_lanes.h"

namespace kds {

namespace {

// Scans for beads that a chord does not prove to stay inside, four at a time, at all control points.

/// A word with one bit for each of 64 consecutive beads, in four runs of every fourth bead, the order in
/// which lanes produce them.
class BeadWord {
 public:
  static constexpr BeadId size = 64;

  [[gnu::always_inline]] void add(const Lanes::Mask& four) {
    bits_ |= four & next_;
    next_ += next_;
  }
  [[nodiscard, gnu::always_inline]] std::uint64_t bits() const {
    const Lanes::Mask in_runs = bits_ << Lanes::Mask{0, 16, 32, 48};
    return static_cast<std::uint64_t>((in_runs[0] | in_runs[1]) | (in_runs[2] | in_runs[3]));
  }
  [[nodiscard]] static constexpr std::uint64_t bit_of(BeadId index) {
    return 1ULL << (16 * (index % 4) + index / 4);
  }
  /// Returns the bits of the first `count` beads.
  [[nodiscard]] static std::uint64_t first(BeadId count) {
    static constexpr auto words = [] {
      std::array<std::uint64_t, size + 1> word{};
      for (BeadId index = 0; index < size; ++index) word[index + 1] = word[index] | bit_of(index);
      return word;
    }();
    return words[count];
  }

 private:
  Lanes::Mask bits_{}, next_{1, 1, 1, 1};
};

/// Allows for the rounding of the comparison with a limit.
inline constexpr double below = 1 - 0x1p-40;

/// Calls `visit` with the beads of a range, ascending and without basis beads, that are not proved to stay
/// inside from then on.
template <int D, int K, bool equal, class Visit>
[[gnu::always_inline]] inline void scan_beyond(const BeadPaths<D>& paths, const BeadRange& range,
                                               const Basis& basis,
                                               const std::array<std::array<double, D>, 2>& ends,
                                               const std::array<double, 2>& limits, double from,
                                               const Visit& visit) {
  constexpr int columns = D + (equal ? 0 : 1);
  std::array<std::array<Lanes, D>, K + 1> center;
  std::array<Lanes, K + 1> limit;
  std::array<std::array<const double*, K + 1>, columns> column;
  std::array<std::array<Lanes, K + 1>, columns> base;
  for (std::size_t k = 0; k <= K; ++k) {
    const double t = static_cast<double>(k) / K;
    for (std::size_t axis = 0; axis < D; ++axis)
      center[k][axis] = Lanes((1 - t) * ends[0][axis] + t * ends[1][axis]);
    limit[k] = Lanes(((1 - t) * limits[0] + t * limits[1]) * below);
    for (std::size_t axis = 0; axis < columns; ++axis) {
      column[axis][k] = paths.column(static_cast<int>(k), static_cast<int>(axis));
      base[axis][k] = Lanes(column[axis][k][basis.beads[0]]);
    }
  }
  for (BeadId first = range.first; first <= range.last; first += BeadWord::size) {
    const BeadId last = std::min(range.last, first + BeadWord::size - 1);
    BeadWord outside;
    for (BeadId b = first; b <= last; b += Lanes::width) {
      std::array<Lanes, K + 1> square, room = limit;
      for (std::size_t axis = 0; axis < columns; ++axis) {
        std::array<Lanes, K + 1> control;
        for (std::size_t k = 0; k <= K; ++k)
          control[k] = Lanes(Lanes::load(column[axis][k] + b)) - base[axis][k];
        if (from > 0) casteljau(control, Lanes(from));
        for (std::size_t k = 0; k <= K; ++k) {
          if (axis < D) {
            const Lanes v = control[k] - center[k][axis];
            square[k] = axis == 0 ? v * v : square[k] + v * v;
          } else {
            room[k] -= control[k];
          }
        }
      }
      outside.add(~are_within(square, room));
    }
    // Basis beads never lie inside. The scan removes their bits here, because a branch on them during the
    // scan would be unpredictable.
    std::uint64_t bits = outside.bits() & BeadWord::first(last - first + 1);
    for (const BeadId member : basis) {
      const BeadId index = member - first;  // wraps around if the member lies before
      bits &= ~(index < BeadWord::size ? BeadWord::bit_of(index) : 0);
    }
    for (BeadId index = 0; bits != 0; ++index) {
      const std::uint64_t bit = BeadWord::bit_of(index);
      if ((bits & bit) != 0) visit(first + index);
      bits &= ~bit;
    }
  }
}

template <int D, int K, bool equal>
[[KDS_LANES_TARGETS]] void beyond_of(const BeadPaths<D>& paths, const BeadRange& range, const Basis& basis,
                                     const SphereChord<D>& chord, double from, std::vector<BeadId>& beyond) {
  scan_beyond<D, K, equal>(
      paths, range, basis, chord.center, chord.limit,
      from, [&](BeadId b) __attribute__((always_inline)) { beyond.push_back(b); });
}

/// Four chords and their periods, in lanes.
template <int D>
struct ChordsOfPeriods {
  std::array<std::array<Lanes, D>, 2> center;
  std::array<Lanes, 2> limit;
  PeriodLanes period;

  ChordsOfPeriods(std::span<const SphereChord<D>, 4> chords, std::span<const Period, 4> periods)
      : period(periods) {
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
                                          const ChordsOfPeriods<D>& parts, std::vector<BeadId>& beyond) {
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
  const ChordsOfPeriods<Dimension> parts(chords, periods);
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

// The first filter over all nodes.

namespace {

template <int D, int K, bool equal>
void look(const BeadPaths<D>& paths, std::span<const BeadRange> nodes, std::span<const Basis> bases,
          const ChordLanes<D>& chords, std::array<bool, 4>& all_inside, std::array<std::size_t, 4>& ends,
          std::vector<BeadId>& beyond) {
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    const std::size_t before = beyond.size();
    if (chords.proved[lane] != 0) {
      std::array<std::array<double, D>, 2> center;
      std::array<double, 2> limit;
      for (std::size_t e = 0; e < 2; ++e) {
        limit[e] = chords.limit[e].v[lane];
        for (std::size_t axis = 0; axis < D; ++axis) center[e][axis] = chords.center[e][axis].v[lane];
      }
      scan_beyond<D, K, equal>(
          paths, nodes[lane], bases[lane], center, limit,
          0, [&](BeadId b) __attribute__((always_inline)) { beyond.push_back(b); });
    }
    all_inside[lane] = beyond.size() == before;
    ends[lane] = beyond.size();
  }
}

template <int D, int K>
void look_in_degree(const BeadPaths<D>& paths, std::span<const BeadRange> nodes, std::span<const Basis> bases,
                    ChordFilterResult<D>& first, std::vector<BeadId>& beyond) {
  constexpr Period step;
  ChordLanes<D> chords;
  find_chords(paths, bases, PeriodLanes({&step, 1}), chords);
  if (paths.equal_radii()) {
    in_long_lanes<&look<D, K, true>>(paths, nodes, bases, chords, first.steady, first.ends, beyond);
  } else {
    in_long_lanes<&look<D, K, false>>(paths, nodes, bases, chords, first.steady, first.ends, beyond);
  }
  const long all = (1L << bases.front().size) - 1;
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    first.steady[lane] &= chords.proved[lane] != 0 && chords.stays[lane] == all;
    if (!first.steady[lane]) chords.give(lane, first.chords[lane]);
  }
}

}  // namespace

template <int Dimension>
void filter_nodes(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                  std::span<const Basis> bases, ChordFilterResult<Dimension>& look,
                  std::vector<BeadId>& beyond) {
  switch (paths.degree()) {
    case 1:
      return look_in_degree<Dimension, 1>(paths, nodes, bases, look, beyond);
    case 2:
      return look_in_degree<Dimension, 2>(paths, nodes, bases, look, beyond);
    default:
      return look_in_degree<Dimension, 3>(paths, nodes, bases, look, beyond);
  }
}

template void filter_nodes(const BeadPaths<2>&, std::span<const BeadRange>, std::span<const Basis>,
                           ChordFilterResult<2>&, std::vector<BeadId>&);
template void filter_nodes(const BeadPaths<3>&, std::span<const BeadRange>, std::span<const Basis>,
                           ChordFilterResult<3>&, std::vector<BeadId>&);

}  // namespace kds
