// The cascade verification with path cages: its verdicts are those of all beads, and the farthest point of
// two spheres is compared with random points in both.

#include "structures/hierarchy/path_cages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "motions/models/shapes.h"
#include "tests/support/inputs/random.h"
#include "tests/support/rounds.h"

namespace kds::path_cages_test {
namespace {

using test::Random;
using test::uniform;

Eigen::Vector3d random_vector(Random& random, int dimension) {
  Eigen::Vector3d v = Eigen::Vector3d::Zero();
  for (Eigen::Index axis = 0; axis < dimension; ++axis) v[axis] = uniform(random, -1, 1);
  return v;
}

TEST(PathCages, NoPointInBothSpheresIsFarther) {
  Random random(4);
  for (int k = 0; k < test::rounds(300); ++k) {
    const int dimension = 2 + k % 2;
    const Sphere a{random_vector(random, dimension), uniform(random, 0.4, 1.5)};
    Sphere b{a.center, uniform(random, 0.4, 1.5)};
    if (k % 10 != 0)
      b.center += (a.radius + b.radius) * uniform(random, 0, 0.55) * random_vector(random, dimension);
    if ((a.center - b.center).norm() > 0.95 * (a.radius + b.radius)) continue;
    const Eigen::Vector3d from = 2 * random_vector(random, dimension);
    const double farthest = farthest_in_both(a, b, from);
    // Points on the surface of either sphere that lie in the other; the farthest point is one of them.
    double most = 0;
    for (int i = 0; i < 4000; ++i)
      for (const bool on_a : {true, false}) {
        const Sphere &on = on_a ? a : b, &in = on_a ? b : a;
        const Eigen::Vector3d point = on.center + on.radius * random_vector(random, dimension).normalized();
        if ((point - in.center).norm() <= in.radius) most = std::max(most, (point - from).norm());
      }
    EXPECT_LE(most, farthest * (1 + 1e-12)) << k;
    EXPECT_GE(most, farthest - 0.15 * std::min(a.radius, b.radius)) << k;
  }
}

template <int Dimension>
void expect_verdicts_of_all_beads(std::uint64_t seed) {
  Random random(seed);
  std::size_t escaped = 0, by_path = 0;
  for (int k = 0; k < 20; ++k) {
    const std::size_t n = 40 + random() % 200;
    const std::vector<double> radii(n, 1);
    Eigen::Matrix3Xd centers(3, static_cast<Eigen::Index>(n));
    Eigen::Vector3d at = Eigen::Vector3d::Zero();
    for (Eigen::Index b = 0; b < centers.cols(); ++b) centers.col(b) = at += random_vector(random, Dimension);
    const Balls<Dimension> before(centers, radii);
    for (Eigen::Index b = 0; b < centers.cols(); ++b)
      centers.col(b) += (k % 2 == 0 ? 0.02 : 0.2) * random_vector(random, Dimension);
    const Balls<Dimension> after(centers, radii);
    const std::array necklaces{BeadRange{0, static_cast<BeadId>(n - 1)}};
    StaticWrappedHierarchy<Dimension> trusted(necklaces), now(necklaces);
    trusted.build(before);
    now.build(after);
    trusted.update(after, Update::trust);

    std::vector<NodeId> wrong;
    for (auto node = static_cast<NodeId>(now.tree().node_count()); node-- > 0;) {
      const Sphere sphere = trusted.sphere(node);
      const BeadRange range = now.tree().range(node);
      bool out = false;
      for (BeadId b = range.first; b <= range.last; ++b)
        out |= (centers.col(b) - sphere.center).norm() + radii[b] > sphere.radius * (1 + 1e-9);
      if (out) wrong.push_back(node);
    }
    const CascadeCost plain = cascade_cost(trusted, now, after, false);
    const CascadeCost with_paths = cascade_cost(trusted, now, after, true);
    EXPECT_EQ(plain.escaped, wrong);
    EXPECT_EQ(with_paths.escaped, wrong);
    EXPECT_EQ(plain.path_tests, 0U);
    EXPECT_LE(with_paths.tests, plain.tests);
    escaped += wrong.size();
    by_path += plain.tests - with_paths.tests;
  }
  EXPECT_GT(escaped, 20U);
  EXPECT_GT(by_path, 20U);  // paths settle some cages
}

TEST(PathCages, VerdictsAreThoseOfAllBeads) {
  expect_verdicts_of_all_beads<2>(1);
  expect_verdicts_of_all_beads<3>(2);
}

}  // namespace
}  // namespace kds::path_cages_test
