#include "structures/triangulation/static_dual_complex.h"

#include <algorithm>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "structures/triangulation/regular_triangulation_cgal.h"

namespace kds {

namespace {

using Triangulation = CgalOf<3>::Type;
using Vertex = Triangulation::Vertex_handle;
constexpr std::uint32_t none = ~std::uint32_t{0};

template <class... Vertices>
bool is_small(Vertices... corners) {
  return Geometry().compare_weighted_squared_radius_3_object()(corners->point()..., 0.0) != CGAL::LARGER;
}
/// Returns whether a bead conflicts with the smallest orthogonal sphere of a simplex.
template <class... Vertices>
bool conflicts(Vertex bead, Vertices... corners) {
  return Geometry().power_side_of_bounded_power_sphere_3_object()(corners->point()..., bead->point()) ==
         CGAL::ON_BOUNDED_SIDE;
}

/// A triangle of the triangulation.
struct Facet {
  std::array<Vertex, 3> corners;
  std::array<std::uint32_t, 3> edges{};  // edges[i] is opposite to corners[i]
  bool belongs = false;
  std::uint32_t place = none;  // in the result
};

struct Edge {
  std::array<Vertex, 2> ends;  // beads ascending
  std::uint32_t next = none;   // the next edge with the same lower bead
  bool belongs = false, may_belong = false;
  std::uint32_t place = none;
};

/// Builds the complex from a triangulation, from cells down to vertices.
class Builder {
 public:
  Builder(const Triangulation& triangulation, std::size_t beads)
      : triangulation_(triangulation), first_edge_(beads, none) {
    read_facets();
    if (triangulation.dimension() == 1)
      for (const auto& e : triangulation.finite_edges())
        edge_between(e.first->vertex(e.second), e.first->vertex(e.third));
    decide_edges();
    decide_vertices();
  }

  [[nodiscard]] ComplexSimplices simplices() && {
    for (Edge& edge : edges_) {
      if (!edge.belongs) continue;
      edge.place = static_cast<std::uint32_t>(result_.edges.size());
      result_.edges.push_back({edge.ends[0]->info(), edge.ends[1]->info()});
    }
    for (Facet& facet : facets_) {
      if (!facet.belongs) continue;
      facet.place = static_cast<std::uint32_t>(result_.triangles.size());
      auto& [beads, edges] = result_.triangles.emplace_back();
      for (std::size_t i = 0; i < 3; ++i) {
        beads[i] = facet.corners[i]->info();
        edges[i] = edges_[facet.edges[i]].place;
      }
    }
    for (auto& [beads, edges, triangles] : result_.tetrahedra) {
      for (std::size_t e = 0; e < 6; ++e) {
        // The edge is in a triangle whose opposite bead is none of its ends.
        const auto [i, j] = tetrahedron_edges[e];
        const Facet& facet = facets_[triangles[tetrahedron_edges[5 - e][0]]];
        for (std::size_t k = 0; k < 3; ++k)
          if (const BeadId bead = facet.corners[k]->info(); bead != beads[i] && bead != beads[j])
            edges[e] = edges_[facet.edges[k]].place;
      }
      for (std::uint32_t& triangle : triangles) triangle = facets_[triangle].place;
    }
    return std::move(result_);
  }

 private:
  std::uint32_t edge_between(Vertex a, Vertex b) {
    if (b->info() < a->info()) std::swap(a, b);
    std::uint32_t* place = &first_edge_[a->info()];
    for (; *place != none; place = &edges_[*place].next)
      if (edges_[*place].ends[1] == b) return *place;
    const auto edge = static_cast<std::uint32_t>(edges_.size());
    *place = edge;
    edges_.push_back({{a, b}});
    return edge;
  }

  std::uint32_t add_facet(Vertex a, Vertex b, Vertex c) {
    facets_.push_back({{a, b, c}, {edge_between(b, c), edge_between(c, a), edge_between(a, b)}});
    return static_cast<std::uint32_t>(facets_.size() - 1);
  }

  /// Reads facets and cells, and decides which belong. Cells of the complex name their facets by number until
  /// the end.
  void read_facets() {
    const int dimension = triangulation_.dimension();
    if (dimension == 2)
      for (const auto& [cell, i] : triangulation_.finite_facets()) {
        Facet& facet = facets_[add_facet(cell->vertex(0), cell->vertex(1), cell->vertex(2))];
        facet.belongs = is_small(facet.corners[0], facet.corners[1], facet.corners[2]);
      }
    if (dimension < 3) return;
    std::vector<std::array<std::uint32_t, 4>> facets_of;  // by cell
    std::vector<std::array<Vertex, 2>> beyond;            // by facet: the beads opposite to it, if any
    CellId cells = 0;
    for (const auto c : triangulation_.finite_cell_handles()) c->info() = cells++;
    facets_of.resize(cells);
    for (auto& of : facets_of) of.fill(none);
    for (const auto c : triangulation_.finite_cell_handles()) {
      const bool belongs = is_small(c->vertex(0), c->vertex(1), c->vertex(2), c->vertex(3));
      auto& own = facets_of[c->info()];
      for (int i = 0; i < 4; ++i) {
        std::uint32_t& facet = own[static_cast<std::size_t>(i)];
        if (facet == none) {
          facet = add_facet(c->vertex((i + 1) % 4), c->vertex((i + 2) % 4), c->vertex((i + 3) % 4));
          const auto neighbor = c->neighbor(i);
          const int back = neighbor->index(c);
          const bool infinite = triangulation_.is_infinite(neighbor);
          if (!infinite) facets_of[neighbor->info()][static_cast<std::size_t>(back)] = facet;
          beyond.push_back({c->vertex(i), infinite ? Vertex() : neighbor->vertex(back)});
        }
        facets_[facet].belongs |= belongs;
      }
      if (!belongs) continue;
      auto& tetrahedron = result_.tetrahedra.emplace_back();
      for (int i = 0; i < 4; ++i) tetrahedron.beads[static_cast<std::size_t>(i)] = c->vertex(i)->info();
      tetrahedron.triangles = own;
    }
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (facets_[f].belongs) continue;
      const auto& [a, b, c] = facets_[f].corners;
      facets_[f].belongs =
          is_small(a, b, c) && std::none_of(beyond[f].begin(), beyond[f].end(), [&](Vertex bead) {
            return bead != Vertex() && conflicts(bead, a, b, c);
          });
    }
  }

  void decide_edges() {
    for (const Facet& facet : facets_)
      if (facet.belongs)
        for (const std::uint32_t e : facet.edges) edges_[e].belongs = true;
    for (Edge& edge : edges_) edge.may_belong = !edge.belongs && is_small(edge.ends[0], edge.ends[1]);
    for (const Facet& facet : facets_)
      for (std::size_t i = 0; i < 3; ++i)
        if (Edge& edge = edges_[facet.edges[i]];
            edge.may_belong && conflicts(facet.corners[i], edge.ends[0], edge.ends[1]))
          edge.may_belong = false;
    for (Edge& edge : edges_) edge.belongs |= edge.may_belong;
  }

  void decide_vertices() {
    std::vector<char> belongs(first_edge_.size(), 0), attached(first_edge_.size(), 0);
    for (const Edge& edge : edges_)
      if (edge.belongs)
        for (const Vertex end : edge.ends) belongs[end->info()] = 1;
    for (const Edge& edge : edges_)
      for (std::size_t i = 0; i < 2; ++i)
        if (const BeadId bead = edge.ends[i]->info();
            belongs[bead] == 0 && conflicts(edge.ends[1 - i], edge.ends[i]))
          attached[bead] = 1;
    for (const Vertex v : triangulation_.finite_vertex_handles())
      if (const BeadId bead = v->info(); belongs[bead] != 0 || (attached[bead] == 0 && is_small(v)))
        result_.vertices.push_back(bead);
    std::sort(result_.vertices.begin(), result_.vertices.end());
  }

  const Triangulation& triangulation_;
  std::vector<std::uint32_t> first_edge_;  // by lower bead
  std::vector<Edge> edges_;
  std::vector<Facet> facets_;
  ComplexSimplices result_;
};

}  // namespace

ComplexSimplices static_dual_complex(const Eigen::Matrix3Xd& centers, std::span<const double> weights) {
  const FloatingPointScope to_nearest;
  Triangulation triangulation;
  insert_all<3>(triangulation, centers, weights);
  return Builder(triangulation, weights.size()).simplices();
}

}  // namespace kds
