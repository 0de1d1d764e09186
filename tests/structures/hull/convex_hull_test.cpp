#include "structures/hull/convex_hull.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Gmpz.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/convex_hull_2.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"
#include "tests/support/judges/moving_points.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::convex_hull_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

using Plane = BezierMotion<2, 1>;
using Curved = BezierMotion<2, 3>;
template <Motion M>
using HullRig = Rig<ConvexHull, M>;

/// Returns the corners that CGAL finds with exact numbers, counterclockwise from the least bead. If several
/// beads lie at one corner, the least of them stands for all.
std::vector<BeadId> corners_by_cgal(const ExactPoints& at) {
  using Geometry = CGAL::Simple_cartesian<CGAL::Gmpq>;
  std::vector<Geometry::Point_2> points, corners;
  const auto number = [](const second::Integer& x) { return CGAL::Gmpq(CGAL::Gmpz(x.str())); };
  for (const auto& p : at) points.emplace_back(number(p[0]), number(p[1]));
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(corners));
  std::vector<BeadId> beads;
  for (const auto& corner : corners)
    beads.push_back(static_cast<BeadId>(std::find(points.begin(), points.end(), corner) - points.begin()));
  std::rotate(beads.begin(), std::min_element(beads.begin(), beads.end()), beads.end());
  return beads;
}

int differences;  // counts the audits at which the known corners differ from the exact corners of that moment

/// Explains what is wrong with the known corners at a moment of ties, or returns nothing. At such a moment
/// known corners may lie on edges or coincide.
std::optional<std::string> fault_at_ties(const std::vector<BeadId>& known, const std::vector<BeadId>& right,
                                         const ExactPoints& at) {
  std::vector<BeadId> places;  // the known beads that are at exact corners
  for (const BeadId b : known)
    for (const BeadId corner : right)
      if (at[b] == at[corner] && (places.empty() || places.back() != corner)) places.push_back(corner);
  if (places.size() > 1 && places.front() == places.back()) places.pop_back();
  if (!places.empty())
    std::rotate(places.begin(), std::min_element(places.begin(), places.end()), places.end());
  if (places != right) return "corners are missing, or in another order";
  for (const BeadId b : known) {
    bool on_edge = false;
    for (std::size_t i = 0; i < right.size(); ++i) {
      const auto &p = at[right[i]], &q = at[right[(i + 1) % right.size()]], &x = at[b];
      const second::Integer turn = (q[0] - p[0]) * (x[1] - p[1]) - (q[1] - p[1]) * (x[0] - p[0]);
      on_edge = on_edge || turn == 0;
    }
    if (!on_edge) return text_of("bead ", b, " lies inside");
  }
  return std::nullopt;
}

std::optional<std::string> fault_of(const ConvexHull& hull, const ExactPoints& at) {
  const std::vector<BeadId> right = corners_by_cgal(at);
  if (hull.corners() == right) return std::nullopt;
  ++differences;
  if (const auto fault = fault_at_ties(hull.corners(), right, at))
    return text_of(*fault, ": ", testing::PrintToString(hull.corners()), " and not ",
                   testing::PrintToString(right));
  return std::nullopt;
}

template <Motion M>
History expect_right(const std::vector<M>& steps) {
  return expect_right_at_all_times<ConvexHull>(steps, fault_of,
                                               [](const ConvexHull& hull) { return hull.corners(); });
}

/// Returns lines such as "enter 3 between 1 and 2 at 0.5". Leaves out interchanges, which only the two halves
/// of the hull need.
std::vector<std::string> told(const History& history) {
  std::vector<std::string> lines;
  for (const Event& e : history.events) {
    const auto& ids = e.change.ids;
    if (e.change.kind != ConvexHull::interchange)
      lines.push_back(text_of(e.change.kind == ConvexHull::enter ? "enter " : "leave ", ids[0], " between ",
                              ids[1], " and ", ids[2], " at ",
                              static_cast<double>(e.step) + 0.5 * (e.lower + e.upper)));
  }
  return lines;
}

Plane flat(const Points& from, const Points& to) {
  Plane motion(from.size());
  for (BeadId b = 0; b < from.size(); ++b) {
    for (int axis = 0; axis < 2; ++axis) {
      motion.set_coordinate(b, 0, axis, from[b][static_cast<std::size_t>(axis)]);
      motion.set_coordinate(b, 1, axis, to[b][static_cast<std::size_t>(axis)]);
    }
  }
  return motion;
}
std::vector<Plane> flat_through(const std::vector<Points>& frames) {
  std::vector<Plane> steps;
  for (std::size_t k = 0; k + 1 < frames.size(); ++k) steps.push_back(flat(frames[k], frames[k + 1]));
  return steps;
}

const Points square{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
Points with(Points points, std::array<double, 3> another) {
  points.push_back(another);
  return points;
}

TEST(ConvexHull, ABeadComesOutOfTheHullAndGoesBack) {
  EXPECT_THAT(told(expect_right(flat_through({with(square, {3, 2, 0}), with(square, {5, 2, 0}),  //
                                              with(square, {1, 2, 0})}))),
              ElementsAre("enter 4 between 1 and 2 at 0.5", "leave 4 between 1 and 2 at 1.25"));
}

TEST(ConvexHull, ATriangleThatTurnsInsideOut) {
  const Points up{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}}, down{{0, 0, 0}, {2, 0, 0}, {1, -1, 0}};
  HullRig<Plane> rig(flat(up, down), AuditMode::events);
  rig.run();
  EXPECT_THAT(rig.structure.corners(), ElementsAre(0, 2, 1));
  expect_right<Plane>({flat(up, down)});
}

TEST(ConvexHull, TheFirstBeadChangesAndTheHullDoesNot) {
  const Points from{{0, 0, 0}, {1, 3, 0}, {5, 1, 0}, {3, 1, 0}},
      to{{2, 0, 0}, {1, 3, 0}, {5, 1, 0}, {3, 1, 0}};
  const History history = expect_right<Plane>({flat(from, to)});
  EXPECT_THAT(told(history), IsEmpty());
  EXPECT_FALSE(history.events.empty());
}

TEST(ConvexHull, OfFewBeads) {
  HullRig<Plane> none(Plane(0), AuditMode::events);
  none.run();
  EXPECT_THAT(none.structure.corners(), IsEmpty());
  HullRig<Plane> one(flat({{1, 2, 0}}, {{2, 1, 0}}), AuditMode::events);
  one.run();
  EXPECT_THAT(one.structure.corners(), ElementsAre(0));
  EXPECT_THAT(told(expect_right(flat_through({{{0, 0, 0}, {1, 0, 0}}, {{1, 0, 0}, {0, 0, 0}}}))), IsEmpty());
  // Two beads are together, apart, and together again.
  EXPECT_THAT(told(expect_right(flat_through({{{0, 0, 0}, {0, 0, 0}},
                                              {{0, 0, 0}, {0, 0, 0}},  //
                                              {{0, 0, 0}, {0, 1, 0}},
                                              {{0, 0, 0}, {0, 0, 0}},  //
                                              {{1, 0, 0}, {1, 0, 0}}}))),
              ElementsAre("enter 1 between 0 and 0 at 1", "leave 1 between 0 and 0 at 3"));
}

TEST(ConvexHull, OnALineTheEndsAreTheCorners) {
  for (const auto& [x, y] : {std::pair{1.0, 0.0}, {0.0, 1.0}, {1.0, 2.0}, {-1.0, 1.0}}) {
    const auto at = [px = x, py = y](double s) { return std::array{s * px, s * py, 0.0}; };
    const auto history =
        expect_right<Plane>({flat({at(0), at(1), at(2), at(3), at(3)}, {at(0), at(5), at(2), at(3), at(3)})});
    EXPECT_THAT(told(history), testing::UnorderedElementsAre("leave 3 between 0 and 0 at 0.5",
                                                             "enter 1 between 0 and 0 at 0.5"));
  }
}

TEST(ConvexHull, OfBeadsTogetherTheLeastIsTheCorner) {
  Points twice = square;
  twice.insert(twice.end(), square.begin(), square.end());
  Points later = twice;
  for (std::size_t b = 0; b < 4; ++b) later[b] = {2, 2, 0};
  for (auto& p : later) p[0] += 1;
  EXPECT_THAT(told(expect_right<Plane>({flat(twice, twice)})), IsEmpty());
  HullRig<Plane> rig(flat(twice, later), AuditMode::events);
  rig.run();
  EXPECT_THAT(rig.structure.corners(), ElementsAre(4, 5, 6, 7));
  // Beads that coincide again for a whole step: the least bead is the corner again.
  for (const Points& last : {twice, later}) {
    const std::vector<Plane> steps = flat_through({twice, later, twice, twice, last});
    expect_right(steps);
    HullRig<Plane> again(steps.front());
    again.run({steps.begin(), steps.begin() + 3});
    EXPECT_THAT(again.structure.corners(), ElementsAre(0, 1, 2, 3));
  }
}

// All beads meet in a point or on a line, and leave in the opposite or another order.
TEST(ConvexHull, AllMeet) {
  Points from, to, to_line;
  for (int b = 0; b < 7; ++b) {
    from.push_back({std::cos(1.0 * b), std::sin(1.0 * b), 0});
    to.push_back({-(b + 1) * from.back()[0], -(b + 1) * from.back()[1], 0});
    to_line.push_back({from.back()[0], -from.back()[1], 0});
  }
  expect_right<Plane>({flat(from, to)});
  expect_right<Plane>({flat(from, to_line)});
  Points on_a_line = to_line;
  for (auto& p : on_a_line) p[1] = 0;
  expect_right(flat_through({from, on_a_line, to_line, Points(7, {0, 0, 0}), from}));
  // Some beads turn back and the other beads pass through, which changes the order around the hull.
  BezierMotion<2, 2> through(5);
  for (BeadId b = 0; b < 5; ++b) {
    for (int axis = 0; axis < 2; ++axis) {
      const double x = from[b][static_cast<std::size_t>(axis)];
      const double bend = b % 2 == 0 ? -1 : 0;  // (1 - 2u)^2 x, or (1 - 2u) x
      through.set_coordinate(b, 0, axis, x);
      through.set_coordinate(b, 1, axis, bend * x);
      through.set_coordinate(b, 2, axis, b % 2 == 0 ? x : -x);
    }
  }
  expect_right<BezierMotion<2, 2>>({through});
}

TEST(ConvexHull, Grids) {
  std::mt19937 random(3);
  for (int round = 0; round < test::rounds(25); ++round) {
    SCOPED_TRACE(text_of("round ", round));
    const std::size_t beads = 3 + random() % 14;
    const int range = 2 + static_cast<int>(random() % 4);
    std::vector<Points> frames;
    for (int k = 0; k < 4; ++k) frames.push_back(random_grid_points(random, beads, range));
    expect_right(flat_through(frames));
    if (HasFailure()) return;
  }
}

template <Motion M>
void try_random_motions(unsigned seed) {
  Random random(seed);
  for (int round = 0; round < test::rounds(7); ++round) {
    for (const MotionKind kind : all_motion_kinds) {
      SCOPED_TRACE(text_of("kind ", static_cast<int>(kind), ", round ", round));
      expect_right(random_steps<M>(random, 1 + random() % 12, kind, 3));
      if (testing::Test::HasFailure()) return;
    }
  }
}
TEST(ConvexHull, RandomMotions) { try_random_motions<Plane>(2); }
TEST(ConvexHull, RandomCurves) { try_random_motions<Curved>(4); }

/// Instances of data/kinetic. In general position the corners are exactly CGAL's between all events.
TEST(ConvexHull, Instances) {
  differences = 0;
  EXPECT_GT(told(expect_right<Plane>({instance_motion<Plane>("d2_n50_linear")})).size(), 10U);
  EXPECT_GT(told(expect_right<Curved>({instance_motion<Curved>("d2_n20_degree3")})).size(), 10U);
  EXPECT_EQ(differences, 0);
  for (const char* name : {"gridint", "gridrand", "gridrigid", "half", "swap", "converge"}) {
    SCOPED_TRACE(name);
    expect_right<Plane>({instance_motion<Plane>(text_of("degenerate_d2_n64_", name))});
  }
}

TEST(ConvexHull, OfAProteinSeenFromOneSide) {
  const auto in_space = trajectory_steps("villin_hp36_300K.dcd", 0, 3);
  std::vector<Plane> steps;
  for (const Space& step : in_space) {
    Plane& plane = steps.emplace_back(step.bead_count());
    for (BeadId b = 0; b < step.bead_count(); ++b)
      for (int k = 0; k <= 1; ++k)
        for (int axis = 0; axis < 2; ++axis) plane.set_coordinate(b, k, axis, step.coordinate(b, k, axis));
  }
  EXPECT_GT(told(expect_right(steps)).size(), 0U);
}

TEST(ConvexHull, HasFewCertificatesAndTheExactStageIsRare) {
  HullRig<Plane> rig(instance_motion<Plane>("d2_n500_linear"));
  rig.run();
  const StructureStatistics& statistics = rig.structure.statistics;
  EXPECT_LE(statistics.certificates.peak, 6U * 500);
  EXPECT_LT(statistics.stages.exact, statistics.certificates.created / 100);
}

TEST(ConvexHull, AuditsNoticeEveryWrongHull) {
  const Points five = with(square, {3, 2, 0});
  HullRig<Plane> rig(flat(five, five));
  rig.run();
  EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
  rig.structure.apply({ConvexHull::leave, 3, {1, 0, 2}});
  for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
  rig.structure.apply({ConvexHull::enter, 3, {1, 2, 3}});  // the same ids in another order
  for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
  rig.structure.apply({ConvexHull::leave, 3, {1, 2, 3}});
  rig.structure.apply({ConvexHull::enter, 3, {1, 0, 2}});
  EXPECT_EQ(rig.structure.audit(Dyadic(0.5)), std::nullopt);
  rig.structure.apply({ConvexHull::enter, 3, {4, 1, 2}});
  for (const double time : {0.0, 0.5, 1.0}) EXPECT_NE(rig.structure.audit(Dyadic(time)), std::nullopt);
}

TEST(ConvexHull, RefusesChangesThatCannotBe) {
  const Points five = with(square, {3, 2, 0});
  HullRig<Plane> rig(flat(five, five));
  rig.run();
  for (const Change& change :
       {Change{ConvexHull::leave, 3, {4, 0, 1}}, Change{ConvexHull::leave, 3, {1, 0, 3}},
        Change{ConvexHull::enter, 3, {1, 0, 2}}, Change{ConvexHull::enter, 3, {4, 0, 2}},
        Change{ConvexHull::enter, 3, {5, 0, 1}}, Change{ConvexHull::enter, 3, {4, 4, 1}},
        Change{ConvexHull::interchange, 2, {0, 5}}})
    EXPECT_THROW(rig.structure.apply(change), std::invalid_argument);
  EXPECT_THAT(rig.structure.corners(), ElementsAre(0, 1, 2, 3));
}

}  // namespace
}  // namespace kds::convex_hull_test
