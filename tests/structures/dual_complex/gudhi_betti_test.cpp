#include "tests/structures/dual_complex/gudhi_betti.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

#include "tests/support/judges/cgal_triangulation.h"

namespace kds::test {
namespace {

using Simplices = std::vector<std::array<BeadId, 4>>;
using WeightedPoints = std::vector<ExactPoint>;

class GudhiBetti : public testing::Test {
 protected:
  void SetUp() override {
    if (!has_gudhi()) GTEST_SKIP() << "needs GUDHI (libgudhi-dev)";
  }
};

/// Returns simplices and all their faces.
Simplices with_faces(const std::vector<std::vector<BeadId>>& tops) {
  std::set<std::array<BeadId, 4>> all;
  for (const auto& top : tops) {
    for (unsigned subset = 1; subset < 1U << top.size(); ++subset) {
      std::array<BeadId, 4> face{no_bead, no_bead, no_bead, no_bead};
      std::size_t count = 0;
      for (std::size_t i = 0; i < top.size(); ++i)
        if ((subset >> i & 1U) != 0) face[count++] = top[i];
      std::sort(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(count));
      all.insert(face);
    }
  }
  return {all.begin(), all.end()};
}

TEST_F(GudhiBetti, OfKnownComplexes) {
  EXPECT_EQ(gudhi_betti({}), (Betti{0, 0, 0}));
  EXPECT_EQ(gudhi_betti(with_faces({{0}, {5}})), (Betti{2, 0, 0}));
  EXPECT_EQ(gudhi_betti(with_faces({{0, 1, 2, 3}})), (Betti{1, 0, 0}));
  EXPECT_EQ(gudhi_betti(with_faces({{0, 1, 2}, {0, 1, 3}, {0, 2, 3}, {1, 2, 3}})), (Betti{1, 0, 1}));
  EXPECT_EQ(gudhi_betti(with_faces({{0, 1}, {1, 2}, {2, 3}, {0, 3}})), (Betti{1, 1, 0}));
  std::vector<std::vector<BeadId>> torus;  // of seven beads
  for (BeadId b = 0; b < 7; ++b) {
    torus.push_back({b, (b + 1) % 7, (b + 3) % 7});
    torus.push_back({b, (b + 2) % 7, (b + 3) % 7});
  }
  EXPECT_EQ(gudhi_betti(with_faces(torus)), (Betti{1, 2, 1}));
}

TEST_F(GudhiBetti, RefusesWhatIsNoComplex) {
  Simplices triangle = with_faces({{0, 1, 2}});
  triangle.push_back(triangle.front());
  EXPECT_THROW(static_cast<void>(gudhi_betti(triangle)), std::invalid_argument);
  triangle = with_faces({{0, 1, 2}});
  triangle.pop_back();
  EXPECT_THROW(static_cast<void>(gudhi_betti(triangle)), std::invalid_argument);
}

/// Returns balls on the grid {-1, 0, 1}^3, at the places where at least `least` coordinates are not 0.
WeightedPoints grid(int least, const Rational& weight) {
  WeightedPoints balls;
  for (int x = -1; x <= 1; ++x)
    for (int y = -1; y <= 1; ++y)
      for (int z = -1; z <= 1; ++z)
        if (x * x + y * y + z * z >= least) balls.push_back({x, y, z, weight});
  return balls;
}

/// Compares GUDHI's complex with CGAL's, whose homology GUDHI computes, and returns the Betti numbers.
Betti compared(const WeightedPoints& balls) {
  const Betti betti = gudhi_betti_of_union(balls);
  const Simplices complex = cgal_alpha_complex(balls);
  EXPECT_EQ(gudhi_betti(complex), betti);
  int euler = 0;
  for (const auto& beads : complex)
    euler += std::count(beads.begin(), beads.end(), no_bead) % 2 == 1 ? 1 : -1;
  EXPECT_EQ(static_cast<int>(betti[0]) - static_cast<int>(betti[1]) + static_cast<int>(betti[2]), euler);
  return betti;
}

TEST_F(GudhiBetti, OfKnownUnions) {
  const WeightedPoints corners = grid(3, Rational(1, 4)), frame = grid(2, Rational(1, 4)),
                       shell = grid(1, Rational(1, 4));
  EXPECT_EQ(compared(corners), (Betti{8, 0, 0}));
  EXPECT_EQ(compared(frame), (Betti{1, 5, 0}));  // balls that touch along the edges of a cube
  EXPECT_EQ(compared(shell), (Betti{1, 23, 0}));
  EXPECT_EQ(compared(grid(1, Rational(3, 4))), (Betti{1, 0, 1}));
  EXPECT_EQ(compared(grid(0, Rational(3, 4))), (Betti{1, 0, 0}));
  EXPECT_EQ(compared(grid(0, -1)), (Betti{0, 0, 0}));
  WeightedPoints ring;  // a closed chain
  for (const auto& [x, y] : {std::pair(4, 0), {3, 3}, {0, 4}, {-3, 3}, {-4, 0}, {-3, -3}, {0, -4}, {3, -3}})
    ring.push_back({x, y, x > 0 ? 1 : 0, 3});
  EXPECT_EQ(compared(ring), (Betti{1, 1, 0}));
  ring.push_back({9, 9, 9, 1});
  EXPECT_EQ(compared(ring), (Betti{2, 1, 0}));
  ring[0][3] = 0;  // a ball of one point, apart from its neighbours
  EXPECT_EQ(compared(ring), (Betti{3, 0, 0}));
  ring[0][3] = -1;  // no ball
  EXPECT_EQ(compared(ring), (Betti{2, 0, 0}));
}

TEST_F(GudhiBetti, RefusesFlatUnions) {
  const WeightedPoints flat{{0, 0, 0, 1}, {1, 0, 0, 1}, {0, 1, 0, 1}};
  EXPECT_THROW(static_cast<void>(gudhi_betti_of_union(flat)), std::invalid_argument);
}

/// Half of the scenes have their balls on the surface of a cube, so that some of them enclose voids.
TEST_F(GudhiBetti, OfRandomUnions) {
  std::mt19937 random(11);
  Betti sum{};
  for (int round = 0; round < 60; ++round) {
    WeightedPoints balls(10 + random() % 50);
    for (ExactPoint& ball : balls) {
      for (std::size_t axis = 0; axis < 3; ++axis) ball[axis] = Rational(random() % 1000, 7);
      if (round % 2 == 0) ball[random() % 3] = Rational(random() % 2 * 1000, 7);
      ball[3] = Rational(1000 + random() % 2000, 2);
    }
    const Betti betti = compared(balls);
    for (std::size_t i = 0; i < 3; ++i) sum[i] += betti[i];
  }
  for (const std::size_t count : sum) EXPECT_GT(count, 5U);
}

}  // namespace
}  // namespace kds::test
