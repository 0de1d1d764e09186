// Power diagrams of motions full of ties.
#include "tests/structures/power_diagram/audited_diagram.h"

#include "motions/base/input_error.h"
#include "tests/support/rounds.h"

namespace kds::degenerate_diagram_test {
namespace {

using namespace test;

class DegeneratePower : public testing::TestWithParam<const char*> {
 protected:
  Space motion = instance_motion<Space>(std::string("degenerate_d3_n64_") + GetParam());
};

TEST_P(DegeneratePower, AuditsPassBetweenAllEvents) {
  PowerRig rig(motion, AuditMode::events);
  Witness witness(rig.simulator, definition(rig, 40));
  ASSERT_NO_THROW(rig.run());
  EXPECT_TRUE(books_balance(rig.structure.statistics));
  expect_right_at_the_end(rig);
  const std::string name = GetParam();
  if (name == "static" || name == "rigid" || name == "gridrigid" || name == "gridscale" ||
      name == "converge") {
    EXPECT_EQ(rig.external_events(), 0U);
  }
  if (name == "half") {
    EXPECT_EQ(rig.external_events(), 1263U);
  }
  if (name == "converge") {
    EXPECT_EQ(rig.structure.at_frame(false).hidden.size(), 63U);
    EXPECT_TRUE(rig.structure.at_frame(false).cells.empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Data, DegeneratePower,
                         testing::Values("static", "half", "rigid", "gridrigid", "gridscale", "converge",
                                         "gridrand", "gridint", "swap"),
                         [](const auto& test) { return test.param; });

TEST(PowerDiagram, RandomMotionsFullOfTies) {
  std::mt19937 random(2);
  int refused = 0, ran = 0;
  for (int round = 0; round < test::rounds(400); ++round) {
    const std::size_t beads = 4 + random() % 7;
    const int range = 2 + static_cast<int>(random() % 4);
    const Points from = random_grid_points(random, beads, range);
    const Points to = random_grid_points(random, beads, range);
    SCOPED_TRACE(text_of("round ", round, ": ", to_text({from, to})));
    ++(run_audited({moving(from, to)}) ? refused : ran);
    if (HasFailure()) return;
  }
  EXPECT_GT(ran, test::rounds(350));
}

TEST(PowerDiagram, RandomFramesFullOfTies) {
  std::mt19937 random(12);
  for (int round = 0; round < test::rounds(60); ++round) {
    const std::size_t beads = 5 + random() % 6;
    std::vector<Points> frames;
    for (int k = 0; k < 4; ++k)
      frames.push_back(k > 0 && random() % 4 == 0 ? frames.back() : random_grid_points(random, beads, 3));
    SCOPED_TRACE(text_of("round ", round, ": ", to_text(frames)));
    run_audited(through(frames));
    if (HasFailure()) return;
  }
}

TEST(PowerDiagram, ExactAgreesOnMotionsFullOfTies) {
  std::mt19937 random(13);
  for (int round = 0; round < test::rounds(25); ++round) {
    const Points from = random_grid_points(random, 7, 4);
    const Points to = random_grid_points(random, 7, 4);
    SCOPED_TRACE(text_of("round ", round, ": ", to_text({from, to})));
    PowerRig filtered(moving(from, to));
    PowerRig exact(moving(from, to), AuditMode::none, Kernel::exact);
    try {
      filtered.run();
      exact.run();
    } catch (const InputError&) {
      continue;
    }
    EXPECT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint());
    if (HasFailure()) return;
  }
}

// Beads that move together hide each other in turn. The result must not depend on which facet of an event is
// handled first.
TEST(PowerDiagram, ExactAgreesOnTwinsThatStayTogether) {
  std::mt19937 random(13);
  for (int round = 0; round < test::rounds(500); ++round) {
    const std::size_t beads = 6 + 2 * (random() % 4);
    const int range = 3 + static_cast<int>(random() % 4);
    Points from = random_grid_points(random, beads, range), to = random_grid_points(random, beads, range);
    const bool weighted = random() % 2 != 0;
    for (std::size_t b = 0; b + 1 < beads; b += 2) {
      if (random() % 4 == 0) continue;
      from[b + 1] = from[b];
      to[b + 1] = to[b];
    }
    Space motion = moving(from, to);
    for (BeadId b = 0; b < beads; ++b)
      for (int k = 0; k <= 1; ++k) motion.set_weight(b, k, weighted ? b % 3 : 0);
    PowerRig filtered(motion);
    PowerRig exact(motion, AuditMode::none, Kernel::exact);
    try {
      filtered.run();
      exact.run();
    } catch (const InputError&) {
      continue;
    }
    ASSERT_EQ(exact.simulator.fingerprint(), filtered.simulator.fingerprint())
        << "round " << round << ": " << to_text({from, to});
  }
}

}  // namespace
}  // namespace kds::degenerate_diagram_test
