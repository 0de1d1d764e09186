// Several inputs of which one is truncated or damaged, and options that hold for inputs and obstacles.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::damaged_inputs_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;
using Strings = std::vector<std::string>;

// Frame k of four beads that move along x, at height y.
std::string frame_at(double y, int k) {
  std::vector<std::string> beads;
  for (int b = 0; b < 4; ++b) beads.push_back(fmt::format("{} {} {}", 2 * b + 0.1 * k, y, 0.3 * b * b));
  return xyz(beads);
}
std::string frames_at(double y, int frames) {
  std::string text;
  for (int k = 0; k < frames; ++k) text += frame_at(y, k);
  return text;
}
std::string damaged_behind(double y, int frames) {
  std::string damaged = frame_at(y, frames);
  damaged.replace(damaged.rfind("C "), 2, "C x");
  return frames_at(y, frames) + damaged + frame_at(y, frames + 1);
}
std::string truncated_behind(double y, int frames) {
  return frames_at(y, frames) + frame_at(y, frames).substr(0, 30);
}

const std::vector<std::string> kCollide{"collide", "--radius", "1.2", "--method", "brute", "--json", "-"};
const std::vector<std::string> kRun{"run", "--radius", "1.2", "--structures", "contacts", "--json", "-"};
const std::vector<std::string> kTrade{"trade",           "--radius", "1.2", "--want",  "contacts",
                                      "--without-exact", "--rounds", "1",   "--times", "2",
                                      "--json",          "-"};

ProgramRun run_with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return run_program(arguments);
}

// The run is that of the frames before the damage.
TEST(DamagedInputs, AllInputsEndWithTheDamagedOne) {
  const ScratchDirectory scratch;
  const std::string whole = scratch.file("whole.xyz", frames_at(0, 6)),
                    rest = scratch.file("rest.xyz", frame_at(4, 0));
  const std::string damaged = scratch.file("damaged.xyz", damaged_behind(2, 3)),
                    truncated = scratch.file("truncated.xyz", truncated_behind(2, 3));
  const std::string three = scratch.file("three.xyz", frames_at(0, 3)),
                    other = scratch.file("other.xyz", frames_at(2, 3));
  for (const auto& command : {kRun, kCollide, kTrade}) {
    const ProgramRun expected = run_with(command, {three, other});
    ASSERT_EQ(expected.code, 0) << expected.err;
    for (const Strings& inputs : {Strings{whole, damaged, "--until-damage"},
                                  {whole, truncated},
                                  {whole, truncated, "--until-damage"}}) {
      SCOPED_TRACE(command.front() + " " + inputs[1]);
      const ProgramRun run = run_with(command, inputs);
      ASSERT_EQ(run.code, 0) << run.err;
      EXPECT_THAT(run.err, HasSubstr("frames are missing after frame 2, so later frames of"));
      const Json json = Json::parse(run.out), of_expected = Json::parse(expected.out);
      EXPECT_EQ(json["input"]["frames"], 3);
      EXPECT_EQ(json["input"]["truncated"], true);
      if (command == kRun) {
        EXPECT_EQ(json["fingerprint"], of_expected["fingerprint"]);
      }
      if (command == kCollide) {
        EXPECT_EQ(json["frames"], of_expected["frames"]);
      }
    }
    // The other order, and a necklace at rest beside.
    const ProgramRun beside = run_with(command, {damaged, whole, rest, "--until-damage"});
    ASSERT_EQ(beside.code, 0) << beside.err;
    EXPECT_EQ(Json::parse(beside.out)["input"]["frames"], 3);
  }
}

std::string dump_at(double y, double scale, int frames) {
  std::string text;
  for (int k = 0; k < frames; ++k) {
    text += fmt::format(
        "ITEM: TIME\n{}\nITEM: TIMESTEP\n{}\nITEM: NUMBER OF ATOMS\n4\nITEM: BOX BOUNDS ff ff ff\n0 1\n0 "
        "1\n0 1\nITEM: "
        "ATOMS id x y z\n",
        7 * k, k);
    for (int b = 0; b < 4; ++b)
      text += fmt::format("{} {} {} {}\n", b + 1, scale * (2 * b + 0.1 * k), scale * y, scale * 0.3 * b * b);
  }
  return text;
}

// --units holds for all LAMMPS dumps, --dt for inputs only.
TEST(DamagedInputs, UnitsHoldForObstaclesAndTimeStepsForInputs) {
  const ScratchDirectory scratch;
  const std::string dump = scratch.file("a.lammpstrj", dump_at(0, 0.1, 3)),
                    wall = scratch.file("wall.lammpstrj", dump_at(2, 0.1, 1));
  const std::string same = scratch.file("a.xyz", frames_at(0, 3)),
                    same_wall = scratch.file("wall.xyz", frame_at(2, 0));
  std::vector<std::string> in_nanometres{dump, "--obstacle", wall, "--units", "nano"};
  const ProgramRun run = run_with(kCollide, in_nanometres),
                   expected = run_with(kCollide, {same, "--obstacle", same_wall});
  ASSERT_EQ(run.code, 0) << run.err;
  ASSERT_EQ(expected.code, 0) << expected.err;
  const Json rows = Json::parse(run.out)["rows"][0], rows_expected = Json::parse(expected.out)["rows"][0];
  EXPECT_GT(rows["pairs"], 0);
  EXPECT_EQ(rows["pairs"], rows_expected["pairs"]);
  EXPECT_NEAR(rows["closest"]["distance"], rows_expected["closest"]["distance"], 1e-5);
  EXPECT_EQ(Json::parse(run.out)["input"]["picoseconds"], Json({0.0, 14000.0}));
  in_nanometres.insert(in_nanometres.end(), {"--dt", "5"});
  const ProgramRun timed = run_with(kCollide, in_nanometres);
  ASSERT_EQ(timed.code, 0) << timed.err;
  EXPECT_EQ(Json::parse(timed.out)["input"]["picoseconds"], Json({0.0, 10.0}));
  EXPECT_THAT(timed.err, HasSubstr("a.lammpstrj: has times of its own"));
  EXPECT_THAT(timed.err, Not(HasSubstr("wall.lammpstrj: has times of its own")));
}

}  // namespace
}  // namespace kds::test::damaged_inputs_test
