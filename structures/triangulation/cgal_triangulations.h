#pragma once
// CGAL's two regular triangulations under common names. Include it only in the few files that use CGAL.

#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Regular_triangulation_cell_base_3.h>
#include <CGAL/Regular_triangulation_face_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_2.h>
#include <CGAL/Regular_triangulation_vertex_base_3.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/Spatial_sort_traits_adapter_3.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <utility>
#include <vector>

#include "structures/triangulation/cells.h"
#include "structures/triangulation/regular_triangulation.h"

namespace kds {

/// The name of a vertex or cell; `none` while only CGAL knows the vertex or cell.
template <class Id, Id none>
class Name {
 public:
  Name() = default;
  Name(Id id) : id_(id) {}
  operator Id() const { return id_; }

 private:
  Id id_ = none;
};
using VertexName = Name<BeadId, no_bead>;
using CellName = Name<CellId, no_cell>;

/// Vertices store their bead, cells their id.
template <class Geometry, int Dimension>
struct CgalTriangulation;

template <class Geometry>
struct CgalTriangulation<Geometry, 2> {
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_2<VertexName, Geometry,
                                                  CGAL::Regular_triangulation_vertex_base_2<Geometry>>;
  using Face = CGAL::Triangulation_face_base_with_info_2<CellName, Geometry,
                                                         CGAL::Regular_triangulation_face_base_2<Geometry>>;
  using Type = CGAL::Regular_triangulation_2<Geometry, CGAL::Triangulation_data_structure_2<Vertex, Face>>;
  using Cell = typename Type::Face_handle;
  template <class PointOf>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_2<Geometry, PointOf>;

  static typename Type::Bare_point point(const typename Geometry::FT& x, const typename Geometry::FT& y,
                                         const typename Geometry::FT&) {
    return {x, y};
  }
  /// Inserts a point, which `near` helps to find. Moves `near` to it. Returns no vertex if the point is
  /// hidden.
  static auto insert(Type& t, const typename Type::Weighted_point& point, Cell& near) {
    const auto vertex = t.insert(point, near);
    if (vertex != typename Type::Vertex_handle()) near = vertex->face();
    return vertex;
  }
  static auto all_cells(const Type& t) { return t.all_face_handles(); }
  static auto finite_cells(const Type& t) { return t.finite_face_handles(); }
  static auto ends(const typename Type::Edge& e) {
    return std::pair(e.first->vertex(Type::cw(e.second)), e.first->vertex(Type::ccw(e.second)));
  }
  template <class Tds>
  static Cell create_cell(Tds& tds) {
    return tds.create_face();
  }
  template <class Tds>
  static void delete_cell(Tds& tds, Cell c) {
    tds.delete_face(c);
  }
  template <class VertexHandle>
  static void set_cell(VertexHandle v, Cell c) {
    v->set_face(c);
  }
  template <class VertexHandle>
  static Cell cell_beside(VertexHandle v) {
    return v->face();
  }
  /// Returns whether a point would lie inside or on the power circle of the cell's beads at their positions
  /// `moved`.
  template <class Moved, class Point>
  static bool in_power_sphere(const CellBeads<2>& cell, const Moved& moved, const Point& point) {
    return typename Geometry::Power_side_of_oriented_power_circle_2()(
               moved(cell[0]), moved(cell[1]), moved(cell[2]), point) != CGAL::ON_NEGATIVE_SIDE;
  }
};

template <class Geometry>
struct CgalTriangulation<Geometry, 3> {
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_3<VertexName, Geometry,
                                                  CGAL::Regular_triangulation_vertex_base_3<Geometry>>;
  using CellBase =
      CGAL::Triangulation_cell_base_with_info_3<CellName, Geometry,
                                                CGAL::Regular_triangulation_cell_base_3<Geometry>>;
  using Type =
      CGAL::Regular_triangulation_3<Geometry, CGAL::Triangulation_data_structure_3<Vertex, CellBase>>;
  using Cell = typename Type::Cell_handle;
  template <class PointOf>
  using SortTraits = CGAL::Spatial_sort_traits_adapter_3<Geometry, PointOf>;

  static typename Type::Bare_point point(const typename Geometry::FT& x, const typename Geometry::FT& y,
                                         const typename Geometry::FT& z) {
    return {x, y, z};
  }
  static auto insert(Type& t, const typename Type::Weighted_point& point, Cell& near) {
    typename Type::Locate_type type{};
    int i = 0, j = 0;
    near = t.locate(point, type, i, j, near);
    const auto vertex = t.insert(point, type, near, i, j);
    if (vertex != typename Type::Vertex_handle()) near = vertex->cell();
    return vertex;
  }
  static auto all_cells(const Type& t) { return t.all_cell_handles(); }
  static auto finite_cells(const Type& t) { return t.finite_cell_handles(); }
  static auto ends(const typename Type::Edge& e) {
    return std::pair(e.first->vertex(e.second), e.first->vertex(e.third));
  }
  template <class Tds>
  static Cell create_cell(Tds& tds) {
    return tds.create_cell();
  }
  template <class Tds>
  static void delete_cell(Tds& tds, Cell c) {
    tds.delete_cell(c);
  }
  template <class VertexHandle>
  static void set_cell(VertexHandle v, Cell c) {
    v->set_cell(c);
  }
  template <class VertexHandle>
  static Cell cell_beside(VertexHandle v) {
    return v->cell();
  }
  /// Returns whether a point would lie inside or on the power sphere of the cell's beads at their positions
  /// `moved`.
  template <class Moved, class Point>
  static bool in_power_sphere(const CellBeads<3>& cell, const Moved& moved, const Point& point) {
    return
        typename Geometry::Power_side_of_oriented_power_sphere_3()(
            moved(cell[0]), moved(cell[1]), moved(cell[2]), moved(cell[3]), point) != CGAL::ON_NEGATIVE_SIDE;
  }
};

template <int Dimension, class Cell>
[[nodiscard]] CellBeads<Dimension> beads_of(Cell c) {
  CellBeads<Dimension> beads{};
  for (int i = 0; i <= Dimension; ++i) beads[static_cast<std::size_t>(i)] = c->vertex(i)->info();
  return beads;
}

template <class Triangulation>
[[nodiscard]] std::vector<BeadId> hidden_beads(const Triangulation& triangulation, std::size_t beads) {
  std::vector<char> visible(beads, 0);
  for (const auto v : triangulation.finite_vertex_handles()) visible[v->info()] = 1;
  std::vector<BeadId> hidden;
  for (std::size_t b = 0; b < beads; ++b) {
    if (visible[b] == 0) hidden.push_back(static_cast<BeadId>(b));
  }
  return hidden;
}

}  // namespace kds
