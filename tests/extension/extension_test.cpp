// A certificate type, a structure, a motion and a reader, each in one file outside the tree's libraries.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "motions/readers/reader_registry.h"
#include "structures/power_diagram/power_diagram.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/extension/nearest.h"
#include "tests/extension/swinging.h"

namespace extension {
namespace {

using ::testing::HasSubstr;

TEST(Extension, AMotionDrivesStructuresOfOursAndOfOthers) {
  Swinging motion(6);
  const double rest[6][3] = {{0, 0, 0}, {4, 0, 0}, {0, 5, 0}, {0, 0, 6}, {7, 7, 7}, {-8, 1, 2}};
  const double still[3] = {0, 0, 0}, back[3] = {-6.5, -6.5, -6.5};
  for (kds::BeadId b = 0; b < 6; ++b) motion.set(b, rest[b], still);
  motion.set(4, rest[4], back);  // bead 4 passes close to bead 0, then returns
  for (const kds::Kernel kernel : {kds::Kernel::filtered, kds::Kernel::exact}) {
    kds::Simulator simulator(kds::AuditMode::events, kernel);
    Nearest nearest(simulator, motion);
    kds::PowerDiagram<3> diagram(simulator, motion);
    simulator.build();
    EXPECT_EQ(nearest.nearest(), 1U);
    simulator.run_step();
    simulator.finish();
    EXPECT_EQ(nearest.statistics.events_by_kind[0], 2U) << kds::name_of(kernel);
    EXPECT_EQ(nearest.nearest(), 1U);
    EXPECT_GT(diagram.statistics.events_per_step.front(), 0U);
  }
}

TEST(Extension, NamesAreTakenOnce) {
  EXPECT_THROW(kds::structure_registry().add({.name = "power", .make = {}}), std::logic_error);
  EXPECT_THROW(kds::reader_registry().add({"mine", {".dcd"}, false, {}}), std::logic_error);
}

TEST(Extension, AProgramRunsThemByName) {
  const kds::test::ScratchDirectory scratch;
  std::ofstream(scratch / "beads.table") << "0 0 0\n3 0 0\n0 4 0\n0 0 5\n\n0 0 0\n3 0 0\n0 2 0\n0 0 1\n";
  const auto file = [&](const char* name) { return (scratch / name).string(); };
  const auto result =
      kds::test::run_program({"run", file("beads.table"), "--structures", "nearest,power", "--audit",
                              "events", "--log", file("log"), "--dump", file("dump"), "--json", "-"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("\"overtake\": 2"));
  EXPECT_TRUE(std::filesystem::exists(scratch / "dump" / "frame-1.nearest.csv"));
  const auto replayed = kds::test::run_program({"replay", file("log")});
  EXPECT_EQ(replayed.code, 0) << replayed.err;
  const auto compared =
      kds::test::run_program({"compare", file("beads.table"), "--structures", "nearest", "--json", "-"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_THAT(compared.out, HasSubstr("\"net_changes\": 1,"));
  EXPECT_THAT(compared.out, HasSubstr("\"events_per_net_change\": 2.0"));
  const auto refused = kds::test::run_program({"run", file("beads.table"), "--structures", "farthest"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr("nearest"));
}

}  // namespace
}  // namespace extension
