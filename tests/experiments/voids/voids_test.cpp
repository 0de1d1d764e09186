// Tests `kds voids`: its options, the stretches of cavities whose times are known, and its files.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "experiments/voids/voids_command.h"
#include "motions/base/input_error.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::voids_command_test {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(VoidsOptions, DefaultsAndAll) {
  const VoidsTask plain = parse_voids_options({"a.pdb"}).task;
  EXPECT_EQ(plain.radius, "element");
  EXPECT_EQ(plain.probe_length(), 1.4);
  EXPECT_EQ(plain.persistence, 0);
  const VoidsTask all = parse_voids_options({"a.pdb", "--radius", "2", "--persistence", "0.5", "--motion",
                                             "hermite", "--tunnels"})
                            .task;
  EXPECT_EQ(all.probe_length(), 0);
  EXPECT_EQ(all.persistence, 0.5);
  EXPECT_EQ(all.motion, FrameMotion::hermite);
  EXPECT_TRUE(all.tunnels && !plain.tunnels);
  EXPECT_THROW(static_cast<void>(parse_voids_options({"a.pdb", "--persistence", "-1"})), InputError);
  EXPECT_THROW(static_cast<void>(parse_voids_options({"a.pdb", "--probe", "x"})), InputError);
}

/// Eight balls of radius 1.5 at the corners of a cube, whose edges have this length in each frame. The void
/// around its centre is closed from 3 / sqrt(2) below and filled at sqrt(3) below: six faces open at once.
std::string cube(const std::vector<double>& edges) {
  std::string text;
  for (const double edge : edges) {
    text += "8\n\n";
    for (unsigned corner = 0; corner < 8; ++corner)
      text += fmt::format("C {} {} {}\n", edge * (corner & 1U), edge * (corner >> 1U & 1U),
                          edge * (corner >> 2U & 1U));
  }
  return text;
}

struct Cube {
  ScratchDirectory directory;

  Json json(const std::vector<double>& edges, std::vector<std::string> options = {}) const {
    const std::string file = directory.file("cube.xyz", cube(edges));
    options.insert(options.begin(), {"voids", file, "--radius", "1.5", "--json", "-"});
    const ProgramRun run = run_program(options);
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out);
  }
};

const double opens_at = 3 / std::numbers::sqrt2;  // balls at opposite corners of a face touch
const double fills_at = std::numbers::sqrt3;      // balls at opposite corners of the cube touch

/// Counts the points of a fine grid that are in the cube of edge 2 and outside the balls. An eighth of the
/// cube is nearest to the ball at the origin.
double outside_of_balls() {
  constexpr int points = 200;  // along an edge of the eighth
  int outside = 0;
  for (int i = 0; i < points; ++i)
    for (int j = 0; j < points; ++j)
      for (int k = 0; k < points; ++k) {
        const double x = (i + 0.5) / points, y = (j + 0.5) / points, z = (k + 0.5) / points;
        if (x * x + y * y + z * z > 1.5 * 1.5) ++outside;
      }
  return 8.0 * outside / (1.0 * points * points * points);
}

TEST(Voids, OpenAndCloseAtKnownTimes) {
  // Edges grow from 2 to 2.5 and shrink again, then the void is filled.
  const Json json = Cube().json({2, 2.5, 2, 1.5});
  ASSERT_EQ(json["rows"].size(), 1U);
  EXPECT_EQ(json["rows"][0]["openings"], 1);
  EXPECT_EQ(json["rows"][0]["ended"], "filled");
  EXPECT_EQ(json["rows"][0]["atoms"], 8);
  ASSERT_EQ(json["stretches"].size(), 2U);
  const Json &first = json["stretches"][0], &second = json["stretches"][1];
  EXPECT_EQ(first["began"], "start");
  EXPECT_EQ(first["ended"], "opened");
  EXPECT_NEAR(first["end_frame"].get<double>(), (opens_at - 2) / 0.5, 1e-11);
  EXPECT_EQ(second["began"], "closed");
  EXPECT_NEAR(second["begin_frame"].get<double>(), 2 - (opens_at - 2) / 0.5, 1e-11);
  EXPECT_NEAR(second["end_frame"].get<double>(), 2 + (2 - fills_at) / 0.5, 1e-11);
  EXPECT_EQ(json["lives"]["all"], 2);
  EXPECT_EQ(json["lives"]["complete"], 1);
  EXPECT_EQ(json["lives"]["in_no_frame"], 0);
  std::vector<int> voids;
  for (const Json& frame : json["frames"]) voids.push_back(frame["b2"].get<int>());
  EXPECT_THAT(voids, ElementsAre(1, 0, 1, 0));
  EXPECT_NEAR(json["volumes"][0]["volume"].get<double>(), outside_of_balls(), 2e-4);
}

TEST(Voids, ShortOpeningsAreBridgedAndShortCavitiesLeftOut) {
  const double open = 2 * (1 - (opens_at - 2) / 0.5);      // frames
  const std::vector<double> edges{2, 2, 2, 2.5, 2, 2, 2};  // both stretches are longer than the opening
  const Json bridged = Cube().json(edges, {"--persistence", fmt::format("{}", open + 0.01)});
  ASSERT_EQ(bridged["stretches"].size(), 1U);
  EXPECT_EQ(bridged["rows"][0]["openings"], 0);
  EXPECT_EQ(bridged["lives"]["all"], 2);  // before they are bridged
  const Json open_once = Cube().json(edges, {"--persistence", fmt::format("{}", open - 0.01)});
  ASSERT_EQ(open_once["rows"].size(), 1U);
  EXPECT_EQ(open_once["rows"][0]["openings"], 1);
  const Json none = Cube().json({2, 2.5}, {"--persistence", "0.5"});
  EXPECT_EQ(none["rows"].size(), 0U);
  EXPECT_EQ(none["short_cavities"], 1);
}

TEST(Voids, ThatNoFrameShowsAreCounted) {
  // The void closes and is filled between two frames.
  const ScratchDirectory directory;
  const std::string file = directory.file("cube.xyz", cube({2.5, 1.5}));
  const ProgramRun run = run_program({"voids", file, "--radius", "1.5"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out,
              HasSubstr("Stretches of time in which a cavity is closed: 1, of which 1 contain no frame."));
}

TEST(Voids, AreWrittenToFilesAndAPage) {
  const ScratchDirectory directory;
  const std::string file = directory.file("cube.xyz", cube({2, 2.5, 2}));
  const std::string out = directory / "out", page = directory / "out/view.html";
  const ProgramRun run =
      run_program({"voids", file, "--radius", "1.5", "--out", out, "--view", page, "--quiet"});
  EXPECT_EQ(run.code, 0) << run.err;
  for (const char* name : {"voids.json", "voids.csv", "stretches.csv", "volumes.csv", "frames.csv",
                           "zigzag.txt", "report.html", "view.html"})
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(out) / name)) << name;
}

TEST(Voids, TheZigzagLeadsToTheLastFrame) {
  const ScratchDirectory directory;
  const std::string file = directory.file("cube.xyz", cube({2, 2.5, 2.2}));
  const std::string out = directory / "out";
  ASSERT_EQ(run_program({"voids", file, "--radius", "1.5", "--out", out, "--quiet"}).code, 0);
  std::ifstream zigzag(std::filesystem::path(out) / "zigzag.txt");
  std::set<std::set<int>> complex;
  for (std::string line; std::getline(zigzag, line);) {
    std::istringstream words(line.substr(2));
    std::set<int> simplex;
    for (int bead; words >> bead;) simplex.insert(bead);
    EXPECT_TRUE(line[0] == 'i' ? complex.insert(simplex).second : complex.erase(simplex) == 1) << line;
  }
  int euler = 0;
  for (const std::set<int>& simplex : complex) euler += simplex.size() % 2 == 1 ? 1 : -1;
  // At edge 2.2, faces are open: the surface of the cube without its six faces is a sphere with six holes.
  EXPECT_EQ(euler, 2 - 6);
  EXPECT_EQ(complex.size(), 8U + 12U);
}

TEST(Voids, TunnelsLastWhileTheFacesAreOpen) {
  // Six open faces are the ends of five tunnels.
  const Json json = Cube().json({2, 2.5, 2}, {"--tunnels"});
  ASSERT_EQ(json["lives_of_tunnels"].size(), 5U);
  for (const Json& tunnel : json["lives_of_tunnels"]) {
    EXPECT_EQ(tunnel["began"], "end");  // of a triangle
    EXPECT_NEAR(tunnel["begin_frame"].get<double>(), (opens_at - 2) / 0.5, 1e-6);
    EXPECT_NEAR(tunnel["end_frame"].get<double>(), 2 - (opens_at - 2) / 0.5, 1e-6);
    EXPECT_EQ(tunnel["in_a_frame"], true);
  }
  EXPECT_EQ(Cube().json({2, 2.5, 2}, {"--tunnels", "--persistence", "1.6"})["lives_of_tunnels"].size(), 0U);
  EXPECT_EQ(Cube().json({2, 2.5, 2})["lives_of_tunnels"].size(), 0U);
}

TEST(Voids, ATunnelThatEndsAtTheFirstFrameIsKept) {
  // Balls of radius 1 on a square of side 2 touch at the first frame and then part.
  const ScratchDirectory directory;
  const std::string file = directory.file(
      "touch.xyz",
      "5\n\nC 0 0 0\nC 2 0 0\nC 2 2 0\nC 0 2 0\nC 9 9 9\n5\n\nC 0 0 0\nC 3 0 0\nC 3 3 0\nC 0 3 0\nC 9 9 9\n");
  const ProgramRun run = run_program({"voids", file, "--radius", "1", "--tunnels", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  const Json json = Json::parse(run.out);
  EXPECT_EQ(json["frames"][0]["b1"], 1);
  ASSERT_EQ(json["lives_of_tunnels"].size(), 1U);
  EXPECT_EQ(json["lives_of_tunnels"][0]["began"], "start");
  EXPECT_EQ(json["lives_of_tunnels"][0]["ended"], "end");
  EXPECT_EQ(json["lives_of_tunnels"][0]["end_frame"], 0);
  EXPECT_EQ(json["lives_of_tunnels"][0]["in_a_frame"], true);
}

TEST(Voids, OfASingleFrameAreThoseOfThisFrame) {
  const Json json = Cube().json({2});
  EXPECT_EQ(json["frames"].size(), 1U);
  EXPECT_EQ(json["frames"][0]["b2"], 1);
  ASSERT_EQ(json["rows"].size(), 1U);
  EXPECT_NEAR(json["rows"][0]["volume_median"].get<double>(), outside_of_balls(), 2e-4);
}

TEST(Voids, NeedTimesThatAdvance) {
  const ScratchDirectory directory;
  std::string text;
  for (const int time : {10, 8}) {
    text += fmt::format("cube t= {}\n    8\n", time);
    for (int corner = 0; corner < 8; ++corner)
      text += fmt::format("    1AAA      C{:5}{:8.3f}{:8.3f}{:8.3f}\n", corner + 1, 0.2 * (corner & 1),
                          0.2 * (corner >> 1 & 1), 0.2 * (corner >> 2 & 1));
    text += "   0 0 0\n";
  }
  const ProgramRun run =
      run_program({"voids", directory.file("back.gro", text), "--radius", "1.5", "--select", "all"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("the time does not advance"));
}

TEST(Voids, RefusePlanarScenes) {
  const ScratchDirectory directory;
  std::string square = "5\n\nC 0 0 0\nC 1 0 0\nC 1 1 0\nC 0 1 0\nC 0.5 2 0\n";
  const std::string flat = directory.file("flat.xyz", square + square);
  const ProgramRun run = run_program({"voids", flat, "--radius", "1"});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("kds voids expects balls in space"));
}

}  // namespace
}  // namespace kds::test::voids_command_test
