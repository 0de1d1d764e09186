
#include "structures/triangulation/diagram_edges.h"
#include "structures/triangulation/regular_triangulation_cgal.h"

namespace kds {

template <int Dimension>
StaticTriangulation<Dimension> static_triangulation(const Eigen::Matrix3Xd& centers,
                                                    std::span<const double> weights) {
  typename CgalOf<Dimension>::Type triangulation;
  insert_all<Dimension>(triangulation, centers, weights);
  return {sorted_finite_cells<Dimension>(triangulation), hidden_beads(triangulation, weights.size()),
          triangulation.dimension()};
}

template <int Dimension>
DiagramEdges static_edges(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  typename CgalOf<Dimension>::Type triangulation;
  insert_all<Dimension>(triangulation, centers, weights);
  std::vector<BeadPairs::Pair> pairs;
  if (triangulation.dimension() >= 1) {
    for (const auto& edge : triangulation.finite_edges()) {
      const auto [a, b] = CgalOf<Dimension>::ends(edge);
      pairs.emplace_back(a->info(), b->info());
    }
  }
  return {BeadPairs(weights.size(), pairs), hidden_beads(triangulation, weights.size())};
}

template <int Dimension>
Seconds seconds_to_triangulate(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  std::vector<typename CgalOf<Dimension>::Type::Weighted_point> points;
  points.reserve(weights.size());
  for (std::size_t b = 0; b < weights.size(); ++b)
    points.push_back(weighted_point<Dimension>(centers, weights, b));
  return seconds_of(
      [&] { const typename CgalOf<Dimension>::Type triangulation(points.begin(), points.end()); });
}

template StaticTriangulation<2> static_triangulation(const Eigen::Matrix3Xd&, std::span<const double>);
template StaticTriangulation<3> static_triangulation(const Eigen::Matrix3Xd&, std::span<const double>);
template DiagramEdges static_edges<2>(const Eigen::Matrix3Xd&, std::span<const double>);
template DiagramEdges static_edges<3>(const Eigen::Matrix3Xd&, std::span<const double>);
template Seconds seconds_to_triangulate<2>(const Eigen::Matrix3Xd&, std::span<const double>);
template Seconds seconds_to_triangulate<3>(const Eigen::Matrix3Xd&, std::span<const double>);

}  // namespace kds
