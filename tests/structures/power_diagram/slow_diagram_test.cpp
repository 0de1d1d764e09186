// Beads that creep, rest, or all move alike.
#include "tests/structures/power_diagram/audited_diagram.h"

namespace kds::slow_diagram_test {
namespace {

using namespace test;

// Makes beads that creep while all of them drift together.
std::vector<Space> creeping(std::mt19937& random, std::size_t beads, std::size_t frames, double step) {
  std::uniform_real_distribution<double> anywhere(0, 1), wander(-step, step);
  std::vector<Points> path(frames, Points(beads));
  for (std::size_t k = 0; k < frames; ++k) {
    for (std::size_t b = 0; b < beads; ++b) {
      for (std::size_t axis = 0; axis < 3; ++axis)
        path[k][b][axis] = k == 0 ? anywhere(random) : path[k - 1][b][axis] + 0.75 + wander(random);
    }
  }
  return through(path);
}

TEST(PowerDiagram, InSlowMotionMostFacetsRest) {
  std::mt19937 random(8);
  for (const double step : {1e-9, 1e-4, 5e-4}) {
    const auto steps = creeping(random, 40, 16, step);
    PowerRig filtered(steps.front(), step > 1e-9 ? AuditMode::events : AuditMode::frames);
    filtered.run(steps);
    PowerRig exact(steps.front(), AuditMode::none, Kernel::exact);
    exact.run(steps);
    EXPECT_EQ(filtered.simulator.fingerprint(), exact.simulator.fingerprint());
    const auto& counts = filtered.structure.statistics.certificates;
    EXPECT_EQ(counts.created, exact.structure.statistics.certificates.created);
    EXPECT_EQ(counts.never_failing, exact.structure.statistics.certificates.never_failing);
    EXPECT_TRUE(test::books_balance(filtered.structure.statistics));
    EXPECT_GT(filtered.structure.statistics.stages.slack, counts.created / 4) << step;
    EXPECT_EQ(exact.structure.statistics.stages.slack, 0U);
    if (step > 1e-9) {
      EXPECT_GT(filtered.external_events(), 0U) << step;
    }
  }
}

TEST(PowerDiagram, ATranslationGivesNoEvent) {
  const Space first = trajectory_steps("villin_hp36_300K.dcd", 0, 1).front();
  std::vector<Points> frames(11, Points(first.bead_count()));
  for (std::size_t k = 0; k < frames.size(); ++k) {
    for (BeadId b = 0; b < first.bead_count(); ++b) {
      // Whole multiples of 2^-12, so that sums are exact.
      for (int axis = 0; axis < 3; ++axis) {
        frames[k][b][static_cast<std::size_t>(axis)] =
            std::round(first.coordinate(b, 0, axis) * 4096) / 4096 + static_cast<double>(k) * (0.5 + axis);
      }
    }
  }
  PowerRig rig(moving(frames[0], frames[1]), AuditMode::frames);
  rig.run(through(frames));
  EXPECT_EQ(rig.history.events.size(), 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.failed, 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.never_failing,
            rig.structure.statistics.certificates.created);
}

}  // namespace
}  // namespace kds::slow_diagram_test
