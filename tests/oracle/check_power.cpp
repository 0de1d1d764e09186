#include "check_power.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Regular_triangulation_2.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <utility>

#include "rational.h"

namespace oracle {

namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

struct BeadOfVertex {
  unsigned bead = std::numeric_limits<unsigned>::max();
};

template <int space>
struct Geometry;

template <>
struct Geometry<2> {
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_2<BeadOfVertex, Kernel,
                                                  CGAL::Regular_triangulation_vertex_base_2<Kernel>>;
  using Structure =
      CGAL::Triangulation_data_structure_2<Vertex, CGAL::Regular_triangulation_face_base_2<Kernel>>;
  using Triangulation = CGAL::Regular_triangulation_2<Kernel, Structure>;
  using WeightedPoint = Kernel::Weighted_point_2;
  using Points = std::vector<WeightedPoint>;

  static WeightedPoint weighted_point(const Ball& ball) {
    return {Kernel::Point_2(ball.centre[0], ball.centre[1]), ball.weight};
  }
  static CGAL::Orientation turn(const Points& p, const Cell& c) {
    return CGAL::orientation(p[c[0]].point(), p[c[1]].point(), p[c[2]].point());
  }
  static CGAL::Oriented_side power_test(const Points& p, const Cell& c, unsigned bead) {
    return CGAL::power_side_of_oriented_power_circle(p[c[0]], p[c[1]], p[c[2]], p[bead]);
  }
  static bool is_hidden(const Triangulation::Vertex_handle& vertex) { return vertex->is_hidden(); }
  static auto cells_of(const Triangulation& t) { return t.finite_face_handles(); }
};

template <>
struct Geometry<3> {
  using Vertex =
      CGAL::Triangulation_vertex_base_with_info_3<BeadOfVertex, Kernel,
                                                  CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
  using Structure =
      CGAL::Triangulation_data_structure_3<Vertex, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
  using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;
  using WeightedPoint = Kernel::Weighted_point_3;
  using Points = std::vector<WeightedPoint>;

  static WeightedPoint weighted_point(const Ball& ball) {
    return {Kernel::Point_3(ball.centre[0], ball.centre[1], ball.centre[2]), ball.weight};
  }
  static CGAL::Orientation turn(const Points& p, const Cell& c) {
    return CGAL::orientation(p[c[0]].point(), p[c[1]].point(), p[c[2]].point(), p[c[3]].point());
  }
  static CGAL::Oriented_side power_test(const Points& p, const Cell& c, unsigned bead) {
    return CGAL::power_side_of_oriented_power_sphere(p[c[0]], p[c[1]], p[c[2]], p[c[3]], p[bead]);
  }
  // CGAL keeps no hidden vertices in space.
  static bool is_hidden(const Triangulation::Vertex_handle&) { return false; }
  static auto cells_of(const Triangulation& t) { return t.finite_cell_handles(); }
};

template <int space>
std::vector<typename Geometry<space>::WeightedPoint> weighted_points(const Frame& frame) {
  std::vector<typename Geometry<space>::WeightedPoint> points;
  points.reserve(frame.size());
  for (const Ball& ball : frame) points.push_back(Geometry<space>::weighted_point(ball));
  return points;
}

std::string text(const std::vector<unsigned>& beads) {
  std::string line;
  for (const unsigned bead : beads) line.append(line.empty() ? "" : ",").append(std::to_string(bead));
  return line;
}

// Returns twice the area in the plane, and six times the volume in space.
Rational volume_of(const Frame& frame, const std::vector<Cell>& cells) {
  Rational sum = 0;
  for (const Cell& cell : cells) {
    const std::size_t space = cell.size() - 1;
    std::array<std::array<Rational, 3>, 3> d;
    for (std::size_t i = 0; i < space; ++i) {
      for (std::size_t c = 0; c < space; ++c) {
        d[i][c] = Rational(frame[cell[i + 1]].centre[c]) - Rational(frame[cell[0]].centre[c]);
      }
    }
    const Rational det = space == 2 ? Rational(d[0][0] * d[1][1] - d[0][1] * d[1][0])
                                    : Rational(d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                                               d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                                               d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]));
    sum += CGAL::abs(det);
  }
  return sum;
}

// Proves that a triangulation is regular, or explains what is wrong with it.
template <int space>
class FacetsProof {
 public:
  FacetsProof(const Frame& frame, const PowerDiagram& dumped)
      : frame_(frame), dumped_(dumped), points_(weighted_points<space>(frame)) {}

  std::optional<std::string> objection(const PowerDiagram& reference) {
    if (auto wrong = flat_cell()) return wrong;
    if (auto wrong = bad_facet()) return wrong;
    // All facets match in pairs and the others are hull facets, so the cells cover every point of the hull
    // equally often. The cells cover it once if the volume is correct.
    if (volume_of(frame_, dumped_.cells) != volume_of(frame_, reference.cells)) {
      return "the cells do not fill the convex hull";
    }
    return wrong_hidden_bead();
  }

 private:
  struct Facet {
    std::vector<unsigned> beads;
    std::size_t cell;
    unsigned apex;
  };

  std::optional<std::string> flat_cell() {
    oriented_ = dumped_.cells;
    for (Cell& cell : oriented_) {
      const auto turn = Geometry<space>::turn(points_, cell);
      if (turn == CGAL::ZERO) return "cell " + text(cell) + " is flat";
      if (turn == CGAL::NEGATIVE) std::swap(cell[0], cell[1]);
    }
    return std::nullopt;
  }

  std::optional<std::string> bad_facet() const {
    std::vector<Facet> facets;
    for (std::size_t k = 0; k < dumped_.cells.size(); ++k) {
      for (std::size_t i = 0; i <= space; ++i) {
        Facet facet{dumped_.cells[k], k, dumped_.cells[k][i]};
        facet.beads.erase(facet.beads.begin() + static_cast<std::ptrdiff_t>(i));
        facets.push_back(std::move(facet));
      }
    }
    std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.beads < b.beads; });
    for (std::size_t i = 0; i < facets.size();) {
      std::size_t end = i;
      while (end < facets.size() && facets[end].beads == facets[i].beads) ++end;
      const Facet& f = facets[i];
      const auto side = [&](unsigned bead) {
        Cell cell = f.beads;
        cell.push_back(bead);
        return Geometry<space>::turn(points_, cell);
      };
      const std::string name = text(f.beads);
      if (end - i > 2) return "facet " + name + " belongs to more than two cells";
      if (end - i == 2) {
        const Facet& g = facets[i + 1];
        if (side(f.apex) == side(g.apex)) return "two cells lie on the same side of facet " + name;
        if (Geometry<space>::power_test(points_, oriented_[f.cell], g.apex) == CGAL::ON_POSITIVE_SIDE) {
          return "facet " + name + " fails the power test";
        }
      } else {
        for (unsigned bead = 0; bead < points_.size(); ++bead) {
          if (side(bead) == -side(f.apex)) {
            return "facet " + name + " has no neighbour, but bead " + std::to_string(bead) +
                   " lies beyond it";
          }
        }
      }
      i = end;
    }
    return std::nullopt;
  }

  std::optional<std::string> wrong_hidden_bead() const {
    for (const unsigned bead : dumped_.hidden) {
      for (const Cell& cell : oriented_) {
        if (Geometry<space>::power_test(points_, cell, bead) == CGAL::ON_POSITIVE_SIDE) {
          return "bead " + std::to_string(bead) + " is not hidden";
        }
      }
    }
    return std::nullopt;
  }

  const Frame& frame_;
  const PowerDiagram& dumped_;
  typename Geometry<space>::Points points_;
  std::vector<Cell> oriented_;  ///< the same cells with positive orientation
};

// Checks the order of ids and lines, their ranges, and that vertices and hidden beads together are all beads.
bool well_formed(std::size_t beads, const PowerDiagram& dumped, bool solid, const std::string& where,
                 Report& report) {
  const std::size_t before = report.mismatch_count;
  std::vector<char> vertex(beads, 0), hidden(beads, 0);
  for (std::size_t k = 0; k < dumped.cells.size(); ++k) {
    const Cell& cell = dumped.cells[k];
    for (std::size_t i = 0; i + 1 < cell.size(); ++i) {
      if (cell[i] >= cell[i + 1]) report.mismatch(where + "cell " + text(cell) + ": ids do not ascend");
    }
    if (k > 0 && dumped.cells[k - 1] == cell)
      report.mismatch(where + "cell " + text(cell) + " is there twice");
    if (k > 0 && dumped.cells[k - 1] > cell)
      report.mismatch(where + "cell " + text(cell) + " is out of order");
    for (const unsigned bead : cell) {
      if (bead < beads) {
        vertex[bead] = 1;
      } else {
        report.mismatch(where + "cell " + text(cell) + " names a bead that does not exist");
      }
    }
  }
  for (const unsigned bead : dumped.hidden) {
    if (bead >= beads) {
      report.mismatch(where + "hidden bead " + std::to_string(bead) + " does not exist");
    } else if (hidden[bead]++) {
      report.mismatch(where + "hidden bead " + std::to_string(bead) + " is there twice");
    } else if (vertex[bead]) {
      report.mismatch(where + "hidden bead " + std::to_string(bead) + " is a vertex of a cell");
    }
  }
  for (unsigned bead = 0; solid && bead < beads; ++bead) {
    if (!vertex[bead] && !hidden[bead]) {
      report.mismatch(where + "bead " + std::to_string(bead) + " is neither a vertex nor hidden");
    }
  }
  return report.mismatch_count == before;
}

// If all beads lie in a plane (or, in the plane, on a line), there are no cells. Any one of several
// coincident beads may be the visible one.
bool same_visible_points(const Frame& frame, const PowerDiagram& dumped, const PowerDiagram& reference) {
  const auto visible = [&](const std::vector<unsigned>& hidden) {
    std::vector<std::array<double, 4>> points;
    for (unsigned bead = 0; bead < frame.size(); ++bead) {
      const Ball& b = frame[bead];
      if (std::find(hidden.begin(), hidden.end(), bead) == hidden.end()) {
        points.push_back({b.centre[0], b.centre[1], b.centre[2], b.weight});
      }
    }
    std::sort(points.begin(), points.end());
    return points;
  };
  return dumped.cells.empty() && visible(dumped.hidden) == visible(reference.hidden);
}

template <int space>
PowerDiagram static_diagram(const Frame& frame, bool backwards) {
  typename Geometry<space>::Triangulation triangulation;
  const auto points = weighted_points<space>(frame);
  for (unsigned i = 0; i < points.size(); ++i) {
    const unsigned bead = backwards ? static_cast<unsigned>(points.size()) - 1 - i : i;
    const auto vertex = triangulation.insert(points[bead]);
    // CGAL returns no vertex for a hidden point in space. For a point that exists already it returns the
    // vertex that represents both.
    if (vertex != decltype(vertex)() && vertex->info().bead == BeadOfVertex{}.bead)
      vertex->info().bead = bead;
  }
  PowerDiagram result;
  result.dimension = triangulation.dimension();
  std::vector<char> visible(frame.size(), 0);
  for (const auto v : triangulation.finite_vertex_handles())
    if (!Geometry<space>::is_hidden(v)) visible[v->info().bead] = 1;
  for (unsigned bead = 0; bead < frame.size(); ++bead) {
    if (!visible[bead]) result.hidden.push_back(bead);
  }
  if (result.dimension == space) {
    for (const auto c : Geometry<space>::cells_of(triangulation)) {
      Cell cell;
      for (int i = 0; i <= space; ++i) cell.push_back(c->vertex(i)->info().bead);
      std::sort(cell.begin(), cell.end());
      result.cells.push_back(std::move(cell));
    }
    std::sort(result.cells.begin(), result.cells.end());
  }
  return result;
}

}  // namespace

PowerDiagram static_power_diagram(const Frame& frame, int space, bool backwards) {
  return space == 2 ? static_diagram<2>(frame, backwards) : static_diagram<3>(frame, backwards);
}

void check_power(const Frame& frame, int space, const PowerDiagram& dumped, const std::string& where,
                 Report& report) {
  const PowerDiagram reference = static_power_diagram(frame, space);
  report.cells += dumped.cells.size();
  if (!well_formed(frame.size(), dumped, reference.dimension == space, where, report)) return;
  std::vector<unsigned> hidden = dumped.hidden;
  std::sort(hidden.begin(), hidden.end());
  if (dumped.cells == reference.cells && hidden == reference.hidden) return;
  if (reference.dimension < space) {
    if (same_visible_points(frame, dumped, reference)) {
      ++report.degenerate;
    } else {
      report.mismatch(where + "the beads span no " + (space == 2 ? "area" : "volume") +
                      ", but there are cells or other hidden beads");
    }
    return;
  }
  const auto objection = space == 2 ? FacetsProof<2>(frame, dumped).objection(reference)
                                    : FacetsProof<3>(frame, dumped).objection(reference);
  if (objection) {
    report.mismatch(where + *objection);
  } else {
    ++report.degenerate;  // two different regular triangulations exist
  }
}

}  // namespace oracle
