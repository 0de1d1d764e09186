#include "structures/triangulation/diagram_edges.h"

#include <algorithm>
#include <utility>

namespace kds {

template <int Dimension>
DiagramEdges edges_of(const RegularTriangulation<Dimension>& triangulation, std::size_t beads,
                      std::vector<BeadId> hidden) {
  const auto cells = triangulation.cells();
  // List each pair of a cell's beads under its lower bead. An edge is listed once for each of its cells.
  std::vector<std::size_t> start(beads + 1, 0);
  const auto for_pairs = [&](auto visit) {
    for (CellId c = 0; c < cells.size(); ++c) {
      if (!triangulation.is_live(c)) continue;
      const auto& v = cells[c].vertex;
      for (std::size_t i = 0; i <= Dimension; ++i) {
        for (std::size_t j = i + 1; j <= Dimension; ++j) {
          const auto [low, high] = std::minmax(v[i], v[j]);
          if (high != infinite_bead) visit(low, high);
        }
      }
    }
  };
  for_pairs([&](BeadId low, BeadId) { ++start[low + 1]; });
  for (std::size_t b = 0; b < beads; ++b) start[b + 1] += start[b];
  std::vector<BeadId> higher(start[beads]);
  std::vector<std::size_t> next(start.begin(), start.end() - 1);
  for_pairs([&](BeadId low, BeadId high) { higher[next[low]++] = high; });
  std::vector<BeadPairs::Pair> pairs;
  std::vector<BeadId> met_by(beads, no_bead);
  for (BeadId b = 0; b < beads; ++b) {
    for (std::size_t at = start[b]; at < start[b + 1]; ++at) {
      if (std::exchange(met_by[higher[at]], b) != b) pairs.emplace_back(b, higher[at]);
    }
  }
  return {BeadPairs(beads, pairs), std::move(hidden)};
}

template <int Dimension>
DiagramEdges static_edges(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  RegularTriangulation<Dimension> triangulation;
  auto built = triangulation.build_bare(centers, weights);
  return {BeadPairs(weights.size(), triangulation.finite_edges()), std::move(built.hidden)};
}

template DiagramEdges edges_of(const RegularTriangulation<2>&, std::size_t, std::vector<BeadId>);
template DiagramEdges edges_of(const RegularTriangulation<3>&, std::size_t, std::vector<BeadId>);
template DiagramEdges static_edges<2>(const Eigen::Matrix3Xd&, std::span<const double>);
template DiagramEdges static_edges<3>(const Eigen::Matrix3Xd&, std::span<const double>);

}  // namespace kds
