#include "corruptions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>
#include <optional>

#include "check_power.h"
#include "check_wrapped.h"
#include "exact_sphere.h"

namespace oracle {
namespace {

void tidy(std::vector<Cell>& cells) {
  for (Cell& cell : cells) std::sort(cell.begin(), cell.end());
  std::sort(cells.begin(), cells.end());
}

bool has(const Cell& cell, unsigned bead) { return std::find(cell.begin(), cell.end(), bead) != cell.end(); }

// Returns the signed volume of the beads of a cell.
double turn(const Frame& f, const Cell& beads) {
  std::array<std::array<double, 3>, 3> v{};
  for (std::size_t i = 0; i + 1 < beads.size(); ++i) {
    for (std::size_t k = 0; k < 3; ++k) v[i][k] = f[beads[i + 1]].centre[k] - f[beads[0]].centre[k];
  }
  if (beads.size() == 3) return v[0][0] * v[1][1] - v[0][1] * v[1][0];
  return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
         v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
         v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

// Exchanges two cells for the cells around the line through their apexes (2-3 in space, 2-2 in the plane).
// The result is a triangulation that only the power test can distinguish from the correct one.
bool flip_around_apexes(const Frame& frame, std::vector<Cell>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      std::vector<unsigned> common, apexes;
      std::set_intersection(cells[i].begin(), cells[i].end(), cells[j].begin(), cells[j].end(),
                            std::back_inserter(common));
      if (common.size() + 1 != cells[i].size()) continue;
      std::set_symmetric_difference(cells[i].begin(), cells[i].end(), cells[j].begin(), cells[j].end(),
                                    std::back_inserter(apexes));
      std::vector<Cell> flipped;
      std::size_t positive = 0, negative = 0;
      for (std::size_t left_out = 0; left_out < common.size(); ++left_out) {
        Cell cell = apexes;  // the other beads of the common facet in cyclic order
        for (std::size_t k = 1; k < common.size(); ++k)
          cell.push_back(common[(left_out + k) % common.size()]);
        // In the plane the two new cells lie on opposite sides of the line.
        const double sign = common.size() == 2 && left_out == 1 ? -1 : 1;
        if (sign * turn(frame, cell) > 1e-6) ++positive;
        if (sign * turn(frame, cell) < -1e-6) ++negative;
        flipped.push_back(std::move(cell));
      }
      if (positive != common.size() && negative != common.size()) continue;
      cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(j));
      cells.erase(cells.begin() + static_cast<std::ptrdiff_t>(i));
      cells.insert(cells.end(), flipped.begin(), flipped.end());
      tidy(cells);
      return true;
    }
  }
  return false;
}

// Covers two hull facets in one plane (on one line) with a cell without volume, so that all facets still
// match in pairs.
bool cover_with_flat_cell(const Frame& frame, std::vector<Cell>& cells) {
  std::map<std::vector<unsigned>, int> facets;
  for (const Cell& cell : cells) {
    for (std::size_t i = 0; i < cell.size(); ++i) {
      std::vector<unsigned> facet = cell;
      facet.erase(facet.begin() + static_cast<std::ptrdiff_t>(i));
      ++facets[facet];
    }
  }
  for (const auto& [f, uses] : facets) {
    for (const auto& [g, others] : facets) {
      Cell beads;
      std::set_union(f.begin(), f.end(), g.begin(), g.end(), std::back_inserter(beads));
      if (uses != 1 || others != 1 || beads.size() != f.size() + 1) continue;
      if (turn(frame, beads) != 0) continue;
      cells.push_back(beads);
      tidy(cells);
      return true;
    }
  }
  return false;
}

// Returns another bead at the same position.
std::optional<unsigned> twin(const Frame& frame, unsigned bead) {
  for (unsigned other = 0; other < frame.size(); ++other) {
    if (other != bead && frame[other].centre == frame[bead].centre) return other;
  }
  return std::nullopt;
}

// If every bead has a twin, the cells of the twins are regular too. Adding them fills the hull twice.
bool add_cells_of_twins(const Frame& frame, Tables& tables) {
  const std::vector<Cell> cells = tables.cells;
  for (Cell cell : cells) {
    for (unsigned& bead : cell) {
      const auto other = twin(frame, bead);
      if (!other) return false;
      bead = *other;
    }
    tables.cells.push_back(cell);
  }
  tables.hidden.clear();
  tidy(tables.cells);
  return true;
}

void set_sphere(Node& node, const ExactSphere& sphere) {
  node.centre = sphere.centre;
  node.radius = sphere.radius;
}

}  // namespace

std::vector<Corruption> power_corruptions() {
  return {
      {"another id in a cell",
       [](const Scene& s, Tables& t, Dice& dice) {
         Cell& cell = t.cells[dice.below(t.cells.size())];
         const auto bead = static_cast<unsigned>(dice.below(s.bead_count()));
         if (has(cell, bead)) return false;
         cell[dice.below(cell.size())] = bead;
         tidy(t.cells);
         return true;
       }},
      {"a lost cell",
       [](const Scene&, Tables& t, Dice& dice) {
         t.cells.erase(t.cells.begin() + static_cast<std::ptrdiff_t>(dice.below(t.cells.size())));
         return true;
       }},
      {"a cell twice",
       [](const Scene&, Tables& t, Dice& dice) {
         t.cells.push_back(t.cells[dice.below(t.cells.size())]);
         tidy(t.cells);
         return true;
       }},
      {"a cell too many",
       [](const Scene& s, Tables& t, Dice& dice) {
         Cell cell(t.cells[0].size());
         std::iota(cell.begin(), cell.end(),
                   static_cast<unsigned>(dice.below(s.bead_count() + 1 - cell.size())));
         if (std::find(t.cells.begin(), t.cells.end(), cell) != t.cells.end()) return false;
         t.cells.push_back(cell);
         tidy(t.cells);
         return true;
       }},
      {"lines out of order",
       [](const Scene&, Tables& t, Dice& dice) {
         const std::size_t i = dice.below(t.cells.size() - 1);
         std::swap(t.cells[i], t.cells[i + 1]);
         return true;
       }},
      {"ids out of order",
       [](const Scene&, Tables& t, Dice& dice) {
         Cell& cell = t.cells[dice.below(t.cells.size())];
         std::swap(cell[1], cell[2]);
         return true;
       }},
      {"an id out of range",
       [](const Scene& s, Tables& t, Dice&) {
         t.cells.back().back() = static_cast<unsigned>(s.bead_count());
         return true;
       }},
      {"no cells",
       [](const Scene&, Tables& t, Dice&) {
         t.cells.clear();
         return true;
       }},
      {"a visible bead called hidden",
       [](const Scene&, Tables& t, Dice& dice) {
         t.hidden.push_back(t.cells[dice.below(t.cells.size())][0]);
         return true;
       }},
      {"a bead and its cells away",
       [](const Scene&, Tables& t, Dice& dice) {
         const unsigned bead = t.cells[dice.below(t.cells.size())][1];
         std::erase_if(t.cells, [&](const Cell& cell) { return has(cell, bead); });
         t.hidden.push_back(bead);
         return true;
       }},
      {"right but for a bead left out",
       [](const Scene& s, Tables& t, Dice& dice) {
         const unsigned bead = t.cells[dice.below(t.cells.size())][2];
         if (twin(s.frames[0], bead)) return false;
         Frame rest = s.in_plane(0);
         rest.erase(rest.begin() + bead);
         const PowerDiagram diagram = static_power_diagram(rest, s.dimension);
         const auto renumbered = [&](unsigned i) { return i < bead ? i : i + 1; };
         t.cells = diagram.cells;
         t.hidden = {bead};
         for (Cell& cell : t.cells) std::transform(cell.begin(), cell.end(), cell.begin(), renumbered);
         for (const unsigned i : diagram.hidden) t.hidden.push_back(renumbered(i));
         tidy(t.cells);
         std::sort(t.hidden.begin(), t.hidden.end());
         return true;
       }},
      {"a hidden bead forgotten",
       [](const Scene&, Tables& t, Dice&) {
         if (t.hidden.empty()) return false;
         t.hidden.pop_back();
         return true;
       }},
      {"a hidden bead twice",
       [](const Scene&, Tables& t, Dice&) {
         if (t.hidden.empty()) return false;
         t.hidden.push_back(t.hidden[0]);
         return true;
       }},
      {"another frame's cells",
       [](const Scene& s, Tables& t, Dice&) {
         const PowerDiagram other = static_power_diagram(s.in_plane(1), s.dimension);
         if (other.cells == t.cells) return false;
         t.cells = other.cells;
         t.hidden = other.hidden;
         return true;
       }},
      {"a flat cell on the hull",
       [](const Scene& s, Tables& t, Dice&) { return cover_with_flat_cell(s.in_plane(0), t.cells); }},
      {"cells of coincident beads as well",
       [](const Scene& s, Tables& t, Dice&) { return add_cells_of_twins(s.frames[0], t); }},
      {"a wrong flip",
       [](const Scene& s, Tables& t, Dice&) { return flip_around_apexes(s.in_plane(0), t.cells); }},
  };
}

std::vector<Corruption> wrapped_corruptions() {
  const auto any = [](Tables& t, Dice& dice) -> Node& { return t.nodes[dice.below(t.nodes.size())]; };
  return {
      {"another basis bead",
       [=](const Scene&, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         const unsigned bead = node.first + static_cast<unsigned>(dice.below(node.last - node.first + 1));
         if (std::find(node.basis.begin(), node.basis.end(), bead) != node.basis.end()) return false;
         node.basis[dice.below(node.basis.size())] = bead;
         std::sort(node.basis.begin(), node.basis.end());
         return true;
       }},
      {"a lost basis bead",
       [=](const Scene&, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         if (node.basis.size() < 2) return false;
         node.basis.erase(node.basis.begin() + static_cast<std::ptrdiff_t>(dice.below(node.basis.size())));
         return true;
       }},
      {"a basis bead too many",
       [=](const Scene& s, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         const unsigned bead = node.first + static_cast<unsigned>(dice.below(node.last - node.first + 1));
         if (touches(cgal_sphere(s.frames[0], node.basis), s.frames[0][bead])) return false;
         node.basis.push_back(bead);
         std::sort(node.basis.begin(), node.basis.end());
         return true;
       }},
      {"a smaller basis with its own sphere",
       [=](const Scene& s, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         if (node.basis.size() < 2) return false;
         node.basis.pop_back();
         set_sphere(node, cgal_sphere(s.frames[0], node.basis));
         return true;
       }},
      {"a sphere around all beads that is too large",
       [](const Scene& s, Tables& t, Dice&) {
         for (Node& node : t.nodes) {
           if (node.last - node.first != 2 || node.basis.size() != 2) continue;
           Node wider = node;  // the circumcircle of an obtuse triangle
           wider.basis = {node.first, node.first + 1, node.first + 2};
           const ExactSphere circle = prove_sphere(s.frames[0], wider).sphere;
           if (!(circle.radius > node.radius * 1.0001)) continue;
           set_sphere(wider, circle);
           node = wider;
           return true;
         }
         return false;
       }},
      {"a nudged radius",
       [=](const Scene&, Tables& t, Dice& dice) {
         any(t, dice).radius *= dice.below(2) ? 1 + 1e-11 : 1 - 1e-11;
         return true;
       }},
      {"a nudged centre",
       [=](const Scene& s, Tables& t, Dice& dice) {
         double size = 0;
         for (const Ball& ball : s.frames[0]) size = std::max(size, std::abs(ball.centre[0]));
         Node& node = any(t, dice);
         node.centre[dice.below(3)] += 1e-10 * std::max(size, node.radius);
         return true;
       }},
      {"a radius that is no number",
       [=](const Scene&, Tables& t, Dice& dice) {
         any(t, dice).radius = std::numeric_limits<double>::quiet_NaN();
         return true;
       }},
      {"a lost node",
       [](const Scene&, Tables& t, Dice& dice) {
         t.nodes.erase(t.nodes.begin() + static_cast<std::ptrdiff_t>(dice.below(t.nodes.size())));
         return true;
       }},
      {"a node twice",
       [=](const Scene&, Tables& t, Dice& dice) {
         t.nodes.push_back(any(t, dice));
         return true;
       }},
      {"a node that crosses others",
       [=](const Scene& s, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         if (node.last - node.first < 3) return false;
         const Frame& frame = s.frames[0];
         --node.last;
         std::vector<unsigned> beads;
         for (unsigned bead = node.first; bead <= node.last; ++bead) beads.push_back(bead);
         const ExactSphere sphere = cgal_sphere(frame, beads);
         node.basis = sphere.support;
         set_sphere(node, sphere);
         return true;
       }},
      {"exchanged spheres",
       [](const Scene&, Tables& t, Dice& dice) {
         const std::size_t i = dice.below(t.nodes.size() - 1);
         if (t.nodes[i].centre == t.nodes[i + 1].centre) return false;
         std::swap(t.nodes[i].centre, t.nodes[i + 1].centre);
         std::swap(t.nodes[i].radius, t.nodes[i + 1].radius);
         return true;
       }},
      {"a basis out of order",
       [=](const Scene&, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         if (node.basis.size() < 2) return false;
         std::swap(node.basis[0], node.basis[1]);
         return true;
       }},
      {"a basis bead of another node",
       [=](const Scene& s, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         node.basis.back() = static_cast<unsigned>(s.bead_count());
         return true;
       }},
      {"a twin from beyond the node",
       [=](const Scene& s, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         const auto other = twin(s.frames[0], node.basis[0]);
         if (!other || (node.first <= *other && *other <= node.last)) return false;
         node.basis[0] = *other;
         std::sort(node.basis.begin(), node.basis.end());
         return true;
       }},
      {"another frame's nodes",
       [](const Scene& s, Tables& t, Dice&) {
         t.nodes = static_hierarchy(s.frames[1], s.ends);
         return true;
       }},
      {"a tree like a list",
       [](const Scene& s, Tables& t, Dice&) {
         if (s.ends.size() > 1) return false;
         t.nodes.clear();
         const auto last = static_cast<unsigned>(s.bead_count() - 1);
         for (unsigned first = 0; first < last; ++first) {
           Node node;
           node.first = first;
           node.last = last;
           std::vector<unsigned> beads;
           for (unsigned bead = first; bead <= last; ++bead) beads.push_back(bead);
           const ExactSphere sphere = cgal_sphere(s.frames[0], beads);
           node.basis = sphere.support;
           set_sphere(node, sphere);
           t.nodes.push_back(node);
         }
         return true;
       }},
  };
}

}  // namespace oracle
