// The program from outside: exit codes, one line for each mistake, and where results go.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");
const std::string kTrajectory = data_file("trajectories/villin_hp36_300K.dcd");

// Exit code 2, nothing on standard output, one line on standard error that has each of the words.
void expect_refused(const std::vector<std::string>& arguments, const std::vector<std::string>& words) {
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.code, 2) << testing::PrintToString(arguments) << "\n" << run.err;
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
  EXPECT_TRUE(run.err.starts_with("kds: ") && run.err.ends_with("\n")) << run.err;
  for (const std::string& word : words) EXPECT_THAT(run.err, HasSubstr(word));
}

std::string xyz(const std::vector<std::string>& beads) {
  std::string frame = std::to_string(beads.size()) + "\nframe\n";
  for (const std::string& bead : beads) frame += "C " + bead + "\n";
  return frame;
}

TEST(Program, HelpAndVersionSucceed) {
  for (const std::vector<std::string>& arguments : {std::vector<std::string>{"--help"},
                                                    {"-h"},
                                                    {"--version"},
                                                    {"run", "--help"},
                                                    {"replay", "--help"},
                                                    {"help"},
                                                    {"help", "bench"}}) {
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0);
    EXPECT_EQ(run.err, "");
    EXPECT_THAT(run.out, HasSubstr("kds"));
  }
  EXPECT_EQ(run_program({"help"}).out, run_program({"--help"}).out);
  EXPECT_EQ(run_program({"help", "run"}).out, run_program({"run", "--help"}).out);
  expect_refused({"help", "fly"}, {"unknown command 'fly'"});
  expect_refused({"help", "run", "info"}, {"one command"});
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
                 {"is not one of sorted, box, hull, closest, wrapped, layered, power, contacts"});
  expect_refused({"run", kSmall, "--motion", "hermite"}, {"--motion", "instance"});
  expect_refused({"run", kSmall, "--motion", "lifted"}, {"--motion", "instance"});
  expect_refused({"run", kTrajectory, "--motion", "lifted"}, {"--motion lifted", "fictitious", "wrapped"});
  expect_refused({"run", kSmall, "--frames", "0:1"}, {"--frames", "instance"});
  expect_refused({"replay"}, {"one LOG"});
  expect_refused({"replay", kSmall, kSmall}, {"one LOG"});
}

// A linear motion written with five control points a coordinate: other polynomials, the same events.
TEST(Program, RunsPolynomialsBeyondTheUsualDegrees) {
  const ScratchDirectory directory;
  std::mt19937 random(7);
  std::string linear = "8 3 1\n", quartic = "8 3 4\n", high = "8 3 11\n";
  for (int number = 0; number < 8 * 3; ++number) {
    const int from = 4 * static_cast<int>(random() % 100), to = 4 * static_cast<int>(random() % 100);
    const char* end = number % 3 == 2 ? "\n" : " ";
    linear += std::to_string(from) + " " + std::to_string(to) + end;
    for (int k = 0; k <= 4; ++k) quartic += std::to_string(from + k * (to - from) / 4) + (k < 4 ? " " : end);
    for (int k = 0; k <= 11; ++k) high += std::to_string(from) + (k < 11 ? " " : end);
  }
  const std::string one = directory.file("linear.txt", linear);
  const std::string four = directory.file("quartic.txt", quartic);
  for (const char* structure : {"sorted", "power", "wrapped"}) {
    const auto result = [&](const std::string& file) {
      const ProgramRun run = run_program(
          {"run", file, "--structures", structure, "--quiet", "--json", "-", "--audit", "events"});
      EXPECT_EQ(run.code, 0) << run.err;
      return Json::parse(run.out);
    };
    const auto expected = result(one);
    const auto found = result(four);
    EXPECT_GT(expected["structures"][structure]["events"]["total"], 0);
    EXPECT_EQ(found["structures"][structure]["events"], expected["structures"][structure]["events"]);
    EXPECT_EQ(found["fingerprint"], expected["fingerprint"]);
  }
  expect_refused({"run", directory.file("high.txt", high)}, {"degree 11", "1 to 10"});
  expect_refused({"run", four, "--kernel", "fast"}, {"--kernel fast", "degree 4"});
}

TEST(Program, RefusesMissingFiles) {
  const ScratchDirectory directory;
  const std::string missing = (directory / "missing.pdb").string();
  expect_refused({"run", missing}, {"missing.pdb"});
  expect_refused({"run", kSmall, missing}, {"missing.pdb"});
  expect_refused({"run", directory.file("a.dcd", ""), "--topology", missing}, {"missing.pdb"});
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

// None of them is there yet, and one is to be a file and a directory.
TEST(Program, AnOutputIsAFileOrADirectory) {
  const ScratchDirectory directory;
  const std::string both = (directory / "both").string();
  const std::vector<std::pair<std::string, std::string>> places{
      {both, both}, {both, both + "/"}, {both, both + "/below"}, {both, both + "/../both/below/more"}};
  for (const auto& [file, folder] : places) {
    for (const char* option : {"--log", "--events", "--json"})
      for (const char* of : {"--out", "--dump"})
        expect_refused({"run", kSmall, option, file, of, folder}, {option, of, "directory"});
    expect_refused({"info", kTrajectory, "--json", file, "--out", folder}, {"--json", "--out", "directory"});
  }
  for (const char* below : {"", "/below"})
    expect_refused({"generate", "grid", "--beads", "8", "-o", both + ".xyz", "--out", both + ".xyz" + below},
                   {"--out", "both.xyz is the file of -o, expected a directory"});
  EXPECT_EQ(directory.entries(), 0U);
  ASSERT_EQ(
      run_program({"run", kSmall, "--quiet", "--dump", both, "--out", both, "--log", both + ".log"}).code, 0);
  EXPECT_TRUE(std::filesystem::is_regular_file(directory / "both/summary.json"));
}

TEST(Program, StandardOutputIsAnOutputByItsPath) {
  const ScratchDirectory directory;
  const std::string here = directory.path().string();
  ASSERT_EQ(run_program({"run", kSmall, "--quiet", "--log", here + "/log"}).code, 0);
  const std::string log = content_of(directory / "log");
  for (const char* name : {"/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"}) {
    const ProgramRun piped =
        run_shell("\"$0\" run \"$1\" --quiet --log " + std::string(name) + " | cat", {kSmall});
    EXPECT_EQ(piped.out, log) << name << piped.err;
    // A file behind it is written on, not anew: what comes behind the log does not replace its beginning.
    const ProgramRun appended = run_shell("{ echo before; \"$0\" run \"$1\" --quiet --log " +
                                              std::string(name) + "; echo after; } > \"$2/file\"",
                                          {kSmall, here});
    EXPECT_EQ(appended.err, "");
    EXPECT_EQ(content_of(directory / "file"), "before\n" + log + "after\n") << name;
  }
  EXPECT_EQ(run_shell("\"$0\" run \"$1\" --quiet --events /dev/fd/3 3>\"$2/third\"", {kSmall, here}).code, 0);
  EXPECT_THAT(content_of(directory / "third"), testing::StartsWith("frame,"));
  for (const char* closed : {"/dev/fd/7", "/dev/stdin"})
    expect_refused({"run", kSmall, "--log", closed}, {"--log", closed, "not open for writing"});
}

// They would wait for a reader, at the end of a run at the latest.
TEST(Program, NamedPipesAreNoOutputs) {
  const ScratchDirectory directory;
  const std::string pipe = (directory / "pipe").string(), out = (directory / "out").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const char* option : {"--events", "--log", "--json"})
    expect_refused({"run", kSmall, option, pipe}, {option, "pipe: is a named pipe, expected a file"});
  std::filesystem::create_directory(out);
  ASSERT_EQ(::mkfifo((out + "/summary.json").c_str(), 0600), 0);
  expect_refused({"run", kSmall, "--out", out}, {"out/summary.json: is no regular file"});
}

TEST(Program, RefusesBrokenFiles) {
  const ScratchDirectory directory;
  const std::string good = xyz({"0 0 0", "1 0 0", "2 0.5 0"});
  expect_refused({"run", directory.file("nan.xyz", good + xyz({"0 0 0", "nan 0 0", "2 0 0"}))},
                 {"nan.xyz", "frame 1"});
  expect_refused({"run", directory.file("count.xyz", good + xyz({"0 0 0", "1 0 0"}))},
                 {"count.xyz", "frame 1"});
  expect_refused({"run", directory.file("cut.xyz", good + good + "3\nframe\nC 0 0")}, {"cut.xyz", "frame"});
  expect_refused({"run", directory.file("one-frame.xyz", good)}, {"one-frame.xyz"});
  expect_refused({"run", directory.file("empty.xyz", "")}, {"empty.xyz"});
  expect_refused({"run", directory.file("what.bin", "?")}, {"what.bin"});
}

TEST(Program, RefusesRadiiWhoseSquareIsNoNumber) {
  const ScratchDirectory directory;
  const std::string wide =
      directory.file("wide.xyz", xyz({"0 0 0", "1e200 0 0"}) + xyz({"0 0 0", "0 1e200 0"}));
  expect_refused({"run", wide, "--structures", "wrapped"}, {"--radius", "auto", "beyond all numbers"});
  expect_refused({"run", wide, "--structures", "wrapped", "--radius", "1e300"}, {"--radius", "1e300"});
  EXPECT_EQ(run_program({"run", wide, "--structures", "wrapped", "--radius", "1", "--audit", "events"}).code,
            0);
}

TEST(Program, RefusesATrajectoryThatEndsInsideAFrame) {
  const ScratchDirectory directory;
  std::string bytes = content_of(data_file("trajectories/villin_hp36_300K.dcd"));
  ASSERT_GT(bytes.size(), 100000U);
  bytes.resize(100000);
  expect_refused({"run", directory.file("cut.dcd", bytes)}, {"cut.dcd", "frame"});
}

TEST(Program, RefusesAnEmptySelection) {
  const std::string model = data_file("trajectories/villin_hp36_300K.pdb");
  expect_refused(
      {"run", data_file("trajectories/villin_hp36_300K.dcd"), "--topology", model, "--chain", "nobody"},
      {"nobody"});
}

TEST(Program, OneBeadIsAHierarchyButNoDiagram) {
  const ScratchDirectory directory;
  const std::string one = directory.file("one.xyz", xyz({"0 0 0"}) + xyz({"1 0 0"}));
  expect_refused({"run", one, "--radius", "1"}, {"power", "at least 4 beads"});
  expect_refused({"run", one, "--structures", "wrapped"}, {"--radius", "auto"});
  const ProgramRun run = run_program(
      {"run", one, "--structures", "wrapped", "--radius", "1", "--audit", "events", "--json", "-"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["structures"]["wrapped"]["events"]["total"], 0);
}

TEST(Program, TwoBeadsInOnePlaceAreAHierarchyButHiddenInTheDiagram) {
  const ScratchDirectory directory;
  const std::string twins =
      directory.file("twins.xyz", xyz({"0 0 0", "0 0 0", "1 1 0", "2 0 1", "3 1 1"}) +
                                      xyz({"0 0 0", "0 0 0", "1 1 1", "2 0 1", "3 2 1"}));
  const ProgramRun wrapped = run_program({"run", twins, "--structures", "wrapped", "--audit", "events"});
  EXPECT_EQ(wrapped.code, 0) << wrapped.err;
  const ProgramRun power = run_program({"run", twins, "--structures", "power", "--audit", "events"});
  if (power.code == 0) return;  // hidden beads are supported
  expect_refused({"run", twins, "--structures", "power", "--audit", "events"}, {"bead", "hidden"});
}

TEST(Program, BeadsThatKeepToAPlaneOfTwoAxesRunInTwoDimensions) {
  const ScratchDirectory directory;
  const std::string flat = directory.file("flat.xyz", xyz({"0 7 0", "1 7 0", "2 7 1", "3 7 0", "4 7 1"}) +
                                                          xyz({"0 7 1", "1 7 0", "2 7 2", "3 7 3", "4 7 2"}));
  const std::string radii = "file:" + directory.file("radii.txt", "0.5\n0.6\n0.5\n0.7\n0.6\n");
  for (const char* motion : {"linear", "hermite", "lifted"}) {
    const std::string structures = motion == std::string("lifted") ? "power" : "wrapped,power";
    for (const std::string& rule : {std::string("auto"), radii}) {
      SCOPED_TRACE(motion + (" " + rule));
      const ProgramRun run =
          run_program({"run", flat, "--structures", structures, "--motion", motion, "--radius", rule,
                       "--audit", "events", "--dump", directory.path().string(), "--quiet", "--json", "-"});
      ASSERT_EQ(run.code, 0) << run.err;
      const Json result = Json::parse(run.out);
      EXPECT_EQ(result["input"]["dimension"], 2);
      EXPECT_GT(result["structures"]["power"]["events"]["total"], 0);
      EXPECT_EQ(content_of(directory.path() / "frame-1.power.csv").substr(0, 6), "a,b,c\n");
      if (motion != std::string("lifted")) {
        EXPECT_THAT(content_of(directory.path() / "frame-1.wrapped.csv"), HasSubstr(",7,"));
      }
    }
  }
  const std::string line = directory.file(
      "line.xyz", xyz({"0 0 0", "1 0 0", "2 0 0", "3 0 0"}) + xyz({"0 0 0", "1 0 0", "2.5 0 0", "3 0 0"}));
  expect_refused({"run", line, "--structures", "power"}, {"line"});
}

TEST(Program, BeadsThatStayInATiltedPlaneAreRefusedByTheDiagramInSpace) {
  const ScratchDirectory directory;
  const std::string flat = directory.file("flat.xyz", xyz({"0 0 0", "1 0 1", "2 1 2", "3 0 3", "4 1 4"}) +
                                                          xyz({"0 1 0", "1 0 1", "2 2 2", "3 0 3", "4 2 4"}));
  expect_refused({"run", flat, "--structures", "power"}, {"plane"});
  EXPECT_EQ(run_program({"run", flat, "--structures", "wrapped", "--audit", "events"}).code, 0);
}

// A bead that comes from so far that all its events lie within 2^-200 of the step.
TEST(Program, EventsTooCloseToRebuildBetweenAreNamed) {
  const ScratchDirectory directory;
  const std::string far = directory.file(
      "far.xyz", xyz({"1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}) +
                     xyz({"-1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}));
  const ProgramRun run = run_program({"run", far, "--structures", "power", "--radius", "0.1"});
  EXPECT_THAT(run.err, Not(HasSubstr("plane")));
}

// Four beads in one plane at the start, and moves of a last place, which doubles cannot tell apart.
TEST(Program, FastGoesOnWhereDoublesContradictThemselves) {
  const ScratchDirectory directory;
  const std::string flat = directory.file("flat.txt",
                                          "5 3 1\n"
                                          "-1 -1 -2 -1.9999999999999998 -2 -2\n"
                                          "-1 -1 -2 -2 -2 -1.9999999999999998\n"
                                          "-1 -1 -2 -2 0 1.1102230246251565e-16\n"
                                          "-1 -1 0 1.1102230246251565e-16 0 -1.1102230246251565e-16\n"
                                          "-2 -2.0000000000000004 -1 -1 0 1.1102230246251565e-16\n");
  for (const char* kernel : {"fast", "filtered", "exact"}) {
    const ProgramRun run = run_program({"run", flat, "--kernel", kernel, "--json", "-"});
    EXPECT_EQ(run.code, 0) << kernel << ": " << run.err;
  }
}

std::uint64_t events_of(const std::string& instance, const std::string& structure) {
  const ProgramRun run = run_program({"run", data_file("kinetic/" + instance + ".txt"), "--json", "-"});
  EXPECT_EQ(run.code, 0) << run.err;
  if (run.code != 0) return 0;
  const Json summary = Json::parse(run.out);
  EXPECT_EQ(summary["structures"].size(), 1U);
  EXPECT_EQ(summary["structures"][structure]["rebuilds"], 0);
  return summary["structures"][structure]["events"]["total"].get<std::uint64_t>();
}

TEST(Program, CountsTheKnownEventsOfInstances) {
  EXPECT_EQ(events_of("d1_n20_linear", "sorted"), 97U);
  EXPECT_EQ(events_of("d1_n50_linear", "sorted"), 671U);
  EXPECT_EQ(events_of("d1_n100_linear", "sorted"), 2743U);
  EXPECT_EQ(events_of("d1_n200_linear", "sorted"), 10183U);
  EXPECT_EQ(events_of("d1_n500_linear", "sorted"), 64078U);
  EXPECT_EQ(events_of("d1_n20_degree2", "sorted"), 171U);
  EXPECT_EQ(events_of("d1_n50_degree2", "sorted"), 896U);
  EXPECT_EQ(events_of("d1_n100_degree2", "sorted"), 3735U);
  EXPECT_EQ(events_of("d1_n20_degree3", "sorted"), 213U);
  EXPECT_EQ(events_of("d1_n50_degree3", "sorted"), 1254U);
  EXPECT_EQ(events_of("d1_n100_degree3", "sorted"), 4791U);
  EXPECT_EQ(events_of("d3_n20_linear", "power"), 234U);
  EXPECT_EQ(events_of("d3_n50_linear", "power"), 1453U);
  EXPECT_EQ(events_of("d3_n100_linear", "power"), 4225U);
  EXPECT_EQ(events_of("d3_n200_linear", "power"), 11286U);
}

std::string fingerprint_of(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "run");
  arguments.insert(arguments.end(), {"--json", "-"});
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.code, 0) << run.err;
  return run.code == 0 ? Json::parse(run.out)["fingerprint"].get<std::string>() : "";
}

TEST(Program, GivesOneFingerprintForAllRunsAndExactKernels) {
  const std::string villin = data_file("trajectories/villin_hp36_300K.dcd");
  const std::vector<std::vector<std::string>> runs{
      {kSmall},
      {data_file("kinetic/d3_n20_linear.txt"), "--structures", "sorted,wrapped,power"},
      {data_file("kinetic/degenerate_d3_n64_swap.txt"), "--structures", "wrapped,power"},
      {villin, "--frames", "0:3"}};
  for (std::vector<std::string> run : runs) {
    const std::string fingerprint = fingerprint_of(run);
    EXPECT_EQ(fingerprint_of(run), fingerprint) << run.front();
    run.insert(run.end(), {"--kernel", "exact"});
    EXPECT_EQ(fingerprint_of(run), fingerprint) << run.front();
  }
}

// Every third bead smaller: the hierarchy's certificates have square roots then.
TEST(Program, WrapsBallsOfSeveralSizes) {
  const ScratchDirectory directory;
  std::string radii;
  for (int b = 0; b < 108; ++b) radii += b % 3 == 0 ? "0.6\n" : "0.75\n";
  const std::string rule = "file:" + directory.file("radii.txt", radii);
  const std::vector<std::string> arguments{"run",          data_file("trajectories/villin_hp36_300K.dcd"),
                                           "--topology",   data_file("trajectories/villin_hp36_300K.pdb"),
                                           "--frames",     "0:4",
                                           "--structures", "wrapped",
                                           "--radius",     rule,
                                           "--audit",      "events",
                                           "--json",       "-"};
  for (const char* motion : {"linear", "hermite"}) {
    std::vector<std::string> one = arguments;
    one.insert(one.end(), {"--motion", motion});
    const ProgramRun run = run_program(one);
    ASSERT_EQ(run.code, 0) << run.err;
    EXPECT_GT(Json::parse(run.out)["structures"]["wrapped"]["events"]["total"], 0);
  }
  expect_refused({"run", data_file("kinetic/w3_n20_linear.txt"), "--structures", "wrapped"},
                 {"weights", "radii"});
}

TEST(Program, KeepsOnlyTheNodesAskedFor) {
  const ScratchDirectory directory;
  const std::string log = (directory.path() / "log").string();
  std::vector<std::string> arguments{
      "run", data_file("kinetic/d3_n50_linear.txt"), "--structures", "wrapped", "--json", "-", "--quiet"};
  const ProgramRun all = run_program(arguments);
  arguments.insert(arguments.end(), {"--levels", "0:2", "--log", log, "--dump", directory.path().string()});
  const ProgramRun some = run_program(arguments);
  ASSERT_EQ(some.code, 0) << some.err;
  const auto created = [](const ProgramRun& run) {
    return Json::parse(run.out)["structures"]["wrapped"]["certificates"]["created"].get<int>();
  };
  EXPECT_LT(created(some), created(all));
  EXPECT_EQ(Json::parse(some.out)["settings"]["levels"], "0:2");
  const std::string dump = content_of(directory.path() / "frame-1.wrapped.csv");
  EXPECT_EQ(std::count(dump.begin(), dump.end(), '\n'), 4);  // a header and three nodes
  EXPECT_EQ(run_program({"replay", log, "--quiet"}).code, 0);
  expect_refused({"run", kSmall, "--structures", "power", "--levels", "0:2"}, {"--levels", "wrapped"});
  for (const char* option : {"--levels", "--nodes"})
    expect_refused(
        {"run", data_file("kinetic/d3_n50_linear.txt"), "--structures", "wrapped", option, "60:70"},
        {option, "no node", "50 beads"});
  const std::string fifty = data_file("kinetic/d3_n50_linear.txt");
  expect_refused({"run", fifty, "--structures", "wrapped", "--nodes", "0:51"},
                 {"--nodes 0:51: expected beads of the input, which has 50 beads"});
  for (const char* range : {"0:50", "3:", ":50"})
    EXPECT_EQ(run_program({"run", fifty, "--structures", "wrapped", "--nodes", range, "--quiet"}).code, 0)
        << range;
}

TEST(Program, RunsSeveralNecklacesOnOneClock) {
  const std::string moving = data_file("trajectories/villin_hp36_300K.dcd");
  const std::string resting = data_file("trajectories/villin_hp36_300K.pdb");
  const ScratchDirectory directory;
  const std::string beads = xyz({"30 0 0", "31 0 0", "31 1 0", "32 1 1"});
  const std::string other =
      directory.file("other.xyz", beads + xyz({"30 0 0", "31 1 0", "31 1 1", "32 0 1"}));
  const std::string three = directory.file("three.xyz", beads + beads + beads);

  for (const std::vector<std::string>& inputs :
       {std::vector<std::string>{moving, other}, {moving, resting}, {resting, other}}) {
    std::vector<std::string> arguments{"run", "--frames", "0:2", "--audit", "frames", "--json", "-"};
    arguments.insert(arguments.begin() + 1, inputs.begin(), inputs.end());
    const ProgramRun run = run_program(arguments);
    ASSERT_EQ(run.code, 0) << run.err;
    const Json summary = Json::parse(run.out);
    EXPECT_EQ(summary["input"]["files"].size(), 2U);
    EXPECT_EQ(summary["input"]["beads"], inputs.back() == resting ? 216 : 112);
    EXPECT_EQ(summary["input"]["frames"], 2);
    EXPECT_EQ(summary["structures"].size(), 2U);
  }
  expect_refused({"run", three, other}, {"other.xyz", "three.xyz", "equal frame counts"});
  expect_refused({"run", resting, resting}, {"two frames"});
  expect_refused({"run", kSmall, other}, {"d1_n20_linear.txt", "alone"});
}

TEST(Program, NamesFramesByTheirNumberInTheFile) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string(), dump = (directory / "dump").string();
  const ProgramRun run = run_program({"run", kTrajectory, "--frames", "100:125:10", "--structures", "wrapped",
                                      "--out", out, "--dump", dump});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.err, HasSubstr("a stride of 10 ends at frame 120; 4 frames behind it are left out"));
  EXPECT_THAT(run.out, HasSubstr("108 beads, 3 frames (100 to 120), dimension 3"));
  EXPECT_THAT(content_of(out + "/events.csv"), HasSubstr("\n100,wrapped,"));
  EXPECT_THAT(content_of(out + "/events.csv"), HasSubstr("\n110,wrapped,"));
  const Json input = Json::parse(content_of(out + "/summary.json"))["input"];
  EXPECT_EQ(input["first_frame"], 100);
  EXPECT_EQ(input["last_frame"], 120);
  EXPECT_FALSE(input.contains("picoseconds"));
  EXPECT_TRUE(std::filesystem::exists(dump + "/frame-2.wrapped.csv"));  // dumps count the frames of the run
  const Json info = Json::parse(
      run_program({"info", kTrajectory, "--frames", "100:121:10", "--radius", "0.5", "--json", "-"}).out);
  EXPECT_EQ(info["rows"][0]["first_frame"], 100);
  std::string flat;
  for (int k = 0; k < 4; ++k)
    flat += xyz({"0 0 0", "1 0 1", "2 " + std::to_string(k) + " 2", "3 0 3", "4 1 4"});
  expect_refused({"run", directory.file("flat.xyz", flat), "--structures", "power", "--frames", "2:"},
                 {"plane", "from frame 2 to frame 3"});
}

TEST(Program, TellsTheTimesThatAFileHas) {
  const ScratchDirectory directory;
  std::string bytes = content_of(kTrajectory);
  const float length = 2 / 48.88821F;  // steps of 2 fs, ten of them a frame
  const std::int32_t steps = 10;
  std::memcpy(&bytes[8 + 4 * 2], &steps, sizeof steps);
  std::memcpy(&bytes[8 + 4 * 9], &length, sizeof length);
  const ProgramRun run =
      run_program({"run", directory.file("timed.dcd", bytes), "--frames", "100:103", "--structures",
                   "wrapped", "--out", (directory / "out").string(), "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["input"]["picoseconds"], Json::array({2.0, 2.04}));
  const std::string csv = content_of(directory / "out/events.csv");
  EXPECT_TRUE(csv.starts_with("frame,structure,events,cumulative,picoseconds\n100,wrapped,")) << csv;
  EXPECT_THAT(csv, HasSubstr(",2.02\n"));
  EXPECT_THAT(content_of(directory / "out/report.html"), HasSubstr("from 2 to 2.04 ps"));
}

TEST(Program, RunsTheChainsOfAComplexOnOneClock) {
  const ScratchDirectory directory;
  std::string complex;
  for (int model = 1; model <= 2; ++model) {
    complex += fmt::format("MODEL     {:4}\n", model);
    for (const char chain : {'A', 'B', 'C'})
      for (int residue = 1; residue <= 3; ++residue)
        for (const auto& [name, place] : {std::pair("N", 0), {"CA", 1}, {"C", 2}})
          complex += fmt::format("ATOM      1  {:<3} ALA {}{:4}    {:8.3f}{:8.3f}{:8.3f}\n", name, chain,
                                 residue, 4.5 * residue + 1.5 * place, 9.0 * (chain - 'A'),
                                 0.5 * model * residue * (residue % 2));
    complex += "ENDMDL\n";
  }
  const std::string file = directory.file("complex.pdb", complex);
  const auto beads = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "run");
    arguments.insert(arguments.end(), {"--structures", "wrapped", "--audit", "events", "--json", "-"});
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    EXPECT_EQ(run.err.empty(), std::find(arguments.begin(), arguments.end(), "--chain") != arguments.end());
    return Json::parse(run.out)["input"]["beads"].get<int>();
  };
  EXPECT_EQ(beads({file}), 9);
  EXPECT_EQ(beads({file, "--chain", "B"}), 9);
  EXPECT_EQ(beads({file, "--chain", "A,C,B"}), 27);
  EXPECT_EQ(beads({file, file, "--chain", "A,B"}), 36);
  EXPECT_EQ(beads({file, file, "--chain", "A,B/C"}), 27);
  EXPECT_THAT(run_program({"info", file}).err, HasSubstr("chains B, C not read; --chain B or --chain A,B"));
  const Json info = Json::parse(run_program({"info", file, "--chain", "A,B", "--json", "-"}).out);
  EXPECT_EQ(info["necklaces"].size(), 2U);
  EXPECT_EQ(info["necklaces"][1]["file"], file + " chain B");
  expect_refused({"run", file, "--chain", "A/B"}, {"--chain", "2 INPUTs", "1 is"});
  expect_refused({"run", file, "--chain", "A,"}, {"--chain", "leaves a name empty"});
  expect_refused({"run", file, "--chain", "A,A"}, {"--chain", "twice"});
  expect_refused({"run", file, "--chain", "A,X"}, {"--chain", "has no chain 'X'"});
}

TEST(Program, StandardOutputHoldsWhatWasAskedFor) {
  const ProgramRun table = run_program({"run", kSmall});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("fingerprint "));
  EXPECT_EQ(table.err, "");  // no progress bar: standard error is no terminal

  EXPECT_EQ(run_program({"run", kSmall, "--quiet"}).out, "");

  const ProgramRun json = run_program({"run", kSmall, "--json", "-"});
  EXPECT_EQ(json.code, 0);
  const Json summary = Json::parse(json.out);
  EXPECT_EQ(summary["structures"]["sorted"]["events"]["total"], 97);
  EXPECT_THAT(table.out, HasSubstr(summary["fingerprint"].get<std::string>()));
  EXPECT_EQ(Json::parse(run_program({"run", kSmall, "--json", "-", "--quiet"}).out)["fingerprint"],
            summary["fingerprint"]);
}

TEST(Program, WritesItsReport) {
  const ScratchDirectory directory;
  const std::string report = (directory / "a/report").string();
  const ProgramRun run =
      run_program({"run", kSmall, "--out", report, "--json", (directory / "copy.json").string()});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr(report + "/report.html"));
  const std::string summary = content_of(report + "/summary.json");
  EXPECT_EQ(summary, content_of(directory / "copy.json"));
  EXPECT_EQ(Json::parse(summary)["input"]["beads"], 20);
  EXPECT_EQ(content_of(report + "/events.csv"), "frame,structure,events,cumulative\n0,sorted,97,97\n");
  EXPECT_THAT(content_of(report + "/report.html"), HasSubstr("</html>"));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(report), {}), 3);
}

TEST(Program, ReplaysItsLog) {
  const ScratchDirectory directory;
  const std::string log = (directory / "events.log").string();
  ASSERT_EQ(run_program({"run", kSmall, "--log", log, "--quiet"}).code, 0);
  const ProgramRun same = run_program({"replay", log});
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_THAT(same.out, HasSubstr("fingerprint same"));
  const ProgramRun json = run_program({"replay", log, "--json", "-"});
  EXPECT_EQ(Json::parse(json.out)["replay"]["same"], true);
  EXPECT_EQ(run_program({"replay", log, "--quiet"}).out, "");
  expect_refused({"replay", directory.file("other.log", "not a log\n")}, {"other.log"});
}

TEST(Program, ReplaysRunsWithoutGuarantees) {
  const ScratchDirectory directory;
  const std::string log = (directory / "events.log").string();
  ASSERT_EQ(run_program({"run", data_file("kinetic/degenerate_d3_n64_swap.txt"), "--structures",
                         "wrapped,power", "--kernel", "fast", "--log", log, "--quiet"})
                .code,
            0);
  EXPECT_THAT(run_program({"replay", log}).out, HasSubstr("fingerprint same"));
}

TEST(Program, ANameThatIsNoTextCannotBeLogged) {
  const ScratchDirectory directory;
  const std::string input = directory.file("odd\xff.xyz", xyz({"0 0 0", "1 0 0"}) + xyz({"0 0 0", "2 0 0"}));
  const std::vector<std::string> arguments{"run", input, "--structures", "sorted"};
  EXPECT_EQ(run_program(arguments).code, 0);
  std::vector<std::string> logged = arguments;
  logged.insert(logged.end(), {"--log", (directory / "events.log").string()});
  expect_refused(logged, {"--log", "UTF-8"});
  EXPECT_EQ(directory.entries(), 1U);
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

// Files of more than 4 KB cannot be written: as on a full disk, but for the reason.
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

TEST(Program, ARefusalMakesNoDirectory) {
  const ScratchDirectory directory;
  const std::string input =
      directory.file("a.xyz", xyz({"0 0 0", "1 0 0", "2 0.5 0"}) + xyz({"0 0 0", "nan 0 0", "2 0 0"}));
  const std::string flat = directory.file("flat.xyz", xyz({"0 0 0", "1 0 1", "2 1 2", "3 0 3", "4 1 4"}) +
                                                          xyz({"0 1 0", "1 0 1", "2 2 2", "3 0 3", "4 2 4"}));
  const std::string log = directory.file("log", "not a log\n");
  for (const char* option : {"--out", "--dump"}) {
    const std::string there = (directory / "new/there").string();
    expect_refused({"run", input, option, there}, {"frame 1"});
    expect_refused({"run", flat, option, there, "--structures", "wrapped,power"}, {"plane"});  // at its end
    expect_refused({"run", kSmall, option, there, "--structures", "power"}, {"power"});
    EXPECT_FALSE(std::filesystem::exists(directory / "new"));
  }
  for (const char* command : {"info", "update", "collide", "replay"}) {
    const std::string of = command == std::string("replay") ? log : input;
    expect_refused({command, of, "--out", (directory / "new").string()}, {of});
    EXPECT_FALSE(std::filesystem::exists(directory / "new"));
  }
  std::filesystem::create_directory(directory / "old");
  directory.file("old/frame-0.wrapped.csv", "precious");
  expect_refused({"run", flat, "--dump", (directory / "old").string()}, {"plane"});
  EXPECT_EQ(content_of(directory / "old/frame-0.wrapped.csv"), "precious");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(directory / "old"), {}), 1);
}

TEST(Program, WarningsWaitUntilTheInputIsAccepted) {
  const ScratchDirectory directory;
  const std::string cut = directory.file("cut.xyz", xyz({"0 0 0", "1 0 0", "2 0 0", "9 0 0"}) +
                                                        xyz({"0 0 0", "1 0 0", "2 0 0", "9 1 0"}) + "4\n");
  const std::string bad = directory.file("bad.xyz", "what\n");
  EXPECT_THAT(run_program({"run", cut, "--frames", ":2", "--structures", "wrapped"}).err,
              HasSubstr("warning: " + cut));
  for (const char* command : {"run", "info", "update", "collide"})
    expect_refused({command, cut, bad, "--frames", ":2"}, {"bad.xyz"});
  expect_refused({"run", cut, "--frames", ":2", "--structures", "wrapped", "--nodes", "70:80"}, {"--nodes"});
}

TEST(Program, ADumpReplacesAnEarlierOneAsAWhole) {
  const ScratchDirectory directory;
  const std::string dump = (directory / "dump").string();
  ASSERT_EQ(run_program({"run", kTrajectory, "--frames", "0:12", "--quiet", "--dump", dump}).code, 0);
  for (const char* name : {"frame-1.notes.txt", "frame-01.power.csv", "notes.csv"})
    directory.file(std::string("dump/") + name, "the user's");
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(dump), {}), 36 + 3);
  ASSERT_EQ(run_program(
                {"run", kTrajectory, "--frames", "0:5", "--structures", "wrapped", "--quiet", "--dump", dump})
                .code,
            0);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(dump))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names, testing::UnorderedElementsAre("frame-0.wrapped.csv", "frame-1.wrapped.csv",
                                                   "frame-2.wrapped.csv", "frame-3.wrapped.csv",
                                                   "frame-4.wrapped.csv", "frame-1.notes.txt",
                                                   "frame-01.power.csv", "notes.csv"));
}

// A frame's file leads nowhere: neither the other frames nor the log nor the summary are replaced.
TEST(Program, AllResultsOfARunAreReplacedOrNone) {
  const ScratchDirectory directory;
  const std::string dump = (directory / "dump").string(), log = directory.file("log", "old"),
                    json = directory.file("json", "old"), out = (directory / "out").string();
  std::filesystem::create_directory(dump);
  directory.file("dump/frame-0.wrapped.csv", "old");
  std::filesystem::create_symlink("missing/file", dump + "/frame-1.power.csv");
  expect_refused({"run", kTrajectory, "--frames", "0:3", "--quiet", "--dump", dump, "--log", log, "--json",
                  json, "--out", out},
                 {"frame-1.power.csv: cannot write: No such file or directory"});
  for (const std::string& file : {log, json, dump + "/frame-0.wrapped.csv"})
    EXPECT_EQ(content_of(file), "old");
  EXPECT_FALSE(std::filesystem::exists(out));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(dump), {}), 2);
}

// The plots of the second run fail: the page of the first must not stand beside the figures of the second.
TEST(Program, AReportReplacesAnEarlierOneAsAWhole) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string();
  ASSERT_EQ(run_program({"run", kSmall, "--quiet", "--out", out}).code, 0);
  ASSERT_EQ(directory.file("gnuplot",
                           "#!/bin/sh\ncase $(cat) in *ready*) echo ready;; *) echo no >&2; exit 1;; esac\n"),
            (directory / "gnuplot").string());
  std::filesystem::permissions(directory / "gnuplot", std::filesystem::perms::owner_all);
  const ProgramRun run = run_shell("PATH=\"$2:$PATH\" \"$0\" run \"$1\" --quiet --out \"$2/out\"",
                                   {data_file("kinetic/d3_n20_linear.txt"), directory.path().string()});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("gnuplot failed"));
  EXPECT_EQ(Json::parse(content_of(out + "/summary.json"))["input"]["dimension"], 3);
  EXPECT_THAT(content_of(out + "/events.csv"), HasSubstr("0,power,"));
  EXPECT_FALSE(std::filesystem::exists(out + "/report.html"));
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

// As many frames as one likes need no more memory than a few.
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
    const ProgramRun run = run_program({"run", input, "--structures", "sorted", "--quiet", "--out", there,
                                        "--dump", there, "--log", there + ".log", "--motion", "hermite"});
    EXPECT_EQ(run.code, 0) << run.err;
    const ProgramRun replay = run_program({"replay", there + ".log", "--quiet"});
    EXPECT_EQ(replay.code, 0) << replay.err;
    return std::max(run.peak_kilobytes, replay.peak_kilobytes);
  };
  const long few = peak(10), many = peak(6000);
  EXPECT_LT(many, few + few / 4) << few;
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

TEST(Program, AnInterruptedRunLeavesNothingBehind) {
  for (const char* signal : {"TERM", "HUP", "USR1", "XCPU"}) {
    const ScratchDirectory directory;
    // Waits for the log in the making, and ends the program then.
    const ProgramRun run = run_shell(
        "\"$0\" run \"$1\" --log \"$2/events.log\" --dump \"$2/made/dump\" --audit events & "
        "i=0; while [ -z \"$seen\" ] && [ $i -lt 200 ]; do sleep 0.05; seen=$(ls -A \"$2\" | grep part); "
        "i=$((i+1)); done; echo \"$seen\"; kill -$3 $!; wait $!",
        {data_file("trajectories/villin_hp36_300K.dcd"), directory.path().string(), signal});
    EXPECT_GT(run.code, 128) << run.err;
    EXPECT_THAT(run.out, HasSubstr(".part"));
    EXPECT_EQ(directory.entries(), 0U);
  }
}

TEST(Program, WhatAKilledRunLeftIsClearedByTheNext) {
  const ScratchDirectory directory;
  const std::string there = directory.path().string();
  const ProgramRun killed = run_shell(
      "\"$0\" run \"$1\" --dump \"$2\" --audit events & "
      "i=0; while [ -z \"$seen\" ] && [ $i -lt 200 ]; do sleep 0.05; seen=$(ls -A \"$2\"/.kds-*); "
      "i=$((i+1)); done; kill -KILL $!; wait $!",
      {data_file("trajectories/villin_hp36_300K.dcd"), there});
  EXPECT_EQ(killed.code, 128 + 9) << killed.err;
  ASSERT_EQ(directory.entries(), 1U);
  EXPECT_EQ(run_program({"run", data_file("kinetic/d3_n20_linear.txt"), "--quiet", "--dump", there}).code, 0);
  EXPECT_EQ(directory.entries(), 4U);  // cells and hidden beads of two frames
}

}  // namespace
}  // namespace kds::test
