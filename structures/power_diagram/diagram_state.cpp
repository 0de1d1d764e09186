#include "structures/power_diagram/diagram_state.h"

#include <algorithm>

#include "motions/curves/positions.h"
#include "structures/triangulation/exact_triangulation.h"

namespace kds {

namespace {

/// Replaces the numbers of a triangulation, which count the given beads from 0, by the beads themselves.
template <int Dimension>
StaticTriangulation<Dimension> with_names(StaticTriangulation<Dimension> triangulation,
                                          std::span<const BeadId> beads) {
  for (auto& cell : triangulation.cells) {
    for (BeadId& b : cell) b = b == infinite_bead ? b : beads[b];
  }
  for (BeadId& b : triangulation.hidden) b = beads[b];
  return triangulation;
}

}  // namespace

template <int Dimension>
StaticTriangulation<Dimension> static_diagram(const DiagramState<Dimension>& state,
                                              std::span<const BeadId> beads, const Dyadic& time,
                                              bool oriented) {
  std::vector<ExactBead> positions(beads.size());
  state.motion.visit([&](const auto& curves) {
    for (std::size_t i = 0; i < beads.size(); ++i) {
      const auto position = exact_position(curves, beads[i], time);
      std::copy(position.begin(), position.end() - 1, positions[i].center.begin());
      positions[i].weight = position.back();
    }
  });
  return with_names(static_triangulation<Dimension>(positions, oriented), beads);
}

template <int Dimension>
StaticTriangulation<Dimension> static_diagram_at_end(const DiagramState<Dimension>& state, int k) {
  const Curves<Dimension> curves = state.motion.curves();
  Eigen::Matrix3Xd points = control_points(curves, k);
  std::vector<double> weights = control_weights(curves, k);
  const std::vector<BeadId> beads = state.present_beads.all();
  for (std::size_t i = 0; i < beads.size(); ++i) {  // each bead moves to the front
    points.col(static_cast<Eigen::Index>(i)) = points.col(Eigen::Index{beads[i]});
    weights[i] = weights[beads[i]];
  }
  points.conservativeResize(3, static_cast<Eigen::Index>(beads.size()));
  weights.resize(beads.size());
  return with_names(static_triangulation<Dimension>(points, weights), beads);
}

template <int Dimension>
DiagramEdges static_edges_at_end(const DiagramState<Dimension>& state, int k) {
  const Curves<Dimension> curves = state.motion.curves();
  return static_edges<Dimension>(control_points(curves, k), control_weights(curves, k));
}

template StaticTriangulation<2> static_diagram(const DiagramState<2>&, std::span<const BeadId>, const Dyadic&,
                                               bool);
template StaticTriangulation<3> static_diagram(const DiagramState<3>&, std::span<const BeadId>, const Dyadic&,
                                               bool);
template StaticTriangulation<2> static_diagram_at_end(const DiagramState<2>&, int);
template StaticTriangulation<3> static_diagram_at_end(const DiagramState<3>&, int);
template DiagramEdges static_edges_at_end(const DiagramState<2>&, int);
template DiagramEdges static_edges_at_end(const DiagramState<3>&, int);

}  // namespace kds
