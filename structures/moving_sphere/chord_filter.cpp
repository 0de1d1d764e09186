#include "structures/moving_sphere/chord_filter.h"

#include "motions/numbers/long_lanes.h"
#include "structures/moving_sphere/chord_lanes.h"
#include "structures/moving_sphere/scan_beyond.h"

namespace kds {

namespace {

template <int D, int K, bool equal>
void look(const BeadPaths<D>& paths, std::span<const BeadRange> nodes, std::span<const Basis> bases,
          double enlarged_by, std::span<const double> raised_by, ChordLanes<D>& chords,
          std::array<bool, 4>& all_inside, std::array<std::size_t, 4>& ends, std::vector<BeadId>& beyond) {
  chords.enlarge(enlarged_by);
  for (std::size_t lane = 0; lane < raised_by.size(); ++lane)
    for (Lanes& limit : chords.limit) limit.v[lane] += raised_by[lane];
  for (std::size_t lane = 0; lane < nodes.size(); ++lane) {
    const std::size_t before = beyond.size();
    if (chords.proved[lane] != 0) {
      std::array<std::array<double, D>, 2> center;
      std::array<double, 2> limit;
      for (std::size_t e = 0; e < 2; ++e) {
        limit[e] = chords.limit[e].v[lane];
        for (std::size_t axis = 0; axis < D; ++axis) center[e][axis] = chords.center[e][axis].v[lane];
      }
      detail::scan_beyond<D, K, equal>(
          paths, nodes[lane], bases[lane], center, limit,
          0, [&](BeadId b) __attribute__((always_inline)) { beyond.push_back(b); });
    }
    all_inside[lane] = beyond.size() == before;
    ends[lane] = beyond.size();
  }
}

template <int D, int K>
void look_in_degree(const BeadPaths<D>& paths, std::span<const BeadRange> nodes, std::span<const Basis> bases,
                    double enlarged_by, std::span<const double> raised_by, ChordFilterResult<D>& first,
                    std::vector<BeadId>& beyond) {
  constexpr Period step;
  ChordLanes<D> chords;
  find_chords(paths, bases, PeriodLanes({&step, 1}), chords);
  if (paths.equal_radii()) {
    in_long_lanes<&look<D, K, true>>(paths, nodes, bases, enlarged_by, raised_by, chords, first.steady,
                                     first.ends, beyond);
  } else {
    in_long_lanes<&look<D, K, false>>(paths, nodes, bases, enlarged_by, raised_by, chords, first.steady,
                                      first.ends, beyond);
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
                  std::vector<BeadId>& beyond, double enlarged_by, std::span<const double> raised_by) {
  switch (paths.degree()) {
    case 1:
      return look_in_degree<Dimension, 1>(paths, nodes, bases, enlarged_by, raised_by, look, beyond);
    case 2:
      return look_in_degree<Dimension, 2>(paths, nodes, bases, enlarged_by, raised_by, look, beyond);
    default:
      return look_in_degree<Dimension, 3>(paths, nodes, bases, enlarged_by, raised_by, look, beyond);
  }
}

template void filter_nodes(const BeadPaths<2>&, std::span<const BeadRange>, std::span<const Basis>,
                           ChordFilterResult<2>&, std::vector<BeadId>&, double, std::span<const double>);
template void filter_nodes(const BeadPaths<3>&, std::span<const BeadRange>, std::span<const Basis>,
                           ChordFilterResult<3>&, std::vector<BeadId>&, double, std::span<const double>);

}  // namespace kds
