// Power diagrams with unequal weights in the plane, under curved and lifted motion, and with integers alone.
// Audits compare with CGAL over rationals and with the definition.

#include <gmock/gmock.h>

#include <algorithm>

#include "motions/base/input_error.h"
#include "motions/curves/lifted_motion.h"
#include "motions/numbers/exact_number.h"
#include "structures/power_diagram/power_diagram.h"
#include "structures/triangulation/regular_triangulation.h"
#include "tests/support/inputs/moving_beads.h"
#include "tests/support/inputs/random_motion.h"

namespace kds::weighted_diagram_test {
namespace {

using namespace test;

template <class M>
using PowerOf = PowerDiagram<M::dimension>;

TEST(WeightedDiagram, CurvedMotion) {
  using Curved = BezierMotion<3, 2>;
  Rig<PowerOf<Curved>, Curved> rig(instance_motion<Curved>("w3_n20_degree2_visible"), AuditMode::events);
  ASSERT_NO_THROW(rig.run());
  // CGAL's package reports 423 events, which contradicts both the audits and the integers.
  EXPECT_EQ(rig.external_events(), 432U);
  EXPECT_EQ(rig.structure.statistics.events_by_kind[PowerOf<Curved>::wanders], 9U);
}

// A common drift of all beads, however large, does not change the result.
TEST(LiftedDiagram, CommonDriftChangesNothing) {
  Random random(4);
  for (const double speed : {1.0, 0x1p20}) {
    auto motion = random_motion<LiftedMotion<3>>(random, 20, MotionKind::generic);
    for (BeadId b = 0; b < 20; ++b) {
      for (int axis = 0; axis < 3; ++axis) {
        motion.set_coordinate(b, 0, axis, pick(random, -1000, 1000));
        motion.set_coordinate(b, 1, axis, motion.coordinate(b, 0, axis) + speed * (axis + 1));
      }
      motion.set_weight(b, 0, b);
      motion.set_weight(b, 1, b);
    }
    motion.set_drift({speed, 2 * speed, 3 * speed});
    Rig<PowerOf<LiftedMotion<3>>, LiftedMotion<3>> rig(motion, AuditMode::events);
    ASSERT_NO_THROW(rig.run());
    EXPECT_EQ(rig.external_events(), 0U);
  }
}

}  // namespace
}  // namespace kds::weighted_diagram_test
