#include "structures/triangulation/static_dual_complex.h"

#include <algorithm>
#include <tuple>
#include <utility>

#include "motions/base/floating_point_scope.h"
#include "structures/triangulation/regular_triangulation_cgal.h"

namespace kds {

namespace {

using Triangulation = CgalOf<3>::Type;
using Vertex = Triangulation::Vertex_handle;
constexpr std::uint32_t none = ~std::uint32_t{0};

/// A triangle of the triangulation. Its edges are numbers in the triangulation until the complex is known.
struct Facet : ComplexSimplices::Triangle {
  bool belongs = false;
};
std::uint32_t edge_opposite(const ComplexSimplices::Triangle& triangle, BeadId bead) {
  return triangle.edges[triangle.beads[0] == bead ? 0 : triangle.beads[1] == bead ? 1 : 2];
}

struct Edge {
  std::array<BeadId, 2> ends;  // ascending
  std::uint32_t next = none;   // the next edge with the same lower bead
  bool belongs = false, may_belong = false;
};

/// Builds the complex from a triangulation, from cells down to vertices.
class Builder {
 public:
  Builder(Triangulation& triangulation, std::size_t beads)
      : triangulation_(triangulation), vertex_(beads), first_edge_(beads, none) {
    for (const auto v : triangulation.finite_vertex_handles()) vertex_[v->info()] = v;
    triangulation.infinite_vertex()->info() = infinite_bead;
    edges_.reserve(8 * beads);
    facets_.reserve(14 * beads);
    if (triangulation.dimension() == 1)
      for (const auto& e : triangulation.finite_edges())
        edge_between(e.first->vertex(e.second)->info(), e.first->vertex(e.third)->info());
    if (triangulation.dimension() == 2)
      for (const auto& [cell, i] : triangulation.finite_facets()) {
        const BeadId a = cell->vertex(0)->info(), b = cell->vertex(1)->info(), c = cell->vertex(2)->info();
        facets_[add_facet({a, b, c}, {edge_between(b, c), edge_between(c, a), edge_between(a, b)})].belongs =
            is_small(std::array{a, b, c});
      }
    if (triangulation.dimension() == 3) read_cells();
    decide_edges();
    decide_vertices();
  }

  [[nodiscard]] ComplexSimplices simplices() && {
    std::vector<std::uint32_t> edge_places(edges_.size()), facet_places(facets_.size());
    for (std::size_t e = 0; e < edges_.size(); ++e) {
      if (!edges_[e].belongs) continue;
      edge_places[e] = static_cast<std::uint32_t>(result_.edges.size());
      result_.edges.push_back(edges_[e].ends);
    }
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      if (!facets_[f].belongs) continue;
      facet_places[f] = static_cast<std::uint32_t>(result_.triangles.size());
      auto& triangle = result_.triangles.emplace_back(facets_[f]);
      for (std::uint32_t& edge : triangle.edges) edge = edge_places[edge];
    }
    for (auto& [beads, edges, triangles] : result_.tetrahedra) {
      for (std::uint32_t& triangle : triangles) triangle = facet_places[triangle];
      for (std::size_t e = 0; e < 6; ++e) {
        // In a triangle at the edge, the edge is opposite to the bead that is none of its ends.
        const auto [k, l] = tetrahedron_edges[5 - e];
        edges[e] = edge_opposite(result_.triangles[triangles[k]], beads[l]);
      }
    }
    return std::move(result_);
  }

 private:
  template <std::size_t N>
  [[nodiscard]] bool is_small(const std::array<BeadId, N>& simplex) const {
    return std::apply(
        [this](auto... bead) {
          return Geometry().compare_weighted_squared_radius_3_object()(vertex_[bead]->point()..., 0.0) !=
                 CGAL::LARGER;
        },
        simplex);
  }
  /// Returns whether a bead conflicts with the smallest orthogonal sphere of a simplex.
  template <std::size_t N>
  [[nodiscard]] bool conflicts(BeadId other, const std::array<BeadId, N>& simplex) const {
    return std::apply(
        [&](auto... bead) {
          return Geometry().power_side_of_bounded_power_sphere_3_object()(
                     vertex_[bead]->point()..., vertex_[other]->point()) == CGAL::ON_BOUNDED_SIDE;
        },
        simplex);
  }

  std::uint32_t edge_between(BeadId a, BeadId b) {
    if (b < a) std::swap(a, b);
    for (std::uint32_t edge = first_edge_[a]; edge != none; edge = edges_[edge].next)
      if (edges_[edge].ends[1] == b) return edge;
    const auto edge = static_cast<std::uint32_t>(edges_.size());
    edges_.push_back(
        {{a, b}, std::exchange(first_edge_[a], edge)});  // in front, where it is soon looked up again
    return edge;
  }
  std::uint32_t add_facet(const std::array<BeadId, 3>& beads, const std::array<std::uint32_t, 3>& edges) {
    facets_.push_back({{beads, edges}});
    return static_cast<std::uint32_t>(facets_.size() - 1);
  }

  /// Reads cells and facets, and decides which belong. Tetrahedra of the result name facets by number.
  void read_cells() {
    std::vector<std::array<std::uint32_t, 4>> facets_of;  // by cell, opposite to its vertices
    std::vector<std::array<BeadId, 2>> beyond;            // by facet: the beads opposite to it
    facets_of.reserve(7 * vertex_.size());
    beyond.reserve(14 * vertex_.size());
    const auto facets_of_cell = [&](Triangulation::Cell_handle c) -> std::array<std::uint32_t, 4>& {
      if (c->info() == no_cell) {
        c->info() = static_cast<CellId>(facets_of.size());
        facets_of.push_back({none, none, none, none});
      }
      return facets_of[c->info()];
    };
    for (const auto c : triangulation_.finite_cell_handles()) {
      const std::array<BeadId, 4> beads = beads_of<3>(c);
      const bool belongs = is_small(beads);
      std::array<std::uint32_t, 4> own = facets_of_cell(c);
      for (std::size_t i = 0; i < 4; ++i) {
        if (own[i] == none) {
          std::array<BeadId, 3> corners;
          std::array<std::uint32_t, 3> edges;
          for (std::size_t k = 0; k < 3; ++k) corners[k] = beads[(i + 1 + k) % 4];
          for (std::size_t k = 0; k < 3; ++k) {  // the edge is also in the facet opposite to corner k
            const std::uint32_t other = own[(i + 1 + k) % 4];
            edges[k] = other != none ? edge_opposite(facets_[other], beads[i])
                                     : edge_between(corners[(k + 1) % 3], corners[(k + 2) % 3]);
          }
          own[i] = add_facet(corners, edges);
          const auto neighbor = c->neighbor(static_cast<int>(i));
          const int back = neighbor->index(c);
          const BeadId opposite = neighbor->vertex(back)->info();
          if (opposite != infinite_bead) facets_of_cell(neighbor)[static_cast<std::size_t>(back)] = own[i];
          beyond.push_back({beads[i], opposite});
        }
        facets_[own[i]].belongs |= belongs;
      }
      if (belongs) result_.tetrahedra.push_back({beads, {}, own});
    }
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      Facet& facet = facets_[f];
      facet.belongs = facet.belongs || (is_small(facet.beads) &&
                                        std::none_of(beyond[f].begin(), beyond[f].end(), [&](BeadId bead) {
                                          return bead != infinite_bead && conflicts(bead, facet.beads);
                                        }));
    }
  }

  void decide_edges() {
    for (const Facet& facet : facets_)
      if (facet.belongs)
        for (const std::uint32_t e : facet.edges) edges_[e].belongs = true;
    for (Edge& edge : edges_) edge.may_belong = !edge.belongs && is_small(edge.ends);
    for (const Facet& facet : facets_)
      for (std::size_t i = 0; i < 3 && !facet.belongs; ++i)
        if (Edge& edge = edges_[facet.edges[i]]; edge.may_belong && conflicts(facet.beads[i], edge.ends))
          edge.may_belong = false;
    for (Edge& edge : edges_) edge.belongs |= edge.may_belong;
  }

  void decide_vertices() {
    std::vector<char> belongs(vertex_.size(), 0), attached(vertex_.size(), 0);
    for (const Edge& edge : edges_)
      if (edge.belongs)
        for (const BeadId end : edge.ends) belongs[end] = 1;
    for (const Edge& edge : edges_)
      for (std::size_t i = 0; i < 2; ++i)
        if (const BeadId end = edge.ends[i];
            belongs[end] == 0 && conflicts(edge.ends[1 - i], std::array{end}))
          attached[end] = 1;
    for (BeadId bead = 0; bead < vertex_.size(); ++bead)
      if (vertex_[bead] != Vertex() &&
          (belongs[bead] != 0 || (attached[bead] == 0 && is_small(std::array{bead}))))
        result_.vertices.push_back(bead);
  }

  Triangulation& triangulation_;
  std::vector<Vertex> vertex_;             // by bead; none if it is hidden
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
