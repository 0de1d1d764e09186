#pragma once
// Triangulations in space, random points for them, and checks that every mirror of CGAL's triangulation must
// pass, cell by cell.

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <utility>
#include <vector>

#include "structures/triangulation/cells.h"
#include "structures/triangulation/exact_triangulation.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/judges/exact_checks.h"

namespace kds::test {

inline std::size_t at(int i) { return static_cast<std::size_t>(i); }

inline CellBeads<3> sorted(CellBeads<3> beads) {
  std::sort(beads.begin(), beads.end());
  return beads;
}

inline std::vector<CellId> live_cells(const RegularTriangulation<3>& triangulation) {
  std::vector<CellId> live;
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (triangulation.is_live(cell)) live.push_back(cell);
  }
  return live;
}

inline int place(const RegularTriangulation<3>& t, CellId cell, BeadId bead) {
  const auto& v = t.cells()[cell].vertex;
  return static_cast<int>(std::find(v.begin(), v.end(), bead) - v.begin());
}

/// Returns all cells, including infinite ones; the beads of each cell ascend.
inline std::set<CellBeads<3>> all_cells(const RegularTriangulation<3>& triangulation) {
  std::set<CellBeads<3>> cells;
  for (const CellId cell : live_cells(triangulation))
    cells.insert(sorted(triangulation.cells()[cell].vertex));
  return cells;
}

inline int parity(CellBeads<3> from, const CellBeads<3>& to) {
  int sign = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    if (from[i] == to[i]) continue;
    const auto place = std::find(from.begin() + static_cast<std::ptrdiff_t>(i), from.end(), to[i]);
    std::swap(from[i], *place);
    sign = -sign;
  }
  return sign;
}

/// Checks the cells around each bead, using the mirror alone.
inline void check_around(const RegularTriangulation<3>& triangulation, std::size_t beads) {
  std::set<std::vector<BeadId>> faces;
  std::map<BeadId, CellId> some_cell;
  for (const CellId cell : live_cells(triangulation)) {
    const CellBeads<3> v = sorted(triangulation.cells()[cell].vertex);
    for (unsigned chosen = 1; chosen < 16; ++chosen) {
      std::vector<BeadId> face;
      for (unsigned i = 0; i < 4; ++i)
        if ((chosen >> i & 1U) != 0) face.push_back(v[i]);
      faces.insert(face);
    }
    for (const BeadId b : v) some_cell[b] = cell;
  }
  std::mt19937 random(static_cast<unsigned>(faces.size()));
  for (const auto& [bead, cell] : some_cell) {
    for (int round = 0; round < 20; ++round) {
      std::vector<BeadId> face{bead};
      for (std::size_t more = 0; more < 1 + random() % 3; ++more) {
        const auto other = static_cast<BeadId>(random() % (beads + 1));
        face.push_back(other == beads ? infinite_bead : other);
      }
      std::sort(face.begin(), face.end());
      face.erase(std::unique(face.begin(), face.end()), face.end());
      ASSERT_EQ(triangulation.stand_together(bead, cell, face), faces.contains(face));
    }
  }
}

/// Checks the mirror itself, and compares it with CGAL's answers.
inline void check_mirror(const RegularTriangulation<3>& triangulation, std::size_t beads) {
  check_around(triangulation, beads);
  const auto cells = triangulation.cells();
  std::set<std::pair<BeadId, BeadId>> edges;
  std::vector<CellBeads<3>> finite;
  const auto live = live_cells(triangulation);
  EXPECT_EQ(all_cells(triangulation).size(), live.size());
  for (const CellId cell : live) {
    const TriangulationCell<3>& c = cells[cell];
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < i; ++j) {
        ASSERT_NE(c.vertex[at(i)], c.vertex[at(j)]);
        edges.insert(std::minmax(c.vertex[at(i)], c.vertex[at(j)]));
      }
      const CellId n = cell_of(c.beyond[at(i)]);
      ASSERT_LT(n, cells.size());
      ASSERT_TRUE(triangulation.is_live(n));
      ASSERT_NE(n, cell);
      const int back = index_of(c.beyond[at(i)]);
      ASSERT_EQ(cells[n].beyond[at(back)], facet_id(cell, i));
      ASSERT_EQ(c.apex[at(i)], cells[n].vertex[at(back)]);
      // A neighbour is this cell with one bead exchanged, and the exchange reverses its orientation.
      CellBeads<3> exchanged = c.vertex;
      exchanged[at(i)] = cells[n].vertex[at(back)];
      ASSERT_NE(exchanged[at(i)], c.vertex[at(i)]);
      ASSERT_EQ(sorted(exchanged), sorted(cells[n].vertex));
      ASSERT_EQ(parity(exchanged, cells[n].vertex), -1);
    }
    ASSERT_EQ(triangulation.find_cell(c.vertex), cell);
    ASSERT_EQ(triangulation.find_cell(sorted(c.vertex)), cell);
    if (std::find(c.vertex.begin(), c.vertex.end(), infinite_bead) == c.vertex.end())
      finite.push_back(c.vertex);
  }
  sort_cells(finite);
  ASSERT_EQ(finite, triangulation.finite_cells());
  // Counts the cells of each bead, and the facets with the bead in at least one of their two cells. The
  // second count is 5/2 of the first.
  std::vector<std::uint32_t> cells_at(beads, 0), facets_with(beads, 0);
  for (const CellId cell : live) {
    for (int i = 0; i < 4; ++i) {
      const BeadId own = cells[cell].vertex[at(i)];
      if (own != infinite_bead) ++cells_at[own];
      if (cell_of(cells[cell].beyond[at(i)]) < cell) continue;
      for (const BeadId b : cells[cell].vertex)
        if (b != infinite_bead) ++facets_with[b];
      if (cells[cell].apex[at(i)] != infinite_bead) ++facets_with[cells[cell].apex[at(i)]];
    }
  }
  for (BeadId b = 0; b < beads; ++b) {
    ASSERT_EQ(triangulation.cells_at()[b], cells_at[b]) << b;
    ASSERT_EQ(2 * facets_with[b], 5 * cells_at[b]) << b;
  }
  for (BeadId a = 0; a <= beads; ++a) {
    for (BeadId b = 0; b < a; ++b) {
      const BeadId bead = a == beads ? infinite_bead : a;
      if (!triangulation.is_vertex(b) || !triangulation.is_vertex(bead)) continue;
      ASSERT_EQ(triangulation.is_edge(b, bead), edges.count({b, bead}) == 1) << b << " " << bead;
      ASSERT_EQ(triangulation.is_edge(bead, b), edges.count({b, bead}) == 1);
    }
  }
}

struct Cloud {
  explicit Cloud(std::size_t beads, unsigned seed = 1, double weight = 0) : weights(beads, weight) {
    std::mt19937 random(seed);
    const Points points = random_grid_points(random, beads, 1000000);
    centers = control_points(moving(points, points), 0);
  }
  Eigen::Matrix3Xd centers;
  std::vector<double> weights;
};

inline std::vector<ExactBead> exact_beads(const Cloud& cloud) {
  std::vector<ExactBead> beads;
  for (Eigen::Index b = 0; b < cloud.centers.cols(); ++b) {
    const auto c = cloud.centers.col(b);
    beads.push_back({{c.x(), c.y(), c.z()}, cloud.weights[static_cast<std::size_t>(b)]});
  }
  return beads;
}

}  // namespace kds::test
