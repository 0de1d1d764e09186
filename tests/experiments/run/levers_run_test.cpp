// Runs with levers on difficult inputs, which were found by attacking the levers.

#include <gtest/gtest.h>

#include <sstream>

#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::levers_run_test {
namespace {

using namespace test;

using Beads = std::vector<std::array<double, 3>>;

std::string xyz(const std::vector<Beads>& frames) {
  std::ostringstream text;
  text.precision(17);
  for (const Beads& frame : frames) {
    text << frame.size() << "\nbeads\n";
    for (const auto& [x, y, z] : frame) text << "C " << x << ' ' << y << ' ' << z << '\n';
  }
  return text.str();
}

// A ball that almost contains its neighbour.
TEST(LeversRun, LayeredSpheresOfBallsThatNearlyHoldEachOther) {
  const ScratchDirectory directory;
  for (const int ulps : {1, 5, 15, 40}) {
    directory.file("lay.xyz", xyz({{{0, 0, 0}, {1, 0, 0}, {0, 5, 0}, {1, 5, 2}},
                                   {{0, 0, 0}, {1, 0, 0}, {0, 6, 0}, {1, 6, 2}}}));
    std::ostringstream radii;
    radii.precision(17);
    radii << 1 + ulps * 0x1p-52 << "\n1e-20\n0.5\n0.5\n";
    directory.file("radii.txt", radii.str());
    run_line("run OUT/lay.xyz --quiet --structures layered --audit frames --radius file:" +
                 (directory / "radii.txt").string(),
             directory.path());
  }
}

// No part of a step can be proved tight: the search ends at once, and the part is counted.
TEST(LeversRun, TightnessThatCannotBeProved) {
  const ScratchDirectory directory;
  const auto unproved = [](const std::string& file, const std::string& radius) {
    const auto run = run_json("run " + file +
                              " --structures wrapped --between chord --tightness 0.003 --radius " + radius);
    return run["structures"]["wrapped"]["events"]["unproved"].get<int>();
  };
  const auto moved = [](double far, double size) {
    return xyz({{{far, 0, 0}, {far + size, 0, 0}, {far, size, 0}, {far, 0, size}},
                {{far, size, 0}, {far + size, 0, size}, {far, 0, 0}, {far + size, 0, size}}});
  };
  EXPECT_GT(unproved(directory.file("far.xyz", moved(1e12, 1)), "0.5"), 0);
  EXPECT_GT(unproved(directory.file("large.xyz", moved(0, 1e100)), "1e99"), 0);
  EXPECT_GT(unproved(directory.file("small.xyz", moved(0, 1e-100)), "1e-101"), 0);
  // Two points coincide throughout.
  const std::string one = directory.file("one.xyz", xyz({{{0, 0, 0}, {0, 0, 0}, {1, 1, 0}, {0, 0, 1}},
                                                         {{1, 1, 1}, {1, 1, 1}, {0, 0, 1}, {1, 1, 0}}}));
  EXPECT_GE(unproved(one, "file:" + directory.file("points.txt", "0\n")), 0);
}

// Beads at rest stay in place, so beads in a plane stay in the plane.
TEST(LeversRun, ATolerancePutsNobodyOutOfAPlane) {
  const ScratchDirectory directory;
  std::vector<Beads> frames;
  for (int k = 0; k < 18; ++k) {
    Beads beads;
    for (int b = 0; b < 8; ++b)
      beads.push_back({b + 0.3 * ((7 * k + 3 * b) % 5), 0.1 * ((5 * k + b) % 7), 0.7});
    frames.push_back(beads);
  }
  directory.file("plane.xyz", xyz(frames));
  run_line("run OUT/plane.xyz --quiet --radius 0.5 --tolerance 0.4 --structures power --audit frames",
           directory.path());
  const auto json =
      run_json("trade OUT/plane.xyz --radius 0.5 --rounds 1 --times 10 --quiet", directory.path());
  for (const auto& row : json["rows"]) {
    if (row["setting"].contains("tolerance")) {
      EXPECT_LE(row["error"]["displacement"].get<double>(), 0.5 * 0.3 * (1 + 1e-9)) << row["setting"];
    }
  }
}

}  // namespace
}  // namespace kds::levers_run_test
