// Tests gzipped files of several members: complete, truncated, damaged, and with other data at the end.

#include "motions/base/input_file.h"

#include <gtest/gtest.h>
#include <zlib.h>

#include <random>

#include "motions/base/text_input.h"
#include "motions/readers/read_trajectory.h"
#include "tests/motions/test_files.h"
#include "tests/support/inputs/gromacs_files.h"

namespace kds::input_file_test {
namespace {

// Returns one gzip member.
std::string member(const std::string& text) {
  z_stream stream{};
  EXPECT_EQ(deflateInit2(&stream, 6, Z_DEFLATED, 16 + MAX_WBITS, 8, Z_DEFAULT_STRATEGY), Z_OK);
  std::string bytes(deflateBound(&stream, text.size()) + 32, '\0');
  std::string input = text;
  stream.next_in = reinterpret_cast<Bytef*>(input.data());
  stream.avail_in = static_cast<uInt>(input.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = static_cast<uInt>(bytes.size());
  EXPECT_EQ(deflate(&stream, Z_FINISH), Z_STREAM_END);
  bytes.resize(stream.total_out);
  deflateEnd(&stream);
  return bytes;
}

std::string unpack(const std::string& bytes) { return read_whole_file(test::write_file("a.gz", bytes)); }

void refuse(const std::string& bytes, std::initializer_list<std::string_view> parts) {
  test::expect_refused([&] { (void)unpack(bytes); }, parts);
  try {
    (void)unpack(bytes);
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).find("<fd"), std::string::npos) << error.what();
  }
}

const std::string zeros(100000, '\0');

TEST(InputFile, MembersFollowEachOther) {
  const std::string empty = member("");
  EXPECT_EQ(unpack(member("one") + member(" two")), "one two");
  EXPECT_EQ(unpack(empty + member("one") + empty + empty + member(" two") + empty), "one two");
  EXPECT_EQ(unpack(empty), "");
  std::string text, bytes;
  for (int i = 0; i < 20000; ++i) {
    text += static_cast<char>('a' + i % 26);
    bytes += member(text.substr(text.size() - 1));
  }
  EXPECT_EQ(unpack(bytes), text);
}

TEST(InputFile, ZerosMayPadTheEnd) {
  EXPECT_EQ(unpack(member("one") + '\0'), "one");
  EXPECT_EQ(unpack(member("one") + member(" two") + zeros), "one two");
}

// The second half of a file must never be dropped silently.
TEST(InputFile, OtherDataBehindAMemberAreRefused) {
  const std::string one = member("one"), two = member("two");
  const std::string at = std::to_string(one.size());
  refuse(one + "plain text\n", {"a.gz: ", "expected", "another gzip member at byte " + at, "other data"});
  refuse(one + "\x1F" + "x", {"another gzip member at byte " + at});
  refuse(one + '\0' + two, {"at byte " + at, "zeros", "at byte " + std::to_string(one.size() + 1)});
  refuse(one + zeros + two, {"at byte " + at, "zeros", "at byte " + std::to_string(one.size() + 100000)});
  refuse(one + zeros + 'x', {"at byte " + at, "zeros"});
  refuse(one + "\x1F\x8B" + "no member", {"damaged at byte", "unknown compression method"});
}

TEST(InputFile, CutAnywhere) {
  const std::string one = member("one line\n"), both = one + member("and another\n");
  for (std::size_t size = 2; size < both.size(); ++size) {
    if (size == one.size()) continue;  // a complete file
    const auto path = test::write_file("a.gz", std::string_view(both).substr(0, size));
    InputFile file(path);
    std::array<char, 100> bytes{};
    std::string text;
    EXPECT_THROW(
        {
          while (const std::size_t got = file.read(bytes.data(), bytes.size()))
            text.append(bytes.data(), got);
        },
        CutFile)
        << size;
    EXPECT_TRUE(std::string_view("one line\nand another\n").starts_with(text)) << size;
    EXPECT_TRUE(size < one.size() || text.starts_with("one line\n")) << size;
    refuse(both.substr(0, size), {"a.gz", "cut off at byte " + std::to_string(size)});
  }
}

TEST(InputFile, DamagedMembers) {
  for (const bool first : {true, false}) {
    std::string bad = member("one line\n");
    bad[bad.size() - 8] ^= 1;
    refuse(first ? bad + member("two") : member("two") + bad, {"damaged at byte", "incorrect data check"});
    bad = member("one line\n");
    bad[bad.size() - 1] ^= 1;
    refuse(first ? bad + member("two") : member("two") + bad, {"damaged at byte", "incorrect length check"});
    bad = member("one line\n");
    bad[3] = '\xE0';
    refuse(first ? bad + member("two") : member("two") + bad, {"damaged at byte", "header flags"});
  }
}

TEST(InputFile, CompressedTwice) {
  refuse(member(member("text")), {"a.gz: this file is compressed twice"});
  test::expect_refused(
      [] { (void)read_trajectory(test::write_file("a.xyz.gz", member(member("1\n\nC 0 0 0\n")))); },
      {"a.xyz.gz", "compressed twice"});
}

TEST(InputFile, SeeksInPlainAndPackedFiles) {
  std::string text, packed;
  for (int i = 0; i < 30000; ++i) text += std::to_string(i) + ' ';
  for (std::size_t begin = 0; begin < text.size(); begin += 40000)
    packed += member(text.substr(begin, 40000));
  for (const std::string& bytes : {text, packed}) {
    InputFile file(test::write_file("a", bytes));
    EXPECT_EQ(file.length().bytes, text.size());
    for (const std::size_t place :
         {std::size_t{0}, std::size_t{70001}, std::size_t{39999}, text.size() - 3}) {
      std::array<char, 5> got{};
      file.seek(place);
      EXPECT_EQ(file.offset(), place);
      const std::size_t count = file.read(got.data(), got.size());
      EXPECT_EQ(std::string_view(got.data(), count), std::string_view(text).substr(place, 5));
    }
    file.seek(text.size() + 7);
    EXPECT_EQ(file.offset(), text.size());
  }
}

// Readers of frames report it, too.
TEST(InputFile, FramesBehindAMemberAreNotLost) {
  const std::string frame = "2\n\nC 0 0 0\nC 1 0 0\n";
  const auto read = [](const std::string& name, const std::string& bytes) {
    return read_trajectory(test::write_file(name, bytes)).frames.size();
  };
  EXPECT_EQ(read("a.xyz.gz", member(frame) + member(frame)), 2U);
  EXPECT_THROW((void)read("a.xyz.gz", member(frame) + frame), InputError);
  EXPECT_EQ(read("a.xyz.gz", member(frame) + member(frame).substr(0, 1)), 1U);  // cut off, with a warning
  const test::DcdMaker maker = test::DcdMaker::chain(3, 4);
  const std::string start = maker.header() + maker.frame(0) + maker.frame(1), rest = maker.frame(2);
  EXPECT_EQ(read("a.dcd.gz", member(start) + member(rest)), 3U);
  EXPECT_THROW((void)read("a.dcd.gz", member(start) + rest), InputError);
  EXPECT_EQ(read("a.dcd.gz", member(start) + member(rest).substr(0, 1)), 2U);
}

TEST(InputFile, SeekingBackALittleUnpacksNothingAgain) {
  std::string text;
  for (int i = 0; i < 30000; ++i) text += std::to_string(i) + ' ';
  InputFile file(test::write_file("a", member(text.substr(0, 1000)) + member(text.substr(1000))));
  std::string got(10000, ' ');
  std::mt19937 random(3);
  std::uint64_t furthest = 0;
  const std::size_t restarts = InputFile::restarts();
  for (std::uint64_t place = 0; place + got.size() < text.size(); place += random() % 9000) {
    place -= std::min(place, (furthest > place ? 0 : random() % (InputFile::kept_behind + 1)));
    if (furthest > place + InputFile::kept_behind) place = furthest - InputFile::kept_behind;
    const std::size_t size = 1 + random() % got.size();
    ASSERT_TRUE(file.read_at(place, got.data(), size));
    ASSERT_EQ(std::string_view(got).substr(0, size), std::string_view(text).substr(place, size)) << place;
    ASSERT_EQ(file.offset(), place + size);
    furthest = std::max(furthest, place + size);
  }
  EXPECT_EQ(InputFile::restarts(), restarts);
  ASSERT_TRUE(file.read_at(furthest - InputFile::kept_behind - 1, got.data(), 1));
  EXPECT_EQ(InputFile::restarts(), restarts + 1);
}

// Readers look at a frame's header before its data. Opening unpacks a file to count bytes and frames, and the
// first frame is read twice, however many frames there are.
TEST(InputFile, FramesAreUnpackedInSequence) {
  test::XtcMaker xtc;
  test::TrrMaker trr;
  for (std::int32_t k = 0; k < 40; ++k) {
    auto& integers = xtc.frames.emplace_back();
    auto& reals = trr.frames.emplace_back();
    for (std::int32_t i = 0; i < 2000; ++i) {
      integers.push_back({100 * i, 7 * k, i % 13});
      reals.push_back({0.1 * i, 0.01 * k, 0.001 * (i % 13)});
    }
  }
  const std::vector<std::pair<std::string, std::string>> files{
      {"a.xtc.gz", xtc.bytes()},
      {"a.trr.gz", trr.bytes()},
      {"a.dcd.gz", test::DcdMaker::chain(2000, 40).bytes()}};
  for (const auto& [name, bytes] : files) {
    const auto path = test::write_file(name, member(bytes));
    const std::size_t restarts = InputFile::restarts();
    EXPECT_EQ(read_trajectory(path).frames.size(), 40U) << name;
    EXPECT_LE(InputFile::restarts() - restarts, 8U) << name;
  }
}

}  // namespace
}  // namespace kds::input_file_test
