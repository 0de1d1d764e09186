// Tests the program as a process: the scenes that it runs, and their counts.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::program_scenes_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

const std::string kSmall = data_file("kinetic/d1_n20_linear.txt");
const std::string kTrajectory = data_file("trajectories/villin_hp36_300K.dcd");

// A linear motion written with five control points per coordinate has other polynomials but the same events.
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
      const ProgramRun run = run_program({"run", flat, "--structures", structures, "--motion", motion,
                                          "--radius", rule, "--audit", "events", "--dump", directory / "dump",
                                          "--replace", "--quiet", "--json", "-"});
      ASSERT_EQ(run.code, 0) << run.err;
      const Json result = Json::parse(run.out);
      EXPECT_EQ(result["input"]["dimension"], 2);
      EXPECT_GT(result["structures"]["power"]["events"]["total"], 0);
      EXPECT_EQ(content_of(directory / "dump/frame-1.power.csv").substr(0, 6), "a,b,c\n");
      if (motion != std::string("lifted")) {
        EXPECT_THAT(content_of(directory / "dump/frame-1.wrapped.csv"), HasSubstr(",7,"));
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

// A bead comes from so far away that all its events lie within 2^-200 of the step.
TEST(Program, RebuildsBetweenEventsOfABeadFromFarAway) {
  const ScratchDirectory directory;
  const std::string far = directory.file(
      "far.xyz", xyz({"1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}) +
                     xyz({"-1e80 0.3 0.2", "0 0 0", "1 0 0", "0 1 0", "1 1 0", "0 0 1", "1 0 1", "0 1 1"}));
  const ProgramRun run = run_program(
      {"run", far, "--structures", "power", "--radius", "0.1", "--audit", "events", "--json", "-"});
  ASSERT_EQ(run.code, 0) << run.err;
  EXPECT_EQ(Json::parse(run.out)["structures"]["power"]["audits"]["failed"], 0);
}

// Four beads start in one plane and move by units in the last place, which doubles cannot resolve.
TEST(Program, GoesOnWhereDoublesDoNotTellTheBeadsApart) {
  const ScratchDirectory directory;
  const std::string flat = directory.file("flat.txt",
                                          "5 3 1\n"
                                          "-1 -1 -2 -1.9999999999999998 -2 -2\n"
                                          "-1 -1 -2 -2 -2 -1.9999999999999998\n"
                                          "-1 -1 -2 -2 0 1.1102230246251565e-16\n"
                                          "-1 -1 0 1.1102230246251565e-16 0 -1.1102230246251565e-16\n"
                                          "-2 -2.0000000000000004 -1 -1 0 1.1102230246251565e-16\n");
  for (const char* kernel : {"filtered", "exact"}) {
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

// Every third bead is smaller, so the certificates of the hierarchy contain square roots.
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
  arguments.insert(arguments.end(), {"--levels", "0:2", "--log", log, "--dump", directory / "dump"});
  const ProgramRun some = run_program(arguments);
  ASSERT_EQ(some.code, 0) << some.err;
  const auto created = [](const ProgramRun& run) {
    return Json::parse(run.out)["structures"]["wrapped"]["certificates"]["created"].get<int>();
  };
  EXPECT_LT(created(some), created(all));
  EXPECT_EQ(Json::parse(some.out)["settings"]["levels"], "0:2");
  const std::string dump = content_of(directory / "dump/frame-1.wrapped.csv");
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
       {std::vector<std::string>{moving, other}, {moving, "--obstacle", resting}, {resting, other}}) {
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
  EXPECT_THAT(run.err, HasSubstr("a stride of 10 ends at frame 120; 4 frames after it are left out"));
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
  const float length = 2 / 48.88821F;  // steps of 2 fs, ten steps per frame
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
                                 0.25 * model * residue * (residue % 2));
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

// The list omits the chain of the water.
TEST(Program, ListsTheChainsThatCanBeChosen) {
  const ScratchDirectory directory;
  std::string model;
  int serial = 0;
  const auto atom = [&](const char* record, const char* name, const char* residue, char chain, char element) {
    ++serial;
    model += fmt::format(
        "{:<6}{:>5} {:<4} {:>3} {}{:>4}    {:8.3f}{:8.3f}{:8.3f}  1.00  0.00          {:>2}\n", record,
        serial, name, residue, chain, (serial + 2) / 3, 1.4 * serial, 0.3 * (serial % 2), 0.0, element);
  };
  for (int k = 0; k < 3; ++k)
    for (const char* name : {" N", " CA", " C"}) atom("ATOM", name, "ALA", 'A', name[1]);
  atom("HETATM", " O", "HOH", 'W', 'O');
  const std::string file = directory.file("water.pdb", model + "END\n");
  expect_refused({"run", file, "--chain", "X"}, {"--chain", "has no chain 'X'; expected A\n"});
}

}  // namespace
}  // namespace kds::test::program_scenes_test
