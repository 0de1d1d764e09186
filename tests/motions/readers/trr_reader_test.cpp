// Reads a TRR file that mdtraj wrote, and files from a writer that shares no code with the reader.

#include "motions/readers/trr_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <random>

#include "tests/motions/reader_files.h"
#include "tests/support/inputs/gromacs_files.h"
#include "tests/support/rounds.h"

namespace kds::trr_reader_test {
namespace {

using test::read_frame;
using test::TrrMaker;

TrrMaker some(std::size_t atoms, std::size_t frames) {
  std::mt19937 random(9);
  std::normal_distribution<double> normal(0, 3);
  TrrMaker maker;
  maker.frames.resize(frames, std::vector<TrrMaker::Atom>(atoms));
  for (auto& frame : maker.frames)
    for (auto& atom : frame)
      for (double& x : atom) x = normal(random);
  return maker;
}

void expect_positions(const std::vector<TrrMaker::Atom>& expected, const Eigen::Matrix3Xd& found) {
  ASSERT_EQ(static_cast<std::size_t>(found.cols()), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_EQ(found(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)),
                static_cast<double>(10.0F * static_cast<float>(expected[i][axis])));
}

TEST(TrrReader, ReadsAFileOfMdtraj) {
  const auto frames = open_trr(test::data_file("formats/nine_atoms.trr"), {});
  const std::string bytes = test::read_bytes(test::data_file("formats/nine_atoms.f32"));
  ASSERT_EQ(frames->held().whole, 3U);
  ASSERT_EQ(frames->atom_count(), 9U);
  for (std::size_t k = 0; k < 3; ++k) {
    const FrameRead frame = read_frame(*frames, k);
    std::array<float, 27> expected;
    std::memcpy(expected.data(), bytes.data() + k * sizeof expected, sizeof expected);
    for (Eigen::Index i = 0; i < 27; ++i)
      EXPECT_EQ(frame.positions.data()[i],
                static_cast<double>(10.0F * expected[static_cast<std::size_t>(i)]));
    EXPECT_EQ(frame.stamp.picoseconds, std::vector<double>({0, 0.2, 0.4})[k]);
    EXPECT_EQ(frame.cell, Cell(Eigen::Vector3d(100, 110, 125).asDiagonal()));
  }
}

TEST(TrrReader, ReadsEveryLayout) {
  for (const int real : {4, 8})
    for (unsigned parts = 0; parts < 16; ++parts) {
      SCOPED_TRACE(parts);
      TrrMaker maker = some(11, 3);
      maker.real = real;
      maker.has_box = (parts & 1U) != 0;
      maker.has_tensors = (parts & 2U) != 0;
      maker.has_velocities = (parts & 4U) != 0;
      maker.has_forces = (parts & 8U) != 0;
      const auto path = test::write_file("a.trr", maker.bytes());
      const auto frames = open_trr(path, {.velocities = true});
      ASSERT_EQ(frames->held().whole, 3U);
      EXPECT_EQ(frames->may_have_cell(), maker.has_box);
      for (std::size_t k = 0; k < 3; ++k) {
        const FrameRead frame = read_frame(*frames, k);
        expect_positions(maker.frames[k], frame.positions);
        auto twice = maker.frames[k];  // as the maker writes velocities
        for (auto& atom : twice)
          for (double& x : atom) x *= 2;
        expect_positions(maker.has_velocities ? twice : std::vector<TrrMaker::Atom>(), frame.velocities);
        EXPECT_EQ(read_frame(*open_trr(path, {}), k).velocities.cols(), 0);
        EXPECT_EQ(frame.cell.has_value(), maker.has_box);
        EXPECT_DOUBLE_EQ(frame.stamp.picoseconds.value(), static_cast<double>(k) * 0.3);
      }
    }
}

TEST(TrrReader, ReadsAnyAtomsInAnyOrder) {
  const TrrMaker maker = some(50, 2);
  const auto frames = open_trr(test::write_file("a.trr", maker.bytes()), {});
  const auto& atoms = maker.frames[1];
  expect_positions({atoms[49], atoms[3], atoms[3], atoms[20]},
                   read_frame(*frames, 1, std::vector<std::size_t>{49, 3, 3, 20}).positions);
  expect_positions({}, read_frame(*frames, 1, {}).positions);
}

TEST(TrrReader, FramesWithoutPositionsAreLeftOut) {
  TrrMaker maker = some(12, 5);
  maker.has_velocities = true;
  maker.without_positions = {true, false, true, true, false};
  const auto frames = open_trr(test::write_file("a.trr", maker.bytes()), {});
  ASSERT_EQ(frames->held().whole, 2U);
  expect_positions(maker.frames[1], read_frame(*frames, 0).positions);
  expect_positions(maker.frames[4], read_frame(*frames, 1).positions);
  EXPECT_THAT(
      frames->notes(),
      testing::ElementsAre("3 frames without positions are left out; the others are numbered from 0"));
  maker.without_positions = {true, true, true, true, true};
  test::expect_refused([&] { (void)open_trr(test::write_file("a.trr", maker.bytes()), {}); },
                       {"a.trr: expected positions, found velocities or forces only in 5 frames"});
}

TEST(TrrReader, DamagedHeadersAreNamed) {
  const TrrMaker maker = some(12, 3);
  const std::size_t begin = maker.frame_bytes(0).size();
  const auto expect_damage = [&](std::size_t place, std::int32_t number, const std::string& message) {
    std::string bytes = maker.bytes();
    bytes.replace(begin + place, 4, test::BigEndian().integer(number).bytes());
    const FramesHeld held = open_trr(test::write_file("a.trr", bytes), {})->held();
    EXPECT_EQ(held.whole, 1U);
    ASSERT_TRUE(held.damage) << message;
    EXPECT_NE(std::string(held.damage->what()).find(message), std::string::npos) << held.damage->what();
    EXPECT_NE(std::string(held.damage->what()).find("a.trr: frame 1, byte "), std::string::npos);
  };
  expect_damage(0, 1994, "expected 1993 and GMX_trn_file");
  expect_damage(12, 0x474D5859, "expected 1993 and GMX_trn_file");
  expect_damage(24, 4, "expected a size of 0, found 4");
  expect_damage(32, 40, "expected a size of 0 or 36 bytes, found 40");
  expect_damage(52, 140, "expected a size of 0 or 144 bytes, found 140");
  expect_damage(56, -144, "expected a size of 0 or 144 bytes, found -144");
  expect_damage(48, -5, "expected a size of 0, found -5");
  expect_damage(64, 11, "expected 12 atoms, found 11");
  expect_damage(64, -12, "expected at least 1 atom, found -12");
}

}  // namespace
}  // namespace kds::trr_reader_test
