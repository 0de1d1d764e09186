// Runs the library in a host that uses another rounding mode or flushes subnormal numbers to zero. Histories
// and static structures are the same, and the host's environment is unchanged afterwards.

#include <gtest/gtest.h>

#include "motions/numbers/exact_number.h"
#include "structures/collision/closest_pair.h"
#include "structures/hierarchy/static_wrapped_hierarchy.h"
#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/sorted/sorted_list.h"
#include "tests/support/inputs/host_environment.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::host_environment_test {
namespace {

using namespace test;

class InHost : public testing::TestWithParam<HostEnvironment> {
 protected:
  void TearDown() override { std::fesetenv(FE_DFL_ENV); }

  // Checks that a run gives the same result inside the host's environment as outside; `of_run` returns the
  // result.
  template <class Run>
  void expect_the_same(const Run& of_run) {
    const auto expected = of_run();
    set(GetParam());
    const auto found = of_run();
    EXPECT_TRUE(is_set(GetParam()));
    std::fesetenv(FE_DFL_ENV);
    EXPECT_EQ(found, expected);
  }

  template <class Structure, Motion M, class... Extra>
  void expect_same_history(const std::vector<M>& steps, const Extra&... extra) {
    for (const Kernel kernel : {Kernel::filtered, Kernel::exact}) {
      expect_the_same([&] {
        Rig<Structure, M> rig(steps.front(), AuditMode::events, kernel, extra...);
        rig.run(steps);
        return std::pair(rig.history.events.size(), rig.simulator.fingerprint());
      });
    }
  }
};

TEST_P(InHost, Sorted) {
  expect_same_history<SortedList<1>>(std::vector{instance_motion<BezierMotion<1, 3>>("d1_n20_degree3")});
}

TEST_P(InHost, Power) {
  expect_same_history<PowerDiagram<3>>(std::vector{instance_motion<Space>("d3_n20_linear")});
}

// Edits enter the library separately.
TEST_P(InHost, PowerWithEdits) {
  expect_the_same([] {
    Rig<PowerDiagram<3>, Space> rig(instance_motion<Space>("d3_n20_linear"), AuditMode::events);
    rig.simulator.build();
    rig.simulator.enter_step();
    for (const double u : {0.25, 0.5, 0.75}) {
      rig.simulator.run_until(Dyadic(u));
      rig.structure.erase(3);
      rig.structure.change_motion(5, [&] {
        EXPECT_EQ(std::fegetround(), FE_TONEAREST);
        rig.motion.set_coordinate(5, 1, 0, 1 / (3 * u));
      });
      rig.structure.insert(3);
    }
    rig.simulator.leave_step();
    return std::pair(rig.history.events.size(), rig.simulator.fingerprint());
  });
}

TEST_P(InHost, Wrapped) {
  const std::vector<BeadRange> twenty{{0, 19}};
  expect_same_history<WrappedHierarchy<3>>(std::vector{instance_motion<Space>("d3_n20_linear")}, twenty,
                                           Radii::equal);
}

// Radii differ so much that the bounds of spheres round often.
TEST_P(InHost, StaticHierarchy) {
  const BeadId beads = 6000;
  Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Random(3, beads);
  for (Eigen::Index b = 1; b < centers.cols(); ++b) centers.col(b) += centers.col(b - 1);
  std::vector<double> radii(beads);
  for (std::size_t b = 0; b < radii.size(); ++b) radii[b] = 0.001 * static_cast<double>(1 + b % 7);
  const std::vector<BeadRange> necklaces{{0, beads - 1}};
  expect_the_same([&] {
    StaticWrappedHierarchy<3> hierarchy(necklaces);
    hierarchy.build(Balls<3>(centers, radii));
    std::vector<double> spheres;
    for (NodeId node = 0; node < hierarchy.tree().node_count(); ++node) {
      const Sphere sphere = hierarchy.sphere(node);
      spheres.insert(spheres.end(), {sphere.center.x(), sphere.center.y(), sphere.center.z(), sphere.radius});
    }
    return spheres;
  });
}

TEST_P(InHost, ClosestPair) {
  const Eigen::Matrix3Xd centers = Eigen::Matrix3Xd::Random(3, 100);
  const std::vector<double> radii(100, 0.01);
  const BeadPairs neighbors = BeadPairs::along(100, std::vector<BeadRange>{{0, 99}});
  expect_the_same([&] {
    const auto report = closest_pair<3>(centers, radii, neighbors);
    return std::pair(report.pair->first, report.pair->second);
  });
}

INSTANTIATE_TEST_SUITE_P(All, InHost, testing::ValuesIn(host_environments));

}  // namespace
}  // namespace kds::host_environment_test
