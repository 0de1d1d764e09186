#include "structures/triangulation/exact_triangulation.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>

#include "motions/base/floating_point_guard.h"
#include "structures/triangulation/cgal_triangulations.h"

namespace kds {

namespace {

using Geometry = CGAL::Exact_predicates_exact_constructions_kernel;

Geometry::FT to_cgal(const Rational& x) {
  using Exact = Geometry::FT::ET;
  return Geometry::FT(Exact(x.backend().data()));
}

}  // namespace

template <int Dimension>
StaticTriangulation<Dimension> static_triangulation(std::span<const ExactBead> beads, bool oriented) {
  const FloatingPointGuard to_nearest;
  using Cgal = CgalTriangulation<Geometry, Dimension>;
  using Triangulation = typename Cgal::Type;
  std::vector<std::pair<typename Triangulation::Weighted_point, BeadId>> points;
  for (const ExactBead& b : beads) {
    points.emplace_back(
        typename Triangulation::Weighted_point(
            Cgal::point(to_cgal(b.center[0]), to_cgal(b.center[1]), to_cgal(b.center[2])), to_cgal(b.weight)),
        static_cast<BeadId>(points.size()));
  }
  Triangulation triangulation;
  triangulation.insert(points.begin(), points.end());
  triangulation.infinite_vertex()->info() = infinite_bead;

  StaticTriangulation<Dimension> result{
      {}, hidden_beads(triangulation, beads.size()), triangulation.dimension()};
  if (result.dimension < Dimension) return result;
  for (const auto c : Cgal::all_cells(triangulation)) {
    if (oriented || !triangulation.is_infinite(c)) result.cells.push_back(beads_of<Dimension>(c));
  }
  if (!oriented) sort_cells(result.cells);
  return result;
}

template StaticTriangulation<2> static_triangulation(std::span<const ExactBead>, bool);
template StaticTriangulation<3> static_triangulation(std::span<const ExactBead>, bool);

}  // namespace kds
