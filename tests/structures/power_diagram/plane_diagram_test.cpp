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

}  // namespace
}  // namespace kds::plane_diagram_test
