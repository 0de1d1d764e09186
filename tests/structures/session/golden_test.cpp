// Fingerprints of whole runs: the order of all events and every change. The fingerprints are equal on all
// machines and with both kernels. A fingerprint changes only for a stated reason (another event order,
// other kinds or ids of changes).

#include <gtest/gtest.h>

#include "structures/hierarchy/wrapped_hierarchy.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/sorted/sorted_list.h"
#include "tests/support/inputs/moving_beads.h"

namespace kds::golden_test {
namespace {

using namespace test;

struct Outcome {
  std::size_t events;
  std::uint64_t fingerprint;
  friend bool operator==(const Outcome&, const Outcome&) = default;
};
void PrintTo(const Outcome& outcome, std::ostream* out) {
  *out << "{" << outcome.events << ", 0x" << std::hex << outcome.fingerprint << std::dec << "U}";
}

template <class Structure, Motion M, class... Extra>
Outcome outcome(Kernel kernel, const std::vector<M>& steps, const Extra&... extra) {
  Rig<Structure, M> rig(steps.front(), AuditMode::none, kernel, extra...);
  rig.run(steps);
  return {rig.history.events.size(), rig.simulator.fingerprint()};
}

template <class Structure, Motion M, class... Extra>
void expect_outcome(const Outcome& expected, const std::vector<M>& steps, bool also_exact,
                    const Extra&... extra) {
  EXPECT_EQ(outcome<Structure>(Kernel::filtered, steps, extra...), expected);
  if (also_exact) {
    EXPECT_EQ(outcome<Structure>(Kernel::exact, steps, extra...), expected);
  }
}

TEST(Golden, Sorted) {
  using Line = BezierMotion<1, 1>;
  expect_outcome<SortedList<1>>({97, 0x4819d51aa782ffeaU},
                                std::vector{instance_motion<Line>("d1_n20_linear")}, true);
  expect_outcome<SortedList<1>>({2743, 0x70402a9ccbb11f34U},
                                std::vector{instance_motion<Line>("d1_n100_linear")}, false);
  expect_outcome<SortedList<1>>({213, 0xf85cdd0bb5face04U},
                                std::vector{instance_motion<BezierMotion<1, 3>>("d1_n20_degree3")}, true);
}

TEST(Golden, Power) {
  expect_outcome<PowerDiagram<3>>({234, 0xf5b784fc2c32e468U},
                                  std::vector{instance_motion<Space>("d3_n20_linear")}, true);
  expect_outcome<PowerDiagram<3>>({1453, 0xbc06a5029007ebbbU},
                                  std::vector{instance_motion<Space>("d3_n50_linear")}, false);
  expect_outcome<PowerDiagram<3>>({135, 0x408da1d7daac569aU}, trajectory_steps("villin_hp36_300K.dcd", 0, 3),
                                  false);
}

TEST(Golden, Wrapped) {
  const std::vector<BeadRange> twenty{{0, 19}}, villin{{0, 107}};
  expect_outcome<WrappedHierarchy<3>>({55, 0xce8073ac8c39147bU},
                                      std::vector{instance_motion<Space>("d3_n20_linear")}, true, twenty,
                                      Radii::equal);
  expect_outcome<WrappedHierarchy<3>>({102, 0xe96f1593bf983399U},
                                      trajectory_steps("villin_hp36_300K.dcd", 0, 10), true, villin,
                                      Radii::equal);
  expect_outcome<WrappedHierarchy<3>>({70, 0x3523596c8eaba307U},
                                      trajectory_steps("villin_hp36_300K.dcd", 0, 900, 300), false, villin,
                                      Radii::equal);
}

}  // namespace
}  // namespace kds::golden_test
