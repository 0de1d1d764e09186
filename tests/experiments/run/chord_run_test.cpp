// Tests `kds run` with chord cages as a process: its files and its options.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "motions/numbers/exact_number.h"
#include "tests/experiments/csv_cells.h"
#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::chord_run_test {
namespace {

using testing::StartsWith;
using Json = nlohmann::ordered_json;

TEST(ChordRun, BasesDumpedAtFramesAreThoseOfTheRunWithEvents) {
  const ScratchDirectory scratch;
  for (const std::string motion : {"linear", "hermite"}) {
    for (const std::string between : {"events", "chord"})
      run_line("run VILLIN --frames 0:6 --quiet --structures wrapped --audit frames --replace --motion " +
                   motion + " --between " + between + " --dump OUT/" + between,
               scratch.path());
    for (const char* frame : {"frame-0", "frame-3", "frame-5"}) {
      const std::string file = std::string("/") + frame + ".wrapped.csv";
      const auto chord = csv_cells(scratch / ("chord" + file));
      const auto events = csv_cells(scratch / ("events" + file));
      ASSERT_EQ(chord.size(), events.size());
      ASSERT_EQ(chord.size(), 107U);
      for (std::size_t node = 0; node < chord.size(); ++node) {
        for (std::size_t k = 0; k < 3; ++k) EXPECT_EQ(chord[node][k], events[node][k]);
        for (std::size_t k = 3; k < 7; ++k)
          EXPECT_NEAR(std::stod(chord[node][k]), std::stod(events[node][k]), 1e-9);
      }
    }
  }
}

/// Returns whether one ball contains the other, with the doubles taken as exact numbers.
bool holds(const std::array<double, 3>& center, double radius, const std::array<double, 3>& bead, double r) {
  const Rational room = Rational(radius) - Rational(r);
  Rational square = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const Rational d = Rational(center[axis]) - Rational(bead[axis]);
    square += d * d;
  }
  return room >= 0 && square <= room * room;
}

// Near the origin, and so far from it that centres are rounded by more than the beads move.
TEST(ChordRun, DumpedSpheresHoldTheirBeadsExactly) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> step(-1, 1);
  for (const double far : {0.0, 1e6, 1e12}) {
    const ScratchDirectory scratch;
    constexpr std::size_t beads = 40, frames = 4;
    std::vector<std::vector<std::array<double, 3>>> positions(frames);
    std::string text;
    for (auto& frame : positions) {
      text += fmt::format("{}\nframe\n", beads);
      std::array<double, 3> place{far, -far, 0.5 * far};
      for (std::size_t b = 0; b < beads; ++b) {
        for (double& x : place) x += step(random);
        frame.push_back(place);
        text += fmt::format("C {} {} {}\n", place[0], place[1], place[2]);
      }
    }
    scratch.file("walk.xyz", text);
    for (const std::string structure : {"wrapped --between chord", "layered"}) {
      for (const double radius : {0.3, 1e-3}) {
        run_line(fmt::format("run OUT/walk.xyz --structures {} --radius {} --quiet --dump OUT/dump --replace",
                             structure, radius),
                 scratch.path());
        const std::string name = structure.substr(0, 7);
        for (std::size_t k = 0; k < frames; ++k) {
          const auto nodes = csv_cells(scratch / fmt::format("dump/frame-{}.{}.csv", k, name));
          ASSERT_EQ(nodes.size(), beads - 1);
          for (const auto& node : nodes) {
            const std::size_t at = node.size() - 4;
            const std::array center{std::stod(node[at]), std::stod(node[at + 1]), std::stod(node[at + 2])};
            for (std::size_t b = std::stoul(node[0]); b <= std::stoul(node[1]); ++b)
              ASSERT_TRUE(holds(center, std::stod(node[at + 3]), positions[k][b], radius))
                  << far << " " << structure << " frame " << k << " node " << node[0] << "-" << node[1];
          }
        }
      }
    }
  }
}

TEST(ChordRun, CountsBisectionsAndNoEvents) {
  const Json summary =
      run_json("run VILLIN --frames 0:6 --structures wrapped,layered --between chord --tightness 0.0005");
  EXPECT_EQ(summary["settings"]["between"], "chord");
  EXPECT_EQ(summary["settings"]["tightness"], "0.0005");
  const Json& wrapped = summary["structures"]["wrapped"];
  EXPECT_EQ(wrapped["events"]["total"], 0);
  EXPECT_GT(wrapped["events"]["bisection"], 0);
  EXPECT_EQ(wrapped["events"]["unproved"], 0);
  EXPECT_EQ(wrapped["certificates"]["created"], 0);
  EXPECT_EQ(summary["structures"]["layered"]["events"]["total"], 0);
}

TEST(ChordRun, WritesLayeredSpheres) {
  const ScratchDirectory scratch;
  run_line("run VILLIN --frames 0:6 --quiet --structures layered --audit frames --levels 0:2 --dump OUT/dump",
           scratch.path());
  const std::string text = content_of(scratch / "dump/frame-5.layered.csv");
  EXPECT_THAT(text, StartsWith("first,last,x,y,z,radius\n0,107,"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4);  // a header and three nodes
}

}  // namespace
}  // namespace kds::test::chord_run_test
