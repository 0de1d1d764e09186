// Inputs with one frame are obstacles.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::obstacle_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string kVillin = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kVillinPdb = data_file("trajectories/villin_hp36_300K.pdb");

TEST(Obstacle, IsANecklaceAtRest) {
  const ScratchDirectory directory;
  const auto run = [&](const std::vector<std::string>& inputs) {
    std::vector<std::string> arguments{"run"};
    arguments.insert(arguments.end(), inputs.begin(), inputs.end());
    for (const char* more :
         {"--frames", ":3", "--structures", "contacts", "--radius", "2", "--json", "-", "--quiet"})
      arguments.emplace_back(more);
    const ProgramRun result = run_program(arguments);
    EXPECT_EQ(result.code, 0) << result.err;
    return std::pair(Json::parse(result.out), result.err);
  };
  const std::string wall = directory.file("wall.xyz", "2\n\nC 0 0 0\nC 2 0 0\n");
  const auto [named, quiet] = run({kVillin, "--obstacle", wall});
  const auto [positional, told] = run({kVillin, wall});
  EXPECT_EQ(named["fingerprint"], positional["fingerprint"]);
  EXPECT_EQ(quiet.find("rests"), std::string::npos) << quiet;
  EXPECT_THAT(told, HasSubstr("wall.xyz: has one frame and rests while"));
  EXPECT_EQ(named["settings"]["obstacle"], wall);
  // The structure itself may be an obstacle if the user declares it as one.
  EXPECT_EQ(run({kVillin, "--obstacle", kVillinPdb}).first["input"]["beads"], 216);
  // The format is that of the inputs.
  EXPECT_EQ(run({kVillin, "--format", "dcd", "--obstacle", kVillinPdb}).first["input"]["beads"], 216);
}

TEST(Obstacle, IsReplayed) {
  const ScratchDirectory directory;
  const std::string wall = directory.file("wall.xyz", "2\n\nC 0 0 0\nC 2 0 0\n");
  const std::string log = (directory / "log").string();
  const ProgramRun run = run_program({"run", kVillin, "--obstacle", wall, "--frames", ":3", "--structures",
                                      "contacts", "--radius", "2", "--log", log, "--quiet"});
  ASSERT_EQ(run.code, 0) << run.err;
  const ProgramRun replay = run_program({"replay", log, "--quiet"});
  EXPECT_EQ(replay.code, 0) << replay.err;
}

}  // namespace
}  // namespace kds::test::obstacle_test
