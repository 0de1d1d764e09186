#include "tests/support/judges/cgal_triangulation.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>

namespace kds::test {

CgalCells cgal_regular_cells(std::span<const ExactPoint> points) {
  using Geometry = CGAL::Simple_cartesian<CGAL::Gmpq>;
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_3<BeadId, Geometry,
                                                  CGAL::Regular_triangulation_vertex_base_3<Geometry>>;
  using Cell = CGAL::Regular_triangulation_cell_base_3<Geometry>;
  using Triangulation =
      CGAL::Regular_triangulation_3<Geometry, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  const auto number = [](const Rational& x) { return CGAL::Gmpq(x.get_mpq_t()); };
  Triangulation triangulation;
  for (BeadId b = 0; b < points.size(); ++b) {
    const ExactPoint& p = points[b];
    const auto v = triangulation.insert(Geometry::Weighted_point_3(
        Geometry::Point_3(number(p[0]), number(p[1]), number(p[2])), number(p[3])));
    if (v != Triangulation::Vertex_handle()) v->info() = b;
  }
  CgalCells result;
  result.visible = triangulation.number_of_vertices();
  result.valid = triangulation.is_valid();
  if (triangulation.dimension() < 3) return result;
  for (const auto c : triangulation.finite_cell_handles()) {
    std::array<BeadId, 4> cell{};
    for (int i = 0; i < 4; ++i) cell[static_cast<std::size_t>(i)] = c->vertex(i)->info();
    std::sort(cell.begin(), cell.end());
    result.cells.push_back(cell);
  }
  std::sort(result.cells.begin(), result.cells.end());
  return result;
}

}  // namespace kds::test
