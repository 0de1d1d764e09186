// Tests `kds sweep` as a program: resuming, changed inputs, parts, collected tables, limits and scripts.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "experiments/output/text.h"
#include "experiments/sweep/engine_scripts.h"
#include "experiments/sweep/pooled_figures.h"
#include "experiments/sweep/result_rows.h"
#include "experiments/sweep/run_sweep.h"
#include "experiments/sweep/sweep_page.h"
#include "experiments/sweep/sweep_status.h"
#include "experiments/sweep/swept_task.h"
#include "tests/experiments/expect_refused.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::test::sweep_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

std::string run_sweep(const ScratchDirectory& scratch, const std::vector<std::string>& more = {},
                      int code = 0) {
  std::vector<std::string> arguments{"sweep", scratch / "s.json", "-o", scratch / "out"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramRun run = run_program(arguments);
  EXPECT_EQ(run.code, code) << run.out << run.err;
  return run.out + run.err;
}

std::size_t records(const ScratchDirectory& scratch, const std::string& kind) {
  std::size_t count = 0;
  for (const auto& file : std::filesystem::directory_iterator(scratch / "out/results"))
    for (const std::string& line : split(content_of(file.path()), '\n'))
      if (line.find(' ' + kind + ' ') == 16) ++count;
  return count;
}

// Returns results.json after collecting.
Json collected(const ScratchDirectory& scratch, int code = 0) {
  const ProgramRun run = run_program({"sweep", "collect", scratch / "out"});
  EXPECT_EQ(run.code, code) << run.out << run.err;
  return Json::parse(content_of(scratch / "out/results.json"));
}

std::string chain(double bend) {
  std::string frames;
  for (int frame = 0; frame < 5; ++frame) {
    std::vector<std::string> beads;
    for (int bead = 0; bead < 12; ++bead)
      beads.push_back(std::to_string(bead) + " " + std::to_string(bend * frame * (bead % 3)) + " " +
                      std::to_string(0.1 * (bead * bead % 7) + 0.05 * frame * (bead % 2)));
    frames += xyz(beads);
  }
  return frames;
}

TEST(Sweep, ResumesAndRepeatsOnlyTasksOfAChangedInput) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("b.xyz", chain(0.3));
  scratch.file("s.json", R"({"inputs": ["?.xyz", "missing.xyz"], "commands": [
      {"command": "run", "options": {"structures": ["wrapped", "power"], "stride": [1, 2]}}]})");
  EXPECT_THAT(run_sweep(scratch, {}, 1), HasSubstr("8 of 12 tasks have results, 4 failed, 0 crashed"));
  EXPECT_EQ(records(scratch, "try"), 12U);
  const Json first = collected(scratch, 1);
  EXPECT_EQ(first["rows"].size(), 8U);

  static_cast<void>(run_sweep(scratch, {}, 1));  // nothing to do
  EXPECT_EQ(records(scratch, "try"), 12U);
  scratch.file("b.xyz", chain(0.4));
  static_cast<void>(run_sweep(scratch, {}, 1));
  EXPECT_EQ(records(scratch, "try"), 16U);
  scratch.file("missing.xyz", chain(0.5));
  static_cast<void>(run_sweep(scratch));
  EXPECT_EQ(records(scratch, "try"), 20U);
  const Json second = collected(scratch);
  EXPECT_EQ(second["rows"].size(), 12U);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(second["rows"][k], first["rows"][k]);  // those of a.xyz
  EXPECT_NE(second["rows"][4], first["rows"][4]);
  expect_sound(content_of(scratch / "out/report.html"));
}

// The result of other content must not get the name of the content that was hashed.
TEST(Sweep, LeavesTasksWhoseInputChangesMeanwhile) {
  const ScratchDirectory scratch;
  const std::string input = scratch.file("a.xyz", chain(0.2));
  const std::string text = R"({"inputs": ["a.xyz"], "commands": ["info", "run"]})";
  InputHashes hashes([] { return false; });
  PatternFiles files;
  const SweepPlan plan(read_sweep(read_json(text, "s.json"), scratch.path(), files, "s.json"), hashes,
                       "s.json");
  EXPECT_FALSE(hashes.has_changed(input));
  scratch.file("a.xyz", chain(0.2) + chain(0.3));
  std::filesystem::create_directories(results_folder(scratch / "out"));
  TaskLauncher launcher;
  StopSignals signals;
  std::vector<std::string> warnings;
  const SweepOutcome outcome = kds::run_sweep(
      plan, hashes, scratch / "out", {}, launcher, signals, [](std::size_t, std::size_t) {},
      [&](const std::string& warning) { warnings.push_back(warning); });
  EXPECT_EQ(outcome.done + outcome.failed + outcome.crashed, 0U);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_THAT(warnings, testing::ElementsAre(HasSubstr("a.xyz: changed while the sweep ran")));
}

// Results are found by the content that an input had, also after the input is gone.
TEST(Sweep, CollectsResultsOfInputsThatAreGone) {
  const ScratchDirectory scratch;
  const std::string a = scratch.file("a.xyz", chain(0.2)), c = scratch.file("c.xyz", chain(0.4));
  scratch.file("b.xyz", chain(0.3));
  scratch.file("d[1].xyz", chain(0.5));
  scratch.file("radii", "0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n");
  scratch.file("s.json", R"({"inputs": ["[ab].xyz", "./d[1].xyz", {"file": "c.xyz", "radius": "file:radii"}],
      "commands": [{"command": "run", "segment_steps": 2, "options": {"structures": "power"}}]})");
  static_cast<void>(run_sweep(scratch));
  static_cast<void>(collected(scratch));
  const std::string before = content_of(scratch / "out/results.csv");
  for (const char* file : {"a.xyz", "c.xyz", "d[1].xyz", "radii"}) std::filesystem::remove(scratch / file);
  const ProgramRun collect = run_program({"sweep", "collect", scratch / "out"});
  EXPECT_EQ(collect.code, 0) << collect.err;
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
  EXPECT_THAT(collect.err, HasSubstr(a + ": cannot be read any more"));
  EXPECT_THAT(collect.err, HasSubstr("1 more cannot be read any more"));
  const ProgramRun status = run_program({"sweep", "status", scratch / "out"});
  EXPECT_EQ(status.code, 0);
  EXPECT_THAT(status.err, HasSubstr(c + ": cannot be read any more"));

  scratch.file("a.xyz", chain(0.6));  // another content has no result
  EXPECT_THAT(run_program({"sweep", "collect", scratch / "out"}).out, HasSubstr("2 are missing"));
  scratch.file("a.xyz", chain(0.2));
  EXPECT_EQ(run_program({"sweep", "collect", scratch / "out"}).code, 0);
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
}

// A topology whose name has a comma is one file, also after it is gone.
TEST(Sweep, KnowsATopologyWithACommaThatIsGone) {
  const ScratchDirectory scratch;
  const std::string topology = scratch / "1,l2y.pdb", away = scratch / "away";
  std::filesystem::copy_file(data_file("proteins/1l2y.pdb"), topology);
  scratch.file("s.json", R"({"inputs": {"file": ")" + data_file("trajectories/1l2y.dcd") +
                             R"(", "topology": "1,l2y.pdb"}, "commands": [
      {"command": "info", "options": {"frames": ["0:2", "900:"]}}]})");
  static_cast<void>(run_sweep(scratch, {}, 1));
  static_cast<void>(collected(scratch, 1));
  const std::string results = content_of(scratch / "out/results.csv"),
                    failed = content_of(scratch / "out/failed.csv");
  EXPECT_THAT(failed, HasSubstr("--topology " + shell_words({topology})));
  std::filesystem::rename(topology, away);
  const ProgramRun collect = run_program({"sweep", "collect", scratch / "out"});
  EXPECT_THAT(collect.out, HasSubstr("1 of 2 tasks have results"));
  EXPECT_THAT(collect.err, HasSubstr(topology + ": cannot be read any more"));
  EXPECT_EQ(content_of(scratch / "out/results.csv"), results);
  EXPECT_EQ(content_of(scratch / "out/failed.csv"), failed);
  EXPECT_THAT(run_sweep(scratch, {"--retry"}, 1), HasSubstr("1 wait for inputs"));
  std::filesystem::rename(away, topology);
  EXPECT_THAT(run_sweep(scratch, {}, 1), HasSubstr("1 of 2 tasks have results, 1 failed"));
}

// Tasks have the name of the content, which does not fail because the file is away for a while.
TEST(Sweep, TasksWaitForInputsThatAreGone) {
  const ScratchDirectory scratch;
  const std::string input = scratch.file("a.xyz", chain(0.2)), away = scratch / "away";
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": ["info"]})");
  static_cast<void>(run_sweep(scratch));
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": ["info", "run"]})");
  std::filesystem::rename(input, away);
  EXPECT_THAT(run_sweep(scratch, {}, 1),
              testing::AllOf(HasSubstr("1 of 2 tasks have results, 0 failed"), HasSubstr("1 wait for inputs"),
                             HasSubstr("a.xyz: cannot be read any more")));
  EXPECT_EQ(records(scratch, "fail"), 0U);
  std::filesystem::rename(away, input);
  static_cast<void>(run_sweep(scratch));
  EXPECT_EQ(collected(scratch)["done"], 2);
}

TEST(Sweep, NoticesContentOfEqualSizeAndTime) {
  const ScratchDirectory scratch;
  const std::string input = scratch.file("a.xyz", chain(0.2));
  const auto time = std::filesystem::last_write_time(input) - std::chrono::hours(1);
  std::filesystem::last_write_time(input, time);
  std::this_thread::sleep_for(std::chrono::milliseconds(2100));  // then the hash is remembered with its times
  const auto hashes = [&] {
    InputHashes found([] { return false; });
    found.load(scratch.path());
    return found;
  };
  InputHashes first = hashes();
  const std::uint64_t hash = first.hash(input);
  first.save(scratch.path());
  EXPECT_THAT(content_of(scratch / "inputs.json"), HasSubstr("\"changed\""));
  EXPECT_EQ(hashes().hash(input), hash);
  std::filesystem::last_write_time(input, time + std::chrono::hours(2));
  EXPECT_FALSE(first.has_changed(input));  // the content is as it was
  EXPECT_EQ(hashes().hash(input), hash);

  const std::string other = chain(0.3);
  ASSERT_EQ(other.size(), chain(0.2).size());
  scratch.file("a.xyz", other);
  std::filesystem::last_write_time(input, time);
  EXPECT_TRUE(first.has_changed(input));
  EXPECT_NE(hashes().hash(input), hash);
}

// Several tasks run at a time, so a task has one thread unless the sweep says another number.
TEST(Sweep, TasksHaveOneThreadUnlessTheSweepSaysMore) {
  const std::string text = R"({"inputs": ["a.xyz"], "commands": ["info",
      {"command": "run", "options": {"threads": [null, 2]}}]})";
  PatternFiles files;
  InputHashes hashes([] { return false; });
  const SweepPlan plan(read_sweep(read_json(text, "s.json"), "/nowhere", files, "s.json"), hashes, "s.json");
  std::vector<Arguments> arguments;
  for (const SweepTask& task : plan.tasks()) arguments.push_back(task_arguments(plan, task));
  const Arguments json{"--quiet", "--json", "-"};
  const auto with = [&](Arguments words) {
    words.insert(words.end(), json.begin(), json.end());
    return words;
  };
  EXPECT_THAT(arguments, testing::ElementsAre(with({"info", "/nowhere/a.xyz"}),
                                              with({"run", "/nowhere/a.xyz", "--threads", "1"}),
                                              with({"run", "/nowhere/a.xyz", "--threads", "2"})));
}

// A name that is not UTF-8 is no reason to lose a row.
TEST(Sweep, CollectsFilesOfAnyName) {
  const ScratchDirectory scratch;
  for (const char* name : {"a\xff.xyz", "a b\nc.xyz", "a\"',.xyz"}) scratch.file(name, chain(0.2));
  scratch.file(
      "s.json",
      R"({"inputs": ["a*.xyz"], "commands": [{"command": "run", "options": {"structures": "power"}}]})");
  static_cast<void>(run_sweep(scratch));
  const Json rows = collected(scratch)["rows"];
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0]["input"], "a b\nc.xyz");
  EXPECT_EQ(rows[1]["input"], "a\"',.xyz");
  EXPECT_EQ(rows[2]["input"], "a\ufffd.xyz");
  for (const Json& row : rows) EXPECT_EQ(row["input.beads"], 12);
}

TEST(Sweep, IntervalsOfCountsStayAboveZero) {
  PooledFigure figure;
  figure.values = {1, 100, 3};
  ASSERT_TRUE(figure.interval());
  EXPECT_GT(figure.interval()->lower, 0);
  EXPECT_LT(figure.interval()->lower, figure.mean());
  EXPECT_GT(figure.interval()->upper, figure.mean());
  figure.counts = false;
  EXPECT_LT(figure.interval()->lower, 0);
  figure.values = {2, 2, 2};
  EXPECT_EQ(figure.interval()->lower, 2);
  figure.counts = true;
  EXPECT_FALSE(figure.interval());
  EXPECT_EQ(figure.no_interval(), "all values are equal");
}

// Two counts would have an interval that reaches over many powers of ten.
TEST(Sweep, IntervalsTakeThreeValues) {
  PooledFigure figure;
  figure.values = {300, 9000};
  for (const bool counts : {true, false}) {
    figure.counts = counts;
    EXPECT_FALSE(figure.interval());
    EXPECT_EQ(figure.no_interval(), "fewer than 3 values");
  }
  figure.counts = true;
  figure.values.push_back(0);
  ASSERT_TRUE(figure.interval());
  EXPECT_EQ(figure.no_interval(), "");
  EXPECT_LT(figure.interval()->upper / figure.mean(), 75);
}

// The twin: each task's own command, read by another JSON library.
TEST(Sweep, CollectsWhatTheCommandsPrint) {
  const ScratchDirectory scratch;
  for (const std::string seed : {"1", "2", "3"})
    static_cast<void>(run_program({"generate", "random-chain", "--beads", "12", "--frames", "6", "--seed",
                                   seed, "-o", scratch / (seed + ".xyz")}));
  scratch.file("s.json", R"({"inputs": ["1.xyz", "2.xyz", "3.xyz"], "commands": [
      {"command": "run", "options": {"structures": "wrapped,power", "radius": [0.6, 0.9]}}]})");
  static_cast<void>(run_sweep(scratch));
  const Json all = collected(scratch);
  ASSERT_EQ(all["rows"].size(), 12U);
  std::map<std::string, std::vector<double>> totals;
  for (const Json& row : all["rows"]) {
    const std::string structure = row["structure"], radius = row["radius"];
    const ProgramRun run = run_program({"run", scratch / row["input"].get<std::string>(), "--structures",
                                        "wrapped,power", "--radius", radius, "--quiet", "--json", "-"});
    const Json twin = Json::parse(run.out);
    EXPECT_EQ(row["events.total"], twin["structures"][structure]["events"]["total"]);
    EXPECT_EQ(row["fingerprint"], twin["fingerprint"]);
    EXPECT_FALSE(row.contains("seconds"));
    totals[structure + radius].push_back(row["events.total"]);
  }
  std::size_t found = 0, intervals = 0;
  for (const std::string& line : split(content_of(scratch / "out/pooled.csv"), '\n')) {
    if (line.find(",events.total,") == std::string::npos) continue;
    const std::vector<std::string> cells =
        split(line, ',');  // command, structures (quoted, 2), radius, row, ...
    ++found;
    EXPECT_EQ(cells[6], "3") << line;
    const std::string structure = cells[4].substr(cells[4].find(' ') + 1);
    const std::vector<double>& values = totals.at(structure + cells[3]);
    const double mean = (values[0] + values[1] + values[2]) / 3;
    EXPECT_DOUBLE_EQ(std::stod(cells[7]), mean) << line;
    double squares = 0;
    for (const double value : values) squares += (value - mean) * (value - mean);
    if (squares == 0) {
      EXPECT_EQ(cells[8] + cells[9] + cells[10], "all values are equal") << line;
      continue;
    }
    ++intervals;
    constexpr double student = 4.302652729749464;  // 97.5%, two degrees of freedom
    const double factor = std::exp(student * std::sqrt(squares / 2 / 3) / mean);
    EXPECT_NEAR(std::stod(cells[8]), mean / factor, 1e-9 * mean) << line;
    EXPECT_NEAR(std::stod(cells[9]), mean * factor, 1e-9 * mean * factor) << line;
    EXPECT_EQ(cells[10], "") << line;
  }
  EXPECT_EQ(found, 4U);
  EXPECT_GE(intervals, 2U);
}

// Counts of segments add up to those of the uncut trajectory.
TEST(Sweep, SegmentsAddUpToTheWhole) {
  const ScratchDirectory scratch;
  const auto rows = [&](const std::string& segment_steps) {
    const std::string input = data_file("trajectories/1l2y.dcd"), topology = data_file("proteins/1l2y.pdb");
    scratch.file("s.json", R"({"inputs": {"file": ")" + input + R"(", "topology": ")" + topology +
                               R"(", "frames": "2:31"}, "commands": [{"command": "run", )" + segment_steps +
                               R"("options": {"structures": "wrapped,power,contacts", "stride": [1, 3]}}]})");
    static_cast<void>(run_sweep(scratch));
    return collected(scratch)["rows"];
  };
  const Json segments = rows(R"("segment_steps": 5, )"), whole = rows("");
  ASSERT_EQ(segments.size(), 6U);
  for (std::size_t k = 0; k < segments.size(); ++k) {
    std::size_t compared = 0;
    for (const auto& [name, value] : segments[k].items()) {
      if (!name.starts_with("events.") && name != "input.frames") continue;
      EXPECT_EQ(value, whole[k][name]) << name;
      ++compared;
    }
    EXPECT_GE(compared, 4U);
    EXPECT_FALSE(segments[k].contains("fingerprint"));
  }
  EXPECT_EQ(records(scratch, "done"), 6U + 2U + 2U);
}

TEST(Sweep, ShardsDivideTheTasks) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": [
      {"command": "info", "options": {"radius": [0.5, 0.6, 0.7, 0.8, 0.9]}}]})");
  EXPECT_THAT(run_sweep(scratch, {"--shard", "2/3"}), HasSubstr("2 of 2 tasks of the shard"));
  const Json half = collected(scratch, 1);
  EXPECT_EQ(half["done"], 2);
  EXPECT_THAT(run_program({"sweep", "collect", scratch / "out"}).out, HasSubstr("3 are missing, such as"));
  EXPECT_THAT(run_program({"sweep", "status", scratch / "out"}).out, HasSubstr("info"));
  const std::string slurm = "SLURM_ARRAY_TASK_MIN=4 SLURM_ARRAY_TASK_COUNT=3 SLURM_ARRAY_TASK_ID=";
  for (const char* id : {"4", "6"})
    EXPECT_EQ(
        run_shell(slurm + id + " $0 sweep $1 -o $2 --quiet", {scratch / "s.json", scratch / "out"}).code, 0);
  const ProgramRun outside =
      run_shell(slurm + "9 $0 sweep $1 -o $2 --quiet", {scratch / "s.json", scratch / "out"});
  EXPECT_EQ(outside.code, 2);
  EXPECT_THAT(outside.err, HasSubstr("SLURM_ARRAY_TASK_ID 9"));
  EXPECT_EQ(collected(scratch)["done"], 5);
  EXPECT_EQ(records(scratch, "try"), 5U);
}

TEST(Sweep, SeedsArePooled) {
  const ScratchDirectory scratch;
  scratch.file("s.json", R"({"seeds": 3, "commands": [
      {"command": "scale", "options": {"model": "random-chain", "beads": "16", "steps": 1, "structures": "power"}}]})");
  static_cast<void>(run_sweep(scratch));
  const Json all = collected(scratch);
  double sum = 0;
  std::size_t seeds = 0;
  for (const Json& row : all["rows"])
    if (row["measure"] == "pairs_looked_at") {
      sum += row["value"].get<double>();
      ++seeds;
    } else {
      EXPECT_TRUE(row["measure"] != "seconds_per_step" || !row.contains("value"));
    }
  EXPECT_EQ(seeds, 3U);
  const std::string pooled = content_of(scratch / "out/pooled.csv");
  std::size_t means = 0;
  for (const std::string& line : split(pooled, '\n'))
    if (line.find("pairs_looked_at\",value") != std::string::npos) {
      ++means;
      EXPECT_THAT(line, HasSubstr(",value,3," + std::to_string(sum / 3).substr(0, 4)));
    }
  EXPECT_EQ(means, 1U);
}

TEST(Sweep, LimitsFailOneTaskAlone) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": [
      {"command": "info"}, {"command": "compare", "options": {"rounds": 1000, "structures": "power"}},
      {"command": "run", "options": {"frames": [null, "90:"]}}]})");
  static_cast<void>(run_sweep(scratch, {"--task-seconds", "0.3"}, 1));
  const std::string failed = content_of(scratch / "out/failed.csv");
  EXPECT_EQ(std::count(failed.begin(), failed.end(), '\n'), 3) << failed;
  EXPECT_THAT(failed, HasSubstr("--frames"));
  EXPECT_THAT(failed, HasSubstr("takes more than 0.3"));
  EXPECT_EQ(collected(scratch, 1)["done"], 2);
}

TEST(Sweep, RefusesWrongUsage) {
  const ScratchDirectory scratch;
  const std::string sweep = scratch.file("s.json", R"({"commands": ["stability"]})");
  const std::string other = scratch.file("folder/../other.txt", "x");
  expect_refused({"sweep"}, {"kds sweep needs SWEEP.json"});
  expect_refused({"sweep", sweep}, {"needs -o DIR"});
  expect_refused({"sweep", scratch / "none.json", "--dry-run"}, {"none.json: no such file"});
  expect_refused({"sweep", scratch.path(), "--dry-run"}, {"is a directory, expected SWEEP.json"});
  expect_refused({"sweep", "collcet", scratch.path()}, {"'collcet'", "did you mean collect?"});
  expect_refused({"sweep", "status"}, {"needs the folder of a sweep"});
  expect_refused({"sweep", "status", scratch.path()}, {"is no folder of a sweep"});
  expect_refused({"sweep", "status", scratch.path(), "--retry"}, {"--retry: has no meaning"});
  expect_refused({"sweep", sweep, "-o", scratch.path()}, {"holds other files and no sweep"});
  expect_refused({"sweep", sweep, "-o", sweep}, {"is a file, expected a directory"});
  const ProgramRun jobs = run_shell("ulimit -n 64; $0 sweep $1 -o $2 --jobs 40", {sweep, scratch / "o"});
  EXPECT_EQ(jobs.code, 2);
  EXPECT_THAT(jobs.err, HasSubstr("--jobs: 40 tasks at a time need more open files"));
  EXPECT_THAT(jobs.err, HasSubstr("expected at most 16"));
  for (const char* shard : {"0/3", "4/3", "3", "a/b", "1/0"})
    expect_refused({"sweep", sweep, "-o", scratch / "o", "--shard", shard}, {"--shard", "is not I/N"});
  for (const char* memory : {"0", "1G2", "10", "65T", "99999999999T"})
    expect_refused({"sweep", sweep, "-o", scratch / "o", "--task-memory", memory}, {"--task-memory", "64M"});
  expect_refused({"sweep", sweep, "-o", scratch / "o", "--write", "slrum"}, {"did you mean slurm?"});
  for (const std::vector<std::string>& options : {std::vector<std::string>{"--dry-run", "--write", "slurm"},
                                                  {"--shard", "1/2", "--write", "slurm"},
                                                  {"--time-budget", "9", "--dry-run"},
                                                  {"--retry", "--write", "slurm"}}) {
    std::vector<std::string> arguments{"sweep", sweep, "-o", scratch / "o"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_refused(arguments, {options.front() + ": has no meaning beside"});
  }
  const std::string none =
      scratch.file("none.json", R"({"commands": ["stability"], "exclude": [{"command": "*"}]})");
  expect_refused({"sweep", none, "-o", scratch / "o"}, {"exclude leaves no task"});
  EXPECT_FALSE(std::filesystem::exists(scratch / "o"));  // a sweep that is refused leaves no plan
}

// "stride 16" says neither a radius of 1 nor one of 6, so these are two series. A plot says what it leaves
// out.
TEST(Sweep, PlotsNameTheirSeriesAndWhatTheyLeaveOut) {
  std::string apart = "1, 6";
  for (int k = 7; k < 17; ++k) apart += ", " + std::to_string(k);
  for (const bool too_many : {false, true}) {
    const std::string text = R"({"inputs": ["a.xyz"], "commands": [{"command": "run", "options": {
        "radius": [2, 4], "apart": [)" +
                             apart + (too_many ? ", 17" : "") + "]}}]}";
    PatternFiles files;
    InputHashes hashes([] { return false; });
    const SweepPlan plan(read_sweep(read_json(text, "s.json"), "/nowhere", files, "s.json"), hashes,
                         "s.json");
    PooledFigures pool(plan);
    for (const SweepTask& task : plan.tasks())
      pool.add(task, {{{{"stride", std::uint64_t{16}}, {"events", std::uint64_t{too_many ? 5U : 0U}}}, {}},
                      {{{"stride", std::uint64_t{16}}, {"events", std::uint64_t{5}}}, {}}});
    SweepCount count;
    count.command = "run";
    const std::string page = sweep_page(plan, {}, pool, {}, {count}, "");
    expect_sound(page);
    EXPECT_THAT(page, testing::AllOf(HasSubstr("stride 16, 1<"), HasSubstr("stride 16, 6<")));
    EXPECT_EQ(page.find("values above 0 only") != std::string::npos, !too_many);
    EXPECT_EQ(page.find("the first 12 series only") != std::string::npos, too_many);
  }
}

// Tasks of one command say nothing about the time of another's.
TEST(Sweep, HoursLeftAreThoseOfEachCommand) {
  const ScratchDirectory scratch;
  const std::string text = R"({"inputs": ["a.xyz"], "commands": [
      {"command": "info", "options": {"radius": [1, 2, 3]}}, {"command": "run", "options": {"radius": [1, 2]}}]})";
  PatternFiles files;
  InputHashes hashes([] { return false; });
  const SweepPlan plan(read_sweep(read_json(text, "s.json"), "/nowhere", files, "s.json"), hashes, "s.json");
  std::filesystem::create_directory(results_folder(scratch.path()));
  JournalWriter journal(results_folder(scratch.path()));
  const auto hours_left = [&] {
    std::vector<std::optional<double>> hours;
    for (const SweepCount& count : count_tasks(plan, scratch.path())) hours.push_back(count.hours_left);
    return hours;
  };
  ASSERT_TRUE(journal.add(RecordKind::done, plan.tasks()[0].name, R"({"seconds":3600})"));
  EXPECT_THAT(hours_left(), testing::ElementsAre(2, std::nullopt, std::nullopt));
  ASSERT_TRUE(journal.add(RecordKind::done, plan.tasks()[3].name, R"({"seconds":36000})"));
  EXPECT_THAT(hours_left(), testing::ElementsAre(2, 10, 12));
}

TEST(Sweep, TellsTimesFromFigures) {
  for (const char* name : {"seconds", "build_seconds", "cost.seconds_least", "responsiveness_worst", "ratio",
                           "cost.ratio", "cost.memory", "seconds_per_step"})
    EXPECT_TRUE(is_time(name)) << name;
  for (const char* name : {"radius_ratio", "first_begin_picoseconds", "events.total", "times", "bond_ratio"})
    EXPECT_FALSE(is_time(name)) << name;
}

TEST(Sweep, BatchesAreAtMostAThousand) {
  EngineRequest request;
  request.tasks = 1'000'000;
  for (const double hours : {0.001, 1.0, 30.0, 250.0, 5000.0}) {
    request.hours = hours;
    request.longest = 5;
    const Batches batches = batches_of(request);
    EXPECT_LE(batches.count, 1000U);
    EXPECT_GE(batches.limit_minutes * 60.0, 2 * batches.seconds);
    EXPECT_NEAR(static_cast<double>(batches.count) * batches.seconds, hours * 3600, 1e-6 * hours * 3600);
    if (hours > 1 && hours < 300) {
      EXPECT_GE(batches.seconds, 5 * 60);
      EXPECT_LE(batches.seconds, 30 * 60);
    }
  }
  request.tasks = 3;
  EXPECT_EQ(batches_of(request).count, 3U);
  EXPECT_THAT(engine_script(SweepEngine::slurm, request), HasSubstr("as an array of 3 batches of about"));
  request.tasks = 1;
  EXPECT_THAT(engine_script(SweepEngine::slurm, request), HasSubstr("as an array of 1 batch of about"));
  request.program = "/a folder/kds";
  request.sweep = "/s'.json";
  request.folder = "/50%a\n";
  EXPECT_THAT(engine_script(SweepEngine::slurm, request), HasSubstr("--output='/50%%a\n/slurm-%A_%a.out'"));
  EXPECT_THAT(engine_script(SweepEngine::snakemake, request), HasSubstr("-o '/50%a\\n' --jobs"));
  for (const SweepEngine engine : {SweepEngine::slurm, SweepEngine::parallel, SweepEngine::snakemake})
    EXPECT_THAT(engine_script(engine, request), HasSubstr("'/a folder/kds' sweep"));
}

// The default of a cluster may be too little memory for a task.
TEST(Sweep, ScriptsAskForTheMemoryOfTheirTasks) {
  EngineRequest request;
  request.tasks = 5;
  request.planned = 2048;  // 2 MiB of plan
  request.jobs = 3;
  EXPECT_THAT(engine_script(SweepEngine::slurm, request), Not(HasSubstr("--mem=")));
  EXPECT_THAT(engine_script(SweepEngine::snakemake, request), Not(HasSubstr("mem_mb")));
  request.task_memory = std::uint64_t{1} << 30U;
  const std::string slurm = engine_script(SweepEngine::slurm, request);
  EXPECT_THAT(slurm, HasSubstr("--cpus-per-task=3 --mem=3202M --time="));  // 3 * 1024 + 128 + 2
  EXPECT_THAT(slurm, HasSubstr("--dependency=\"afterany:${array%%;*}\" --mem=3202M --time="));
  EXPECT_THAT(engine_script(SweepEngine::snakemake, request), HasSubstr("    resources: mem_mb=3358\n"));
  EXPECT_THAT(engine_script(SweepEngine::snakemake, request),
              HasSubstr("+ 1))\n    resources: mem_mb=3358\n"));
  EXPECT_THAT(engine_script(SweepEngine::parallel, request), Not(HasSubstr("--mem")));
}

// Batches of several tasks at a time must not have more tasks than the machine has cores.
TEST(Sweep, GnuParallelDividesTheCoresByTheJobsOfABatch) {
  EngineRequest request;
  request.tasks = 100;
  EXPECT_THAT(engine_script(SweepEngine::parallel, request), HasSubstr(" --jobs 100% "));
  request.jobs = 4;
  EXPECT_THAT(engine_script(SweepEngine::parallel, request), HasSubstr(" --jobs 25% "));
  request.jobs = 3;  // 33% of 6 cores is one batch, not two
  EXPECT_THAT(engine_script(SweepEngine::parallel, request), HasSubstr(" --jobs 34% "));
  request.jobs = 1000;
  EXPECT_THAT(engine_script(SweepEngine::parallel, request), HasSubstr(" --jobs 1% "));
}

TEST(Sweep, SaysThatABatchIsShorterThanItsTasksMayBe) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": [{"command": "info"}]})");
  EXPECT_THAT(run_sweep(scratch, {"--write", "slurm", "--task-seconds", "600"}),
              HasSubstr("--task-seconds 600 is longer than a batch, which stops after 540 s"));
  EXPECT_THAT(run_sweep(scratch, {"--write", "slurm", "--task-seconds", "500"}),
              Not(HasSubstr("longer than a batch")));
}

TEST(Sweep, WritesNoScriptIfNoTaskIsLeft) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json",
               R"({"inputs": ["a.xyz"], "commands": [{"command": "info", "options": {"radius": [1, 2]}}]})");
  EXPECT_THAT(run_sweep(scratch, {"--write", "slurm"}), HasSubstr("the script asks for no memory"));
  static_cast<void>(run_sweep(scratch, {"--write", "slurm", "--task-memory", "256M", "--jobs", "2"}));
  EXPECT_THAT(content_of(scratch / "out/slurm.sh"), HasSubstr(" --mem=641M "));
  std::filesystem::remove(scratch / "out/slurm.sh");
  static_cast<void>(run_sweep(scratch));
  const std::string all = run_sweep(scratch, {"--write", "slurm"});
  EXPECT_THAT(all, testing::StartsWith(
                       "all 2 tasks have results, so there is no script to write; kds sweep collect"));
  EXPECT_EQ(std::ranges::count(all, '\n'), 1);
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/slurm.sh"));

  scratch.file("s.json", R"({"inputs": ["a.xyz", "none.xyz"], "commands": ["info"]})");
  static_cast<void>(run_sweep(scratch, {}, 1));
  EXPECT_THAT(
      run_sweep(scratch, {"--write", "parallel"}),
      HasSubstr("no task is left to run, so there is no script to write: 1 of 2 tasks have results, 1 "
                "failed, 0 crashed; kds sweep"));
  EXPECT_FALSE(std::filesystem::exists(scratch / "out/parallel.sh"));
}

}  // namespace
}  // namespace kds::test::sweep_test
