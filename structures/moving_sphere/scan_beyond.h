#pragma once
// Scans for beads that the chord of a sphere (sphere_chord.h) does not prove to stay inside, four at a time,
// at all control points.

#include <algorithm>
#include <array>
#include <cstdint>

#include "motions/base/bead_range.h"
#include "structures/enclosing_sphere/basis.h"
#include "structures/moving_sphere/bead_paths.h"
#include "structures/moving_sphere/period_lanes.h"

namespace kds::detail {

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
  [[nodiscard]] static constexpr std::uint64_t bit_of(BeadId place) {
    return 1ULL << (16 * (place % 4) + place / 4);
  }
  /// Returns the bits of the first `count` beads.
  [[nodiscard]] static std::uint64_t first(BeadId count) {
    static constexpr auto words = [] {
      std::array<std::uint64_t, size + 1> word{};
      for (BeadId place = 0; place < size; ++place) word[place + 1] = word[place] | bit_of(place);
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
      const BeadId place = member - first;  // wraps around if the member lies before
      bits &= ~(place < BeadWord::size ? BeadWord::bit_of(place) : 0);
    }
    for (BeadId place = 0; bits != 0; ++place) {
      const std::uint64_t bit = BeadWord::bit_of(place);
      if ((bits & bit) != 0) visit(first + place);
      bits &= ~bit;
    }
  }
}

}  // namespace kds::detail
