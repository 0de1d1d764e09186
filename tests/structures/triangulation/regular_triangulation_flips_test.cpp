#include "structures/triangulation/regular_triangulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "tests/support/judges/triangulation_checks.h"
#include "tests/support/rounds.h"

namespace kds::regular_triangulation_flips_test {
namespace {

using namespace test;

// Changes the triangulation, validates it, and repeats.

/// Returns the other bead across a facet.
BeadId apex(const RegularTriangulation<3>& t, CellId cell, int i) { return t.apex(t.beyond(cell, i)); }

struct Flip {
  bool to_edge;
  std::array<BeadId, 3> facet;
  std::array<BeadId, 2> edge;
};

bool has_facet(const RegularTriangulation<3>& t, const std::array<BeadId, 3>& facet) {
  for (const CellId cell : live_cells(t)) {
    const auto& v = t.cells()[cell].vertex;
    if (std::all_of(facet.begin(), facet.end(),
                    [&](BeadId b) { return std::find(v.begin(), v.end(), b) != v.end(); }))
      return true;
  }
  return false;
}

/// Makes a flip and checks the cells that it reports as made.
void make(RegularTriangulation<3>& t, const Flip& flip) {
  const auto& [a, b, c] = flip.facet;
  const auto& [d, e] = flip.edge;
  if (flip.to_edge) {
    const auto cell = t.find_cell({a, b, c, d});
    ASSERT_TRUE(cell);
    const auto made = t.flip_facet(*cell, place(t, *cell, d));
    std::set<CellBeads<3>> beads;
    for (const CellId id : made) beads.insert(sorted(t.cells()[id].vertex));
    ASSERT_EQ(beads,
              (std::set<CellBeads<3>>{sorted({a, b, d, e}), sorted({a, c, d, e}), sorted({b, c, d, e})}));
    for (const CellId id : made) ASSERT_TRUE(t.is_live(id));
  } else {
    const auto cell = t.find_cell({a, b, d, e});
    ASSERT_TRUE(cell);
    const auto made = t.flip_edge(*cell, place(t, *cell, d), place(t, *cell, e));
    std::set<CellBeads<3>> beads;
    for (const CellId id : made) beads.insert(sorted(t.cells()[id].vertex));
    ASSERT_EQ(beads, (std::set<CellBeads<3>>{sorted({a, b, c, d}), sorted({a, b, c, e})}));
    for (const CellId id : made) ASSERT_TRUE(t.is_live(id));
    ASSERT_FALSE(t.is_live(*cell) && std::find(made.begin(), made.end(), *cell) == made.end());
  }
}

class RandomFlips : public testing::TestWithParam<unsigned> {};

TEST_P(RandomFlips, ForthAndBack) {
  const std::size_t beads = 6 + GetParam() % 3 * 5;
  const Cloud cloud(beads, GetParam(), 4);
  RegularTriangulation<3> t;
  (void)t.build(cloud.centers, cloud.weights);
  const auto start = all_cells(t);
  std::mt19937 random(GetParam() + 100);
  std::vector<Flip> done;
  std::size_t slots = t.cells().size();
  for (int attempt = 0; attempt < 3000 && done.size() < 150; ++attempt) {
    const auto live = live_cells(t);
    const CellId cell = live[random() % live.size()];
    const int i = static_cast<int>(random() % 4);
    const auto v = t.cells()[cell].vertex;
    const BeadId d = v[at(i)], e = apex(t, cell, i);
    std::array<BeadId, 3> facet{};
    for (int k = 0, n = 0; k < 4; ++k) {
      if (k != i) facet[at(n++)] = v[at(k)];
    }
    Flip flip{true, facet, {d, e}};
    if (random() % 2 == 0) {
      if (t.is_edge(d, e)) continue;
    } else {
      // An edge of the facet with three cells: x and y belong to the facet; d, e and the third bead are
      // around the edge.
      const std::size_t third = random() % 3;
      const BeadId x = facet[(third + 1) % 3], y = facet[(third + 2) % 3], z = facet[third];
      if (!t.find_cell({x, y, d, e}) || has_facet(t, {z, d, e})) continue;
      flip = {false, {z, d, e}, {x, y}};
    }
    make(t, flip);
    if (HasFatalFailure()) return;
    check_mirror(t, beads);
    if (HasFatalFailure()) return;
    done.push_back(flip);
  }
  EXPECT_GT(done.size(), 20U);
  EXPECT_TRUE(std::any_of(done.begin(), done.end(), [](const Flip& f) { return !f.to_edge; }));
  for (; !done.empty(); done.pop_back()) {
    Flip back = done.back();
    back.to_edge = !back.to_edge;
    make(t, back);
    if (HasFatalFailure()) return;
  }
  check_mirror(t, beads);
  EXPECT_EQ(all_cells(t), start);
  EXPECT_TRUE(t.is_valid());
  EXPECT_LE(t.cells().size(), slots + 151);  // the slots of removed cells are reused
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFlips, testing::Range(0U, 12U));

// Removes a bead and puts it back, cell by cell. CGAL's triangulation without the bead has the
// cells that fill its place.
TEST(RegularTriangulation, ReplacesCells) {
  constexpr BeadId beads = 40;
  const Cloud cloud(beads);
  RegularTriangulation<3> triangulation;
  static_cast<void>(triangulation.build(cloud.centers, cloud.weights));
  const auto cells = all_cells(triangulation);
  for (BeadId bead = 0; bead < test::rounds(beads); ++bead) {
    SCOPED_TRACE(bead);
    const std::vector<CellId> around = triangulation.cells_around(bead);
    std::vector<CellBeads<3>> star;
    for (const CellId c : around) star.push_back(triangulation.cells()[c].vertex);
    EXPECT_EQ(std::set<CellId>(around.begin(), around.end()).size(), around.size());
    EXPECT_EQ(star.size(), std::count_if(cells.begin(), cells.end(), [&](const CellBeads<3>& c) {
                return std::find(c.begin(), c.end(), bead) != c.end();
              }));
    // All beads except this one, renumbered from 0.
    std::vector<ExactBead> others = exact_beads(cloud);
    others.erase(others.begin() + bead);
    std::vector<CellBeads<3>> made;
    for (CellBeads<3> c : static_triangulation<3>(others, true).cells) {
      for (BeadId& b : c) b += b != infinite_bead && b >= bead ? 1 : 0;
      if (!cells.contains(sorted(c))) made.push_back(c);
    }
    ASSERT_TRUE(triangulation.fits(around, made));

    // Cells that do not fit are refused.
    const auto refused = [&](const std::vector<CellId>& old, const std::vector<CellBeads<3>>& cells_made) {
      EXPECT_FALSE(triangulation.fits(old, cells_made));
      EXPECT_THROW(static_cast<void>(triangulation.replace(old, cells_made)), std::logic_error);
    };
    std::vector<CellBeads<3>> wrong = made;
    std::swap(wrong[0][0], wrong[0][1]);
    refused(around, wrong);
    wrong = made;
    wrong.pop_back();
    refused(around, wrong);
    wrong = made;
    wrong.push_back(made[0]);
    refused(around, wrong);
    refused(around, {});
    refused({around.begin() + 1, around.end()}, made);
    std::vector<CellId> twice = around;
    twice.push_back(around[0]);
    refused(twice, made);
    wrong = star;  // replaces the bead by another bead, which is a vertex elsewhere
    BeadId far = 0;
    while (far == bead || triangulation.is_edge(far, bead)) ++far;
    for (auto& c : wrong) std::replace(c.begin(), c.end(), bead, far);
    refused(around, wrong);
    EXPECT_EQ(all_cells(triangulation), cells);

    const std::vector<CellId> filled = triangulation.replace(around, made);
    for (std::size_t c = 0; c < made.size(); ++c) EXPECT_EQ(triangulation.cells()[filled[c]].vertex, made[c]);
    EXPECT_FALSE(triangulation.is_vertex(bead));
    check_mirror(triangulation, beads);
    EXPECT_TRUE(triangulation.is_valid());
    static_cast<void>(triangulation.replace(filled, star));
    triangulation.set_points(cloud.centers, cloud.weights);
    check_mirror(triangulation, beads);
    EXPECT_TRUE(triangulation.is_valid());
    EXPECT_EQ(all_cells(triangulation), cells);
  }
}

TEST(RegularTriangulation, SlotsAreUsedAgain) {
  const Points points{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}, {0, 0, -5}};
  RegularTriangulation<3> t;
  (void)t.build(control_points(moving(points, points), 0), std::vector<double>(5, 0));
  const std::size_t slots = t.cells().size();
  for (int round = 0; round < 20; ++round) {
    make(t, {true, {0, 1, 2}, {3, 4}});
    make(t, {false, {0, 1, 2}, {3, 4}});
    check_mirror(t, 5);
  }
  EXPECT_EQ(t.cells().size(), slots + 1);
}

// Flips that are not yet made in CGAL's triangulation are forgotten when the triangulation is built again.
TEST(RegularTriangulation, FlipsBeforeABuildAreForgotten) {
  const std::vector<double> weights(5, 0.25);
  const auto centers = [](const Points& points) { return control_points(moving(points, points), 0); };
  const Points solid{{3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}, {0, 0, -5}};
  Points flat = solid;
  for (auto& point : flat) point[2] = 0;
  RegularTriangulation<3> triangulation;
  for (const Points& next : {flat, solid}) {
    (void)triangulation.build(centers(solid), weights);
    const auto cell = triangulation.find_cell({0, 1, 2, 3});
    ASSERT_TRUE(cell);
    (void)triangulation.flip_facet(*cell, place(triangulation, *cell, 3));
    (void)triangulation.build(centers(next), weights);
    EXPECT_EQ(triangulation.is_solid(), next == solid);
    triangulation.set_points(centers(next), weights);
    EXPECT_TRUE(triangulation.is_valid());
    EXPECT_EQ(triangulation.finite_cells(), static_triangulation<3>(centers(next), weights).cells);
  }
  const auto oriented = static_triangulation<3>(
      std::vector<ExactBead>{
          {{3, 0, 0}, 1}, {{-3, 3, 0}, 1}, {{-3, -3, 0}, 1}, {{0, 0, 5}, 1}, {{0, 0, -5}, 1}},
      true);
  const auto cell = triangulation.find_cell({0, 1, 2, 3});
  ASSERT_TRUE(cell);
  (void)triangulation.flip_facet(*cell, place(triangulation, *cell, 3));
  triangulation.assign(5, oriented.cells);
  triangulation.set_points(centers(solid), weights);
  EXPECT_TRUE(triangulation.is_valid());
  check_mirror(triangulation, 5);
}

}  // namespace
}  // namespace kds::regular_triangulation_flips_test
