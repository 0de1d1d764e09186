// Tests the program as a process: help, exit codes, and one line for each mistake.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <string>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/program/command_line.h"
#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_usage_test {
namespace {

using testing::HasSubstr;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");
const std::string kTrajectory = data_file("trajectories/villin_hp36_300K.dcd");

TEST(Program, HelpAndVersionSucceed) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"-h"},
                                                    {"--version"},
                                                    {"run", "--help"},
                                                    {"replay", "--help"},
                                                    {"help"},
                                                    {"help", "stability"}}) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, HasSubstr("kds"));
  }
  EXPECT_EQ(run_program({"help"}).out, run_program({"--help"}).out);
  EXPECT_EQ(run_program({"help", "--help"}).out, run_program({"--help"}).out);
  EXPECT_EQ(run_program({"help", "help"}).out, run_program({"--help"}).out);
  EXPECT_EQ(run_program({"help", "run"}).out, run_program({"run", "--help"}).out);
  expect_refused({"help", "fly"}, {"unknown command 'fly'"});
  expect_refused({"help", "run", "info"}, {"one command"});
  expect_refused({"help", "--version"}, {"takes a command, not the option '--version'"});
}

TEST(Program, OptionsOfInputsAreExplainedOnce) {
  const std::string run = run_program({"run", "--help"}).out, inputs = run_program({"help", "inputs"}).out;
  EXPECT_THAT(run, HasSubstr("kds help inputs explains the options of inputs: --topology, --select, "));
  EXPECT_THAT(inputs, HasSubstr("\n  --topology FILE "));
  EXPECT_THAT(run, testing::Not(HasSubstr("\n  --topology FILE ")));
  for (const std::string& help : {run, inputs})
    for (const std::string& line : split(help, '\n'))
      EXPECT_TRUE(line.size() <= 100 || line.starts_with("  kds ")) << line;
}

TEST(Program, HelpHasTheWidthAskedFor) {
  constexpr CommandSpec command{"kds try", "Tries one two three.", "FILE", "a file", "kds try a"};
  EXPECT_EQ(
      help_text(command, {{"--input", "", "not explained here", 1, true}, {"--far", "N", "one two three"}},
                24),
      "Tries one two three.\n\nusage: kds try FILE [OPTION]...\n\n  FILE     a file\n\n"
      "kds help inputs explains\nthe options of inputs:\n--input\n\n"
      "  --far N  one two three\n  --help   print this\n           and exit\n\nexamples:\n  kds try a\n");
}

TEST(Program, RefusesWrongUsage) {
  expect_refused({}, {"no command"});
  expect_refused({"fly"}, {"unknown command 'fly'"});
  expect_refused({"two\nlines"}, {"unknown command"});
  expect_refused({"--fly"}, {"unknown option '--fly'"});
  expect_refused({"run"}, {"INPUT"});
  expect_refused({"run", kSmall, "--fly"}, {"unknown option '--fly'"});
  expect_refused({"run", kSmall, "--kernel", "slow"}, {"--kernel", "slow"});
  expect_refused({"run", kSmall, "--structures", "heaps"},
                 {"is not one of sorted, box, hull, closest, wrapped, boxes, layered, power, contacts"});
  expect_refused({"run", kSmall, "--motion", "hermite"}, {"--motion", "instance"});
  expect_refused({"run", kSmall, "--motion", "lifted"}, {"--motion", "instance"});
  expect_refused({"run", kTrajectory, "--motion", "lifted"}, {"--motion lifted", "fictitious", "wrapped"});
  expect_refused({"run", kSmall, "--frames", "0:1"}, {"--frames", "instance"});
  expect_refused({"replay"}, {"one LOG"});
  expect_refused({"replay", kSmall, kSmall}, {"one LOG"});
}

TEST(Program, StandardInputIsNotRead) {
  for (const std::vector<std::string>& arguments : std::vector<std::vector<std::string>>{
           {"run", "-"},
           {"info", kTrajectory, "-"},
           {"info", kTrajectory, "--topology", "-"},
           {"run", kTrajectory, "--obstacle", "-"},
           {"run", kTrajectory, "--structures", "contacts", "--radius", "file:-"},
           {"replay", "-"},
           {"contacts", "-", "--cutoff", "8"},
           {"sweep", "-", "--dry-run"}})
    expect_refused(arguments, {"standard input is not read"});
}

TEST(Program, SuggestsTheNearestName) {
  expect_refused({"rnu"}, {"unknown command 'rnu', did you mean run?"});
  expect_refused({"help", "colide"}, {"did you mean collide?"});
  expect_refused({"layered", kSmall},
                 {"unknown command 'layered', did you mean run INPUT --structures layered?"});
  expect_refused({"Wrapped"}, {"did you mean run INPUT --structures wrapped?"});
  expect_refused({"run", kSmall, "--radii", "3"}, {"unknown option '--radii', did you mean --radius?"});
  expect_refused({"--versoin"}, {"did you mean --version?"});
  expect_refused({"run", kSmall, "--frame", "0:3"}, {"unknown option '--frame', did you mean --frames?"});
  expect_refused({"run", kSmall, "--frame=0:3"}, {"did you mean --frames?"});
  expect_refused({"run", kSmall, "--structures", "power,contact"}, {"did you mean contacts?"});
  expect_refused({"run", kSmall, "--kernel", "filter"}, {"did you mean filtered?"});
  expect_refused({"run", kSmall, "--motion", "hermit"}, {"did you mean hermite?"});
  expect_refused({"run", kSmall, "--select", "backbon"}, {"did you mean backbone?"});
  for (const char* radius : {"vdw", "VDW", "elements", "van-der-waals"})
    expect_refused({"run", kSmall, "--radius", radius},
                   {"'" + std::string(radius) + "'", "did you mean element?"});
  expect_refused({"run", kSmall, "--radius", "aut"}, {"did you mean auto?"});
  expect_refused({"collide", kTrajectory, "--method", "cell"}, {"did you mean cells?"});
  expect_refused({"update", kTrajectory, "--techniques", "reinserts"}, {"did you mean reinsert?"});
  expect_refused({"generate", "chain", "--beads", "9"}, {"did you mean random-chain?"});
  for (const char* script : {"figures", "questions", "reproduce", "scale", "theorems"}) {
    expect_refused({script}, {"is a script now", "scripts/reproduce"});
    expect_refused({"help", script}, {"scripts/reproduce"});
  }
  expect_refused({"bench", "power"}, {"kds_bench"});
  expect_refused({"stability", "--subjects", "powertest"}, {"did you mean power_test?"});
}

TEST(Program, RefusesMissingFiles) {
  const ScratchDirectory directory;
  const std::string missing = (directory / "missing.pdb").string();
  expect_refused({"run", missing}, {"missing.pdb"});
  expect_refused({"run", kSmall, missing}, {"missing.pdb"});
  expect_refused({"run", directory.file("a.dcd", ""), "--topology", missing}, {"missing.pdb"});
  expect_refused(
      {"run", data_file("trajectories/villin_hp36_300K.pdb"), "--topology", directory.file("a.dcd", "")},
      {"a.dcd names no atoms; the trajectory comes first"});
  expect_refused({"run", directory.path().string()}, {"is a directory"});
  expect_refused({"replay", missing}, {"missing.pdb"});
  expect_refused({"run", missing, "--out", (directory / "report").string()}, {"missing.pdb"});
  EXPECT_FALSE(std::filesystem::exists(directory / "report"));
}

TEST(Program, RefusesOutputsBeforeTheRun) {
  const ScratchDirectory directory;
  const std::string file = directory.file("taken", "precious");
  const std::string nowhere = (directory / "no/such").string();
  expect_refused({"run", kSmall, "--out", file}, {"--out", "taken"});
  expect_refused({"run", kSmall, "--dump", file}, {"--dump", "taken"});
  expect_refused({"run", kSmall, "--json", nowhere}, {"--json", "no/such"});
  expect_refused({"run", kSmall, "--log", nowhere}, {"--log", "no/such"});
  expect_refused({"run", kSmall, "--json", file, "--log", file}, {"--log", "taken", "--json"});
  EXPECT_EQ(content_of(file), "precious");
}

TEST(Program, NeverOverwritesItsInput) {
  const ScratchDirectory directory;
  const std::string input = directory.file("two.xyz", xyz({"0 0 0", "1 0 0"}) + xyz({"0 0 0", "2 0 0"}));
  const std::string before = content_of(input);
  expect_refused({"run", input, "--json", input}, {"--json", "input"});
  expect_refused({"run", input, "--log", (directory / "." / "two.xyz").string()}, {"--log", "input"});
  EXPECT_EQ(content_of(input), before);
  const std::string radii = directory.file("radii.txt", "0.5\n");
  expect_refused({"run", input, "--radius", "file:" + radii, "--json", radii}, {"--json", "--radius"});
  EXPECT_EQ(content_of(radii), "0.5\n");
}

TEST(Program, ResultsDoNotReplaceEachOther) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string();
  expect_refused({"run", kSmall, "--out", out, "--json", out + "/events.csv"}, {"--json", "--out"});
  expect_refused({"run", kSmall, "--out", out, "--log", out + "/report.html"}, {"--log", "--out"});
  const std::string log = (directory / "events.log").string();
  ASSERT_EQ(run_program({"run", kSmall, "--log", log, "--quiet"}).code, 0);
  expect_refused({"replay", log, "--json", log}, {"--json", "the log"});
}

TEST(Program, RefusesBrokenFiles) {
  const ScratchDirectory directory;
  const std::string good = xyz({"0 0 0", "1 0 0", "2 0.5 0"});
  expect_refused({"run", directory.file("nan.xyz", good + xyz({"0 0 0", "nan 0 0", "2 0 0"}))},
                 {"nan.xyz", "frame 1"});
  expect_refused({"run", directory.file("count.xyz", good + xyz({"0 0 0", "1 0 0"}))},
                 {"count.xyz", "frame 1"});
  expect_refused({"run", directory.file("cut.xyz", good + "3\nframe\nC 0 0")}, {"cut.xyz", "two frames"});
  expect_refused({"run", directory.file("one-frame.xyz", good)}, {"one-frame.xyz"});
  expect_refused({"run", directory.file("empty.xyz", "")}, {"empty.xyz"});
  expect_refused({"run", directory.file("what.bin", "?")}, {"what.bin"});
}

TEST(Program, RefusesRadiiWhoseSquareIsNoNumber) {
  const ScratchDirectory directory;
  const std::string wide =
      directory.file("wide.xyz", xyz({"0 0 0", "1e200 0 0"}) + xyz({"0 0 0", "0 1e200 0"}));
  expect_refused({"run", wide, "--structures", "wrapped"}, {"--radius", "auto", "too large for a double"});
  expect_refused({"run", wide, "--structures", "wrapped", "--radius", "1e300"}, {"--radius", "1e300"});
  EXPECT_EQ(run_program({"run", wide, "--structures", "wrapped", "--radius", "1", "--audit", "events"}).code,
            0);
}

TEST(Program, ReadsATrajectoryThatEndsInsideAFrame) {
  const ScratchDirectory directory;
  std::string bytes = content_of(data_file("trajectories/villin_hp36_300K.dcd"));
  ASSERT_GT(bytes.size(), 100000U);
  bytes.resize(100000);
  const ProgramRun run = run_program({"run", directory.file("cut.dcd", bytes), "--json", "-", "--quiet"});
  EXPECT_EQ(run.code, 0);
  EXPECT_THAT(run.err, HasSubstr("cut.dcd: the file ends inside frame 75 (after 100000 bytes)"));
  EXPECT_THAT(run.out, HasSubstr("\"truncated\": true"));
}

TEST(Program, RefusesAnEmptySelection) {
  const std::string model = data_file("trajectories/villin_hp36_300K.pdb");
  expect_refused(
      {"run", data_file("trajectories/villin_hp36_300K.dcd"), "--topology", model, "--chain", "nobody"},
      {"nobody"});
}

TEST(Program, PipesAndDevicesAreRefusedAtOnce) {
  const ScratchDirectory directory;
  const std::string input = directory.file("two.xyz", xyz({"0 0 0", "1 0 0"}) + xyz({"0 0 0", "2 0 0"}));
  for (const char* name : {"pipe.xyz", "pipe.pdb", "pipe.cif", "pipe.dcd", "pipe.txt"}) {
    const std::string pipe = (directory / name).string();
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    for (const char* command : {"run", "info", "update", "collide", "replay"})
      expect_refused({command, pipe}, {name, "is a pipe, expected a file"});
    expect_refused({"run", input, "--topology", pipe}, {name, "is a pipe"});
    expect_refused({"run", input, "--radius", "file:" + pipe}, {name, "is a pipe"});
  }
  std::filesystem::create_symlink("/dev/zero", directory / "zero.xyz");
  expect_refused({"run", (directory / "zero.xyz").string()}, {"zero.xyz", "is a device"});
}

}  // namespace
}  // namespace kds::test::program_usage_test
