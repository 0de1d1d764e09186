// Impacts of points on triangles and of edges on edges, judged over whole numbers.

#include "structures/impacts/impact_search.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <vector>

#include "motions/base/input_error.h"
#include "tests/support/inputs/random.h"
#include "tests/support/judges/impacts.h"
#include "tests/support/property_runs.h"
#include "tests/support/rounds.h"
#include "tests/support/text_of.h"

namespace kds::impact_search_test {
namespace {

using namespace test;
using testing::ElementsAre;
using testing::IsEmpty;

std::vector<double> doubles(const std::vector<int>& points) { return {points.begin(), points.end()}; }

bool is_within(const JudgedTime& time, const Impact& impact) {
  const Rational lower(impact.lower), upper(impact.upper);
  if (impact.lower == impact.upper)
    return time.sequence->is_root(lower) &&
           (time.root.is_number() ? time.root.lower == lower
                                  : time.root.lower < lower && lower <= time.root.upper);
  sturm::Root root = time.root;
  for (;;) {
    if (root.is_number()) return lower < root.lower && root.lower < upper;
    if (lower <= root.lower && root.upper < upper) return true;
    if (root.upper <= lower || upper <= root.lower) return false;
    sturm::halve(*time.sequence, root);
  }
}

void expect_right(ImpactKind kind, int degree, const std::vector<int>& points) {
  ImpactSearch search(kind, degree);
  const std::vector<JudgedTime> right = ImpactJudge(kind, degree, points).impacts();
  const std::vector<Impact> found = search.all_impacts(doubles(points));
  ASSERT_EQ(found.size(), right.size()) << testing::PrintToString(points);
  for (std::size_t k = 0; k < right.size(); ++k) {
    EXPECT_TRUE(is_within(right[k], found[k])) << testing::PrintToString(points);
    EXPECT_LE(found[k].upper - found[k].lower, 0x1p-40);
  }
  const auto first = search.first_impact(doubles(points));
  ASSERT_EQ(first.has_value(), !right.empty());
  if (first) {
    EXPECT_EQ(first->lower, found.front().lower);
  }
}

/// The ways in which random points are made.
enum class Made { anywhere, on_plane, on_moving_plane, on_line, shared_points, at_rest };

std::vector<int> random_points(Random& random, int degree, Made made) {
  const auto row = static_cast<std::size_t>(degree) + 1;
  const int most = pick(random, 1, 6);
  std::vector<int> points(4 * row * 3);
  for (int& x : points) x = pick(random, -most, most);
  const auto coordinate = [&](std::size_t point, std::size_t k, std::size_t axis) -> int& {
    return points[(point * row + k) * 3 + axis];
  };
  const std::size_t axis = static_cast<std::size_t>(pick(random, 0, 2));
  for (std::size_t k = 0; k < row; ++k) {
    const int at = pick(random, -2, 2);
    for (std::size_t point = 0; point < 4; ++point) {
      if (made == Made::on_plane) coordinate(point, k, axis) = 1;
      if (made == Made::on_moving_plane) coordinate(point, k, axis) = at;
      if (made == Made::on_line) coordinate(point, k, axis) = coordinate(point, k, (axis + 1) % 3) = at;
      if (made == Made::at_rest)
        for (std::size_t x = 0; x < 3; ++x) coordinate(point, k, x) = coordinate(point, 0, x);
    }
  }
  if (made == Made::shared_points) {
    const auto from = static_cast<std::size_t>(pick(random, 0, 3)),
               to = static_cast<std::size_t>(pick(random, 0, 3));
    for (std::size_t k = 0; k < row; ++k)
      for (std::size_t x = 0; x < 3; ++x)
        if (k == 0 || pick(random, 0, 1) == 0) coordinate(to, k, x) = coordinate(from, k, x);
  }
  return points;
}

void try_random(ImpactKind kind, int degree, int count) {
  count *= static_cast<int>(from_environment("KDS_IMPACT_ROUNDS", 1));  // multiplies the number of queries
  Random random(from_environment("KDS_IMPACT_SEED", 530) + static_cast<unsigned>(degree));
  for (int round = 0; round < rounds(count, 10); ++round) {
    for (const Made made : {Made::anywhere, Made::on_plane, Made::on_moving_plane, Made::on_line,
                            Made::shared_points, Made::at_rest}) {
      SCOPED_TRACE(text_of("round ", round, ", made ", static_cast<int>(made)));
      expect_right(kind, degree, random_points(random, degree, made));
      if (testing::Test::HasFailure()) return;
    }
  }
}

TEST(ImpactSearch, RandomVerticesOnFaces) { try_random(ImpactKind::vertex_face, 1, 300); }
TEST(ImpactSearch, RandomEdgesOnEdges) { try_random(ImpactKind::edge_edge, 1, 300); }
TEST(ImpactSearch, RandomCurves) {
  for (const int degree : {2, 3}) {
    try_random(ImpactKind::vertex_face, degree, 10);
    try_random(ImpactKind::edge_edge, degree, 10);
  }
}

std::vector<double> vertex_on_face(double from, double to, double x = 0.25) {
  return {x, 0.25, from, x, 0.25, to, 0, 0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 0};
}

TEST(ImpactSearch, OfAVertexThatFalls) {
  ImpactSearch search(ImpactKind::vertex_face);
  const auto all = search.all_impacts(vertex_on_face(1, -1));
  ASSERT_EQ(all.size(), 1U);
  EXPECT_LE(all[0].lower, 0.5);
  EXPECT_GE(all[0].upper, 0.5);
  EXPECT_TRUE(all[0].passes);
  EXPECT_THAT(search.all_impacts(vertex_on_face(1, 0)), testing::SizeIs(1));  // at the end of the step
  EXPECT_THAT(search.all_impacts(vertex_on_face(0, 1)), testing::SizeIs(1));  // at its start
  EXPECT_THAT(search.all_impacts(vertex_on_face(1, 2)), IsEmpty());
  EXPECT_THAT(search.all_impacts(vertex_on_face(1, -1, 0.75)), testing::SizeIs(1));  // on an edge
  EXPECT_THAT(search.all_impacts(vertex_on_face(1, -1, std::nextafter(0.75, 1))), IsEmpty());
}

// Along the third axis, edges from the first step on are disjoint by one bit.
TEST(ImpactSearch, AtExtremeScales) {
  for (const double scale : {0x1p-1000, 0x1p-300, 0x1p300, 0x1p900}) {
    ImpactSearch search(ImpactKind::vertex_face);
    std::vector<double> points = vertex_on_face(1, -1, 0.75);
    for (double& x : points) x *= scale;
    EXPECT_THAT(search.all_impacts(points), testing::SizeIs(1));
    points[0] = points[3] = std::nextafter(points[0], HUGE_VAL);
    EXPECT_THAT(search.all_impacts(points), IsEmpty());
  }
}

TEST(ImpactSearch, RefusesOtherInput) {
  EXPECT_THROW(ImpactSearch(ImpactKind::edge_edge, 0), std::invalid_argument);
  EXPECT_THROW(ImpactSearch(ImpactKind::edge_edge, 21), std::invalid_argument);
  ImpactSearch search(ImpactKind::edge_edge);
  EXPECT_THROW((void)search.first_impact(std::vector<double>(23, 0)), InputError);
  std::vector<double> points(24, 0);
  points[5] = std::numeric_limits<double>::infinity();
  EXPECT_ANY_THROW((void)search.first_impact(points));
}

}  // namespace
}  // namespace kds::impact_search_test
