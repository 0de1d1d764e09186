#include "structures/dual_complex/dual_topology.h"
#include "kds/event_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include "certificates/exact/exact_time.h"
#include "kds/event.h"
#include "motions/curves/bezier_motion.h"
#include "structures/power_diagram/power_diagram.h"
#include "tests/structures/dual_complex/gudhi_betti.h"
#include "tests/support/judges/exact_checks.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"

namespace kds::test {
namespace {

using testing::ElementsAre;
using Topology = DualTopology<3>;

/// The topology of moving balls, with its simulator and the structures below it.
struct FollowedBalls {
  explicit FollowedBalls(const BezierMotion<3, 1>& m, AuditMode audits = AuditMode::events)
      : motion(m), simulator(audits) {
    simulator.build();
  }

  BezierMotion<3, 1> motion;
  Simulator simulator;
  PowerDiagram<3> diagram{simulator, motion};
  DualComplex<3> complex{simulator, motion, diagram};
  Topology topology{simulator, motion.bead_count(), complex};

  [[nodiscard]] std::vector<SimplexBeads> simplices() const {
    std::vector<SimplexBeads> all;
    for (int dimension = 0; dimension <= 3; ++dimension)
      for (const SimplexBeads& simplex : complex.simplices(dimension)) all.push_back(simplex);
    return all;
  }
  [[nodiscard]] std::uint64_t events(Topology::Kind kind) const {
    return topology.statistics.events_by_kind[kind];
  }
};

using Point = std::array<double, 3>;

BezierMotion<3, 1> balls_between(const std::vector<Point>& from, const std::vector<Point>& to,
                                 double radius) {
  BezierMotion<3, 1> motion(from.size());
  for (BeadId b = 0; b < from.size(); ++b)
    for (int k = 0; k <= 1; ++k) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        motion.set_coordinate(b, k, static_cast<int>(axis), (k == 0 ? from : to)[b][axis]);
      motion.set_weight(b, k, radius * radius);
    }
  return motion;
}

/// Returns the corners of an icosahedron, moved a little so that no four lie in one plane.
std::vector<Point> cage(double size) {
  const double golden = 1.61803398875;
  std::vector<Point> corners;
  std::mt19937 random(5);
  for (unsigned i = 0; i < 12; ++i) {
    const double a = i % 2 == 0 ? -1 : 1, b = i / 2 % 2 == 0 ? -golden : golden;
    Point corner{0, a, b};
    std::rotate(corner.begin(), corner.begin() + i / 4, corner.end());
    for (double& x : corner) x = size * (x + static_cast<double>(random() % 1000) * 1e-6);
    corners.push_back(corner);
  }
  return corners;
}

TEST(DualTopology, ACageHasAVoidUntilABallLeaves) {
  const std::vector<Point> closed = cage(1.0);
  std::vector<Point> open = closed;
  for (double& x : open[0]) x *= 3;
  FollowedBalls balls(balls_between(closed, open, 1.25));
  EXPECT_THAT(balls.topology.betti(), ElementsAre(1, 0, 1));
  const auto voids = balls.topology.voids();
  ASSERT_EQ(voids.size(), 1U);
  std::set<BeadId> walls;
  for (const SimplexBeads& cell : voids.begin()->second) walls.insert(cell.begin(), cell.end());
  EXPECT_EQ(walls.size(), closed.size());
  balls.simulator.run_step();
  EXPECT_THAT(balls.topology.betti(), ElementsAre(2, 0, 0));  // the ball is alone
  EXPECT_EQ(balls.events(Topology::void_open), 1U);
  EXPECT_EQ(balls.events(Topology::component_split), 1U);
  EXPECT_EQ(balls.events(Topology::void_end), 0U);
}

TEST(DualTopology, AVoidIsFilledWhenTheCageShrinks) {
  FollowedBalls balls(balls_between(cage(1.0), cage(0.4), 1.25));
  EXPECT_THAT(balls.topology.betti(), ElementsAre(1, 0, 1));
  balls.simulator.run_step();
  EXPECT_THAT(balls.topology.betti(), ElementsAre(1, 0, 0));
  EXPECT_EQ(balls.events(Topology::void_end), 1U + balls.events(Topology::void_split));
  EXPECT_EQ(balls.events(Topology::void_open), 0U);
  EXPECT_TRUE(balls.topology.void_cells().empty());
}

TEST(DualTopology, BallsThatMeetAreOneComponentWithTheLeastNumber) {
  FollowedBalls balls(balls_between({{0, 0, 0}, {10, 0.1, 0}, {0.2, 10, 0}, {0.3, 0.4, 10}},
                                    {{0, 0, 0}, {1, 0.1, 0}, {0.2, 10, 0}, {0.3, 0.4, 10}}, 1));
  EXPECT_THAT(balls.topology.betti(), ElementsAre(4, 0, 0));
  balls.simulator.run_step();
  EXPECT_THAT(balls.topology.betti(), ElementsAre(3, 0, 0));
  const auto components = balls.topology.components();
  ASSERT_EQ(components.size(), 3U);
  EXPECT_THAT(components.at(0), ElementsAre(0, 1));
}

TEST(DualTopology, HasTheBettiNumbersOfGudhiAfterEveryEvent) {
  if (!has_gudhi()) GTEST_SKIP() << "built without GUDHI";
  std::mt19937 random(static_cast<std::uint32_t>(from_environment("KDS_DUAL_SEED", 20261130)));
  std::array<std::uint64_t, Topology::tunnel_end + 1> seen{};
  for (std::size_t round = 0; round < rounds(6, 1) * from_environment("KDS_DUAL_ROUNDS", 1); ++round) {
    // Balls near a sphere enclose tunnels and voids.
    BezierMotion<3, 1> motion(12 + random() % 12);
    for (BeadId b = 0; b < motion.bead_count(); ++b) {
      const double radius = 300 + static_cast<double>(random() % 150);
      for (int k = 0; k <= 1; ++k) {
        Point at;
        double length = 0;
        for (double& x : at) {
          x = static_cast<double>(random() % 2001) - 1000;
          length += x * x;
        }
        // Bead 1 leaves the others, and bead 0 disappears far away from them. Bead 5 appears.
        const double distance = b == 0 ? 3000 : b == 1 && k == 1 ? 2000 : k == 0 ? 700 : 650;
        for (std::size_t axis = 0; axis < 3; ++axis)
          motion.set_coordinate(b, k, static_cast<int>(axis),
                                std::round(at[axis] * distance / std::sqrt(1 + length)));
        motion.set_weight(b, k, b % 5 == 0 && (b == 0) == (k == 1) ? -1000 : radius * radius);
      }
    }
    FollowedBalls balls(motion, AuditMode::none);
    const auto compare = [&] {
      const auto [components, tunnels, voids] = balls.topology.betti();
      const Betti found{static_cast<std::size_t>(components), static_cast<std::size_t>(tunnels),
                        static_cast<std::size_t>(voids)};
      ASSERT_EQ(found, gudhi_betti(balls.simplices())) << "round " << round;
      ASSERT_EQ(balls.topology.voids().size(), found[2]);
      ASSERT_EQ(balls.topology.components().size(), found[0]);
    };
    compare();
    balls.simulator.enter_step();
    do {
      const Dyadic soon = next_on_grid(balls.simulator.now().exact(), 60);
      if (!(soon < Dyadic(1.0))) break;
      balls.simulator.run_until(soon);
      ASSERT_NO_FATAL_FAILURE(compare());
    } while (balls.simulator.run_next());
    balls.simulator.leave_step();
    const Betti at_frame = gudhi_betti_of_union(exact_points(motion, Dyadic(1.0)));
    EXPECT_EQ(at_frame, gudhi_betti(balls.simplices())) << "round " << round;
    for (std::size_t kind = 0; kind < seen.size(); ++kind)
      seen[kind] += balls.events(static_cast<Topology::Kind>(kind));
  }
  EXPECT_THAT(seen, testing::Each(testing::Gt(0U)));
}

TEST(DualTopology, NamesASimplexAtEachEventWhereBeadsTie) {
  // Beads on a coarse grid, so that cells tie, and cells are exchanged that are no flips.
  std::mt19937 random(33);
  std::uint64_t voids = 0;
  for (int round = 0; round < rounds(12, 2); ++round) {
    const std::size_t beads = 10 + random() % 5;
    std::vector<Point> from(beads), to(beads);
    for (auto* points : {&from, &to})
      for (Point& p : *points)
        for (double& x : p) x = static_cast<double>(random() % 4);
    FollowedBalls balls(balls_between(from, to, 0.9));
    EventLog log;
    balls.simulator.listen(log);
    balls.simulator.run_step();
    for (const Event& event : log.events) {
      if (event.structure != "voids" || !event.kind.external) continue;
      const bool names_two =
          event.change.kind == Topology::component_merge || event.change.kind == Topology::component_split ||
          event.change.kind == Topology::void_merge || event.change.kind == Topology::void_split;
      const bool is_tunnel = event.change.kind >= Topology::tunnel_begin;
      EXPECT_GT(event.change.size, is_tunnel   ? 0
                                   : names_two ? 2
                                               : 1)
          << event.kind.name << ", round " << round;
      voids += event.change.kind >= Topology::void_begin && event.change.kind <= Topology::void_close ? 1 : 0;
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(voids, 0U);
}

}  // namespace
}  // namespace kds::test
