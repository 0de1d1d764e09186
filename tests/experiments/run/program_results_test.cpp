// Tests the program as a process: the places of its results, and that all results appear together.

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_results_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");
const std::string kTrajectory = data_file("trajectories/villin_hp36_300K.dcd");

TEST(Program, StandardOutputHoldsWhatWasAskedFor) {
  const ProgramRun table = run_program({"run", kSmall});
  EXPECT_EQ(table.code, 0) << table.err;
  EXPECT_THAT(table.out, HasSubstr("fingerprint "));
  EXPECT_EQ(table.err, "");  // no progress bar, because standard error is not a terminal

  EXPECT_EQ(run_program({"run", kSmall, "--quiet"}).out, "");

  const ProgramRun json = run_program({"run", kSmall, "--json", "-"});
  EXPECT_EQ(json.code, 0);
  const Json summary = Json::parse(json.out);
  EXPECT_EQ(summary["structures"]["sorted"]["events"]["total"], 97);
  EXPECT_THAT(table.out, HasSubstr(summary["fingerprint"].get<std::string>()));
  EXPECT_EQ(Json::parse(run_program({"run", kSmall, "--json", "-", "--quiet"}).out)["fingerprint"],
            summary["fingerprint"]);
}

TEST(Program, RoundsChangeNothingButTimes) {
  const auto summary = [](std::vector<std::string> more) {
    std::vector<std::string> arguments{"run",     kTrajectory, "--frames", ":9",
                                       "--audit", "frames",    "--json",   "-"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const ProgramRun run = run_program(arguments);
    EXPECT_EQ(run.code, 0) << run.err;
    return Json::parse(run.out);
  };
  const Json once = summary({}), thrice = summary({"--rounds", "3"});
  EXPECT_EQ(once["fingerprint"], thrice["fingerprint"]);
  EXPECT_THAT(once["settings"]["rounds"], "");
  EXPECT_THAT(thrice["settings"]["rounds"], "3");
  EXPECT_THAT(thrice["command"].get<std::string>(), HasSubstr(" --rounds 3"));
  for (const auto& [name, structure] : thrice["structures"].items()) {
    const Json& single = once["structures"][name];
    for (const char* same : {"events", "certificates", "stages", "audits"})
      EXPECT_EQ(structure[same], single[same]) << name;
    EXPECT_FALSE(single.contains("seconds_least"));
    for (const std::string what : {"seconds", "static_seconds"}) {
      EXPECT_GT(structure[what + "_least"], 0) << name;
      EXPECT_LE(structure[what + "_least"], structure[what]) << name;
      EXPECT_LE(structure[what], structure[what + "_most"]) << name;
    }
  }
  EXPECT_EQ(run_program({"run", kTrajectory, "--rounds", "0"}).code, 2);
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
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(report), {}), 4);
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
    // The run fails at its end.
    expect_refused({"run", flat, option, there, "--structures", "wrapped,power"}, {"plane"});
    expect_refused({"run", kSmall, option, there, "--structures", "power"}, {"power"});
    EXPECT_FALSE(std::filesystem::exists(directory / "new"));
  }
  for (const char* command : {"info", "update", "collide", "replay"}) {
    const std::string of = command == std::string("replay") ? log : input;
    expect_refused({command, of, "--out", (directory / "new").string()}, {of});
    EXPECT_FALSE(std::filesystem::exists(directory / "new"));
  }
  std::filesystem::create_directory(directory / "old");
  directory.file("old/contacts.csv", "precious");
  expect_refused({"run", flat, "--dump", (directory / "old").string()}, {"--dump", "holds files"});
  EXPECT_EQ(content_of(directory / "old/contacts.csv"), "precious");
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

TEST(Program, ResultsAreReplacedOnRequestOnly) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string(), dump = (directory / "dump").string();
  const std::vector<std::string> first{"run",    kTrajectory, "--frames", "0:12", "--quiet",
                                       "--dump", dump,        "--out",    out};
  ASSERT_EQ(run_program(first).code, 0);
  ASSERT_EQ(std::distance(std::filesystem::directory_iterator(dump), {}), 36 + 1);
  expect_refused(first, {"holds files; --replace replaces an earlier result"});
  std::vector<std::string> second{"run",          kTrajectory, "--frames", "0:2",
                                  "--structures", "wrapped",   "--quiet",  "--dump",
                                  dump,           "--out",     out,        "--replace"};
  ASSERT_EQ(run_program(second).code, 0);
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(dump))
    names.push_back(entry.path().filename().string());
  EXPECT_THAT(names,
              testing::UnorderedElementsAre("frame-0.wrapped.csv", "frame-1.wrapped.csv", ".kds-results"));
  EXPECT_EQ(Json::parse(content_of(out + "/summary.json"))["input"]["frames"], 2);
  directory.file("dump/notes.txt", "the user's");
  const std::string summary = content_of(out + "/summary.json");
  expect_refused(second, {"--dump", "notes.txt there is not of an earlier result"});
  EXPECT_EQ(content_of(dump + "/notes.txt"), "the user's");
  EXPECT_EQ(content_of(out + "/summary.json"), summary);
  expect_refused({"info", kTrajectory, "--out", dump, "--replace"}, {"notes.txt there is not of"});
  EXPECT_EQ(run_program({"info", kTrajectory, "--quiet", "--out", out, "--replace"}).code, 0);
  EXPECT_FALSE(std::filesystem::exists(out + "/summary.json"));
}

TEST(Program, GeneratedFilesReplaceOnlyGeneratedFiles) {
  const ScratchDirectory directory;
  // The user has not named these two files on the command line.
  directory.file("pair-2.xyz", "the user's");
  expect_refused({"generate", "two-spirals", "--beads", "8", "-o", (directory / "pair.xyz").string()},
                 {"-o", "pair-2.xyz", "was not written by kds generate"});
  EXPECT_EQ(content_of(directory / "pair-2.xyz"), "the user's");
  for (int k = 0; k < 2; ++k)
    EXPECT_EQ(run_program({"generate", "two-spirals", "--beads", "8", "--quiet", "-o",
                           (directory / "two.xyz").string()})
                  .code,
              0);
}

TEST(Program, AReportReplacesAnEarlierOneAsAWhole) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string();
  ASSERT_EQ(run_program({"run", kSmall, "--quiet", "--out", out}).code, 0);
  const ProgramRun run =
      run_program({"run", data_file("kinetic/d3_n20_linear.txt"), "--quiet", "--out", out, "--replace"});
  EXPECT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(content_of(out + "/summary.json"))["input"]["dimension"], 3);
  EXPECT_THAT(content_of(out + "/events.csv"), HasSubstr("0,power,"));
  const std::string page = content_of(out + "/report.html");
  EXPECT_THAT(page, HasSubstr("d3_n20_linear.txt"));
  EXPECT_THAT(page, Not(HasSubstr("d1_n20_linear.txt")));
}

// The plots of the second run fail, so the page and the figures of the first result stay.
TEST(Program, APlotThatFailsLeavesTheEarlierResult) {
  const ScratchDirectory directory;
  const std::string out = (directory / "out").string();
  ASSERT_EQ(run_program({"run", kSmall, "--quiet", "--out", out}).code, 0);
  ASSERT_EQ(directory.file("gnuplot",
                           "#!/bin/sh\ncase $(cat) in *ready*) echo ready;; *) echo no >&2; exit 1;; esac\n"),
            (directory / "gnuplot").string());
  std::filesystem::permissions(directory / "gnuplot", std::filesystem::perms::owner_all);
  const ProgramRun run = run_shell("PATH=\"$2:$PATH\" \"$0\" run \"$1\" --quiet --replace --out \"$2/out\"",
                                   {data_file("kinetic/d3_n20_linear.txt"), directory.path().string()});
  EXPECT_EQ(run.code, 1);
  EXPECT_THAT(run.err, HasSubstr("gnuplot failed"));
  EXPECT_EQ(Json::parse(content_of(out + "/summary.json"))["input"]["dimension"], 1);
  EXPECT_THAT(content_of(out + "/report.html"), HasSubstr("d1_n20_linear.txt"));
}

TEST(Program, WithoutGnuplotNoPageIsPromised) {
  const ScratchDirectory directory;
  for (const char* command : {"run", "compare", "update"}) {
    const ProgramRun run =
        run_shell(std::string("PATH=/nowhere \"$0\" ") + command + " \"$1\" --out \"$2/out\"",
                  {kTrajectory, directory.path().string()});
    EXPECT_EQ(run.code, 2) << command;
    EXPECT_THAT(run.err, HasSubstr("--out needs gnuplot for its plots")) << command;
    EXPECT_FALSE(std::filesystem::exists(directory / "out")) << command;
  }
}

// The outputs do not exist yet, and one name is used as a file and as a directory.
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
  // Results wait in PLACE.part.
  const std::string part = both + ".part";
  expect_refused({"run", kSmall, "--json", part, "--out", both}, {"--json", "both.part", "--out"});
  expect_refused({"run", kSmall, "--log", both, "--events", part}, {"both.part: is the file of"});
  expect_refused({"run", kSmall, "--dump", part, "--out", both}, {"both.part", "is in the way of"});
  for (const char* command : {"run", "compare", "info"})
    expect_refused({command, kTrajectory, "--replace"}, {"--replace: replaces a directory of results"});
  expect_refused({"view", kTrajectory, "-o", both, "--replace"}, {"--replace", "--vtk DIR"});
  EXPECT_EQ(directory.entries(), 0U);
}

// Each result is a whole directory.
TEST(Program, DumpAndResultsLieInTwoDirectories) {
  const ScratchDirectory directory;
  const std::string both = (directory / "both").string(), link = (directory / "link").string();
  std::filesystem::create_directory(both);
  std::filesystem::create_directory_symlink(both, link);
  for (const std::string& other : {both, both + "/", link, link + "/../both", both + "/below"}) {
    expect_refused({"run", kSmall, "--dump", other, "--out", both}, {"--dump", "is in the way of --out"});
    expect_refused({"run", kSmall, "--dump", both, "--out", other}, {"--dump", "is in the way of --out"});
  }
  for (const char* option : {"--log", "--events", "--view", "--json"})
    for (const char* of : {"--out", "--dump"})
      expect_refused({"run", kSmall, option, both + "/file", of, both}, {option, of, "both"});
  const std::string input = (directory / "both/helix.xyz").string();
  ASSERT_EQ(run_program({"generate", "helix", "--beads", "8", "--frames", "2", "--quiet", "-o", input}).code,
            0);
  expect_refused({"run", input, "--out", both, "--replace"}, {"helix.xyz", "an input"});
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
    // Standard output that appends to a file: the program writes on, and must not replace the beginning of
    // the file.
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

// A named pipe would wait for a reader, at the end of a run at the latest.
TEST(Program, NamedPipesAreNoOutputs) {
  const ScratchDirectory directory;
  const std::string pipe = (directory / "pipe").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  for (const char* option : {"--events", "--log", "--json"})
    expect_refused({"run", kSmall, option, pipe}, {option, "pipe: is a named pipe, expected a file"});
}

}  // namespace
}  // namespace kds::test::program_results_test
