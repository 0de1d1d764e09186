// Inputs with one frame: topologies that are given as inputs, and obstacles.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::obstacle_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string kVillin = data_file("trajectories/villin_hp36_300K.dcd");
const std::string kVillinPdb = data_file("trajectories/villin_hp36_300K.pdb");
const std::string kModels = data_file("trajectories/1l2y.dcd");

TEST(Obstacle, TopologiesGivenAsInputsAreRefused) {
  for (const char* command : {"run", "collide", "missed", "info", "update"}) {
    expect_refused({command, kVillinPdb, kVillin, "--frames", ":3"},
                   {"villin_hp36_300K.pdb", "one frame", "--topology", "--obstacle"});
    expect_refused({command, kVillin, kVillinPdb, "--frames", ":3"}, {"villin_hp36_300K.pdb", "--topology"});
    expect_refused({command, kVillin, kVillinPdb, "--topology", kVillinPdb, "--frames", ":3"},
                   {"villin_hp36_300K.pdb", "expected one of the two", "--obstacle"});
  }
}

// A file with several models that names the atoms of a DCD is not a second necklace.
TEST(Obstacle, ModelsGivenAsInputsAreRefused) {
  for (const char* command : {"run", "collide", "info", "update"})
    expect_refused({command, data_file("proteins/1l2y.pdb"), kModels}, {"1l2y.pdb", "--topology"});
}

TEST(Obstacle, HasAChainOfItsOwn) {
  expect_refused({"run", kVillin, "--topology", kVillinPdb, "--obstacle", kVillinPdb, "--chain", "/B"},
                 {"villin_hp36_300K.pdb", "no chain", "B"});
  expect_refused({"run", kVillin, "--obstacle", kVillinPdb, "--chain", "A/B/C"}, {"--chain", "A/B/C"});
}

// A DCD with all atoms, beside a structure from which fewer beads are selected.
TEST(Obstacle, AtomsAreCountedToo) {
  const ScratchDirectory directory;
  const std::string models = content_of(data_file("proteins/1l2y.pdb"));
  const std::size_t end = models.find("ENDMDL");
  const std::string first = directory.file("first.pdb", models.substr(0, end) + "ENDMDL\nEND\n");
  expect_refused({"run", first, kModels, "--frames", ":3"},
                 {"first.pdb", "one frame and the atoms of", "--topology"});
  // A structure that names the atoms of a trajectory of models.
  expect_refused({"run", data_file("proteins/1l2y.pdb"), first, "--frames", ":3"},
                 {"first.pdb", "--obstacle"});
}

// Frames that the only input does not hold are not replaced by its one frame.
TEST(Obstacle, LoneInputsOfOneFrameRefuseOtherFrames) {
  const ScratchDirectory directory;
  const std::string wall = directory.file("wall.xyz", "2\n\nC 0 0 0\nC 2 0 0\n");
  for (const char* command : {"collide", "info"}) {
    expect_refused({command, wall, "--frames", "5:9"}, {"--frames", "frame 5", "wall.xyz holds 1 frame"});
    expect_refused({command, wall, "--frames", ":200"}, {"--frames", "frame 199", "wall.xyz holds 1 frame"});
    for (const char* range : {":1", "::3", "0:1:2"})
      EXPECT_EQ(run_program({command, wall, "--frames", range, "--quiet"}).code, 0) << range;
  }
}

// --frames selects one frame of a file that moves.
TEST(Obstacle, IsNoLongerFileOfWhichOneFrameIsRead) {
  const ScratchDirectory directory;
  const std::string frame = "2\n\nC 0 0 0\nC 2 0 0\n";
  const std::string three = directory.file("three.xyz", frame + frame + frame);
  const std::string six = directory.file("six.xyz", frame + frame + frame + frame + frame + frame);
  for (const char* command : {"run", "collide", "missed", "trade"})
    for (const char* range : {"2:", "::4"})
      expect_refused({command, three, six, "--radius", "1", "--frames", range},
                     {"three.xyz: 1 frame", "six.xyz has", "equal frame counts"});
}

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

TEST(Obstacle, Refuses) {
  expect_refused({"run", kVillin, "--obstacle", kVillin, "--frames", ":3"},
                 {"--obstacle", "several frames, expected one"});
  expect_refused({"run", kVillin, "--obstacle", "no-such-file.pdb"}, {"no-such-file.pdb"});
  expect_refused({"run", data_file("kinetic/d1_n20_linear.txt"), "--obstacle", kVillinPdb},
                 {"--obstacle", "instance"});
}

}  // namespace
}  // namespace kds::test::obstacle_test
