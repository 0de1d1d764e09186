#include "structures/triangulation/regular_triangulation.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "structures/triangulation/regularity_fault.h"
#include "tests/support/judges/triangulation_checks.h"

namespace kds::regular_triangulation_test {
namespace {

using namespace test;

TEST(RegularTriangulation, BuildsAndMirrors) {
  for (const std::size_t beads : {4U, 5U, 8U, 40U}) {
    const Cloud cloud(beads);
    RegularTriangulation<3> triangulation;
    const StaticTriangulation<3> built = triangulation.build(cloud.centers, cloud.weights);
    EXPECT_EQ(built.dimension, 3);
    EXPECT_TRUE(built.hidden.empty());
    check_mirror(triangulation, beads);
    EXPECT_TRUE(triangulation.is_valid());
    EXPECT_EQ(least_orientation(triangulation, Snapshot<3>(cloud.centers, cloud.weights)), 1);
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
  // A small ball deep inside a large ball.
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
    EXPECT_EQ(least_orientation(triangulation, Snapshot<3>(cloud.centers, cloud.weights)), 1);
    RegularTriangulation<3> built;
    (void)built.build(cloud.centers, cloud.weights);
    EXPECT_EQ(all_cells(triangulation), all_cells(built));
    // Builds over another triangulation whose points remain.
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
        // Moves a bead elsewhere and makes it so heavy that it hides others.
        cloud.centers.col(b).x() = static_cast<double>(random() % 1000000);
        cloud.weights[b] = b == some.front() ? 4e10 : 0;
      }
      t.put_in(some, cloud.centers, cloud.weights);
      (void)t.mirror_changes();
      const auto expected = static_triangulation<3>(cloud.centers, cloud.weights);
      EXPECT_EQ(t.finite_cells(), expected.cells);
      for (BeadId b = 0; b < beads; ++b)
        EXPECT_NE(t.is_vertex(b), std::binary_search(expected.hidden.begin(), expected.hidden.end(), b));
      for (double& w : cloud.weights) w = 0;  // all beads become visible
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
  const auto apart = t.sample(Cloud(400, 4).centers, cloud.weights, 1, 0);  // everything differs
  EXPECT_GT(3 * apart.failed, apart.tested);
  EXPECT_LT(t.sample(cloud.centers, cloud.weights, 8, 0).tested, still.tested / 4);
  // Samples with another phase, with or without a mirror.
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

// Validity depends on the points: they are turned inside out, or moved through a facet.
TEST(RegularTriangulation, ValidityFollowsThePoints) {
  const Points before{
      {3, 0, 0}, {-3, 3, 0}, {-3, -3, 0}, {0, 0, 5}, {0, 0, -5}};  // two cells without edge 3-4
  Points after = before;
  after[3][2] = 1;
  after[4][2] = -1;  // the correct diagram contains edge 3-4 now
  const std::vector<double> weights(5, 0.25);
  const auto centers = [](const Points& points) { return control_points(moving(points, points), 0); };
  RegularTriangulation<3> triangulation;
  (void)triangulation.build(centers(before), weights);
  ASSERT_FALSE(triangulation.is_edge(3, 4));
  ASSERT_EQ(triangulation.finite_cells().size(), 2U);
  triangulation.set_points(centers(after), weights);
  EXPECT_FALSE(triangulation.is_valid());
  EXPECT_EQ(least_orientation(triangulation, Snapshot<3>(centers(after), weights)), 1);
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
  EXPECT_FALSE(triangulation.is_valid());
  EXPECT_EQ(least_orientation(triangulation, Snapshot<3>(centers(mirrored), weights)), -1);
  EXPECT_EQ(least_orientation(triangulation, Snapshot<3>(centers(after), weights)), 1);
  EXPECT_EQ(least_orientation(triangulation, Snapshot<3>(Eigen::Matrix3Xd::Zero(3, 5), weights)), 0);
}

// The points of a motion are passed to CGAL's triangulation when that is next read, after the pending flips.
TEST(RegularTriangulation, PointsFollowAMotion) {
  // Bead 4 moves into the sphere of the other beads.
  const Points before{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {20, 20, 20}};
  Points after = before;
  after[4] = {3.5, 3.5, 3.5};
  const auto motion = moving(before, after);
  RegularTriangulation<3> t;
  (void)t.build(control_points(motion, 0), control_weights(motion, 0));
  EXPECT_TRUE(t.is_valid());
  EXPECT_EQ(t.set_points(motion, 1).coordinate(4, 0, 2), 3.5);
  EXPECT_FALSE(t.is_valid());
  (void)t.set_points(motion, 0);
  EXPECT_TRUE(t.is_valid());
  (void)t.set_points(motion, 1);
  t.set_points(control_points(motion, 0), control_weights(motion, 0));  // the last call counts
  EXPECT_TRUE(t.is_valid());
  (void)t.set_points(motion, 1);
  (void)t.build(control_points(motion, 0), control_weights(motion, 0));
  EXPECT_TRUE(t.is_valid());
  // Assigned cells get the points that were pending.
  RegularTriangulation<3> other;
  (void)other.build(control_points(motion, 1), control_weights(motion, 1));
  std::vector<CellBeads<3>> cells;
  for (const CellId cell : live_cells(other)) cells.push_back(other.cells()[cell].vertex);
  (void)t.set_points(motion, 1);
  t.assign(5, cells);
  EXPECT_TRUE(t.is_valid());
  check_mirror(t, 5);
}

}  // namespace
}  // namespace kds::regular_triangulation_test
