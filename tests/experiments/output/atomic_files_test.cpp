#include "experiments/output/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <string>
#include <thread>

#include "experiments/output/result_manifest.h"
#include "motions/base/input_error.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::atomic_files_test {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::ScratchDirectory;

unsigned mode_of(const fs::path& path) {
  struct stat status {};
  EXPECT_EQ(::stat(path.c_str(), &status), 0);
  return status.st_mode & 07777U;
}

// Counts entries without the manifest.
std::size_t visible_entries(const ScratchDirectory& directory) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(directory.path()))
    count += entry.path().filename().string().starts_with(".") ? 0 : 1;
  return count;
}

// Writes one result in each of the two ways.
void write_alone(const fs::path& path, const std::string& content) {
  AtomicFiles files;
  files.write(path, content);
  commit_together({&files});
}
// Lists the file in a manifest, as if an earlier result had written it.
void claim(const fs::path& path) {
  const ResultManifest manifest(path.parent_path(), "run", "--dump");
  std::ofstream(manifest.path()) << manifest.heading() << '\n'
                                 << ResultManifest::line(path, path.filename().string());
}
void write_staged(const fs::path& path, const std::string& content) {
  claim(path);
  AtomicFiles files(path.parent_path(), "run", "--dump");
  files.write(path.filename().string(), content);
  commit_together({&files});
}
constexpr auto kWays = {write_alone, write_staged};

TEST(ReplaceFile, PermissionsStay) {
  for (const auto write : kWays) {
    const ScratchDirectory directory;
    const fs::path path = directory.file("result", "old");
    for (const unsigned mode : {0640U, 0444U, 0755U}) {
      ::chmod(path.c_str(), mode);
      write(path, "new " + std::to_string(mode));
      EXPECT_EQ(content_of(path), "new " + std::to_string(mode));
      EXPECT_EQ(mode_of(path), mode);
    }
    EXPECT_EQ(visible_entries(directory), 1U);
  }
}

TEST(ReplaceFile, SymbolicLinksStay) {
  for (const auto write : kWays) {
    const ScratchDirectory directory;
    fs::create_directory(directory / "elsewhere");
    const fs::path target = directory.file("elsewhere/kept", "old"), link = directory / "result";
    fs::create_symlink("elsewhere/kept", link);
    write(link, "new");
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content_of(target), "new");
    EXPECT_EQ(std::distance(fs::directory_iterator(directory / "elsewhere"), {}), 1);
    const fs::path dangling = directory / "dangling";
    fs::create_symlink(directory / "elsewhere/made", dangling);
    write(dangling, "new");
    EXPECT_TRUE(fs::is_symlink(dangling));
    EXPECT_EQ(content_of(directory / "elsewhere/made"), "new");
  }
}

TEST(ReplaceFile, HardLinksStay) {
  for (const auto write : kWays) {
    const ScratchDirectory directory;
    const fs::path path = directory.file("result", "old and long"), other = directory / "other";
    fs::create_hard_link(path, other);
    for (const std::string& content : {std::string("short"), std::string(200000, 'x'), std::string()}) {
      write(path, content);
      EXPECT_EQ(content_of(other), content);
      EXPECT_EQ(fs::hard_link_count(path), 2U);
    }
    EXPECT_EQ(visible_entries(directory), 2U);
  }
}

// One of the places is a directory, so nothing is replaced.
TEST(AtomicFiles, ARefusedPlaceLeavesTheOthersAlone) {
  const ScratchDirectory directory;
  directory.file("a", "old");
  fs::create_directory(directory / "b");
  claim(directory / "a");
  AtomicFiles files(directory.path(), "run", "--dump");
  files.write("a", "new");
  files.write("b", "new");
  EXPECT_THROW(commit_together({&files}), InputError);
  EXPECT_EQ(content_of(directory / "a"), "old");
}

// Results of one command: if one cannot be moved to its place, none is.
TEST(AtomicFiles, AllOrNone) {
  const ScratchDirectory directory;
  const fs::path kept = directory.file("kept", "old"), circle = directory / "circle",
                 nowhere = directory / "nowhere";
  fs::create_symlink("circle", circle);
  fs::create_symlink("missing/file", nowhere);
  for (const char* place : {"circle", "nowhere"}) {
    AtomicFiles alone;
    alone.write(kept, "new");
    AtomicFiles files(directory.path(), "run", "--dump");
    files.write("a", "new");
    files.write(place, "new");
    try {
      commit_together({&alone, nullptr, &files});
      FAIL() << place;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), testing::HasSubstr((directory / place).string() + ": cannot write"));
    }
    EXPECT_EQ(content_of(kept), "old");
    EXPECT_FALSE(fs::exists(directory / "a"));
  }
  EXPECT_EQ(directory.entries(), 3U);
}

// A file that even its owner may not replace (immutable) is detected before other files are replaced. Some
// file systems lack such files, and some users may not create them.
TEST(AtomicFiles, ImmutableFilesAreFoundOutBeforehand) {
  const ScratchDirectory directory;
  const fs::path immutable = directory.file("immutable", "old"), kept = directory.file("kept", "old");
  if (std::system(("chattr +i '" + immutable.string() + "' 2>/dev/null").c_str()) != 0)
    GTEST_SKIP() << "no immutable files here";
  AtomicFiles files;
  files.write(kept, "new");
  files.write(immutable, "new");
  EXPECT_THROW(commit_together({&files}), InputError);
  EXPECT_EQ(std::system(("chattr -i '" + immutable.string() + "'").c_str()), 0);
  EXPECT_EQ(content_of(kept), "old");
}

// Clearing needs no file descriptor.
TEST(AtomicFiles, NothingIsLeftWhereFilesRunOut) {
  const ScratchDirectory directory;
  EXPECT_EXIT(
      {
        rlimit few{};
        few.rlim_cur = few.rlim_max = 8;
        ::setrlimit(RLIMIT_NOFILE, &few);
        try {
          AtomicFiles files(directory / "made", "run", "--dump");
          AtomicFiles more;
          for (int k = 0; k < 10; ++k) more.open(directory / ("file-" + std::to_string(k))) << k;
        } catch (const std::exception&) {
          ::_exit(7);
        }
      },
      testing::ExitedWithCode(7), "");
  EXPECT_EQ(directory.entries(), 0U);
}

TEST(AtomicFiles, AFileMayGrowUntilTheEnd) {
  const ScratchDirectory directory;
  {
    AtomicFiles earlier(directory.path(), "run", "--out");
    earlier.write("stale", "of an earlier result");
    commit_together({&earlier});
  }
  directory.file("mine", "the user's");
  {
    AtomicFiles files(directory.path(), "run", "--out");
    std::ostream& growing = files.open("growing");
    for (int k = 0; k < 10000; ++k) growing << k << '\n';
    files.write("other", "x");
    files.check();
    commit_together({&files});
  }
  EXPECT_EQ(content_of(directory / "growing").substr(0, 4), "0\n1\n");
  EXPECT_EQ(content_of(directory / "growing").size(), 48890U);
  EXPECT_FALSE(fs::exists(directory / "stale"));
  EXPECT_EQ(directory.entries(), 4U);  // including the manifest
}

// A signal at any moment, also between creating a file and finishing it, leaves no file behind.
TEST(UnfinishedFolder, EverySignalThatCanBeCaughtClearsTheFolder) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGALRM, SIGVTALRM, SIGPROF, SIGUSR1,
                           SIGUSR2, SIGXCPU, SIGABRT, SIGSEGV, SIGFPE, SIGRTMIN, SIGRTMAX}) {
#ifdef KDS_SANITIZED
    if (signal == SIGSEGV || signal == SIGFPE) continue;  // handled by the sanitizer
#endif
    const ScratchDirectory directory;
    EXPECT_EXIT(
        {
          AtomicFiles files(directory / "made/dump", "run", "--dump");
          for (int k = 0; k < 30; ++k) files.write("frame-" + std::to_string(k), "x");
          AtomicFiles single;
          single.open(directory / "single") << "half";
          ::raise(signal);
        },
        testing::KilledBySignal(signal), "");
    EXPECT_EQ(directory.entries(), 0U) << signal;
  }
}

// Two signals of one kind: the second arrives during the cleanup after the first. A program with one thread
// has this state only for a moment, so another thread sends the second signal while the cleanup runs.
TEST(UnfinishedFolder, ASecondSignalEndsNothingBeforeAllIsCleared) {
  const ScratchDirectory directory;
  EXPECT_EXIT(
      {
        constexpr int files = 3000;
        AtomicFiles staged(directory / "made", "run", "--dump");
        for (int k = 0; k < files; ++k) staged.write("frame-" + std::to_string(k), "x");
        const auto part = *fs::directory_iterator(directory / "made");
        const fs::path last = part.path() / std::to_string(files);  // the first file to be removed
        std::thread other([&last] {
          while (::access(last.c_str(), F_OK) == 0) {
          }
          ::raise(SIGTERM);
        });
        ::raise(SIGTERM);
        other.join();
      },
      testing::KilledBySignal(SIGTERM), "");
  EXPECT_EQ(directory.entries(), 0U);
}

TEST(UnfinishedFolder, SignalsThatDoNotEndAProgramDoNot) {
  const ScratchDirectory directory;
  EXPECT_EXIT(
      {
        const UnfinishedFolder unfinished((directory / "made").string(), 0700);
        for (const int signal : {SIGCHLD, SIGURG, SIGWINCH, SIGCONT}) ::raise(signal);
        ::_exit(7);
      },
      testing::ExitedWithCode(7), "");
}

}  // namespace
}  // namespace kds::atomic_files_test
