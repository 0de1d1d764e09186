// Images of chains are tracked through the frames that a stride skips: reading every n-th frame gives the
// n-th frames of the whole file.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"
#include "tests/support/rounds.h"

namespace kds::stride_images_test {
namespace {

using Frames = std::vector<std::vector<std::array<double, 3>>>;

constexpr double box = 12;

// Makes a random chain that drifts fast in some direction, wrapped into the box bead by bead or as a whole.
Frames drifting(std::mt19937& random, std::size_t beads, std::size_t count, double speed, bool by_bead) {
  std::uniform_real_distribution<double> unit(-1, 1);
  std::vector<std::array<double, 3>> chain(beads);
  for (std::size_t i = 1; i < beads; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) chain[i][axis] = chain[i - 1][axis] + 0.8 * unit(random);
  const std::array<double, 3> drift{speed * unit(random), speed * unit(random), speed * unit(random)};
  Frames frames;
  for (std::size_t k = 0; k < count; ++k) {
    auto& frame = frames.emplace_back(chain);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double moved = drift[axis] * static_cast<double>(k);
      for (auto& bead : frame) {
        bead[axis] += moved;
        bead[axis] -= box * std::floor((by_bead ? bead[axis] : moved) / box);
      }
    }
  }
  return frames;
}

// Frames for which `has_cell` is false are written without a cell.
std::string as_xyz(const Frames& frames, const std::vector<bool>& has_cell) {
  std::string text;
  for (std::size_t k = 0; k < frames.size(); ++k) {
    text += std::to_string(frames[k].size()) + '\n';
    if (has_cell[k]) text += "Lattice=\"12 0 0 0 12 0 0 0 12\"";
    text += '\n';
    for (const auto& bead : frames[k]) {
      char line[200];
      std::snprintf(line, sizeof line, "C %.17g %.17g %.17g\n", bead[0], bead[1], bead[2]);
      text += line;
    }
  }
  return text;
}

std::string as_dcd(const Frames& frames) {
  test::DcdMaker maker;
  maker.cell = true;
  maker.cell_values = {box, 90, box, 90, 90, box};
  for (const auto& frame : frames) {
    auto& into = maker.frames.emplace_back();
    for (const auto& bead : frame)
      into.push_back({static_cast<float>(bead[0]), static_cast<float>(bead[1]), static_cast<float>(bead[2])});
  }
  return maker.bytes();
}

std::string as_pdb(const Frames& frames) {
  std::string text = "CRYST1   12.000   12.000   12.000  90.00  90.00  90.00 P 1           1\n";
  for (const auto& frame : frames) {
    text += "MODEL        1\n";
    for (std::size_t i = 0; i < frame.size(); ++i)
      text += test::pdb_line(
          {.number = static_cast<int>(i) + 1, .x = frame[i][0], .y = frame[i][1], .z = frame[i][2]});
    text += "ENDMDL\n";
  }
  return text;
}

void expect_every_nth(const std::filesystem::path& path, std::size_t first, std::size_t stride) {
  const Trajectory all = read_trajectory(path, {.frames = {first, {}, 1}});
  const Trajectory some = read_trajectory(path, {.frames = {first, {}, stride}});
  ASSERT_EQ(some.frames.size(), 1 + (all.frames.size() - 1) / stride);
  for (std::size_t k = 0; k < some.frames.size(); ++k) {
    EXPECT_EQ(some.frame_numbers[k], first + k * stride);
    EXPECT_EQ(some.frames[k], all.frames[k * stride]) << path << " frame " << some.frame_numbers[k];
  }
}

TEST(StrideImages, EveryNthFrameOfTheWholeFile) {
  std::mt19937 random(1);
  std::uniform_int_distribution<std::size_t> beads(1, 12), stride(2, 13), first(0, 5);
  std::uniform_real_distribution<double> speed(0, 5.5);
  std::bernoulli_distribution coin(0.5), often(0.9);
  for (std::size_t round = 0; round < test::rounds(60U); ++round) {
    const bool by_bead = coin(random);
    const Frames frames = drifting(random, beads(random), 40, speed(random), by_bead);
    std::vector<bool> some(frames.size()), all(frames.size(), true);
    for (std::size_t k = 0; k < some.size(); ++k) some[k] = often(random);
    const std::size_t begin = first(random), every = stride(random);
    expect_every_nth(test::write_file("a.xyz", as_xyz(frames, all)), begin, every);
    expect_every_nth(test::write_file("b.xyz", as_xyz(frames, some)), begin, every);
    expect_every_nth(test::write_file("a.dcd", as_dcd(frames)), begin, every);
    expect_every_nth(test::write_file("a.pdb", as_pdb(frames)), begin, every);
  }
}

// A chain that moves by 10 in a box of 12 between two selected frames must not appear to move back by 2.
TEST(StrideImages, FastMotionKeepsItsDirection) {
  Frames frames;
  for (int k = 0; k <= 30; ++k) {
    auto& frame = frames.emplace_back();
    for (int i = 0; i < 4; ++i) frame.push_back({std::fmod(1.5 * i + k, box), 1, 2});
  }
  const ReadOptions options{.frames = {0, {}, 10}};
  const std::vector<bool> all(frames.size(), true), none(frames.size(), false);
  for (const auto& path :
       {test::write_file("a.xyz", as_xyz(frames, all)), test::write_file("a.dcd", as_dcd(frames)),
        test::write_file("a.pdb", as_pdb(frames))}) {
    const Trajectory trajectory = read_trajectory(path, options);
    ASSERT_EQ(trajectory.frames.size(), 4U);
    for (int k = 0; k < 4; ++k)
      EXPECT_NEAR(trajectory.frames[static_cast<std::size_t>(k)](0, 0), 10 * k, 1e-5) << path;
  }
  // Without cells the frames in between are skipped without parsing.
  std::string text = as_xyz(frames, none);
  const std::size_t second = text.find("4\n\n", 1);
  text[text.find("C ", second)] = 'X';
  const auto path = test::write_file("n.xyz", text);
  EXPECT_EQ(read_trajectory(path, {.frames = {0, {}, 30}}).frames.size(), 2U);
  EXPECT_THROW((void)read_trajectory(path), InputError);
}

// A frame that is needed to track images is checked, although it is not selected.
TEST(StrideImages, FramesBetweenAreChecked) {
  Frames frames(5, {{0, 0, 0}, {1.5, 0, 0}, {3, 0, 0}});
  std::string text = as_xyz(frames, std::vector<bool>(5, true));
  std::size_t place = 0;
  for (int k = 0; k < 3; ++k) place = text.find("3\nLattice", place + 1);  // the cell of frame 3
  text.replace(text.find("C 1.5", place), 5, "C nan");
  test::expect_refused(
      [&] {
        (void)read_trajectory(test::write_file("a.xyz", text), {.frames = {0, {}, 4}});
      },
      {"a.xyz: frame 3: bead 1 has x = nan"});
}

}  // namespace
}  // namespace kds::stride_images_test
