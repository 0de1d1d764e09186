// Tests the journals of a sweep: what counts after crashes, cut-off lines and full disks.

#include "experiments/sweep/task_journal.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "experiments/sweep/task_process.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::task_journal_test {
namespace {

namespace fs = std::filesystem;

TaskStatus status_in(const fs::path& folder, TaskName task) { return TaskStates(folder).of(task).status(); }

fs::path only_file(const ScratchDirectory& scratch) { return fs::directory_iterator(scratch.path())->path(); }

TEST(TaskJournal, CountsAttemptsAndResults) {
  const ScratchDirectory scratch;
  JournalWriter journal(scratch.path());
  const auto add = [&](RecordKind kind, TaskName task, const char* json = "{}") {
    ASSERT_TRUE(journal.add(kind, task, json));
  };
  EXPECT_EQ(scratch.entries(), 0U);
  add(RecordKind::attempt, 1);
  EXPECT_EQ(status_in(scratch.path(), 1), TaskStatus::open);
  add(RecordKind::attempt, 1);
  EXPECT_EQ(status_in(scratch.path(), 1), TaskStatus::crashed);  // two attempts without a result
  add(RecordKind::done, 1, R"({"result":{"a":1}})");
  EXPECT_EQ(status_in(scratch.path(), 1), TaskStatus::done);
  for (int k = 0; k < 3; ++k) {
    add(RecordKind::attempt, 2);
    add(RecordKind::drop, 2);
  }
  EXPECT_EQ(status_in(scratch.path(), 2), TaskStatus::open);
  add(RecordKind::attempt, 3);
  add(RecordKind::fail, 3, R"({"code":2})");
  EXPECT_EQ(status_in(scratch.path(), 3), TaskStatus::failed);

  TaskStates states(scratch.path());
  states.forgive();
  EXPECT_EQ(states.of(3).status(), TaskStatus::open);
  EXPECT_EQ(states.of(1).status(), TaskStatus::done);
  EXPECT_EQ(line_of(states.read(states.of(1).span)), R"({"result":{"a":1}})");
  EXPECT_EQ(states.damaged(), 0U);
  EXPECT_TRUE(states.of_other_versions().empty());
}

// A failure counts beside the crashes of other journals, in whichever order the directory lists them. Names
// of journals are random.
TEST(TaskJournal, FailureCountsWhateverTheOrderOfJournals) {
  for (int round = 0; round < 16; ++round) {
    const ScratchDirectory scratch;
    JournalWriter crashes(scratch.path()), failures(scratch.path());
    const auto add_crashes = [&] {
      for (int k = 0; k < 2; ++k) {
        ASSERT_TRUE(crashes.add(RecordKind::attempt, 1));
        ASSERT_TRUE(crashes.add(RecordKind::died, 1, R"({"error":"ended by signal 11"})"));
      }
    };
    if (round % 2 == 0) add_crashes();
    ASSERT_TRUE(failures.add(RecordKind::fail, 1, R"({"code":2})"));
    if (round % 2 == 1) add_crashes();
    const TaskStates states(scratch.path());
    EXPECT_EQ(states.of(1).status(), TaskStatus::failed);
    EXPECT_EQ(line_of(states.read(states.of(1).span)), R"({"code":2})");
  }
}

// However many bytes of a journal survive, the records that are whole count and no others.
TEST(TaskJournal, CutOffAtEachByteKeepsWholeRecords) {
  const ScratchDirectory scratch;
  const fs::path cut = scratch / "cut";
  JournalWriter journal(scratch.path());
  std::vector<std::uint64_t> ends;
  for (TaskName task = 1; task <= 4; ++task) {
    ASSERT_TRUE(
        journal.add(RecordKind::done, task, R"({"result":{"x":")" + std::string(task * 3, 'y') + R"("}})"));
    ends.push_back(fs::file_size(only_file(scratch)));
  }
  const std::string whole = content_of(only_file(scratch));
  fs::create_directory(cut);
  for (std::size_t size = 0; size <= whole.size(); ++size) {
    scratch.file("cut/cut.results", whole.substr(0, size));
    for (TaskName task = 1; task <= 4; ++task)
      EXPECT_EQ(status_in(cut, task) == TaskStatus::done, ends[task - 1] <= size) << size;
  }
}

TEST(TaskJournal, ChangedByteMakesARecordVoid) {
  const ScratchDirectory scratch;
  const fs::path changed = scratch / "changed";
  JournalWriter journal(scratch.path());
  ASSERT_TRUE(journal.add(RecordKind::attempt, 1));
  const std::size_t begin = fs::file_size(only_file(scratch));
  ASSERT_TRUE(journal.add(RecordKind::done, 1, R"({"result":{"x":1}})"));
  const std::size_t first = fs::file_size(only_file(scratch));
  ASSERT_TRUE(journal.add(RecordKind::done, 2, R"({"result":{"x":2}})"));
  const std::string whole = content_of(only_file(scratch));
  fs::create_directory(changed);
  for (std::size_t byte = begin; byte + 1 < first; ++byte) {
    std::string text = whole;
    text[byte] ^= 1;
    scratch.file("changed/changed.results", text);
    EXPECT_EQ(status_in(changed, 1), TaskStatus::open) << byte;
    EXPECT_EQ(status_in(changed, 2), TaskStatus::done) << byte;
  }
}

TEST(TaskProcess, ReportsHowWorkEnds) {
  const auto run = [](const std::function<int()>& work, const TaskLimits& limits = {}) {
    TaskProcess process(work, limits);
    const TaskProcess::End end = process.wait();
    return std::tuple(end.code, end.signal, process.out(), process.err());
  };
  EXPECT_EQ(run([] { return std::fputs("out", stdout), std::fputs("err", stderr), 7; }),
            std::tuple(7, 0, "out", "err"));
  EXPECT_EQ(std::get<1>(run([] { return ::raise(SIGKILL); })), SIGKILL);
  EXPECT_EQ(std::get<0>(run([] { return ::raise(SIGTERM); })), 0);  // only the parent ends a task
#ifndef KDS_SANITIZED
  const auto fill = [] {
    try {
      std::vector<std::string> blocks;
      while (blocks.size() < 1000) blocks.emplace_back(std::size_t{1} << 20U, 'x');
      return 0;
    } catch (const std::bad_alloc&) {
      return 4;
    }
  };
  EXPECT_EQ(std::get<0>(run(fill, {.memory = std::uint64_t{200} << 20U})), 4);
#endif
}

}  // namespace
}  // namespace kds::test::task_journal_test
