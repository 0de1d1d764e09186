#include "structures/regular_triangulation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>

#include "structures/necklace_tree.h"
#include "structures/placed_faults.h"
#include "structures/sorted_cells.h"
#include "structures/static_build.h"
#include "tests/support/exact_checks.h"
#include "tests/support/moving_beads.h"

namespace kds {
namespace {

using namespace test;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

CellBeads<3> sorted(CellBeads<3> beads) {
  std::sort(beads.begin(), beads.end());
  return beads;
}

std::vector<CellId> live_cells(const RegularTriangulation<3>& triangulation) {
  std::vector<CellId> live;
  for (CellId cell = 0; cell < triangulation.cells().size(); ++cell) {
    if (triangulation.is_live(cell)) live.push_back(cell);
  }
  return live;
}

int place(const RegularTriangulation<3>& t, CellId cell, BeadId bead) {
  const auto& v = t.cells()[cell].vertex;
  return static_cast<int>(std::find(v.begin(), v.end(), bead) - v.begin());
}

/// All cells, infinite ones too, beads ascending.
std::set<CellBeads<3>> all_cells(const RegularTriangulation<3>& triangulation) {
  std::set<CellBeads<3>> cells;
  for (const CellId cell : live_cells(triangulation))
    cells.insert(sorted(triangulation.cells()[cell].vertex));
  return cells;
}

int parity(CellBeads<3> from, const CellBeads<3>& to) {
  int sign = 1;
  for (std::size_t i = 0; i < 4; ++i) {
    if (from[i] == to[i]) continue;
    const auto place = std::find(from.begin() + static_cast<std::ptrdiff_t>(i), from.end(), to[i]);
    std::swap(from[i], *place);
    sign = -sign;
  }
  return sign;
}

/// What stands together around a bead, looked for in the mirror alone.
void check_around(const RegularTriangulation<3>& triangulation, std::size_t beads) {
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

/// The mirror by itself, and against what CGAL can be asked for.
void check_mirror(const RegularTriangulation<3>& triangulation, std::size_t beads) {
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
      // The neighbour is this cell with one bead exchanged, and turns the other way for it.
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
  // Cells of each bead, and what follows for the facets whose two cells name it.
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

std::vector<ExactBead> exact_beads(const Cloud& cloud) {
  std::vector<ExactBead> beads;
  for (Eigen::Index b = 0; b < cloud.centers.cols(); ++b) {
    const auto c = cloud.centers.col(b);
    beads.push_back({{c.x(), c.y(), c.z()}, cloud.weights[static_cast<std::size_t>(b)]});
  }
  return beads;
}

TEST(RegularTriangulation, BuildsAndMirrors) {
  for (const std::size_t beads : {4U, 5U, 8U, 40U}) {
    const Cloud cloud(beads);
    RegularTriangulation<3> triangulation;
    const StaticTriangulation<3> built = triangulation.build(cloud.centers, cloud.weights);
    EXPECT_EQ(built.dimension, 3);
    EXPECT_TRUE(built.hidden.empty());
    check_mirror(triangulation, beads);
    EXPECT_TRUE(triangulation.is_valid());
    EXPECT_EQ(triangulation.least_orientation(), 1);
    EXPECT_EQ(triangulation.finite_cells(), static_triangulation<3>(cloud.centers, cloud.weights).cells);
    EXPECT_EQ(triangulation.finite_cells(), static_triangulation<3>(exact_beads(cloud), false).cells);
  }
}

TEST(RegularTriangulation, BuildsAnew) {
  RegularTriangulation<3> triangulation;
  for (const std::size_t beads : {30U, 6U, 50U}) {
    const Cloud cloud(beads, static_cast<unsigned>(beads));
    (void)triangulation.build(cloud.centers, cloud.weights);
    check_mirror(triangulation, beads);
    EXPECT_TRUE(triangulation.is_valid());
  }
}

TEST(RegularTriangulation, TellsDimensionAndHiddenBeads) {
  RegularTriangulation<3> triangulation;
  Cloud cloud(6);
  cloud.centers.row(2).setZero();
  EXPECT_EQ(triangulation.build(cloud.centers, cloud.weights).dimension, 2);
  EXPECT_EQ(static_triangulation<3>(cloud.centers, cloud.weights).dimension, 2);
  EXPECT_TRUE(static_triangulation<3>(cloud.centers, cloud.weights).cells.empty());
  EXPECT_EQ(static_triangulation<3>(exact_beads(cloud), true).dimension, 2);
  cloud = Cloud(6);
  cloud.centers.col(4) = cloud.centers.col(1);
  EXPECT_EQ(triangulation.build(cloud.centers, cloud.weights).hidden.size(), 1U);
  // A small ball deep inside a large one.
  cloud = Cloud(6);
  cloud.centers.col(0) = Eigen::Vector3d(-9, -9, -9);
  cloud.centers.col(1) = Eigen::Vector3d(9, 0, 0);
  cloud.centers.col(2) = Eigen::Vector3d(1, 0, 0);
  cloud.centers.col(3) = Eigen::Vector3d(0, 9, 0);
  cloud.centers.col(4) = Eigen::Vector3d(0, 0, 9);
  cloud.centers.col(5) = Eigen::Vector3d(0, 0, 0);
  cloud.weights[5] = 25;
  for (const auto& hidden : {triangulation.build(cloud.centers, cloud.weights).hidden,
                             static_triangulation<3>(cloud.centers, cloud.weights).hidden,
                             static_triangulation<3>(exact_beads(cloud), false).hidden}) {
    EXPECT_THAT(hidden, testing::Contains(2U));
  }
  EXPECT_EQ(triangulation.find_cell({0, 1, 2, 3}), std::nullopt);
  EXPECT_EQ(triangulation.find_cell({0, 1, 3, 77}), std::nullopt);
}

TEST(RegularTriangulation, AssignsOrientedCells) {
  for (const std::size_t beads : {4U, 5U, 20U}) {
    const Cloud cloud(beads, 5);
    const StaticTriangulation<3> exact = static_triangulation<3>(exact_beads(cloud), true);
    RegularTriangulation<3> triangulation;
    triangulation.assign(beads, exact.cells);
    EXPECT_EQ(live_cells(triangulation).size(), exact.cells.size());
    check_mirror(triangulation, beads);
    triangulation.set_points(cloud.centers, cloud.weights);
    EXPECT_TRUE(triangulation.is_valid());
    EXPECT_EQ(triangulation.least_orientation(), 1);
    RegularTriangulation<3> built;
    (void)built.build(cloud.centers, cloud.weights);
    EXPECT_EQ(all_cells(triangulation), all_cells(built));
    // Over another one, whose points stay.
    (void)built.build(Cloud(beads, 6).centers, cloud.weights);
    built.set_points(cloud.centers, cloud.weights);
    built.assign(beads, exact.cells);
    EXPECT_TRUE(built.is_valid());
    check_mirror(built, beads);
  }
}

TEST(RegularTriangulation, TakesBeadsOutAndPutsThemIn) {
  std::mt19937 random(12);
  for (const std::size_t beads : {20U, 60U}) {
    Cloud cloud(beads, static_cast<unsigned>(beads));
    RegularTriangulation<3> t;
    (void)t.build(cloud.centers, cloud.weights);
    for (int round = 0; round < 4; ++round) {
      std::vector<BeadId> some;
      for (BeadId b = 0; b < beads; ++b)
        if (random() % 4 == 0) some.push_back(b);
      t.take_out(some);
      ASSERT_TRUE(t.is_solid());
      std::set<CellId> made;
      for (const CellId cell : t.mirror_changes()) {
        EXPECT_TRUE(t.is_live(cell));
        EXPECT_TRUE(made.insert(cell).second);
      }
      check_mirror(t, beads);
      if (HasFatalFailure()) return;
      EXPECT_TRUE(t.is_valid());
      for (const BeadId b : some) {
        EXPECT_FALSE(t.is_vertex(b));
        // Elsewhere, and one so heavy that it hides others.
        cloud.centers.col(b).x() = static_cast<double>(random() % 1000000);
        cloud.weights[b] = b == some.front() ? 4e10 : 0;
      }
      t.put_in(some, cloud.centers, cloud.weights);
      (void)t.mirror_changes();
      const auto expected = static_triangulation<3>(cloud.centers, cloud.weights);
      EXPECT_EQ(t.finite_cells(), expected.cells);
      for (BeadId b = 0; b < beads; ++b)
        EXPECT_NE(t.is_vertex(b), std::binary_search(expected.hidden.begin(), expected.hidden.end(), b));
      for (double& w : cloud.weights) w = 0;  // all come back
      (void)t.build(cloud.centers, cloud.weights);
    }
  }
}

TEST(RegularTriangulation, ASampleTellsTheShareOfFailedCertificates) {
  const Cloud cloud(400, 3);
  RegularTriangulation<3> t;
  (void)t.build_bare(cloud.centers, cloud.weights);
  EXPECT_FALSE(t.has_mirror());
  const auto still = t.sample(cloud.centers, cloud.weights, 1, 0);
  EXPECT_GT(still.tested, 1000U);
  EXPECT_EQ(still.failed, 0U);
  const auto apart = t.sample(Cloud(400, 4).centers, cloud.weights, 1, 0);  // all else
  EXPECT_GT(3 * apart.failed, apart.tested);
  EXPECT_LT(t.sample(cloud.centers, cloud.weights, 8, 0).tested, still.tested / 4);
  // At other turns of others, with or without a mirror.
  RegularTriangulation<3> bare;
  (void)bare.build_bare(cloud.centers, cloud.weights);
  t.make_mirror();
  std::set<std::uint64_t> failed, failed_of_bare;
  const Cloud other(400, 4);
  for (std::uint64_t turn = 0; turn < 20; ++turn) {
    failed.insert(t.sample(other.centers, cloud.weights, 8, turn).failed);
    failed_of_bare.insert(bare.sample(other.centers, cloud.weights, 8, turn).failed);
  }
  EXPECT_GT(failed.size(), 3U);
  EXPECT_GT(failed_of_bare.size(), 3U);
  EXPECT_EQ(t.finite_cells(), static_triangulation<3>(cloud.centers, cloud.weights).cells);
  t.make_mirror();
  check_mirror(t, 400);
}

TEST(RegularTriangulation, RefusesCellsThatDoNotCloseUp) {
  auto cells = static_triangulation<3>(exact_beads(Cloud(8)), true).cells;
  cells.pop_back();
  RegularTriangulation<3> triangulation;
  EXPECT_THROW(triangulation.assign(8, cells), std::logic_error);
}

// The points decide: turned inside out, or moved through a facet.
TEST(RegularTriangulation, ValidityFollowsThePoints) {
  const Points before{
      {3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}, {0, 0, -5}};  // two cells and no edge 3-4
  Points after = before;
  after[3][2] = 1;
  after[4][2] = -1;  // now the edge 3-4 is there
  const std::vector<double> weights(5, 0.25);
  const auto centers = [](const Points& points) { return control_points(moving(points, points), 0); };
  RegularTriangulation<3> triangulation;
  (void)triangulation.build(centers(before), weights);
  ASSERT_FALSE(triangulation.is_edge(3, 4));
  ASSERT_EQ(triangulation.finite_cells().size(), 2U);
  triangulation.set_points(centers(after), weights);
  EXPECT_FALSE(triangulation.is_valid());
  EXPECT_EQ(triangulation.least_orientation(), 1);
  const auto cell = triangulation.find_cell({0, 1, 2, 3});
  ASSERT_TRUE(cell);
  const auto made = triangulation.flip_facet(*cell, place(triangulation, *cell, 3));
  EXPECT_TRUE(triangulation.is_valid());
  EXPECT_TRUE(triangulation.is_edge(3, 4));
  EXPECT_EQ(triangulation.finite_cells(), static_triangulation<3>(centers(after), weights).cells);
  check_mirror(triangulation, 5);
  for (const CellId id : made) EXPECT_TRUE(triangulation.is_live(id));
  triangulation.set_points(centers(before), weights);
  EXPECT_FALSE(triangulation.is_valid());
  Points mirrored = after;
  for (auto& p : mirrored) p[0] = -p[0];
  triangulation.set_points(centers(mirrored), weights);
  EXPECT_LT(triangulation.least_orientation(), 1);
  EXPECT_EQ(least_orientation(triangulation, Placement<3>(centers(mirrored), weights)), -1);
  EXPECT_EQ(least_orientation(triangulation, Placement<3>(centers(after), weights)), 1);
  EXPECT_EQ(least_orientation(triangulation, Placement<3>(Eigen::Matrix3Xd::Zero(3, 5), weights)), 0);
}

// Flips that CGAL's side has not done yet do not outlive what they were of.
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

// Mutate, validate, repeat.

/// The other bead across a facet.
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

/// Makes a flip and checks the cells it says it made.
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

// Points that a motion has reached are set when CGAL's side is looked at, after what flips did there.
TEST(RegularTriangulation, PointsFollowAMotion) {
  // Bead 4 goes from one side of the others to the other.
  const Points before{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {20, 20, 20}};
  Points after = before;
  after[4] = {-20, -20, -20};
  const auto motion = moving(before, after);
  RegularTriangulation<3> t;
  (void)t.build(control_points(motion, 0), control_weights(motion, 0));
  EXPECT_TRUE(t.is_valid());
  EXPECT_EQ(t.set_points(motion, 1).coordinate(4, 0, 2), -20);
  EXPECT_LT(t.least_orientation(), 0);
  (void)t.set_points(motion, 0);
  EXPECT_TRUE(t.is_valid());
  (void)t.set_points(motion, 1);
  t.set_points(control_points(motion, 0), control_weights(motion, 0));  // the latest counts
  EXPECT_TRUE(t.is_valid());
  (void)t.set_points(motion, 1);
  (void)t.build(control_points(motion, 0), control_weights(motion, 0));
  EXPECT_TRUE(t.is_valid());
  // Cells assigned get the points that were to be set.
  RegularTriangulation<3> other;
  (void)other.build(control_points(motion, 1), control_weights(motion, 1));
  std::vector<CellBeads<3>> cells;
  for (const CellId cell : live_cells(other)) cells.push_back(other.cells()[cell].vertex);
  (void)t.set_points(motion, 1);
  t.assign(5, cells);
  EXPECT_TRUE(t.is_valid());
  check_mirror(t, 5);
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
      // An edge of the facet with three cells: x, y of the facet, around them d, e and the third.
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
  EXPECT_LE(t.cells().size(), slots + 151);  // slots of cells that went are used again
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomFlips, testing::Range(0U, 12U));

// A bead is taken out and put back by cells, its place filled as CGAL fills it without the bead.
TEST(RegularTriangulation, ReplacesCells) {
  constexpr BeadId beads = 40;
  const Cloud cloud(beads);
  RegularTriangulation<3> triangulation;
  static_cast<void>(triangulation.build(cloud.centers, cloud.weights));
  const auto cells = all_cells(triangulation);
  for (BeadId bead = 0; bead < beads; ++bead) {
    SCOPED_TRACE(bead);
    const std::vector<CellId> around = triangulation.cells_around(bead);
    std::vector<CellBeads<3>> star;
    for (const CellId c : around) star.push_back(triangulation.cells()[c].vertex);
    EXPECT_EQ(std::set<CellId>(around.begin(), around.end()).size(), around.size());
    EXPECT_EQ(star.size(), std::count_if(cells.begin(), cells.end(), [&](const CellBeads<3>& c) {
                return std::find(c.begin(), c.end(), bead) != c.end();
              }));
    // All beads but this one, named from 0.
    std::vector<ExactBead> others = exact_beads(cloud);
    others.erase(others.begin() + bead);
    std::vector<CellBeads<3>> made;
    for (CellBeads<3> c : static_triangulation<3>(others, true).cells) {
      for (BeadId& b : c) b += b != infinite_bead && b >= bead ? 1 : 0;
      if (!cells.contains(sorted(c))) made.push_back(c);
    }
    ASSERT_TRUE(triangulation.fits(around, made));

    // What does not fit is refused.
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
    wrong = star;  // another bead, a vertex elsewhere, in its place
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

TEST(StaticBuild, TakesTime) {
  const Cloud cloud(300);
  const std::vector<BeadRange> necklaces{{0, 299}};
  EXPECT_GT(seconds_to_triangulate<3>(cloud.centers, cloud.weights).clock, 0);
  EXPECT_GT(seconds_to_wrap<3>(NecklaceTree(necklaces).ranges(), cloud.centers, cloud.weights).clock, 0);
  EXPECT_GT(seconds_to_sort(cloud.centers).clock, 0);
}

}  // namespace
}  // namespace kds
