// Tests the program as a process: full disks, signals, closed streams, memory.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_process_test {
namespace {

using testing::HasSubstr;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");

TEST(Program, StandardOutputThatIsAFileIsNoOtherOutput) {
  const ScratchDirectory directory;
  const std::string file = (directory / "both").string();
  const ProgramRun run =
      run_shell("\"$0\" run \"$1\" --quiet --json - --log \"$2\" > \"$2\"", {kSmall, file});
  EXPECT_EQ(run.code, 2);
  EXPECT_THAT(run.err, HasSubstr("/both: is the file of --json -"));
  EXPECT_EQ(run_shell("\"$0\" run \"$1\" --quiet --json - --log \"$2\" | cat > \"$3\"",
                      {kSmall, file, (directory / "other").string()})
                .code,
            0);
}

TEST(Program, AFullOutputIsAFailureWithTheSystemsReason) {
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  const ScratchDirectory directory;
  const std::string log = (directory / "events.log").string(), model = (directory / "model.xyz").string();
  ASSERT_EQ(run_program({"run", kSmall, "--log", log, "--quiet"}).code, 0);
  std::filesystem::create_symlink("/dev/full", model);
  const auto expect_full = [](const ProgramRun& run) {
    EXPECT_EQ(run.code, 1);
    EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("No space left on device"));
  };
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"run", kSmall, "--quiet", "--json", "/dev/full"},
        {"run", kSmall, "--quiet", "--log", "/dev/full"},
        {"run", data_file("kinetic/d1_n200_linear.txt"), "--quiet", "--log", "/dev/full"},
        {"replay", log, "--quiet", "--json", "/dev/full"},
        {"info", kSmall, "--quiet", "--json", "/dev/full"},
        {"generate", "helix", "--beads", "10", "--quiet", "-o", model}})
    expect_full(run_program(arguments));
  for (const char* line :
       {"\"$0\" --help", "\"$0\" help run", "\"$0\" run \"$1\"", "\"$0\" run \"$1\" --json -",
        "\"$0\" info \"$1\"", "\"$0\" replay \"$2\"", "\"$0\" replay \"$2\" --json -"})
    expect_full(run_shell(std::string(line) + " > /dev/full", {kSmall, log}));
}

// A file size limit of 4 KB acts like a full disk, with another error.
TEST(Program, ADiskThatFillsUpLeavesNoHalfResults) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out/below").string();
  const auto expect_full = [&](const std::string& arguments) {
    const ProgramRun run =
        run_shell("ulimit -f 8; \"$0\" " + arguments, {data_file("kinetic/d3_n100_linear.txt"), out});
    EXPECT_EQ(run.code, 1) << run.err;
    EXPECT_THAT(run.err, HasSubstr("cannot write: File too large"));
    EXPECT_EQ(directory.entries(), 0U) << arguments;
  };
  expect_full("run \"$1\" --quiet --dump \"$2\"");
  expect_full("generate helix --beads 1000 --quiet -o \"${2%/out/below}/m.xyz\"");
  expect_full("stability --quiet --subjects orientation,power_test --cases 1 --out \"$2\"");
}

// Many frames need no more memory than a third of them. Both runs are cut into parts.
TEST(Program, MemoryDoesNotGrowWithTheFrames) {
  const ScratchDirectory directory;
  const auto peak = [&](std::size_t frames) {
    std::string text;
    for (std::size_t k = 0; k < frames; ++k) {
      std::vector<std::string> beads;
      for (std::size_t b = 0; b < 60; ++b)
        beads.push_back(fmt::format("{} {} 0.{}", b, k % 7, (b * 37 + k) % 10));
      text += xyz(beads);
    }
    const std::string input = directory.file(std::to_string(frames) + ".xyz", text);
    const std::string there = (directory / std::to_string(frames)).string();
    const ProgramRun run =
        run_program({"run", input, "--structures", "sorted", "--quiet", "--out", there, "--dump",
                     there + ".dump", "--log", there + ".log", "--motion", "hermite"});
    EXPECT_EQ(run.code, 0) << run.err;
    const ProgramRun replay = run_program({"replay", there + ".log", "--quiet"});
    EXPECT_EQ(replay.code, 0) << replay.err;
    return std::max(run.peak_kilobytes, replay.peak_kilobytes);
  };
  const long few = peak(2000), many = peak(6000);
  EXPECT_LT(many, few + few / 4) << few;
}

TEST(Program, MemoryDoesNotGrowInOtherCommands) {
  const ScratchDirectory directory;
  const std::vector<std::vector<std::string>> commands{
      {"info", "--radius", "auto"},
      {"info", "--beads"},
      {"collide", "--radius", "1", "--method", "cells", "--json", (directory / "json").string(), "--out",
       (directory / "out").string(), "--replace"},
      {"update", "--radius", "0.1", "--rounds", "1", "--techniques", "hermite"}};
  const auto peaks = [&](std::size_t frames) {
    // The input is written frame by frame, because the peak memory of a child process includes that of its
    // parent.
    const std::string input = directory.file(std::to_string(frames) + ".xyz", "");
    std::ofstream file(input);
    for (std::size_t k = 0; k < frames; ++k) {
      std::vector<std::string> beads;
      for (std::size_t b = 0; b < 40; ++b)
        beads.push_back(fmt::format("{}.{} {}.{} {}.{}", b, (b * k) % 7, (b * 5) % 7, (b * 3 + k) % 9,
                                    (b * b) % 11, (b * 37 + k) % 10));
      file << xyz(beads);
    }
    file.close();
    std::vector<long> kilobytes;
    for (std::vector<std::string> arguments : commands) {
      arguments.insert(arguments.begin() + 1, {input, "--quiet"});
      const ProgramRun run = run_program(arguments);
      EXPECT_EQ(run.code, 0) << run.err;
      kilobytes.push_back(run.peak_kilobytes);
    }
    return kilobytes;
  };
  const std::vector<long> few = peaks(500), many = peaks(3000);
  for (std::size_t c = 0; c < commands.size(); ++c)
    EXPECT_LT(many[c], few[c] + few[c] / 8) << testing::PrintToString(commands[c]) << few[c];
}

TEST(Program, StandardStreamsMayBeClosed) {
  const ScratchDirectory directory;
  const std::string log = (directory / "events.log").string();
  EXPECT_EQ(run_shell("\"$0\" run nowhere.pdb 2>&-").code, 2);
  EXPECT_EQ(run_shell("\"$0\" run \"$1\" >&-", {kSmall}).code, 1);
  EXPECT_EQ(run_shell("\"$0\" run \"$1\" >&- 2>&-", {kSmall}).code, 1);
  EXPECT_EQ(run_shell("\"$0\" run \"$1\" --quiet --log \"$2\" <&- >&- 2>&-", {kSmall, log}).code, 0);
  EXPECT_TRUE(content_of(log).starts_with("kds event log"));
}

TEST(Program, AFileThatMayNotGrowIsAFailureWithoutATrace) {
  const ScratchDirectory directory;
  const std::string log = (directory / "events.log").string();
  const ProgramRun run = run_shell("ulimit -f 8; \"$0\" run \"$1\" --quiet --log \"$2\"",
                                   {data_file("kinetic/d1_n200_linear.txt"), log});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("events.log: cannot write: File too large"));
  EXPECT_EQ(directory.entries(), 0U);
}

// On one thread, the dump of the first frame is written at once.
TEST(Program, WhatAStoppedRunLeftIsReplacedByTheNext) {
  for (const char* signal : {"TERM", "KILL"}) {
    const ScratchDirectory directory;
    const std::string dump = (directory / "made/dump").string(), log = (directory / "events.log").string();
    const ProgramRun stopped = run_shell(
        "\"$0\" run \"$1\" --log \"$3\" --dump \"$2\" --audit events --threads 1 & "
        "i=0; while [ ! -e \"$2.part/frame-0.power.csv\" ] && [ $i -lt 200 ]; do sleep 0.05; i=$((i+1)); "
        "done; "
        "\"$0\" run \"$1\" --frames :2 --dump \"$2\"; kill -$4 $!; wait $!",
        {data_file("trajectories/villin_hp36_300K.dcd"), dump, log, signal});
    EXPECT_GT(stopped.code, 128) << stopped.err;
    EXPECT_THAT(stopped.err, HasSubstr("another run writes to " + dump + ".part now"));
    ASSERT_FALSE(std::filesystem::exists(dump) || std::filesystem::exists(log));
    const ProgramRun next =
        run_program({"run", data_file("kinetic/d3_n20_linear.txt"), "--quiet", "--dump", dump, "--log", log});
    EXPECT_EQ(next.code, 0);
    for (const std::string& left : {dump, log})
      EXPECT_THAT(next.err, HasSubstr(left + ".part was left by a run that was stopped, and is replaced"));
    EXPECT_EQ(directory.entries(), 2U);
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dump), {}),
              5);  // cells and hidden beads of two frames, and the list
  }
}

}  // namespace
}  // namespace kds::test::program_process_test
