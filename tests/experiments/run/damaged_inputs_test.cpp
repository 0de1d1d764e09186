// Several inputs of which one is truncated or damaged, and options that hold for inputs and obstacles.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::damaged_inputs_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

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

constexpr const char* collide = "collide --radius 1.2 --method brute ";

// The run is that of the frames before the damage.
TEST(DamagedInputs, AllInputsEndWithTheDamagedOne) {
  const ScratchDirectory scratch;
  scratch.file("whole.xyz", frames_at(0, 6));
  scratch.file("rest.xyz", frame_at(4, 0));
  scratch.file("damaged.xyz", damaged_behind(2, 3));
  scratch.file("truncated.xyz", truncated_behind(2, 3));
  scratch.file("three.xyz", frames_at(0, 3));
  scratch.file("other.xyz", frames_at(2, 3));
  for (const std::string command :
       {"run --radius 1.2 --structures contacts ", collide,
        "trade --radius 1.2 --want contacts --without-exact --rounds 1 --times 2 "}) {
    const Json expected = run_json(command + "OUT/three.xyz OUT/other.xyz", scratch.path());
    // Also in the other order, and with a necklace at rest beside.
    for (const std::string inputs :
         {"OUT/whole.xyz OUT/damaged.xyz --until-damage", "OUT/whole.xyz OUT/truncated.xyz",
          "OUT/whole.xyz OUT/truncated.xyz --until-damage",
          "OUT/damaged.xyz OUT/whole.xyz OUT/rest.xyz --until-damage"}) {
      SCOPED_TRACE(command + inputs);
      const ProgramRun run = run_line(command + inputs + " --json -", scratch.path());
      EXPECT_THAT(run.err, HasSubstr("frames are missing after frame 2, so later frames of"));
      const Json json = Json::parse(run.out);
      EXPECT_EQ(json["input"]["frames"], 3);
      EXPECT_EQ(json["input"]["truncated"], true);
      if (inputs.starts_with("OUT/damaged")) continue;
      if (command.starts_with("run")) {
        EXPECT_EQ(json["fingerprint"], expected["fingerprint"]);
      }
      if (command == collide) {
        EXPECT_EQ(json["frames"], expected["frames"]);
      }
    }
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
  scratch.file("a.lammpstrj", dump_at(0, 0.1, 3));
  scratch.file("wall.lammpstrj", dump_at(2, 0.1, 1));
  scratch.file("a.xyz", frames_at(0, 3));
  scratch.file("wall.xyz", frame_at(2, 0));
  const std::string nano =
      std::string(collide) + "OUT/a.lammpstrj --obstacle OUT/wall.lammpstrj --units nano --json - ";
  const Json found = Json::parse(run_line(nano, scratch.path()).out);
  const Json rows = found["rows"][0],
             rows_expected = run_json(std::string(collide) + "OUT/a.xyz --obstacle OUT/wall.xyz",
                                      scratch.path())["rows"][0];
  EXPECT_GT(rows["pairs"], 0);
  EXPECT_EQ(rows["pairs"], rows_expected["pairs"]);
  EXPECT_NEAR(rows["closest"]["distance"], rows_expected["closest"]["distance"], 1e-5);
  EXPECT_EQ(found["input"]["picoseconds"], Json({0.0, 14000.0}));
  const ProgramRun timed = run_line(nano + "--dt 5", scratch.path());
  EXPECT_EQ(Json::parse(timed.out)["input"]["picoseconds"], Json({0.0, 10.0}));
  EXPECT_THAT(timed.err, HasSubstr("a.lammpstrj: has times of its own"));
  EXPECT_THAT(timed.err, Not(HasSubstr("wall.lammpstrj: has times of its own")));
}

}  // namespace
}  // namespace kds::test::damaged_inputs_test
