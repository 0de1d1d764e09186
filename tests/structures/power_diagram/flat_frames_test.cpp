// Scenes without cells: what is refused, and what is hidden.
#include "tests/structures/power_diagram/audited_diagram.h"

#include "motions/base/input_error.h"
#include "motions/models/model.h"

namespace kds::flat_frames_test {
namespace {

using namespace test;

TEST(PowerDiagram, NeedsFourBeads) {
  PowerRig rig(moving({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 1}}));
  EXPECT_THROW(rig.run(), InputError);
}

TEST(PowerDiagram, CoplanarAllTheTimeIsRefused) {
  const Points flat{{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {6, 7, 0}, {2, 3, 0}};
  const Points other{{1, 0, 0}, {4, 2, 0}, {0, 5, 0}, {6, 8, 0}, {2, 1, 0}};
  PowerRig rig(moving(flat, other));
  EXPECT_THROW(rig.run(), InputError);
}

TEST(PowerDiagram, HidesOneOfTwoBeadsInOnePlace) {
  const Points points{{0, 0, 0}, {5, 0, 1}, {0, 6, 0}, {1, 0, 7}, {6, 5, 4}, {6, 5, 4}};
  PowerRig rig(moving(points, points), AuditMode::events);
  ASSERT_NO_THROW(rig.run());
  EXPECT_EQ(rig.structure.at_frame(false).hidden.size(), 1U);
}

TEST(PowerDiagram, ATranslationGivesNoEvent) {
  std::mt19937 random(3);
  const Points from = random_grid_points(random, 60, 64);
  Points to = from;
  for (auto& p : to) p = {p[0] + 0.5, p[1] + 1.5, p[2] + 2.5};
  PowerRig rig(moving(from, to), AuditMode::frames);
  rig.run();
  EXPECT_EQ(rig.history.events.size(), 0U);
  EXPECT_EQ(rig.structure.statistics.certificates.never_failing,
            rig.structure.statistics.certificates.created);
}

// If flips block each other, only a few cells are exchanged, not the whole diagram.
TEST(PowerDiagram, BlockedFlipsAreRepairedWhereTheyAre) {
  const models::Settings settings{.beads = 343, .frames = 2, .motion = models::ShapeMotion::rotate};
  std::vector<Points> frames;
  const auto necklaces = models::generate(*models::find_model("grid"), settings);
  for (const Eigen::Matrix3Xd& frame : necklaces.front().frames) {
    frames.emplace_back();
    for (const auto& p : frame.colwise()) frames.back().push_back({p[0], p[1], p[2]});
  }
  PowerRig rig(through(frames).front());
  rig.run();
  const auto& kinds = rig.structure.statistics.events_by_kind;
  EXPECT_GT(kinds[DiagramEvents<3>::repairs], 0U);
  EXPECT_LE(kinds[DiagramEvents<3>::rebuild], 2U);
  EXPECT_EQ(kinds[DiagramEvents<3>::rebuild] + kinds[DiagramEvents<3>::repairs],
            rig.structure.statistics.rebuilds);
  EXPECT_LE(kinds[DiagramEvents<3>::clears], 40 * kinds[DiagramEvents<3>::repairs]);
}

}  // namespace
}  // namespace kds::flat_frames_test
