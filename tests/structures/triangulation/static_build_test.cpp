#include "structures/triangulation/static_build.h"

#include <gtest/gtest.h>

#include <vector>

#include "kds/stopwatch.h"
#include "structures/necklace/necklace_tree.h"
#include "tests/support/judges/triangulation_checks.h"

namespace kds::static_build_test {
namespace {

TEST(StaticBuild, TakesTime) {
  const test::Cloud cloud(300);
  const std::vector<BeadRange> necklaces{{0, 299}};
  const NecklaceTree tree(necklaces);
  for (const StaticBuild& build :
       {triangulation_by_cgal<3>(cloud.centers, cloud.weights),
        spheres_by_cgal<3>(tree.ranges(), cloud.centers, cloud.weights), hull_by_cgal(cloud.centers),
        order_by_sorting(cloud.centers), box_by_scanning(cloud.centers)}) {
    const double seconds = seconds_per_call<WallClock>(build);
    EXPECT_GT(seconds, 1e-8);
    EXPECT_LT(seconds, 1);
  }
}

}  // namespace
}  // namespace kds::static_build_test
