#include "corruptions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
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

double turn(const Frame& f, unsigned a, unsigned b, unsigned c, unsigned d) {
  std::array<std::array<double, 3>, 3> v{};
  for (std::size_t k = 0; k < 3; ++k) {
    v[0][k] = f[b].centre[k] - f[a].centre[k];
    v[1][k] = f[c].centre[k] - f[a].centre[k];
    v[2][k] = f[d].centre[k] - f[a].centre[k];
  }
  return v[0][0] * (v[1][1] * v[2][2] - v[1][2] * v[2][1]) -
         v[0][1] * (v[1][0] * v[2][2] - v[1][2] * v[2][0]) +
         v[0][2] * (v[1][0] * v[2][1] - v[1][1] * v[2][0]);
}

// A flip that leaves a sound triangulation, which only the power test can tell from the right one.
bool flip_two_to_three(const Frame& frame, std::vector<Cell>& cells) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t j = i + 1; j < cells.size(); ++j) {
      std::vector<unsigned> common, apexes;
      std::set_intersection(cells[i].begin(), cells[i].end(), cells[j].begin(), cells[j].end(),
                            std::back_inserter(common));
      if (common.size() != 3) continue;
      std::set_symmetric_difference(cells[i].begin(), cells[i].end(), cells[j].begin(), cells[j].end(),
                                    std::back_inserter(apexes));
      const auto [a, b, c] = std::array{common[0], common[1], common[2]};
      const unsigned d = apexes[0], e = apexes[1];
      const double x = turn(frame, d, e, a, b), y = turn(frame, d, e, b, c), z = turn(frame, d, e, c, a);
      if (!((x > 1e-6 && y > 1e-6 && z > 1e-6) || (x < -1e-6 && y < -1e-6 && z < -1e-6))) continue;
      cells[i] = {a, b, d, e};
      cells[j] = {b, c, d, e};
      cells.push_back({a, c, d, e});
      tidy(cells);
      return true;
    }
  }
  return false;
}

// Two hull facets in one plane, covered by a cell without volume: all facets still pair up.
bool cover_with_flat_cell(const Frame& frame, std::vector<Cell>& cells) {
  std::map<std::array<unsigned, 3>, int> facets;
  for (const Cell& c : cells) {
    for (const auto& facet :
         {std::array{c[0], c[1], c[2]}, {c[0], c[1], c[3]}, {c[0], c[2], c[3]}, {c[1], c[2], c[3]}}) {
      ++facets[facet];
    }
  }
  for (const auto& [f, uses] : facets) {
    for (const auto& [g, others] : facets) {
      std::vector<unsigned> beads;
      std::set_union(f.begin(), f.end(), g.begin(), g.end(), std::back_inserter(beads));
      if (uses != 1 || others != 1 || beads.size() != 4) continue;
      if (turn(frame, beads[0], beads[1], beads[2], beads[3]) != 0) continue;
      cells.push_back({beads[0], beads[1], beads[2], beads[3]});
      tidy(cells);
      return true;
    }
  }
  return false;
}

// Another bead in the same place.
std::optional<unsigned> twin(const Frame& frame, unsigned bead) {
  for (unsigned other = 0; other < frame.size(); ++other) {
    if (other != bead && frame[other].centre == frame[bead].centre) return other;
  }
  return std::nullopt;
}

// Where every bead has a twin, the twins' cells are as regular: the hull is filled twice.
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
         cell[dice.below(4)] = bead;
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
         const auto a = static_cast<unsigned>(dice.below(s.bead_count() - 3));
         const Cell cell{a, a + 1, a + 2, a + 3};
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
         std::swap(cell[2], cell[3]);
         return true;
       }},
      {"an id out of range",
       [](const Scene& s, Tables& t, Dice&) {
         t.cells.back()[3] = static_cast<unsigned>(s.bead_count());
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
         Frame rest = s.frames[0];
         rest.erase(rest.begin() + bead);
         const PowerDiagram diagram = static_power_diagram(rest);
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
         const PowerDiagram other = static_power_diagram(s.frames[1]);
         if (other.cells == t.cells) return false;
         t.cells = other.cells;
         t.hidden = other.hidden;
         return true;
       }},
      {"a flat cell on the hull",
       [](const Scene& s, Tables& t, Dice&) { return cover_with_flat_cell(s.frames[0], t.cells); }},
      {"cells of coincident beads as well",
       [](const Scene& s, Tables& t, Dice&) { return add_cells_of_twins(s.frames[0], t); }},
      {"a wrong flip",
       [](const Scene& s, Tables& t, Dice&) { return flip_two_to_three(s.frames[0], t.cells); }},
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
       [=](const Scene&, Tables& t, Dice& dice) {
         Node& node = any(t, dice);
         const unsigned bead = node.first + static_cast<unsigned>(dice.below(node.last - node.first + 1));
         if (std::find(node.basis.begin(), node.basis.end(), bead) != node.basis.end()) return false;
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
           Node wider = node;  // the circle through an obtuse triangle
           wider.basis = {node.first, node.first + 1, node.first + 2};
           const ExactSphere circle = prove_sphere(s.frames[0], wider).sphere;
           if (!(circle.radius > node.radius * 1.0001)) continue;
           set_sphere(wider, circle);
           node = wider;
           return true;
         }
         return false;
       }},
      {"a basis bead that changes nothing",
       [](const Scene& s, Tables& t, Dice&) {
         for (Node& node : t.nodes) {
           for (unsigned bead = node.first; bead <= node.last && node.basis.size() < 4; ++bead) {
             if (std::find(node.basis.begin(), node.basis.end(), bead) != node.basis.end()) continue;
             Node more = node;
             more.basis.push_back(bead);
             std::sort(more.basis.begin(), more.basis.end());
             const ExactSphere sphere = prove_sphere(s.frames[0], more).sphere;
             if (sphere.radius != node.radius || sphere.centre != node.centre) continue;
             node = more;
             return true;
           }
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
