#include "experiments/output/output_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <csignal>
#include <set>
#include <stdexcept>

#include "experiments/output/result_json.h"
#include "motions/base/input_error.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::output_files_test {
namespace {

namespace fs = std::filesystem;
using test::content_of;
using test::ScratchDirectory;
using testing::AllOf;
using testing::HasSubstr;

void write(const fs::path& path, std::string_view content) {
  AtomicFiles files;
  files.write(path, content);
  commit_together({&files});
}

void write_folder(const fs::path& path, std::initializer_list<const char*> names, const std::string& content,
                  bool replace = false) {
  AtomicFiles files(path, "--out", replace);
  for (const char* name : names) files.write(name, content);
  commit_together({&files});
}

std::set<std::string> names_in(const fs::path& path) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(path)) names.insert(entry.path().filename().string());
  return names;
}

template <class Function>
std::string refusal(const Function& function) {
  try {
    function();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}
std::string refused_folder(const fs::path& path, bool replace) {
  return refusal([&] { check_directory(path, "--out", replace); });
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
  const fs::path path = directory / "events.csv", folder = directory / "made/dump";
  write(path, "old");
  try {
    AtomicFiles files, more(folder, "--dump", false);
    files.open(path) << "half of the new";
    more.write("frame-0", "zero");
    EXPECT_EQ(content_of(directory / "made/dump.part/frame-0"), "zero");
    throw std::runtime_error("the run failed");
  } catch (const std::runtime_error&) {
  }
  EXPECT_EQ(content_of(path), "old");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFiles, NamesThePathItCannotWrite) {
  const ScratchDirectory directory;
  for (const fs::path& path : {directory / "missing/file", directory.path()})
    EXPECT_THAT(refusal([&] { write(path, "x"); }), HasSubstr(path.string()));
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
  AtomicFiles files;
  files.open("/dev/full") << std::string(1 << 20, 'x');
  EXPECT_THROW(files.check(), OutputError);
}

TEST(OutputFiles, AFolderAppearsWithAllItsFiles) {
  const ScratchDirectory directory;
  const fs::path folder = directory / "made/dump/";
  {
    AtomicFiles files(folder, "--dump", false);
    std::ostream& growing = files.open("growing");
    for (int k = 0; k < 10000; ++k) growing << k << '\n';
    files.write("frame-1", "one");
    files.check();
    EXPECT_FALSE(fs::exists(folder));
    commit_together({nullptr, &files});
  }
  EXPECT_EQ(content_of(folder / "growing").size(), 48890U);
  EXPECT_EQ(content_of(folder / "frame-1"), "one");
  EXPECT_EQ(names_in(folder), (std::set<std::string>{".kds-results", "growing", "frame-1"}));
  EXPECT_EQ(names_in(directory / "made"), std::set<std::string>{"dump"});
}

TEST(OutputFiles, AnEarlierResultIsReplacedOnRequestOnly) {
  const ScratchDirectory directory;
  const fs::path folder = directory / "out";
  fs::create_directory(folder);
  write_folder(folder, {"a.csv", "b.csv"}, "old");  // the folder was empty
  EXPECT_THAT(refused_folder(folder, false), AllOf(HasSubstr("holds files"), HasSubstr("--replace")));
  EXPECT_THAT(refusal([&] { write_folder(folder, {"a.csv"}, "new"); }), HasSubstr("--replace"));
  EXPECT_EQ(content_of(folder / "a.csv"), "old");
  fs::permissions(folder, fs::perms::owner_all);
  write_folder(folder, {"b.csv", "c.csv"}, "new", true);
  EXPECT_EQ(names_in(folder), (std::set<std::string>{".kds-results", "b.csv", "c.csv"}));
  EXPECT_EQ(content_of(folder / "b.csv"), "new");
  EXPECT_EQ(fs::status(folder).permissions(), fs::perms::owner_all);
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFiles, AFolderIsReplacedWhileACommandGoesOn) {
  const ScratchDirectory directory;
  AtomicFiles files(directory / "out", "--out", false);
  UnnamedFile list;
  for (const char* const line : {"a", "b"}) {
    list.stream() << line;
    list.copy_to(files.open("list"));
    EXPECT_EQ(files.commit_and_begin_anew(), std::nullopt);
    EXPECT_TRUE(std::filesystem::exists(directory / "out.part"));  // the place stays taken
  }
  EXPECT_EQ(content_of(directory / "out" / "list"), "ab");
  static_cast<void>(directory.file("out/list", "mine"));
  files.write("list", "abc");
  EXPECT_THAT(files.commit_and_begin_anew(), testing::Optional(testing::HasSubstr("list there has changed")));
  EXPECT_EQ(content_of(directory / "out" / "list"), "mine");
  static_cast<void>(directory.file("out/list", "ab"));
  files.write("list", "abcd");
  commit_together({&files});
  EXPECT_EQ(content_of(directory / "out" / "list"), "abcd");
  EXPECT_EQ(directory.entries(), 1U);
}

TEST(OutputFiles, NothingOfTheUsersIsReplaced) {
  const ScratchDirectory directory;
  const fs::path folder = directory / "out";
  const auto expect_kept = [&](const char* name, const char* reason) {
    EXPECT_THAT(refused_folder(folder, true), AllOf(HasSubstr(name), HasSubstr(reason)));
    EXPECT_NE(refusal([&] { write_folder(folder, {"b.csv"}, "new", true); }), "");
    EXPECT_TRUE(fs::exists(fs::symlink_status(folder / name))) << name;
  };
  fs::create_directory(folder);
  directory.file("out/notes", "mine");
  expect_kept("notes", "is not of an earlier result");  // kds has written nothing there
  fs::remove(folder / "notes");
  const std::string older = directory.file("older", "mine");
  write_folder(folder, {"a.csv", "b.csv"}, "old");
  fs::copy(older, folder / "notes");
  fs::last_write_time(folder / "notes", fs::last_write_time(older));
  expect_kept("notes", "is not of an earlier result");
  fs::remove(folder / "notes");
  fs::create_directory(folder / "more");
  expect_kept("more", "is not of an earlier result");
  fs::remove(folder / "more");
  fs::rename(folder / "a.csv", directory / "moved");
  fs::create_symlink(directory / "moved", folder / "a.csv");
  expect_kept("a.csv", "is not of an earlier result");
  fs::rename(older, folder / "a.csv");
  expect_kept("a.csv", "has changed since kds wrote it");
  EXPECT_EQ(content_of(folder / "a.csv"), "mine");
  fs::remove(folder / "a.csv");
  fs::create_directory(directory / "out.old");
  EXPECT_THAT(refused_folder(folder, true), HasSubstr("out.old away"));
  EXPECT_EQ(content_of(folder / "b.csv"), "old");
}

// Files that appear in the directory during the run stay, and so does the result.
TEST(OutputFiles, AResultThatCannotTakeItsPlaceIsNotLost) {
  const ScratchDirectory directory;
  AtomicFiles files(directory / "out", "--out", true);
  files.write("a.csv", "new");
  fs::create_directory(directory / "out");
  directory.file("out/notes", "mine");
  EXPECT_THAT(refusal([&] { commit_together({&files}); }), HasSubstr("so the result stays in"));
  EXPECT_EQ(content_of(directory / "out/notes"), "mine");
  EXPECT_EQ(content_of(directory / "out.part/a.csv"), "new");
}

TEST(OutputFiles, APlaceInUseIsRefused) {
  const ScratchDirectory directory;
  AtomicFiles files(directory / "out", "--out", false), single;
  files.write("a.csv", "first");
  single.write(directory / "single", "first");
  EXPECT_THAT(refused_folder(directory / "out", false), HasSubstr("another run writes to"));
  EXPECT_THAT(refusal([&] { write(directory / "single", "x"); }), HasSubstr("another run writes to"));
  commit_together({&files, &single});
  EXPECT_EQ(content_of(directory / "out/a.csv"), "first");
  EXPECT_EQ(content_of(directory / "single"), "first");
}

TEST(OutputFiles, APartThatKdsDidNotWriteStays) {
  const ScratchDirectory directory;
  fs::create_directory(directory / "out.part");
  directory.file("out.part/notes", "mine");
  directory.file("single.part", "mine");
  EXPECT_THAT(refused_folder(directory / "out", true), HasSubstr("is in the way: notes there"));
  EXPECT_NE(refusal([&] { write(directory / "single", "x"); }), "");
  EXPECT_EQ(content_of(directory / "out.part/notes"), "mine");
  EXPECT_EQ(content_of(directory / "single.part"), "mine");
}

// PLACE.part is cleared only if it is what a killed program left.
TEST(OutputFiles, AnotherResultNamedPartStays) {
  const ScratchDirectory directory;
  const auto expect_kept = [&](const char* place, const char* file, const char* reason) {
    EXPECT_THAT(refused_folder(directory / place, true),
                AllOf(HasSubstr("is in the way"), HasSubstr(reason)));
    EXPECT_NE(refusal([&] { write(directory / place, "x"); }), "");
    EXPECT_TRUE(fs::exists(directory / file)) << file;
  };
  write_folder(directory / "a.part", {"a.csv"}, "whole");
  expect_kept("a", "a.part/a.csv", "holds a complete result");
  directory.file("a.part/notes", "mine");
  expect_kept("a", "a.part/notes", "notes there is not of an earlier result");
  write_folder(directory / "elsewhere", {"b.csv"}, "whole");
  fs::create_directory_symlink(directory / "elsewhere", directory / "b.part");
  expect_kept("b", "elsewhere/b.csv", "is not a directory");
  EXPECT_EXIT(
      {
        AtomicFiles files(directory / "c", "--out", false);
        files.write("c.csv", "half");
        ::raise(SIGKILL);
      },
      testing::KilledBySignal(SIGKILL), "");
  directory.file("c.part/notes", "mine");
  expect_kept("c", "c.part/notes", "notes there is not of an earlier result");
}

// A change is one of content: neither a copy nor new permissions hide or feign one.
TEST(OutputFiles, ChangesAreThoseOfContent) {
  const ScratchDirectory directory;
  write_folder(directory / "out", {"a.csv", "b.csv"}, "old");
  fs::copy(directory / "out", directory / "copied");
  ::chmod((directory / "copied/a.csv").c_str(), 0600);
  write_folder(directory / "copied", {"a.csv"}, "new", true);
  EXPECT_EQ(content_of(directory / "copied/a.csv"), "new");
  directory.file("out/b.csv", "odd");  // as long as before
  for (const char* name : {"a.csv", "b.csv", ".kds-results"})
    ::chmod((directory / "out" / name).c_str(), 0660);
  EXPECT_THAT(refused_folder(directory / "out", true), HasSubstr("b.csv there has changed since"));
}

TEST(OutputFiles, PermissionsAndSymbolicLinksStay) {
  const ScratchDirectory directory;
  fs::create_directory(directory / "elsewhere");
  const fs::path target = directory.file("elsewhere/kept", "old"), link = directory / "result",
                 dangling = directory / "dangling", circle = directory / "circle";
  fs::create_symlink("elsewhere/kept", link);
  for (const unsigned mode : {0640U, 0444U, 0755U}) {
    ::chmod(target.c_str(), mode);
    write(link, std::to_string(mode));
    EXPECT_TRUE(fs::is_symlink(link));
    EXPECT_EQ(content_of(target), std::to_string(mode));
    struct stat status {};
    EXPECT_EQ(::stat(target.c_str(), &status), 0);
    EXPECT_EQ(status.st_mode & 07777U, mode);
  }
  fs::create_symlink(directory / "elsewhere/made", dangling);
  write(dangling, "new");
  EXPECT_TRUE(fs::is_symlink(dangling));
  EXPECT_EQ(content_of(directory / "elsewhere/made"), "new");
  fs::create_symlink("circle", circle);
  EXPECT_THAT(refusal([&] { write(circle, "x"); }), HasSubstr("circle: cannot write"));
  fs::create_directory_symlink("elsewhere/folder", directory / "there");
  write_folder(directory / "there", {"a.csv"}, "new");
  EXPECT_EQ(content_of(directory / "elsewhere/folder/a.csv"), "new");
  EXPECT_EQ(names_in(directory / "elsewhere"), (std::set<std::string>{"kept", "made", "folder"}));
}

TEST(OutputFiles, ChecksLeaveNoTrace) {
  const ScratchDirectory directory;
  EXPECT_EQ(refused_folder(directory / "a/b/c", false), "");
  EXPECT_EQ(refused_folder(directory / "a", false), "");
  EXPECT_NE(refused_folder(directory / std::string(300, 'x'), false), "");
  EXPECT_THAT(refused_folder(fs::current_path(), true), HasSubstr("is the working directory"));
  EXPECT_THAT(refused_folder("/proc", true), HasSubstr("is a mount point"));
  ensure_writable_file(directory / "new.json", "--json");
  EXPECT_EQ(directory.entries(), 0U);
  EXPECT_THROW(ensure_writable_file(directory.path(), "--json"), InputError);
  EXPECT_THROW(ensure_writable_file(directory / "missing/new.json", "--json"), InputError);
  directory.file("taken", "x");
  EXPECT_THAT(refused_folder(directory / "taken", true),
              AllOf(HasSubstr("--out"), HasSubstr("taken: is a file")));
  EXPECT_THAT(refused_folder(directory / "taken/below", true), HasSubstr("expected a directory"));
}

TEST(OutputFiles, RefusesADirectoryWithoutPermission) {
  if (::geteuid() == 0) GTEST_SKIP() << "root may write everywhere";
  const ScratchDirectory directory;
  fs::permissions(directory.path(), fs::perms::owner_read | fs::perms::owner_exec);
  EXPECT_NE(refused_folder(directory / "out", false), "");
  EXPECT_THROW(ensure_writable_file(directory / "file", "--json"), InputError);
  fs::permissions(directory.path(), fs::perms::owner_all);
}

TEST(JsonItems, AreWrittenAsTheArrayInMemoryIs) {
  for (const int count : {0, 1, 5}) {
    Json object{
        {"rows", {{"frames", Json::array()}}}, {"text", "a\n  \"frames\": []"}, {"frames", Json::array()}};
    const Json without = object;
    object["last"] = 1;
    Json last = without;
    last["last"] = 1;
    JsonItems items;
    for (int k = 0; k < count; ++k) {
      const Json item{{"k", k}, {"of", std::vector<int>{k, k}}, {"none", Json::array()}};
      object["frames"].push_back(item);
      items.add(item);
    }
    for (int time = 0; time < 2; ++time) {
      std::string text;
      items.write_within(last, "frames", [&](std::string_view part) { text += part; });
      EXPECT_EQ(text, text_of(object));
    }
  }
}

}  // namespace
}  // namespace kds::output_files_test
