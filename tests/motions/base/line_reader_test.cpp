#include "motions/base/input_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <zlib.h>

#include "motions/base/text_input.h"
#include "tests/motions/test_files.h"

namespace kds::line_reader_test {
namespace {

using Lines = std::vector<std::string>;

Lines lines_of(LineReader& reader) {
  Lines lines;
  for (std::string_view line; reader.next(line);) lines.emplace_back(line);
  return lines;
}

std::filesystem::path packed(const std::string& name, const std::string& piece, int times) {
  const auto path = test::temporary(name);
  const gzFile out = gzopen(path.c_str(), "wb1");
  for (int i = 0; i < times; ++i) gzwrite(out, piece.data(), static_cast<unsigned>(piece.size()));
  gzclose(out);
  return path;
}

TEST(LineReader, CutsAFileIntoItsLines) {
  LineReader reader(test::write_file("a", "one\r\n\ntwo\nthree"));
  for (int round = 0; round < 2; ++round) {
    EXPECT_EQ(lines_of(reader), (Lines{"one", "", "two", "three"}));
    EXPECT_EQ(reader.number(), 4U);
    EXPECT_TRUE(reader.cut());
    reader.rewind();
  }
  LineReader empty(test::write_file("b", ""));
  EXPECT_TRUE(lines_of(empty).empty());
}

TEST(LineReader, LinesAreWholeAcrossPieces) {
  std::string text;
  Lines expected;
  for (std::size_t k = 0; k < 3000; ++k) {
    expected.emplace_back((k * 7919) % 211, static_cast<char>('a' + k % 26));
    text += expected.back() + "\n";
  }
  expected.emplace_back(200000, 'x');
  text += expected.back() + "\n";
  LineReader plain(test::write_file("a", text)), zipped(packed("a.gz", text, 1));
  EXPECT_EQ(lines_of(plain), expected);
  EXPECT_EQ(lines_of(zipped), expected);
  EXPECT_FALSE(plain.cut());
}

TEST(LineReader, GoesBackToALine) {
  std::string text = "\xEF\xBB\xBF";
  for (int i = 1; i <= 30000; ++i) text += "line " + std::to_string(i) + "\n";
  const gzFile out = gzopen(test::temporary("b").c_str(), "wb1");
  gzwrite(out, text.data(), static_cast<unsigned>(text.size()));
  gzclose(out);
  for (const auto& path : {test::write_file("a", text), test::temporary("b")}) {
    LineReader reader(path);
    std::vector<std::uint64_t> places;
    std::string_view line;
    do places.push_back(reader.offset());
    while (reader.next(line));
    for (const std::size_t number : {1U, 2U, 30000U, 29999U, 15000U, 15001U, 1U}) {
      reader.seek(places[number - 1], number);
      ASSERT_TRUE(reader.next(line));
      EXPECT_EQ(line, "line " + std::to_string(number));
      EXPECT_EQ(reader.number(), number);
    }
    reader.seek(places[30000], 30001);
    EXPECT_FALSE(reader.next(line));
  }
}

TEST(LineReader, RefusesALineWithoutEnd) {
  const std::string zeros(1 << 20, '\0');
  for (const auto& path :
       {test::write_file("a", "line\n" + zeros + zeros), packed("a.gz", "line\n" + zeros, 9)})
    test::expect_refused(
        [&] {
          LineReader reader(path);
          (void)lines_of(reader);
        },
        {path.string(), ":2: ", "longer than 1048576"});
  test::expect_refused([&] { (void)read_whole_file(packed("b.gz", zeros, 50)); }, {"b.gz", "longer than"});
}

std::string many_lines() {
  std::string text;
  while (text.size() < 1U << 20U) text += std::string(999, 'x') + '\n';
  return text;
}

TEST(LineReader, RefusesWhatUnpacksWithoutEnd) {
  const auto bomb = packed("a.gz", many_lines(), 100);
  test::expect_refused(
      [&] {
        LineReader reader(bomb);
        (void)lines_of(reader);
      },
      {"a.gz", "unpacks to more than 100 times its size"});
  test::expect_refused([&] { (void)read_whole_file(bomb); }, {"a.gz", "unpacks to more"});
}

TEST(LineReader, ReadsRegularFilesOnlyAndWaitsForNoPipe) {
  const auto pipe = test::temporary("pipe");
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  test::expect_refused([&] { const LineReader reader(pipe); }, {pipe.string(), "is a pipe, expected a file"});
  test::expect_refused([&] { require_regular_file(pipe); }, {pipe.string(), "is a pipe"});
  test::expect_refused([&] { const LineReader reader("/dev/zero"); }, {"/dev/zero", "is a device"});
  test::expect_refused([&] { const LineReader reader(testing::TempDir()); }, {"is a folder"});
  test::expect_refused([&] { const LineReader reader("no/such"); }, {"no/such", "cannot open"});
}

// Data appended while the file is read is not read.
TEST(LineReader, AFileThatGrowsEndsWhereItEnded) {
  const auto path = test::write_file("a", "one\ntwo\n");
  LineReader reader(path);
  std::ofstream(path, std::ios::app) << "three\n";
  EXPECT_EQ(lines_of(reader), (Lines{"one", "two"}));
}

}  // namespace
}  // namespace kds::line_reader_test
