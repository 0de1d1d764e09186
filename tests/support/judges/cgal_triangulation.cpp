#include "tests/support/judges/cgal_triangulation.h"

#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Fixed_alpha_shape_3.h>
#include <CGAL/Fixed_alpha_shape_cell_base_3.h>
#include <CGAL/Fixed_alpha_shape_vertex_base_3.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>

namespace kds::test {

namespace {

using Filtered = CGAL::Exact_predicates_exact_constructions_kernel;
using Number = Filtered::FT::ET;  // rational
using Plain = CGAL::Simple_cartesian<Number>;
template <class Geometry>
using NamedVertex =
    CGAL::Triangulation_vertex_base_with_info_3<BeadId, Geometry,
                                                CGAL::Regular_triangulation_vertex_base_3<Geometry>>;
template <class Geometry>
using CellBase = CGAL::Regular_triangulation_cell_base_3<Geometry>;

template <class Triangulation>
void insert_all(Triangulation& triangulation, std::span<const ExactPoint> points) {
  using Geometry = typename Triangulation::Geom_traits;
  using FT = typename Geometry::FT;
  const auto number = [](const Rational& x) {  // CGAL's filter is faster for doubles
    return x == x.get_d() ? FT(x.get_d()) : FT(Number(x.get_mpq_t()));
  };
  for (BeadId b = 0; b < points.size(); ++b) {
    const ExactPoint& p = points[b];
    const auto v = triangulation.insert(typename Geometry::Weighted_point_3(
        typename Geometry::Point_3(number(p[0]), number(p[1]), number(p[2])), number(p[3])));
    if (v != typename Triangulation::Vertex_handle()) v->info() = b;
  }
}

}  // namespace

std::vector<std::array<BeadId, 4>> cgal_alpha_complex(std::span<const ExactPoint> points) {
  using Vertex = CGAL::Fixed_alpha_shape_vertex_base_3<Filtered, NamedVertex<Filtered>>;
  using Cell = CGAL::Fixed_alpha_shape_cell_base_3<Filtered, CellBase<Filtered>>;
  using Triangulation =
      CGAL::Regular_triangulation_3<Filtered, CGAL::Triangulation_data_structure_3<Vertex, Cell>>;
  Triangulation triangulation;
  insert_all(triangulation, points);
  CGAL::Fixed_alpha_shape_3<Triangulation> shape(triangulation, 0);  // takes the triangulation over
  std::vector<std::array<BeadId, 4>> simplices;
  const auto add = [&](std::initializer_list<BeadId> beads) {
    auto& simplex = simplices.emplace_back();
    simplex.fill(no_bead);
    std::copy(beads.begin(), beads.end(), simplex.begin());
    std::sort(simplex.begin(), simplex.begin() + beads.size());
  };
  const auto belongs = [&](const auto& simplex) { return shape.classify(simplex) != shape.EXTERIOR; };
  for (const auto v : shape.finite_vertex_handles())
    if (belongs(v)) add({v->info()});
  for (const auto& e : shape.finite_edges())
    if (belongs(e)) add({e.first->vertex(e.second)->info(), e.first->vertex(e.third)->info()});
  for (const auto& f : shape.finite_facets())
    if (belongs(f))
      add({f.first->vertex((f.second + 1) % 4)->info(), f.first->vertex((f.second + 2) % 4)->info(),
           f.first->vertex((f.second + 3) % 4)->info()});
  for (const auto c : shape.finite_cell_handles())
    if (belongs(c))
      add({c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()});
  std::sort(simplices.begin(), simplices.end());
  return simplices;
}

CgalCells cgal_regular_cells(std::span<const ExactPoint> points) {
  using Triangulation = CGAL::Regular_triangulation_3<
      Plain, CGAL::Triangulation_data_structure_3<NamedVertex<Plain>, CellBase<Plain>>>;
  Triangulation triangulation;
  insert_all(triangulation, points);
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
