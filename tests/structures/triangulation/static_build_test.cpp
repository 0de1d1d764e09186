#include "structures/triangulation/static_build.h"

#include <gtest/gtest.h>

#include <vector>

#include "structures/necklace/necklace_tree.h"
#include "tests/support/judges/triangulation_checks.h"

namespace kds::static_build_test {
namespace {

TEST(StaticBuild, TakesTime) {
  const test::Cloud cloud(300);
  const std::vector<BeadRange> necklaces{{0, 299}};
  EXPECT_GT(seconds_to_triangulate<3>(cloud.centers, cloud.weights).clock, 0);
  EXPECT_GT(seconds_to_wrap<3>(NecklaceTree(necklaces).ranges(), cloud.centers, cloud.weights).clock, 0);
  EXPECT_GT(seconds_to_sort(cloud.centers).clock, 0);
}

}  // namespace
}  // namespace kds::static_build_test
