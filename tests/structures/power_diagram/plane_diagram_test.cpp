// The power diagram in the plane, and in space under curved motions. The counts of CGAL's kinetic package and
// the definition, by brute force between events, judge it.

#include <gmock/gmock.h>

#include <algorithm>

#include "motions/base/input_error.h"
#include "motions/curves/positions.h"
#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::plane_diagram_test {
namespace {

using namespace test;

template <int Degree>
using Plane = BezierMotion<2, Degree>;
template <class M>
using RigOf = Rig<PowerDiagram<M::dimension>, M>;
using Point = std::array<Rational, 2>;

Rational turn(const Point& a, const Point& b, const Point& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Returns twice the area of the convex hull, by Andrew's monotone chain algorithm.
Rational hull_area(std::vector<Point> points) {
  std::sort(points.begin(), points.end());
  std::vector<Point> hull;
  for (int pass = 0; pass < 2; ++pass) {
    const std::size_t start = hull.size();
    for (const Point& p : points) {
      while (hull.size() >= start + 2 && turn(hull[hull.size() - 2], hull.back(), p) <= 0) hull.pop_back();
      hull.push_back(p);
    }
    hull.pop_back();
    std::reverse(points.begin(), points.end());
  }
  Rational area = 0;
  for (std::size_t i = 2; i < hull.size(); ++i) area += turn(hull[0], hull[i - 1], hull[i]);
  return area;
}

/// Explains why these triangles are not a Delaunay triangulation of the points: a point lies inside a
/// circumcircle, or the areas do not add up to the hull's area. Returns nothing if they are one.
std::optional<std::string> not_delaunay(const std::vector<Point>& p, std::span<const CellBeads<2>> cells) {
  Rational area = 0;
  for (const auto& [a, b, c] : cells) {
    const Rational twice = turn(p[a], p[b], p[c]);
    if (twice == 0) return text_of("cell ", a, ' ', b, ' ', c, " is flat");
    area += abs(twice);
    const auto square = [&](BeadId i, BeadId from) -> Rational {
      const Rational x = p[i][0] - p[from][0];
      const Rational y = p[i][1] - p[from][1];
      return x * x + y * y;
    };
    for (BeadId t = 0; t < p.size(); ++t) {
      // The incircle determinant with rows relative to t.
      const Rational inside = square(a, t) * turn(p[t], p[b], p[c]) - square(b, t) * turn(p[t], p[a], p[c]) +
                              square(c, t) * turn(p[t], p[a], p[b]);
      if (inside * twice > 0) return text_of("bead ", t, " is inside the circle of ", a, ' ', b, ' ', c);
    }
  }
  if (area != hull_area(p)) return "the cells do not cover the hull once";
  return std::nullopt;
}

template <class M>
std::vector<Point> points_at(const M& motion, const Dyadic& time) {
  std::vector<Point> points;
  for (BeadId b = 0; b < motion.bead_count(); ++b) {
    const auto position = exact_position(motion, b, time);
    points.push_back({position[0], position[1]});
  }
  return points;
}

/// Returns a witness that checks every `stride`-th audit at a slightly later time, because cells may be flat
/// at a single moment without an event.
template <class M>
Witness::Look definition(const RigOf<M>& rig, int stride) {
  return [&rig, stride, count = 0](const Dyadic& time) mutable -> std::optional<std::string> {
    if (time == Dyadic(0.0) || time == Dyadic(1.0) || count++ % stride != 0) return std::nullopt;
    const Dyadic later((time.numerator() << 100U) + 1, time.exponent() + 100);
    return not_delaunay(points_at(rig.motion, later), rig.structure.at_frame(false).cells);
  };
}

template <class M>
void expect_events(const std::string& name, std::uint64_t events) {
  SCOPED_TRACE(name);
  const M motion = instance_motion<M>(name);
  RigOf<M> rig(motion, AuditMode::frames);
  rig.run();
  EXPECT_EQ(rig.external_events(), events);
  EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  RigOf<M> replayed(motion, AuditMode::frames);
  ASSERT_NO_THROW(replayed.replay({motion}, rig.history));
  EXPECT_EQ(replayed.simulator.fingerprint(), rig.simulator.fingerprint());
}

TEST(PlaneDiagram, HasTheEventsOfCgal) {
  expect_events<Plane<1>>("d2_n20_linear", 133);
  expect_events<Plane<1>>("d2_n50_linear", 547);
  expect_events<Plane<1>>("d2_n100_linear", 1801);
  expect_events<Plane<1>>("d2_n200_linear", 4929);
  expect_events<Plane<1>>("d2_n500_linear", 19760);
  expect_events<Plane<2>>("d2_n20_degree2", 205);
  expect_events<Plane<2>>("d2_n50_degree2", 914);
  expect_events<Plane<2>>("d2_n100_degree2", 2800);
  expect_events<Plane<3>>("d2_n20_degree3", 252);
  expect_events<Plane<3>>("d2_n50_degree3", 1196);
  expect_events<Plane<3>>("d2_n100_degree3", 3276);
}

TEST(PlaneDiagram, CurvedMotionsInSpaceHaveTheEventsOfCgal) {
  expect_events<BezierMotion<3, 2>>("d3_n20_degree2", 476);
  expect_events<BezierMotion<3, 3>>("d3_n20_degree3", 489);
}

template <class M>
void expect_kernels_agree(const std::string& name) {
  SCOPED_TRACE(name);
  const M motion = instance_motion<M>(name);
  RigOf<M> filtered(motion, AuditMode::events);
  RigOf<M> exact(motion, AuditMode::none, Kernel::exact);
  ASSERT_NO_THROW(filtered.run());
  exact.run();
  EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
}

TEST(PlaneDiagram, KernelsAgree) {
  expect_kernels_agree<Plane<1>>("d2_n20_linear");
  expect_kernels_agree<Plane<2>>("d2_n20_degree2");
  expect_kernels_agree<Plane<3>>("d2_n20_degree3");
  expect_kernels_agree<BezierMotion<3, 2>>("d3_n20_degree2");
}

TEST(PlaneDiagram, IsDelaunayBetweenAllEvents) {
  const auto motion = instance_motion<Plane<1>>("d2_n50_linear");
  RigOf<Plane<1>> rig(motion, AuditMode::events);
  Witness witness(rig.simulator, definition(rig, 90 / rounds(10, 2)));
  ASSERT_NO_THROW(rig.run());
  EXPECT_EQ(not_delaunay(points_at(motion, Dyadic(1.0)), rig.structure.at_frame(false).cells), std::nullopt);
}

class DegeneratePlane : public testing::TestWithParam<const char*> {};

TEST_P(DegeneratePlane, AuditsPassBetweenAllEvents) {
  const auto motion = instance_motion<Plane<1>>(std::string("degenerate_d2_n64_") + GetParam());
  RigOf<Plane<1>> rig(motion, AuditMode::events);
  Witness witness(rig.simulator, definition(rig, 20));
  ASSERT_NO_THROW(rig.run());
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  const std::string name = GetParam();
  if (name == "half") {
    EXPECT_EQ(rig.external_events(), 527U);
  }
  if (name.find("rigid") != std::string::npos || name == "static" || name == "gridscale") {
    EXPECT_EQ(rig.external_events(), 0U);
    EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
  }
}

INSTANTIATE_TEST_SUITE_P(Data, DegeneratePlane,
                         testing::Values("static", "half", "rigid", "gridrigid", "gridscale", "gridrand",
                                         "gridint", "swap", "converge"),
                         [](const auto& test) { return std::string(test.param); });

// Few points on a small grid: coincident, collinear and cocircular points, and many simultaneous events.
TEST(PlaneDiagram, RandomMotionsFullOfTies) {
  std::mt19937 random(21);
  int ran = 0;
  for (int round = 0; round < test::rounds(600); ++round) {
    const std::size_t beads = 3 + random() % 8;
    const int range = 2 + static_cast<int>(random() % 4);
    const Points from = random_grid_points(random, beads, range);
    const Points to = random_grid_points(random, beads, range);
    SCOPED_TRACE(text_of("round ", round, ": ", testing::PrintToString(std::pair(from, to))));
    Plane<1> motion(beads);
    for (BeadId b = 0; b < beads; ++b) {
      for (int axis = 0; axis < 2; ++axis) {
        motion.set_coordinate(b, 0, axis, from[b][static_cast<std::size_t>(axis)]);
        motion.set_coordinate(b, 1, axis, to[b][static_cast<std::size_t>(axis)]);
      }
    }
    RigOf<Plane<1>> rig(motion, AuditMode::events);
    Witness witness(rig.simulator, definition(rig, 1));
    RigOf<Plane<1>> exact(motion, AuditMode::none, Kernel::exact);
    try {
      rig.run();
      exact.run();
      EXPECT_EQ(exact.simulator.fingerprint(), rig.simulator.fingerprint());
      ++ran;
    } catch (const InputError&) {  // beads move together, or all beads are on one line
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
    if (HasFailure()) return;
  }
  EXPECT_GT(ran, test::rounds(400));
}

// Two beads move together and one of them is hidden. The bead lies in each of the cells around the other, and
// both kernels must choose one cell.
TEST(PlaneDiagram, KernelsHouseHiddenBeadsAtVerticesAlike) {
  std::uint64_t wandered = 0;
  for (unsigned seed = 1; seed <= rounds(12U, 3U); ++seed) {
    std::mt19937 random(seed);
    constexpr BeadId beads = 40;
    Plane<1> motion(beads);
    for (BeadId b = 0; b < beads; ++b) {
      for (int k = 0; k <= 1; ++k) {
        for (int axis = 0; axis < 2; ++axis) motion.set_coordinate(b, k, axis, random() % 5);
        motion.set_weight(b, k, random() % 3);
      }
    }
    RigOf<Plane<1>> filtered(motion);
    RigOf<Plane<1>> exact(motion, AuditMode::none, Kernel::exact);
    filtered.run();
    exact.run();
    EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint()) << seed;
    wandered += filtered.structure.statistics.events_by_kind[3];
  }
  EXPECT_GT(wandered, rounds(100U));
}

}  // namespace
}  // namespace kds::plane_diagram_test
