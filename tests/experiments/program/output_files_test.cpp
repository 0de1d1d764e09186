#include "experiments/program/output_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "motions/base/input_error.h"
#include "tests/experiments/scratch_directory.h"

namespace kds {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::ScratchDirectory;

TEST(OutputFiles, WritesAndReplacesWholeFiles) {
  const ScratchDirectory directory;
  const fs::path path = directory / "summary.json";
  write_file_atomically(path, std::string("one\0two", 7));
  EXPECT_EQ(content_of(path), std::string("one\0two", 7));
  write_file_atomically(path, "short");
  EXPECT_EQ(content_of(path), "short");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFiles, WithoutCommitNothingChanges) {
  const ScratchDirectory directory;
  const fs::path path = directory / "events.csv";
  write_file_atomically(path, "old");
  try {
    AtomicFile file(path);
    file.stream() << "half of the new";
    throw std::runtime_error("the run failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFiles, NamesThePathItCannotWrite) {
  const ScratchDirectory directory;
  for (const fs::path& path : {directory / "missing/file", directory.path()}) {
    try {
      write_file_atomically(path, "x");
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
  }
  EXPECT_EQ(directory.entries(), 0U);
}

TEST(OutputFiles, AFullDiskIsNoSuccess) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  EXPECT_THROW(write_file_atomically("/dev/full", std::string(1 << 20, 'x')), InputError);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(OutputFiles, MakesDirectoriesWithTheirParents) {
  const ScratchDirectory directory;
  ensure_directory(directory / "a/b/c", "--out");
  ensure_directory(directory / "a/b/c", "--out");
  EXPECT_TRUE(fs::is_directory(directory / "a/b/c"));
  EXPECT_TRUE(fs::is_empty(directory / "a/b/c"));
}

TEST(OutputFiles, RefusesAFileWhereADirectoryIsExpected) {
  const ScratchDirectory directory;
  directory.file("taken", "x");
  try {
    ensure_directory(directory / "taken", "--out");
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("--out"), std::string::npos);
    EXPECT_NE(message.find("taken"), std::string::npos);
    EXPECT_NE(message.find("expected a directory"), std::string::npos);
  }
  EXPECT_THROW(ensure_directory(directory / "taken/below", "--out"), InputError);
}

TEST(OutputFiles, ChecksFilesBeforeTheyAreWritten) {
  const ScratchDirectory directory;
  ensure_writable_file(directory / "new.json", "--json");
  EXPECT_EQ(directory.entries(), 0U);
  EXPECT_THROW(ensure_writable_file(directory.path(), "--json"), InputError);
  EXPECT_THROW(ensure_writable_file(directory / "missing/new.json", "--json"), InputError);
}

TEST(OutputFiles, RefusesADirectoryWithoutPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const ScratchDirectory directory;
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_THROW(ensure_directory(directory.path(), "--out"), InputError);
  EXPECT_THROW(ensure_writable_file(directory / "file", "--json"), InputError);
  fs::permissions(directory.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace kds
