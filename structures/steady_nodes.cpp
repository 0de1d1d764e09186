#include "structures/steady_nodes.h"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "structures/chord_lanes.h"

namespace kds {

namespace {

/// 64 beads from some bead on, a bit each: in four runs of every fourth bead, as lanes see them.
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
  [[nodiscard]] static std::uint64_t bit_of(BeadId place) { return 1ULL << (16 * (place % 4) + place / 4); }
  /// Of the first `count`.
  [[nodiscard]] static std::uint64_t first(BeadId count) {
    static constexpr auto words = [] {
      std::array<std::uint64_t, size + 1> word{};
      for (BeadId place = 0; place < size; ++place)
        word[place + 1] = word[place] | 1ULL << (16 * (place % 4) + place / 4);
      return word;
    }();
    return words[std::min(count, size)];
  }

 private:
  Lanes::Mask bits_{}, next_{1, 1, 1, 1};
};

constexpr double below = 1 - 0x1p-40;

/// The beads that a chord does not prove to stay inside are told to `visit`, words of them.
template <int D, int K, bool equal, class Visit>
[[gnu::always_inline]] inline void scan(const BeadPaths<D>& paths, const BeadRange& range, const Basis& basis,
                                        const ChordLanes<D>& chords, std::size_t lane, const Visit& visit) {
  constexpr int columns = D + (equal ? 0 : 1);
  std::array<std::array<Lanes, D>, K + 1> center;
  std::array<Lanes, K + 1> limit;
  std::array<std::array<const double*, K + 1>, columns> column;
  std::array<std::array<Lanes, K + 1>, columns> base;
  for (std::size_t k = 0; k <= K; ++k) {
    const double t = static_cast<double>(k) / K;
    for (std::size_t axis = 0; axis < D; ++axis)
      center[k][axis] =
          Lanes((1 - t) * chords.center[0][axis].v[lane] + t * chords.center[1][axis].v[lane]);
    limit[k] = Lanes(((1 - t) * chords.limit[0].v[lane] + t * chords.limit[1].v[lane]) * below);
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
        for (std::size_t k = 0; k <= K; ++k) {
          const Lanes control = Lanes(Lanes::load(column[axis][k] + b)) - base[axis][k];
          if (axis < D) {
            const Lanes v = control - center[k][axis];
            square[k] = axis == 0 ? v * v : square[k] + v * v;
          } else {
            room[k] -= control;
          }
        }
      }
      outside.add(~are_within(square, room));
    }
    // Basis beads never lie inside: looked at on the way they would often be, and no one could foretell in
    // which four.
    std::uint64_t bits = outside.bits() & BeadWord::first(last - first + 1);
    for (const BeadId member : basis) {
      const BeadId place = member - first;  // wraps around where it is before
      bits &= ~(place < BeadWord::size ? BeadWord::bit_of(place) : 0);
    }
    if (bits != 0) visit(first, bits);
  }
}

template <int D, int K, bool equal>
[[KDS_LONG_LANES_TARGETS]] void look(const BeadPaths<D>& paths, std::span<const BeadRange> nodes,
                                std::span<const Basis> bases, const ChordLanes<D>& chords,
                                std::array<bool, 4>& all_inside, std::array<std::size_t, 4>& ends,
                                std::vector<BeadId>& beyond) {
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    all_inside[lane] = true;
    if (chords.proved[lane] != 0) {
      scan<D, K, equal>(paths, nodes[lane], bases[lane], chords, lane,
                        [&](BeadId first, std::uint64_t bits) __attribute__((always_inline)) {
                          all_inside[lane] = false;
                          for (BeadId place = 0; place < BeadWord::size; ++place)
                            if ((bits & BeadWord::bit_of(place)) != 0) beyond.push_back(first + place);
                        });
    }
    ends[lane] = beyond.size();
  }
}

template <int D, int K>
void look_in_degree(const BeadPaths<D>& paths, std::span<const BeadRange> nodes, std::span<const Basis> bases,
                    FirstLook<D>& first, std::vector<BeadId>& beyond) {
  constexpr Period step;
  ChordLanes<D> chords;
  find_chords(paths, bases, PeriodLanes({&step, 1}), chords);
  if (paths.equal_radii()) {
    look<D, K, true>(paths, nodes, bases, chords, first.steady, first.ends, beyond);
  } else {
    look<D, K, false>(paths, nodes, bases, chords, first.steady, first.ends, beyond);
  }
  const long all = (1L << bases.front().size) - 1;
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    first.steady[lane] &= chords.proved[lane] != 0 && chords.stays[lane] == all;
    if (!first.steady[lane]) chords.give(lane, first.chords[lane]);
  }
}

}  // namespace

template <int Dimension>
void look_at_nodes(const BeadPaths<Dimension>& paths, std::span<const BeadRange> nodes,
                   std::span<const Basis> bases, FirstLook<Dimension>& look, std::vector<BeadId>& beyond) {
  switch (paths.degree()) {
    case 1:
      return look_in_degree<Dimension, 1>(paths, nodes, bases, look, beyond);
    case 2:
      return look_in_degree<Dimension, 2>(paths, nodes, bases, look, beyond);
    default:
      return look_in_degree<Dimension, 3>(paths, nodes, bases, look, beyond);
  }
}

template void look_at_nodes(const BeadPaths<2>&, std::span<const BeadRange>, std::span<const Basis>,
                            FirstLook<2>&, std::vector<BeadId>&);
template void look_at_nodes(const BeadPaths<3>&, std::span<const BeadRange>, std::span<const Basis>,
                            FirstLook<3>&, std::vector<BeadId>&);

}  // namespace kds
