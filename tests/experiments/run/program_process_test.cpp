// Tests the program as a process: memory, and runs that are stopped.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_process_test {
namespace {

using testing::HasSubstr;

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
