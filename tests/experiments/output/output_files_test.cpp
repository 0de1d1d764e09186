#include "experiments/output/output_files.h"

#include <gtest/gtest.h>

#include <fstream>
#include <stdexcept>

#include "motions/base/input_error.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::output_files_test {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::ScratchDirectory;

void write(const fs::path& path, std::string_view content) {
  AtomicFiles files;
  files.write(path, content);
  commit_together({&files});
}

TEST(OutputFiles, WritesAndReplacesWholeFiles) {
  const ScratchDirectory directory;
  const fs::path path = directory / "summary.json";
  write(path, std::string("one\0two", 7));
  EXPECT_EQ(content_of(path), std::string("one\0two", 7));
  write(path, "short");
  EXPECT_EQ(content_of(path), "short");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFiles, WithoutCommitNothingChanges) {
  const ScratchDirectory directory;
  const fs::path path = directory / "events.csv";
  write(path, "old");
  try {
    AtomicFiles files;
    files.open(path) << "half of the new";
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
      write(path, "x");
      FAIL() << path;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
    }
  }
  EXPECT_EQ(directory.entries(), 0U);
}

TEST(OutputFiles, AFullDiskIsNoSuccess) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  for (const std::size_t size : {std::size_t{1}, std::size_t{1} << 20U}) {
    try {
      write("/dev/full", std::string(size, 'x'));
      FAIL();
    } catch (const OutputError& error) {
      EXPECT_STREQ(error.what(), "/dev/full: cannot write: No space left on device");
    }
  }
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST(OutputFiles, TellsOfAFullDiskBeforeTheEnd) {
  if (!fs::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  AtomicFiles files;
  files.open("/dev/full") << std::string(1 << 20, 'x');
  EXPECT_THROW(files.check(), OutputError);
}

TEST(AtomicFiles, MakeTheirDirectoryWithItsParentsAndRemoveItIfEmpty) {
  const ScratchDirectory directory;
  fs::create_directory(directory / "there");
  {
    const AtomicFiles made(directory / "there/a/b/", "run", "--out");
    const AtomicFiles again(directory / "there/a/b", "run", "--out");
    EXPECT_TRUE(fs::is_directory(directory / "there/a/b"));
  }
  EXPECT_TRUE(fs::is_empty(directory / "there"));
  {
    const AtomicFiles made(directory / "there/a/b/c", "run", "--out");
    directory.file("there/a/kept", "x");
  }
  EXPECT_FALSE(fs::exists(directory / "there/a/b"));
  EXPECT_TRUE(fs::exists(directory / "there/a/kept"));
  EXPECT_THROW(AtomicFiles(directory / "there/a/kept/below", "run", "--out"), InputError);
}

TEST(OutputFiles, ChecksDirectoriesBeforeTheyAreMade) {
  const ScratchDirectory directory;
  check_directory(directory / "a/b/c", "run", "--out", {"x"});
  check_directory(directory.path(), "run", "--out", {"x"});
  EXPECT_EQ(directory.entries(), 0U);
  fs::create_directories(directory / "a/x");
  EXPECT_THROW(check_directory(directory / "a", "run", "--out", {"x"}), InputError);
  EXPECT_THROW(check_directory(directory / std::string(300, 'x'), "run", "--out"), InputError);
}

TEST(AtomicFiles, AppearTogetherOrNotAtAll) {
  const ScratchDirectory directory;
  const auto entries_of = [&](const char* name) {
    return std::distance(fs::directory_iterator(directory / name), {});
  };
  {
    AtomicFiles files(directory / "made/dump", "run", "--dump");
    files.write("frame-0", "zero");
    EXPECT_EQ(entries_of("made/dump"), 1);  // a hidden entry
    EXPECT_FALSE(fs::exists(directory / "made/dump/frame-0"));
  }
  EXPECT_EQ(directory.entries(), 0U);
  {
    AtomicFiles files(directory / "dump", "run", "--dump");
    files.write("frame-0", "zero");
    files.write("frame-1", "one");
    commit_together({&files});
  }
  EXPECT_EQ(entries_of("dump"), 3);  // including the manifest
  EXPECT_EQ(content_of(directory / "dump/frame-1"), "one");
}

TEST(AtomicFiles, ClearTheFoldersOfKilledPrograms) {
  const ScratchDirectory directory;
  directory.file(".kds-1-0.part", "left behind");
  fs::create_directory(directory / ".kds-1-1.part");
  directory.file(".kds-1-1.part/frame-0", "left behind");
  directory.file(".kds-notes", "not ours");
  directory.file(".kds-a-b.part", "not ours");
  AtomicFiles single, second;
  single.write(directory / "single", "x");
  second.write(directory / "second", "x");
  EXPECT_EQ(directory.entries(), 4U);
  EXPECT_FALSE(fs::exists(directory / ".kds-1-0.part") || fs::exists(directory / ".kds-1-1.part"));
  EXPECT_TRUE(fs::exists(directory / ".kds-notes"));
  commit_together({&single, &second});  // fails if either folder was cleared
  EXPECT_EQ(content_of(directory / "single"), "x");
  EXPECT_TRUE(fs::exists(directory / ".kds-a-b.part"));
}

TEST(OutputFiles, RefusesAFileWhereADirectoryIsExpected) {
  const ScratchDirectory directory;
  directory.file("taken", "x");
  try {
    check_directory(directory / "taken", "run", "--out");
    FAIL();
  } catch (const InputError& error) {
    const std::string message = error.what();
    EXPECT_NE(message.find("--out"), std::string::npos);
    EXPECT_NE(message.find("taken"), std::string::npos);
    EXPECT_NE(message.find("expected a directory"), std::string::npos);
  }
  EXPECT_THROW(check_directory(directory / "taken/below", "run", "--out"), InputError);
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
  EXPECT_THROW(check_directory(directory.path(), "run", "--out"), InputError);
  EXPECT_THROW(ensure_writable_file(directory / "file", "--json"), InputError);
  fs::permissions(directory.path(), fs::perms::owner_all);
}

}  // namespace
}  // namespace kds::output_files_test
