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

TEST(WeightedDiagram, ExactKernelAgrees) {
  for (const char* name : {"w3_n20_linear", "w3_n20_linear_movingweights"}) {
    const auto motion = instance_motion<Space>(name);
    Rig<PowerOf<Space>, Space> filtered(motion);
    filtered.run();
    Rig<PowerOf<Space>, Space> exact(motion, AuditMode::none, Kernel::exact);
    exact.run();
    EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint()) << name;
  }
}

TEST(WeightedDiagram, CurvedMotion) {
  using Curved = BezierMotion<3, 2>;
  Rig<PowerOf<Curved>, Curved> rig(instance_motion<Curved>("w3_n20_degree2_visible"), AuditMode::events);
  ASSERT_NO_THROW(rig.run());
  // CGAL's package reports 423 events, which contradicts both the audits and the integers.
  EXPECT_EQ(rig.external_events(), 432U);
  EXPECT_EQ(rig.structure.statistics.events_by_kind[PowerOf<Curved>::wanders], 9U);
}

/// Runs random motions of all kinds with audits between all events; `change` may modify each motion.
template <class M, class ChangeMotion>
void run_random(unsigned seeds, ChangeMotion change) {
  std::uint64_t hides = 0, shows = 0;
  for (unsigned seed = 0; seed < seeds; ++seed) {
    for (const MotionKind kind : all_motion_kinds) {
      if (kind == MotionKind::mixed_scales) continue;
      SCOPED_TRACE(testing::Message() << "seed " << seed << ", kind " << static_cast<int>(kind));
      Random random(1000 * seed + static_cast<unsigned>(kind));
      M motion = random_motion<M>(random, M::dimension + 2 + random() % 8, kind);
      change(motion, random, kind);
      Rig<PowerOf<M>, M> rig(motion, AuditMode::events);
      try {
        rig.run();
      } catch (const InputError&) {  // all beads on one line, or events too close for a rebuild
        continue;
      } catch (const std::exception& error) {
        FAIL() << error.what();
      }
      hides += rig.structure.statistics.events_by_kind[PowerOf<M>::hides];
      shows += rig.structure.statistics.events_by_kind[PowerOf<M>::shows];
    }
  }
  EXPECT_GT(hides, 10U);
  EXPECT_GT(shows, 10U);
}

TEST(WeightedDiagram, InThePlane) {
  run_random<BezierMotion<2, 1>>(8, [](auto&&...) {});
}

TEST(LiftedDiagram, RandomMotions) {
  run_random<LiftedMotion<3>>(6, [](LiftedMotion<3>& motion, Random& random, MotionKind kind) {
    const bool small =
        kind == MotionKind::far_away || kind == MotionKind::tiny_steps || kind == MotionKind::ulp_steps;
    LiftedMotion<3>::Vector drift{};
    for (double& x : drift)
      x = (small ? 0x1p-40 : 1.0) * (random() % 2 ? uniform(random) : pick(random, -1, 1));
    motion.set_drift(drift);
  });
}

TEST(LiftedDiagram, BringsTheDiagramFromFrameToFrame) {
  ReadOptions options;
  options.frames = {0, 4, 1};
  const Trajectory trajectory = read_trajectory(data("trajectories/villin_hp36_300K.dcd"), options);
  const Scene scene(std::span(&trajectory, 1), std::vector<double>(trajectory.bead_count(), 1.5),
                    FrameMotion::lifted);
  std::vector<LiftedMotion<3>> steps(scene.step_count(), LiftedMotion<3>(scene.bead_count()));
  for (std::size_t k = 0; k < steps.size(); ++k) scene.load(k, steps[k]);
  Rig<PowerOf<LiftedMotion<3>>, LiftedMotion<3>> rig(steps.front(), AuditMode::frames);
  ASSERT_NO_THROW(rig.run(steps));
  EXPECT_GT(rig.external_events(), 20U);
  EXPECT_EQ(rig.structure.statistics.rebuilds, 0U);
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
