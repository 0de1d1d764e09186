#include "check_power.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Exact_rational.h>
#include <CGAL/Regular_triangulation_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace oracle {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = CGAL::Triangulation_vertex_base_with_info_3<unsigned, Kernel,
                                                           CGAL::Regular_triangulation_vertex_base_3<Kernel>>;
using Structure =
    CGAL::Triangulation_data_structure_3<Vertex, CGAL::Regular_triangulation_cell_base_3<Kernel>>;
using Triangulation = CGAL::Regular_triangulation_3<Kernel, Structure>;
using Point = Kernel::Point_3;
using WeightedPoint = Kernel::Weighted_point_3;
using Rational = CGAL::Exact_rational;

std::vector<WeightedPoint> weighted_points(const Frame& frame) {
  std::vector<WeightedPoint> points;
  points.reserve(frame.size());
  for (const Ball& ball : frame) {
    points.emplace_back(Point(ball.centre[0], ball.centre[1], ball.centre[2]), ball.weight);
  }
  return points;
}

std::string text(const Cell& cell) {
  return std::to_string(cell[0]) + "," + std::to_string(cell[1]) + "," + std::to_string(cell[2]) + "," +
         std::to_string(cell[3]);
}

Rational volume_of(const Frame& frame, const std::vector<Cell>& cells) {
  Rational sum = 0;
  for (const Cell& cell : cells) {
    std::array<std::array<Rational, 3>, 3> d;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t c = 0; c < 3; ++c) {
        d[i][c] = Rational(frame[cell[i + 1]].centre[c]) - Rational(frame[cell[0]].centre[c]);
      }
    }
    const Rational det = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                         d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                         d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    sum += CGAL::abs(det);
  }
  return sum;
}

// Proves a triangulation regular, or says what is wrong with it.
class Proof {
 public:
  Proof(const Frame& frame, const PowerDiagram& dumped)
      : frame_(frame), dumped_(dumped), points_(weighted_points(frame)) {}

  std::optional<std::string> objection(const PowerDiagram& reference) {
    if (auto wrong = flat_cell()) return wrong;
    if (auto wrong = bad_facet()) return wrong;
    // All facets pair up and the rest is hull: the cells cover the hull evenly. Once, if the volume fits.
    if (volume_of(frame_, dumped_.cells) != volume_of(frame_, reference.cells)) {
      return "the cells do not fill the convex hull";
    }
    return wrong_hidden_bead();
  }

 private:
  struct Facet {
    std::array<unsigned, 3> beads;
    unsigned cell, apex;
  };

  const Point& point(unsigned bead) const { return points_[bead].point(); }

  std::optional<std::string> flat_cell() {
    oriented_ = dumped_.cells;
    for (Cell& cell : oriented_) {
      const auto turn = CGAL::orientation(point(cell[0]), point(cell[1]), point(cell[2]), point(cell[3]));
      if (turn == CGAL::COPLANAR) return "cell " + text(cell) + " is flat";
      if (turn == CGAL::NEGATIVE) std::swap(cell[0], cell[1]);
    }
    return std::nullopt;
  }

  CGAL::Oriented_side power_test(const Cell& cell, unsigned bead) const {
    return CGAL::power_side_of_oriented_power_sphere(points_[cell[0]], points_[cell[1]], points_[cell[2]],
                                                     points_[cell[3]], points_[bead]);
  }

  std::optional<std::string> bad_facet() const {
    std::vector<Facet> facets;
    for (unsigned k = 0; k < dumped_.cells.size(); ++k) {
      const Cell& c = dumped_.cells[k];
      facets.push_back({{c[1], c[2], c[3]}, k, c[0]});
      facets.push_back({{c[0], c[2], c[3]}, k, c[1]});
      facets.push_back({{c[0], c[1], c[3]}, k, c[2]});
      facets.push_back({{c[0], c[1], c[2]}, k, c[3]});
    }
    std::sort(facets.begin(), facets.end(), [](const Facet& a, const Facet& b) { return a.beads < b.beads; });
    for (std::size_t i = 0; i < facets.size();) {
      std::size_t end = i;
      while (end < facets.size() && facets[end].beads == facets[i].beads) ++end;
      const Facet& f = facets[i];
      const auto side = [&](unsigned bead) {
        return CGAL::orientation(point(f.beads[0]), point(f.beads[1]), point(f.beads[2]), point(bead));
      };
      const std::string name =
          std::to_string(f.beads[0]) + "," + std::to_string(f.beads[1]) + "," + std::to_string(f.beads[2]);
      if (end - i > 2) return "facet " + name + " belongs to more than two cells";
      if (end - i == 2) {
        const Facet& g = facets[i + 1];
        if (side(f.apex) == side(g.apex)) return "two cells lie on the same side of facet " + name;
        if (power_test(oriented_[f.cell], g.apex) == CGAL::ON_POSITIVE_SIDE) {
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
        if (power_test(cell, bead) == CGAL::ON_POSITIVE_SIDE) {
          return "bead " + std::to_string(bead) + " is not hidden";
        }
      }
    }
    return std::nullopt;
  }

  const Frame& frame_;
  const PowerDiagram& dumped_;
  std::vector<WeightedPoint> points_;
  std::vector<Cell> oriented_;  ///< the same cells, positively oriented
};

// Order of ids and lines, ranges, and vertices + hidden beads = all beads.
bool well_formed(std::size_t beads, const PowerDiagram& dumped, bool solid, const std::string& where,
                 Report& report) {
  const std::size_t before = report.mismatch_count;
  std::vector<char> vertex(beads, 0), hidden(beads, 0);
  for (std::size_t k = 0; k < dumped.cells.size(); ++k) {
    const Cell& cell = dumped.cells[k];
    for (std::size_t i = 0; i < 3; ++i) {
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

// Where all beads lie in a plane there are no cells; of coincident beads any may be the one seen.
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

}  // namespace

PowerDiagram static_power_diagram(const Frame& frame, bool backwards) {
  std::vector<std::pair<WeightedPoint, unsigned>> input;
  for (const WeightedPoint& point : weighted_points(frame)) {
    input.emplace_back(point, static_cast<unsigned>(input.size()));
  }
  Triangulation triangulation;
  if (backwards) {
    for (auto it = input.rbegin(); it != input.rend(); ++it) {
      const auto vertex = triangulation.insert(it->first);
      if (vertex != Triangulation::Vertex_handle()) vertex->info() = it->second;
    }
  } else {
    triangulation.insert(input.begin(), input.end());
  }
  PowerDiagram result;
  result.dimension = triangulation.dimension();
  std::vector<char> visible(frame.size(), 0);
  for (const auto v : triangulation.finite_vertex_handles()) visible[v->info()] = 1;
  for (unsigned bead = 0; bead < frame.size(); ++bead) {
    if (!visible[bead]) result.hidden.push_back(bead);
  }
  if (result.dimension == 3) {
    for (const auto c : triangulation.finite_cell_handles()) {
      Cell cell{c->vertex(0)->info(), c->vertex(1)->info(), c->vertex(2)->info(), c->vertex(3)->info()};
      std::sort(cell.begin(), cell.end());
      result.cells.push_back(cell);
    }
    std::sort(result.cells.begin(), result.cells.end());
  }
  return result;
}

void check_power(const Frame& frame, const PowerDiagram& dumped, const std::string& where, Report& report) {
  const PowerDiagram reference = static_power_diagram(frame);
  report.cells += dumped.cells.size();
  if (!well_formed(frame.size(), dumped, reference.dimension == 3, where, report)) return;
  std::vector<unsigned> hidden = dumped.hidden;
  std::sort(hidden.begin(), hidden.end());
  if (dumped.cells == reference.cells && hidden == reference.hidden) return;
  if (reference.dimension < 3) {
    if (same_visible_points(frame, dumped, reference)) {
      ++report.degenerate;
    } else {
      report.mismatch(where + "the beads span no volume, but there are cells or other hidden beads");
    }
    return;
  }
  if (const auto objection = Proof(frame, dumped).objection(reference)) {
    report.mismatch(where + *objection);
  } else {
    ++report.degenerate;  // two different regular triangulations exist
  }
}

}  // namespace oracle
