// Reads XTC files that mdtraj wrote, and files from a writer that shares no code with the reader.

#include "motions/readers/xtc_reader.h"

#include <gtest/gtest.h>
#include <cstring>
#include <limits>
#include <random>

#include "tests/motions/reader_files.h"
#include "tests/support/inputs/gromacs_files.h"
#include "tests/support/rounds.h"

namespace kds::xtc_reader_test {
namespace {

using test::all_atoms;
using test::read_frame;
using test::XtcMaker;

// Returns nanometres as the formats have them, in little-endian floats.
std::vector<float> floats_of(const std::filesystem::path& path) {
  const std::string bytes = test::read_bytes(path);
  std::vector<float> floats(bytes.size() / sizeof(float));
  std::memcpy(floats.data(), bytes.data(), bytes.size());
  return floats;
}

// A chain with some scattered atoms, so that groups with and without runs occur.
XtcMaker chain(std::size_t atoms, std::size_t frames, std::int32_t step, std::int32_t scatter) {
  std::mt19937 random(7);
  const auto within = [&](std::int32_t most) {
    return std::uniform_int_distribution<std::int32_t>(-most, most)(random);
  };
  XtcMaker maker;
  for (std::size_t k = 0; k < frames; ++k) {
    std::vector<XtcMaker::Atom>& frame = maker.frames.emplace_back();
    XtcMaker::Atom last{};
    for (std::size_t i = 0; i < atoms; ++i) {
      const bool far = i % 13 > 9;
      for (std::int32_t& x : last) x = far ? within(scatter) : x + within(step);
      frame.push_back(last);
    }
  }
  return maker;
}

// Compares all frames with what the maker was given, bit by bit.
void expect_frames_of(const XtcMaker& maker) {
  const auto frames = open_xtc(test::write_file("a.xtc", maker.bytes()), {});
  const FramesHeld held = frames->held();
  ASSERT_EQ(held.whole, maker.frames.size());
  EXPECT_FALSE(held.ends_inside);
  EXPECT_FALSE(held.damage);
  ASSERT_EQ(frames->atom_count(), maker.frames[0].size());
  const std::vector<std::size_t> atoms = all_atoms(*frames);
  const float inverse = 1.0F / maker.precision;
  for (std::size_t k = 0; k < held.whole; ++k) {
    const FrameRead frame = read_frame(*frames, k, atoms);
    ASSERT_EQ(static_cast<std::size_t>(frame.positions.cols()), atoms.size());
    for (std::size_t i = 0; i < atoms.size(); ++i)
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float nanometres = static_cast<float>(maker.frames[k][i][axis]) * inverse;
        ASSERT_EQ(frame.positions(static_cast<Eigen::Index>(axis), static_cast<Eigen::Index>(i)),
                  static_cast<double>(10.0F * nanometres))
            << "frame " << k << ", atom " << i << ", axis " << axis;
      }
  }
}

TEST(XtcReader, ReadsFilesOfMdtraj) {
  for (const std::string name : {"chain_and_gas", "wide", "nine_atoms"}) {
    SCOPED_TRACE(name);
    const auto frames = open_xtc(test::data_file("formats/" + name + ".xtc"), {});
    const std::vector<float> expected = floats_of(test::data_file("formats/" + name + ".f32"));
    const std::vector<std::size_t> atoms = all_atoms(*frames);
    ASSERT_EQ(expected.size(), 3 * atoms.size() * frames->held().whole);
    std::size_t place = 0;
    for (std::size_t k = 0; k < frames->held().whole; ++k) {
      const FrameRead frame = read_frame(*frames, k, atoms);
      for (Eigen::Index i = 0; i < frame.positions.size(); ++i)
        ASSERT_EQ(frame.positions.data()[i], static_cast<double>(10.0F * expected[place++]));
      EXPECT_EQ(frame.stamp.number, k);
      EXPECT_EQ(frame.stamp.picoseconds, std::vector<double>({0, 0.2, 0.4, 0.6})[k]);  // not 0.2F
      ASSERT_TRUE(frame.cell);
      EXPECT_EQ(*frame.cell, Cell(Eigen::Vector3d(100, 110, 125).asDiagonal()));
    }
  }
}

TEST(XtcReader, ReadsAllKindsOfPacking) {
  for (const std::int32_t magic : {1995, 2023})
    for (const std::int32_t scatter : {3, 500, 100'000, 9'000'000, 2'000'000'000})
      for (const std::size_t most_run : {0U, 1U, 8U, 9U})
        for (const std::size_t small : {9U, 12U, 15U, 25U})
          for (const bool change : {false, true}) {
            SCOPED_TRACE(testing::Message() << magic << " " << scatter << " " << most_run << " " << small);
            XtcMaker maker = chain(60, 2, std::min(12, scatter), scatter);
            maker.magic = magic;
            maker.most_run = most_run;
            maker.small = small;
            maker.change_small = change;
            expect_frames_of(maker);
            if (testing::Test::HasFailure()) return;
          }
}

TEST(XtcReader, ReadsEveryPrecision) {
  for (const float precision : {10.0F, 100.0F, 1234.5F, 1e6F}) {
    XtcMaker maker = chain(40, 2, 12, 5000);
    maker.precision = precision;
    expect_frames_of(maker);
  }
}

TEST(XtcReader, ReadsBeadsAtRestInOnePlace) {
  XtcMaker maker;
  maker.frames.assign(3, std::vector<XtcMaker::Atom>(30, {7, -8, 9}));
  expect_frames_of(maker);
  maker.most_run = 0;
  expect_frames_of(maker);
}

TEST(XtcReader, UpToNineAtomsAreNotPacked) {
  for (const std::size_t atoms : {1U, 2U, 9U, 10U}) expect_frames_of(chain(atoms, 3, 12, 100));
}

TEST(XtcReader, ReadsTheBoxByRows) {
  XtcMaker maker = chain(12, 2, 12, 100);
  maker.box = {5, 0, 0, 1, 4, 0, -1, 2, 3};
  auto frames = open_xtc(test::write_file("a.xtc", maker.bytes()), {});
  Cell cell;
  cell << 50, 10, -10, 0, 40, 20, 0, 0, 30;
  EXPECT_EQ(read_frame(*frames, 1, {}).cell, cell);
  maker.box = {};
  frames = open_xtc(test::write_file("a.xtc", maker.bytes()), {});
  EXPECT_FALSE(read_frame(*frames, 1, {}).cell);
}

TEST(XtcReader, ReadsAnyAtomsInAnyOrder) {
  const XtcMaker maker = chain(100'000, 1, 12, 50'000);  // some blocks of the file
  const auto frames = open_xtc(test::write_file("a.xtc", maker.bytes()), {});
  const FrameRead all = read_frame(*frames, 0);
  for (const std::vector<std::size_t>& atoms :
       {std::vector<std::size_t>{}, {0}, {3, 1, 1}, {40'000, 2}, {30'000}, {99'999, 0}, {99'998}}) {
    const FrameRead some = read_frame(*frames, 0, atoms);
    ASSERT_EQ(static_cast<std::size_t>(some.positions.cols()), atoms.size());
    for (std::size_t i = 0; i < atoms.size(); ++i)
      EXPECT_EQ(some.positions.col(static_cast<Eigen::Index>(i)),
                all.positions.col(static_cast<Eigen::Index>(atoms[i])));
  }
}

TEST(XtcReader, FramesBetweenNeedNoPositionsWithoutCell) {
  XtcMaker maker = chain(20, 2, 12, 100);
  maker.box = {};
  const auto frames = open_xtc(test::write_file("a.xtc", maker.bytes()), {});
  FrameRead frame;
  frame.asked = false;
  frames->read(1, all_atoms(*frames), frame);
  EXPECT_EQ(frame.positions.cols(), 0);
}

TEST(XtcReader, ReadsGzippedFiles) {
  const XtcMaker maker = chain(50, 4, 12, 500);
  const std::string bytes = maker.bytes();
  const auto packed = open_xtc(test::write_gzipped("a.xtc.gz", bytes), {}),
             plain = open_xtc(test::write_file("a.xtc", bytes), {});
  ASSERT_EQ(packed->held().whole, 4U);
  for (const std::size_t k : {3U, 0U})
    EXPECT_EQ(read_frame(*packed, k).positions, read_frame(*plain, k).positions);
}

// Writes a number into frame 1 of three and expects the file to be damaged there.
void expect_damage(std::size_t place, const std::string& number, const std::string& message) {
  const XtcMaker maker = chain(40, 3, 12, 500);
  std::string bytes = maker.bytes();
  const std::size_t begin = maker.frame_bytes(0).size();
  bytes.replace(begin + place, number.size(), number);
  const FramesHeld held = open_xtc(test::write_file("a.xtc", bytes), {})->held();
  EXPECT_EQ(held.whole, 1U);
  ASSERT_TRUE(held.damage) << message;
  const std::string what = held.damage->what();
  const std::string where = "a.xtc: frame 1, byte " + std::to_string(begin + place) + ": ";
  EXPECT_NE(what.find(where + message), std::string::npos) << what;
}

TEST(XtcReader, DamagedHeadersAreNamed) {
  const auto integer = [](std::int32_t value) { return test::BigEndian().integer(value).bytes(); };
  expect_damage(0, integer(1994), "expected 1995 or 2023, the numbers of XTC, found 1994");
  expect_damage(4, integer(0), "expected at least 1 atom, found 0");
  expect_damage(4, integer(41), "expected 40 atoms, found 41");
  expect_damage(52, integer(39), "expected 40 atoms, found 39");
  expect_damage(56, test::BigEndian().real(-1000).bytes(), "expected a positive precision, found -1000");
  expect_damage(56, test::BigEndian().real(std::numeric_limits<double>::quiet_NaN()).bytes(),
                "expected a positive precision, found nan");
  expect_damage(72, integer(-5000), "expected a greatest coordinate of at least");
  expect_damage(84, integer(8), "expected differences of 9 to 72 bits, found 8");
  expect_damage(84, integer(-1), "expected differences of 9 to 72 bits, found -1");
  expect_damage(88, integer(-5), "expected 10 to 520 bytes of coordinates, found -5");
  expect_damage(88, integer(9), "expected 10 to 520 bytes of coordinates, found 9");
  expect_damage(88, integer(2'000'000'000), "expected 10 to 520 bytes of coordinates, found 2000000000");
}

TEST(XtcReader, AWrongSizeIsNoCutFile) {
  const XtcMaker maker = chain(40, 4, 12, 500);
  std::string bytes = maker.bytes();
  const std::size_t begin = bytes.size() - maker.frame_bytes(3).size() - maker.frame_bytes(2).size();
  ASSERT_LT(bytes.size() - begin - 92, 520U);
  bytes.replace(begin + 88, 4, test::BigEndian().integer(520).bytes());
  const FramesHeld held = open_xtc(test::write_file("a.xtc", bytes), {})->held();
  EXPECT_EQ(held.whole, 2U);
  EXPECT_FALSE(held.ends_inside);
  ASSERT_TRUE(held.damage);
  EXPECT_NE(std::string(held.damage->what()).find("up to the next frame at byte"), std::string::npos)
      << held.damage->what();
}

TEST(XtcReader, DamagedCoordinatesAreNamed) {
  const XtcMaker maker = chain(40, 1, 12, 500);
  const std::string bytes = maker.bytes();
  const std::size_t end = bytes.size() - (4 - (bytes.size() % 4)) % 4;
  std::size_t outside = 0;
  for (std::size_t place = 92; place < end; ++place) {
    std::string damaged = bytes;
    damaged[place] = static_cast<char>(damaged[place] ^ 0x55);
    const auto frames = open_xtc(test::write_file("a.xtc", damaged), {});
    try {
      read_frame(*frames, 0);
    } catch (const DamagedFrame& damage) {
      const std::string what = damage.what();
      EXPECT_NE(what.find("a.xtc: frame 0, byte 92: expected "), std::string::npos) << what;
      outside += what.find("within the bounds") == std::string::npos ? 0 : 1;
    }
  }
  EXPECT_GT(outside, 10U);
}

TEST(XtcReader, UnusedBytesAreDamage) {
  std::string bytes = chain(40, 1, 12, 500).bytes();
  const auto size = static_cast<std::int32_t>(static_cast<unsigned char>(bytes[91]));
  bytes.replace(88, 4, test::BigEndian().integer(size + 4).bytes());
  bytes += "\1\2\3\4";
  const auto frames = open_xtc(test::write_file("a.xtc", bytes), {});
  test::expect_refused([&] { read_frame(*frames, 0); },
                       {"frame 0, byte 92: expected coordinates in " + std::to_string(size + 4) +
                        " bytes, found them in " + std::to_string(size)});
  EXPECT_EQ(read_frame(*frames, 0, std::vector<std::size_t>{38}).positions.cols(), 1);
}

}  // namespace
}  // namespace kds::xtc_reader_test
