// Static regular triangulations of exact positions: for audits between events, and rebuilds there.

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include "structures/regular_triangulation.h"
#include "structures/sorted_cells.h"

namespace kds {

namespace {

using Geometry = CGAL::Exact_predicates_exact_constructions_kernel;
using VertexBase =
    CGAL::Triangulation_vertex_base_with_info_3<BeadId, Geometry,
                                                CGAL::Regular_triangulation_vertex_base_3<Geometry>>;
using CellBase = CGAL::Regular_triangulation_cell_base_3<Geometry>;
using Triangulation =
    CGAL::Regular_triangulation_3<Geometry, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;

Geometry::FT to_cgal(const Rational& x) {
  using Exact = Geometry::FT::ET;
  return Geometry::FT(Exact(x.backend().data()));
}

}  // namespace

StaticTriangulation static_triangulation(std::span<const ExactBead> beads, bool oriented) {
  std::vector<std::pair<Triangulation::Weighted_point, BeadId>> points;
  for (const ExactBead& b : beads) {
    const Triangulation::Bare_point center(to_cgal(b.center[0]), to_cgal(b.center[1]), to_cgal(b.center[2]));
    points.emplace_back(Triangulation::Weighted_point(center, to_cgal(b.weight)),
                        static_cast<BeadId>(points.size()));
  }
  Triangulation triangulation;
  triangulation.insert(points.begin(), points.end());
  triangulation.infinite_vertex()->info() = infinite_bead;

  StaticTriangulation result;
  result.dimension = triangulation.dimension();
  std::vector<char> visible(beads.size(), 0);
  for (const auto v : triangulation.finite_vertex_handles()) visible[v->info()] = 1;
  for (std::size_t b = 0; b < beads.size(); ++b) {
    if (visible[b] == 0) result.hidden.push_back(static_cast<BeadId>(b));
  }
  if (result.dimension < 3) return result;
  for (const auto c : triangulation.all_cell_handles()) {
    if (!oriented && triangulation.is_infinite(c)) continue;
    result.cells.push_back(
        {c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
  }
  if (!oriented) sort_cells(result.cells);
  return result;
}

}  // namespace kds
