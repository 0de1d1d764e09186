// Chains of one file side by side in a periodic cell.

#include "motions/readers/necklace_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "motions/frames/periodic.h"
#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/netcdf_maker.h"
#include "tests/support/inputs/random.h"

namespace kds::necklace_stream_test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

constexpr double box = 20;

// Chain A runs along x at y = 10, the others at y = 10 + `apart`; with `wrapped`, beads are wrapped into the
// box.
std::string models(const std::vector<double>& apart, std::size_t count, bool wrapped,
                   const std::string& group = "P 1", double drift = 0) {
  const auto inside = [&](double x) { return wrapped ? x - box * std::floor(x / box) : x; };
  std::string text;
  for (std::size_t k = 0; k < count; ++k) {
    char cell[100];
    std::snprintf(cell, sizeof cell, "CRYST1%9.3f%9.3f%9.3f  90.00  90.00  90.00 %-11s\nMODEL        1\n",
                  box, box, box, group.c_str());
    text += cell;
    for (std::size_t chain = 0; chain <= apart.size(); ++chain) {
      double y = 10;
      if (chain > 0) y += apart[chain - 1] + drift * static_cast<double>(k);
      for (int residue = 1; residue <= 3; ++residue)
        for (int atom = 0; atom < 3; ++atom)
          text += test::pdb_line({.name = std::array{"N", "CA", "C"}[static_cast<std::size_t>(atom)],
                                  .chain = static_cast<char>('A' + chain),
                                  .number = residue,
                                  .x = inside(2 + 1.4 * (3 * (residue - 1) + atom)),
                                  .y = inside(y)});
      text += "TER\n";
    }
    text += "ENDMDL\n";
  }
  return text;
}

std::vector<Trajectory> read(const std::string& text, const std::string& chains) {
  return read_trajectories(test::write_file("a.pdb", text), {.chain = chains});
}

double distance(const Trajectory& a, const Trajectory& b, std::size_t frame) {
  return (a.frames[frame].col(0) - b.frames[frame].col(0)).norm();
}

TEST(NecklaceStream, PlacesChainsNearestToTheFirst) {
  for (const double apart : {3.0, -3.0, 7.0, -6.5, 4.5, -7.25}) {
    for (const double shift : {0.0, 20.0, -20.0, 40.0, 60.0}) {
      const auto chains = read(models({apart + shift}, 3, false), "A,B");
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_NEAR(distance(chains[0], chains[1], k), std::abs(apart), 1e-9);
      EXPECT_EQ(chains[1].warnings.empty(), shift == 0) << apart << " " << shift;
      if (shift != 0) {
        EXPECT_THAT(chains[1].warnings[0], HasSubstr("chain B: moved to its periodic image nearest"));
      }
    }
  }
}

// A chain is placed near any earlier chain, not only near the first.
TEST(NecklaceStream, PlacesAChainOfALongComplex) {
  const auto whole = read(models({4, 8, 12}, 2, false), "A,B,C,D");
  const auto wrapped = read(models({4, 8, 12}, 2, true), "A,B,C,D");
  for (std::size_t n = 0; n < 4; ++n) {
    EXPECT_TRUE(whole[n].warnings.empty()) << whole[n].warnings[0];
    for (std::size_t k = 0; k < 2; ++k)
      EXPECT_LT((whole[n].frames[k] - wrapped[n].frames[k]).cwiseAbs().maxCoeff(), 1e-9);
  }
}

// A chain stays in place if its image is only slightly nearer, and a warning reports that image.
TEST(NecklaceStream, TellsOfAnImageThatIsLittleNearer) {
  const auto chains = read(models({11}, 2, false), "A,B");
  EXPECT_NEAR(distance(chains[0], chains[1], 0), 11, 1e-9);
  EXPECT_THAT(chains[1].warnings,
              ElementsAre(HasSubstr("has a periodic image nearer to the chains before it (9")));
}

TEST(NecklaceStream, TellsOfChainsThatDriftIntoAnotherImage) {
  const auto chains = read(models({3}, 5, false, "P 1", 3), "A,B");
  EXPECT_NEAR(distance(chains[0], chains[1], 4), 15, 1e-9);
  EXPECT_THAT(chains[1].warnings,
              ElementsAre(testing::AllOf(HasSubstr("frame 3: has drifted into another periodic image"),
                                         HasSubstr("(2 frames)"))));
}

TEST(NecklaceStream, CrystalsStayAsTheyAre) {
  // A single model, or a crystal's space group.
  for (const std::string& text : {models({23}, 1, false), models({23}, 2, false, "P 21 21 21")}) {
    const auto chains = read(text, "A,B");
    EXPECT_NEAR(distance(chains[0], chains[1], 0), 23, 1e-9);
    EXPECT_TRUE(chains[1].warnings.empty());
  }
}

TEST(NecklaceStream, TellsWhereACellDoesNotSuitTheBonds) {
  std::string text;
  for (int k = 0; k < 3; ++k)
    text += "4\nLattice=\"10 0 0 0 10 0 0 0 10\"\nC 0 0 0\nC 6 0 0\nC 12 0 0\nC 18 0 0\n";
  const Trajectory trajectory = read_trajectory(test::write_file("a.xyz", text));
  EXPECT_EQ(trajectory.frames[2](0, 3), 18);
  EXPECT_THAT(trajectory.warnings, ElementsAre(testing::AllOf(HasSubstr("a.xyz: frame 0: not made whole"),
                                                              HasSubstr("(3 frames)"))));
}

// Returns a frame with a chain along x whose bead 0 is at x = `begin`, in a cell of length `cell` (0: no
// cell).
std::string xyz_frame(double begin, int beads, double cell, double gap_after_1 = 0) {
  std::string text = std::to_string(beads) + '\n';
  const std::string length = std::to_string(cell);
  if (cell > 0) text += "Lattice=\"" + length + " 0 0 0 " + length + " 0 0 0 " + length + '"';
  text += '\n';
  for (int i = 0; i < beads; ++i)
    text += "C " + std::to_string(begin + 1.5 * i + (i > 1 ? gap_after_1 : 0)) + " 0 0\n";
  return text;
}

Trajectory read_xyz(const std::string& text, const ReadOptions& options = {}) {
  return read_trajectory(test::write_file("a.xyz", text), options);
}

// The cell is in nanometres by mistake, and the chain moves by 3 angstrom per frame.
TEST(NecklaceStream, DoesNotUseACellThatIsShorterThanTheChain) {
  std::string text;
  for (int k = 0; k < 4; ++k) text += xyz_frame(3 * k, 8, 5);
  const Trajectory trajectory = read_xyz(text);
  for (int k = 0; k < 4; ++k) EXPECT_EQ(trajectory.frames[static_cast<std::size_t>(k)](0, 0), 3 * k);
  EXPECT_THAT(trajectory.warnings,
              ElementsAre(testing::AllOf(
                  HasSubstr("a.xyz: frame 0: its periodic cell is not used: a chain is 10.5 long where the "
                            "cell is 5, and no bond crosses the walls"),
                  HasSubstr("(4 frames)"))));
}

// A long chain whose bonds were joined in an earlier frame keeps its cell.
TEST(NecklaceStream, UsesACellAcrossWhichBondsWereJoined) {
  const std::string joined =
      "8\nLattice=\"5 0 0 0 5 0 0 0 5\"\nC 0 0 0\nC 1.5 0 0\nC 3 0 0\nC 4.5 0 0\nC 1 0 0\nC 2.5 0 0\nC 4 0 "
      "0\nC 0.5 0 0\n";
  const Trajectory trajectory = read_xyz(joined + xyz_frame(4, 8, 5));
  EXPECT_NEAR(trajectory.frames[0](0, 7), 10.5, 1e-9);
  EXPECT_NEAR(trajectory.frames[1](0, 0), -1, 1e-9);
  EXPECT_THAT(trajectory.warnings,
              ElementsAre(HasSubstr("made whole across the periodic cell in 1 frame"),
                          HasSubstr("a.xyz: frame 1: moved as a whole to its periodic image nearest to the "
                                    "frame before, no bond crosses the walls (1 frame)")));
}

TEST(NecklaceStream, TellsOfChainsThatMoveAsAWhole) {
  const Trajectory trajectory = read_xyz(xyz_frame(0, 3, 10) + xyz_frame(8, 3, 10) + xyz_frame(7, 3, 10));
  EXPECT_NEAR(trajectory.frames[2](0, 0), -3, 1e-9);
  EXPECT_THAT(trajectory.warnings, ElementsAre(testing::AllOf(HasSubstr("a.xyz: frame 1: moved as a whole"),
                                                              HasSubstr("(2 frames)"))));
}

TEST(NecklaceStream, TellsOfBreaksInLaterFrames) {
  const std::string whole = xyz_frame(0, 6, 0), broken = xyz_frame(0, 6, 0, 5);
  const Trajectory later = read_xyz(whole + broken + whole + broken);
  EXPECT_TRUE(later.breaks.empty());
  EXPECT_EQ(later.later_breaks.frames, 2U);
  EXPECT_EQ(later.later_breaks.first_frame, 1U);
  EXPECT_THAT(later.warnings,
              ElementsAre("" + test::temporary("a.xyz").string() +
                          ": frame 1: chain break after bead 1 (joined), not in frame 0 (2 frames)"));
  // Breaks that already exist in the first frame are not reported again.
  const Trajectory first = read_xyz(broken + whole + broken);
  EXPECT_EQ(first.breaks, std::vector<std::size_t>{1});
  EXPECT_EQ(first.later_breaks.frames, 0U);
  EXPECT_EQ(first.warnings.size(), 1U);
  // Skipped frames do not count, and a second pass reports the same.
  EXPECT_EQ(read_xyz(whole + broken + whole, {.frames = {0, {}, 2}}).later_breaks.frames, 0U);
  NecklaceStream stream(test::write_file("b.xyz", whole + broken), {});
  for (int pass = 0; pass < 2; ++pass) {
    for (FrameRead frame; stream.next(frame);) {
    }
    EXPECT_EQ(stream.heads()[0].later_breaks.frames, 1U);
    EXPECT_EQ(stream.warnings(0).size(), 1U);
    stream.rewind();
  }
}

// A difference between two distances that print alike is not reported.
TEST(NecklaceStream, TellsOfNoImageThatIsNearerByRoundingOnly) {
  EXPECT_TRUE(read(models({10.001}, 2, false), "A,B")[1].warnings.empty());
  EXPECT_FALSE(read(models({10.1}, 2, false), "A,B")[1].warnings.empty());
}

// Waters in a file without names, wrapped atom by atom: no bead moves farther than it has.
TEST(NecklaceStream, FollowsUnnamedMolecules) {
  test::Random random(3);
  constexpr int waters = 30;
  Eigen::Matrix3Xd at(3, 3 * waters);
  for (int w = 0; w < waters; ++w) {
    for (int axis = 0; axis < 3; ++axis) at(axis, 3 * w) = box * 0.5 * (1 + test::uniform(random));
    at.col(3 * w + 1) = at.col(3 * w) + Eigen::Vector3d(1, 0, 0);
    at.col(3 * w + 2) = at.col(3 * w) + Eigen::Vector3d(0.3, 0.9, 0);
  }
  std::string text;
  for (int frame = 0; frame < 40; ++frame) {
    text += "90\nLattice=\"20 0 0 0 20 0 0 0 20\" Properties=species:S:1:pos:R:3\n";
    for (int w = 0; w < waters; ++w) {
      Eigen::Vector3d move;
      for (double& x : move) x = test::uniform(random);
      at.middleCols(3 * w, 3).colwise() += move;
    }
    for (Eigen::Index b = 0; b < at.cols(); ++b) {
      text += "X";
      for (const double x : at.col(b)) text += " " + std::to_string(x - box * std::floor(x / box));
      text += "\n";
    }
  }
  const Trajectory read = read_trajectory(test::write_file("waters.xyz", text));
  EXPECT_THAT(read.warnings, testing::Contains(HasSubstr("names no molecules, and some consecutive beads")));
  for (std::size_t k = 0; k < read.frames.size(); ++k) {
    if (k > 0) {
      EXPECT_LT((read.frames[k] - read.frames[k - 1]).colwise().norm().maxCoeff(), 1.8) << "frame " << k;
    }
    for (Eigen::Index b = 0; b < read.frames[k].cols(); ++b)
      EXPECT_LT((read.frames[k].col(b) - read.frames[k].col(b - b % 3)).norm(), 1.1) << "frame " << k;
  }
}

// Without a cell too, atoms of a gas are not bonded. A coil of as many beads is.
TEST(NecklaceStream, TellsAGasFromAChain) {
  test::Random random(4);
  std::string gas = "400\n\n", coil = gas;
  Eigen::Vector3d at = Eigen::Vector3d::Zero();
  for (int b = 0; b < 400; ++b) {
    for (double& x : at) x += test::uniform(random);
    const auto line = [](double x, double y, double z) {
      return "X " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    };
    gas += line(20 * test::uniform(random), 20 * test::uniform(random), 20 * test::uniform(random));
    coil += line(at.x(), at.y(), at.z());
  }
  EXPECT_FALSE(NecklaceStream(test::write_file("gas.xyz", gas), {}).chain_like());
  EXPECT_TRUE(NecklaceStream(test::write_file("coil.xyz", coil), {}).chain_like());
}

// Beads on both sides of a missing loop, across a wall, are in one image.
TEST(NecklaceStream, JoinsAnUnnamedChainAcrossAMissingLoop) {
  std::string text;
  for (int frame = 0; frame < 2; ++frame) {
    text += "20\nLattice=\"20 0 0 0 20 0 0 0 20\" Properties=species:S:1:pos:R:3\n";
    for (int b = 0; b < 20; ++b) {
      const double x = 10 + (b < 10 ? 0.5 * b : 0.5 * b + 7.5);
      text += "X " + std::to_string(x < box ? x : x - box) + " 1 1\n";
    }
  }
  const Trajectory read = read_trajectory(test::write_file("loop.xyz", text));
  for (const Eigen::Matrix3Xd& frame : read.frames) EXPECT_NEAR(frame(0, 10) - frame(0, 9), 8, 1e-9);
}

// Frames without a time must not shift the times of later frames.
TEST(NecklaceStream, TimesAreThoseOfTheirFrames) {
  test::NetcdfMaker maker = test::NetcdfMaker::chain(4, 3);
  maker.times[1] = std::numeric_limits<double>::quiet_NaN();
  const auto path = test::write_file("a.nc", maker.bytes());
  const Trajectory mixed = read_trajectory(path);
  EXPECT_TRUE(mixed.times.empty());
  EXPECT_THAT(mixed.warnings, ElementsAre(HasSubstr("1 of 3 frames have no time")));
  EXPECT_THAT(read_trajectory(path, {.frames = {0, 3, 2}}).times, ElementsAre(0, 2));
}

}  // namespace
}  // namespace kds::necklace_stream_test
