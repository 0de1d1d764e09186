// Tests `kds sweep` as a program: resuming, changed inputs, parts, collected tables, limits and scripts.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

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
#include "experiments/sweep/sweep_folder.h"
#include "experiments/sweep/sweep_status.h"
#include "experiments/sweep/task_journal.h"
#include "motions/base/input_error.h"
#include "tests/experiments/report_data.h"
#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

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

struct Planned {
  InputFiles files;
  SweepPlan plan;
  explicit Planned(const std::string& text, const std::string& folder = "/nowhere")
      : plan(read_sweep(read_json(text, "s.json"), folder, files, "s.json"), files, "s.json") {}
};

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
  const Json report = ReportData(scratch / "out/report.html").result;
  EXPECT_EQ(report["kind"], "sweep");
  EXPECT_TRUE(report["rows"] == nlohmann::json::parse(second["rows"].dump()));
  EXPECT_TRUE(report["left_out"].empty());
  EXPECT_GT(report["means"].size(), 0U);
}

// The result of other content must not get the name of the content that was hashed.
TEST(Sweep, LeavesTasksWhoseInputChangesMeanwhile) {
  const ScratchDirectory scratch;
  const std::string input = scratch.file("a.xyz", chain(0.2));
  Planned sweep(R"({"inputs": ["a.xyz"], "commands": ["info", "run"]})", scratch.path());
  EXPECT_FALSE(sweep.files.has_changed(input));
  scratch.file("a.xyz", chain(0.2) + chain(0.3));
  SweepOptions options;
  options.out = scratch / "out";
  options.quiet = true;
  std::filesystem::create_directories(results_folder(*options.out));
  StopSignals signals;
  testing::internal::CaptureStderr();
  const SweepOutcome outcome = kds::run_sweep(sweep.plan, sweep.files, options, signals);
  const std::string warning = testing::internal::GetCapturedStderr();
  EXPECT_EQ(outcome.count.open, 2U);
  EXPECT_TRUE(outcome.stopped());
  EXPECT_THAT(warning, HasSubstr("a.xyz: changed while the sweep ran"));
  EXPECT_EQ(std::ranges::count(warning, '\n'), 1);
}

// Results are found by the content that an input had, also after the input is gone.
TEST(Sweep, CollectsResultsOfInputsThatAreGone) {
  const ScratchDirectory scratch;
  const std::string a = scratch.file("a.xyz", chain(0.2)), c = scratch.file("c.xyz", chain(0.4));
  scratch.file("b.xyz", chain(0.3));
  scratch.file("d[1].xyz", chain(0.5));
  scratch.file("radii", "0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n0.5\n0.6\n");
  scratch.file("s.json", R"({"inputs": ["[ab].xyz", "./d[1].xyz", {"file": "c.xyz", "radius": "file:radii"}],
      "commands": [{"command": "run", "options": {"structures": "power"}}]})");
  static_cast<void>(run_sweep(scratch));
  static_cast<void>(collected(scratch));
  const std::string before = content_of(scratch / "out/results.csv");
  for (const char* file : {"a.xyz", "c.xyz", "d[1].xyz", "radii"}) std::filesystem::remove(scratch / file);
  const ProgramRun collect = run_program({"sweep", "collect", scratch / "out"});
  EXPECT_EQ(collect.code, 0) << collect.err;
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
  EXPECT_THAT(collect.err, HasSubstr(a + ": cannot be read any more"));
  EXPECT_THAT(collect.err, HasSubstr("more warnings of this kind: 1"));
  const ProgramRun status = run_program({"sweep", "status", scratch / "out"});
  EXPECT_EQ(status.code, 0);
  EXPECT_THAT(status.err, HasSubstr(c + ": cannot be read any more"));

  scratch.file("a.xyz", chain(0.6));  // another content has no result
  const ProgramRun emptier = run_program({"sweep", "collect", scratch / "out"});
  EXPECT_EQ(emptier.code, 2);
  EXPECT_THAT(emptier.err, HasSubstr("results.json has results of 4 tasks and would be replaced by 3 of 4"));
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
  scratch.file("a.xyz", chain(0.2));
  EXPECT_EQ(run_program({"sweep", "collect", scratch / "out"}).code, 0);
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
}

// A topology whose name has a comma is one file.
TEST(Sweep, KnowsATopologyWithAComma) {
  const ScratchDirectory scratch;
  std::filesystem::copy_file(data_file("proteins/1l2y.pdb"), scratch / "1,l2y.pdb");
  scratch.file("s.json", R"({"inputs": {"file": ")" + data_file("trajectories/1l2y.dcd") +
                             R"(", "topology": "1,l2y.pdb"}, "commands": ["info"]})");
  static_cast<void>(run_sweep(scratch));
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
  InputFiles first;
  const std::uint64_t hash = first.hash(input);
  const auto again = [&] { return InputFiles(first.json()).hash(input); };
  EXPECT_THAT(text_of(first.json()), HasSubstr("\"stamp\""));
  EXPECT_EQ(again(), hash);
  std::filesystem::last_write_time(input, time + std::chrono::hours(2));
  EXPECT_FALSE(first.has_changed(input));  // the content is as it was
  EXPECT_EQ(again(), hash);

  const std::string other = chain(0.3);
  ASSERT_EQ(other.size(), chain(0.2).size());
  scratch.file("a.xyz", other);
  std::filesystem::last_write_time(input, time);
  EXPECT_TRUE(first.has_changed(input));
  EXPECT_NE(again(), hash);
}

// Several tasks run at a time, so a task has one thread unless the sweep says another number.
TEST(Sweep, TasksHaveOneThreadUnlessTheSweepSaysMore) {
  const Planned sweep(R"({"inputs": ["a.xyz"], "commands": ["info",
      {"command": "run", "options": {"threads": [null, 2]}}]})");
  const SweepPlan& plan = sweep.plan;
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

PooledFigure figure_of(const std::vector<double>& values) {
  PooledFigure figure;
  for (const double value : values) figure.add(value);
  return figure;
}

// Two values would have an interval that reaches over many powers of ten.
TEST(Sweep, IntervalsStayAboveZeroAndTakeThreeValues) {
  const PooledFigure counts = figure_of({1, 100, 3});
  ASSERT_TRUE(counts.interval());
  EXPECT_GT(counts.interval()->lower, 0);
  EXPECT_LT(counts.interval()->lower, counts.mean);
  EXPECT_GT(counts.interval()->upper, counts.mean);
  EXPECT_GT(figure_of({0.5, 100, 3}).interval()->lower, 0);
  EXPECT_EQ(figure_of({2, 2, 2}).no_interval(), "all values are equal");
  EXPECT_EQ(figure_of({300, 9000}).no_interval(), "fewer than 3 values");
  const PooledFigure three = figure_of({300, 9000, 0});
  ASSERT_TRUE(three.interval());
  EXPECT_EQ(three.no_interval(), "");
  EXPECT_LT(three.interval()->upper / three.mean, 75);
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

// Segments of this trajectory, whose frames are full of ties, had other counts.
TEST(Sweep, CountsAreThoseOfTheWholeRunOnAnyNumberOfThreads) {
  const ScratchDirectory scratch;
  scratch.file("s.json", R"({"inputs": [")" + data_file("hostile/lattice24.xyz") + R"("], "commands": [{
      "command": "run", "options": {"structures": "box,closest,contacts", "radius": 0.5, "threads": [1, 2, 3, 7]}}]})");
  static_cast<void>(run_sweep(scratch));
  const Json rows = collected(scratch)["rows"];
  ASSERT_EQ(rows.size(), 12U);
  const std::map<std::string, int> totals{{"box", 17}, {"closest", 52}, {"contacts", 299}};
  for (const Json& row : rows) EXPECT_EQ(row["events.total"], totals.at(row["structure"])) << row;
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
  for (const char* shard : {"1/3", "3/3"}) static_cast<void>(run_sweep(scratch, {"--shard", shard}));
  EXPECT_EQ(collected(scratch)["done"], 5);
  EXPECT_EQ(records(scratch, "try"), 5U);
}

// The first row of each task has the same case, which depends on the seed.
TEST(Sweep, SeedsArePooled) {
  const ScratchDirectory scratch;
  scratch.file("s.json", R"({"seeds": 3, "commands": [
      {"command": "stability", "options": {"cases": 1, "subjects": "power_test"}}]})");
  static_cast<void>(run_sweep(scratch));
  const Json all = collected(scratch);
  std::map<std::string, double> of_task;
  for (const Json& row : all["rows"]) of_task.emplace(row["task"], row["stages_signs_double"].get<double>());
  ASSERT_EQ(of_task.size(), 3U);
  double sum = 0;
  for (const auto& [task, value] : of_task) sum += value;
  const std::string pooled = content_of(scratch / "out/pooled.csv");
  const std::string mean = ",stages_signs_double,3,";
  ASSERT_NE(pooled.find(mean), std::string::npos);
  EXPECT_THAT(pooled.substr(pooled.find(mean) + mean.size()),
              testing::StartsWith(std::to_string(sum / 3).substr(0, 4)));
}

TEST(Sweep, LimitsFailOneTaskAlone) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": [
      {"command": "info"}, {"command": "run", "options": {"frames": [null, "90:"]}},
      {"command": "compare", "options": {"rounds": 1000, "strides": "1,2,3",
                                         "structures": "power,wrapped,boxes,closest,contacts,box"}}]})");
  static_cast<void>(run_sweep(scratch, {"--task-seconds", "1"}, 1));
  const std::string failed = content_of(scratch / "out/failed.csv");
  EXPECT_EQ(std::count(failed.begin(), failed.end(), '\n'), 3) << failed;
  EXPECT_THAT(failed, HasSubstr("--frames"));
  EXPECT_THAT(failed, HasSubstr("takes more than 1"));
  EXPECT_EQ(collected(scratch, 1)["done"], 2);
}

// Tasks of one command say nothing about the time of another's.
TEST(Sweep, HoursLeftAreThoseOfEachCommand) {
  const ScratchDirectory scratch;
  const Planned sweep(R"({"inputs": ["a.xyz"], "commands": [
      {"command": "info", "options": {"radius": [1, 2, 3]}}, {"command": "run", "options": {"radius": [1, 2]}}]})");
  const SweepPlan& plan = sweep.plan;
  JournalWriter journal(scratch.path());
  const auto hours_left = [&] {
    std::vector<std::optional<double>> hours;
    for (const SweepCount& count : count_tasks(plan, TaskStates(scratch.path()), false))
      hours.push_back(count.hours_left);
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

EngineRequest request_of(SweepEngine engine, std::size_t jobs = 1) {
  EngineRequest request;
  request.engine = engine;
  request.program = "/a folder/kds";
  request.sweep = "/s'.json";
  request.folder = "/$HOME #1";
  request.tasks = 2048;
  request.batches = 100;
  request.jobs = jobs;
  return request;
}

TEST(Sweep, ScriptsQuoteNamesAndRefuseThoseThatTheyCannotQuote) {
  for (const SweepEngine engine : {SweepEngine::slurm, SweepEngine::parallel, SweepEngine::snakemake}) {
    EngineRequest request = request_of(engine);
    EXPECT_THAT(engine_script(request),
                HasSubstr("'/a folder/kds' sweep '/s'\\''.json' -o '/$HOME #1' --jobs"));
    for (const char* folder : {"/a\\", "/a\nBATCH\n", "/50%a", "/a\r", "/\"", "/{x}", "/\x7f"}) {
      request.folder = folder;
      EXPECT_THROW(static_cast<void>(engine_script(request)), InputError) << folder;
    }
  }
}

// The default of a cluster may be too little memory for a task.
TEST(Sweep, ScriptsAskForTheTimeAndTheMemoryOfTheirTasks) {
  EngineRequest slurm = request_of(SweepEngine::slurm, 3), snakemake = request_of(SweepEngine::snakemake, 3);
  EXPECT_THAT(engine_script(slurm),
              testing::AllOf(HasSubstr("--array=1-100 "), HasSubstr(" --time=62 "),
                             HasSubstr(" --time-budget 3600\n"), Not(HasSubstr("--mem="))));
  EXPECT_THAT(engine_script(snakemake), Not(HasSubstr("mem_mb")));
  slurm.task_memory = snakemake.task_memory = std::uint64_t{1} << 30U;
  EXPECT_THAT(engine_script(slurm),
              HasSubstr("--cpus-per-task=3 --mem=3202M --time="));  // 3 * 1024 + 128 + 2
  EXPECT_THAT(engine_script(slurm), HasSubstr("--dependency=\"afterany:${array%%;*}\" --mem=3202M --time="));
  EXPECT_THAT(engine_script(snakemake), HasSubstr("    resources: mem_mb=3358\n    retries"));
  EXPECT_THAT(engine_script(snakemake), HasSubstr("+ 1))\n    resources: mem_mb=3358\n"));
}

// Batches of several tasks at a time must not have more tasks than the machine has cores.
TEST(Sweep, GnuParallelDividesTheCoresByTheJobsOfABatch) {
  for (const auto& [jobs, percent] : std::map<std::size_t, std::string>{
           {1, "100%"}, {4, "25%"}, {3, "34%"} /* 33% of 6 cores is one batch, not two */, {1000, "1%"}})
    EXPECT_THAT(engine_script(request_of(SweepEngine::parallel, jobs)),
                HasSubstr(" --jobs " + percent + " "));
}

// A task's warnings are kept with its result.
TEST(Sweep, ListsTheWarningsOfTasks) {
  const ScratchDirectory scratch;
  scratch.file("cut.xyz", chain(0.2) + "12\nframe\nC 0 0 0\n");
  scratch.file("whole.xyz", chain(0.2));
  scratch.file("s.json", R"({"inputs": ["*.xyz"], "commands": [
      {"command": "info", "options": {"until-damage": true}},
      {"command": "contacts", "options": {"until-damage": true, "cutoff": [0.01, 5]}}]})");
  EXPECT_THAT(run_sweep(scratch), HasSubstr("4 have warnings; kds sweep collect lists them"));
  static_cast<void>(collected(scratch));
  std::vector<std::string> lines = split(content_of(scratch / "out/warnings.csv"), '\n');
  EXPECT_EQ(lines.front(), "task,command,input,warning,repeat");
  const std::string damage = "cut.xyz: the file ends inside frame 5", none = "there are no contacts within";
  EXPECT_THAT(lines, testing::ElementsAre(
                         lines.front(), testing::AllOf(HasSubstr(",info,cut.xyz,"), HasSubstr(damage)),
                         testing::AllOf(HasSubstr(",contacts,cut.xyz,"), HasSubstr(damage)), HasSubstr(none),
                         testing::AllOf(HasSubstr(",contacts,cut.xyz,"), HasSubstr(damage)),
                         testing::AllOf(HasSubstr(",contacts,whole.xyz,"), HasSubstr(none)), ""));
  EXPECT_THAT(ReportData(scratch / "out/report.html").result["warned"].dump(),
              testing::AllOf(HasSubstr(damage), HasSubstr(none)));
  EXPECT_THAT(run_program({"sweep", "status", scratch / "out"}).out,
              testing::ContainsRegex("all +6 +6 +4 +0 +0 +0 "));
}

TEST(Sweep, CountsInputsOfEqualContentOnceInMeans) {
  const ScratchDirectory scratch;
  for (const char* name : {"a.xyz", "copy.xyz", "dup.xyz"}) scratch.file(name, chain(0.2));
  scratch.file("e.xyz", chain(0.3));
  const auto tasks_pooled = [&](const std::string& pool) {
    scratch.file("s.json", R"({"inputs": ["*.xyz"], "pool": [)" + pool + R"(], "commands": [
        {"command": "run", "options": {"structures": "power"}}]})");
    EXPECT_THAT(run_sweep(scratch), testing::AllOf(HasSubstr("4 of 4 tasks have results"),
                                                   HasSubstr("copy.xyz has the same content as"),
                                                   HasSubstr("dup.xyz has the same content as")));
    EXPECT_EQ(collected(scratch)["rows"].size(), 4U);
    std::string tasks;
    for (const std::string& line : split(content_of(scratch / "out/pooled.csv"), '\n'))
      if (const std::size_t at = line.find(",events.total,"); at != std::string::npos) tasks += line[at + 14];
    return tasks;
  };
  EXPECT_EQ(tasks_pooled(R"("input")"), "2");
  EXPECT_EQ(tasks_pooled(""), "1111");  // each input has a mean of its own
  EXPECT_EQ(records(scratch, "try"), 2U);
}

TEST(Sweep, NamesResultsOfOtherVersionsAndKeepsTheirTables) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json", R"({"inputs": ["a.xyz"], "commands": ["info"]})");
  static_cast<void>(run_sweep(scratch));
  static_cast<void>(collected(scratch));
  const std::string before = content_of(scratch / "out/results.csv");
  for (const auto& file : std::filesystem::directory_iterator(scratch / "out/results"))
    std::filesystem::remove(file.path());
  JournalWriter other(scratch / "out/results", {7, "0.0.9+old"});
  for (TaskName task = 1; task <= 32; ++task)
    ASSERT_TRUE(other.add(RecordKind::done, task, R"({"result":{}})"));
  const std::string line = "32 results belong to version 0.0.9+old";
  const ProgramRun refused = run_program({"sweep", "collect", scratch / "out"});
  EXPECT_EQ(refused.code, 2);
  EXPECT_THAT(refused.err, HasSubstr(line));
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
  EXPECT_THAT(run_program({"sweep", "status", scratch / "out"}).out, HasSubstr(line));
  std::filesystem::remove(scratch / "out/results.json");
  EXPECT_THAT(run_program({"sweep", "collect", scratch / "out"}).out, HasSubstr(line));
  static_cast<void>(run_sweep(scratch));
  static_cast<void>(collected(scratch));
  EXPECT_EQ(content_of(scratch / "out/results.csv"), before);
}

// No process does what another is doing: of one shard, or of shards that have other numbers.
TEST(Sweep, RefusesASecondProcessOfAShard) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  scratch.file("s.json",
               R"({"inputs": ["a.xyz"], "commands": [{"command": "info", "options": {"radius": [1, 2]}}]})");
  std::filesystem::create_directories(scratch / "out/results");
  const auto beside = [&](const Shard& runs, const std::string& shard) {
    const ShardLock lock(scratch / "out", runs);
    EXPECT_TRUE(lock.holds());
    const ProgramRun run =
        run_program({"sweep", scratch / "s.json", "-o", scratch / "out", "--shard", shard});
    EXPECT_EQ(std::ranges::count(run.err, '\n'), run.code == 75 ? 1 : 0) << run.err;
    return std::pair(run.code, run.err);
  };
  EXPECT_THAT(beside({1, 1}, "1/1"), testing::Pair(75, HasSubstr("a sweep runs in this folder already")));
  EXPECT_THAT(beside({2, 3}, "2/3"), testing::Pair(75, HasSubstr("shard 2/3 runs in this folder already")));
  EXPECT_THAT(beside({2, 3}, "1/1"), testing::Pair(75, HasSubstr("another number of shards runs")));
  EXPECT_THAT(beside({1, 1}, "1/2"), testing::Pair(75, HasSubstr("another number of shards runs")));
  EXPECT_EQ(std::ranges::distance(std::filesystem::directory_iterator(scratch / "out/results")), 0);
  EXPECT_EQ(beside({2, 2}, "1/2").first, 0);
  EXPECT_EQ(records(scratch, "done"), 1U);
}

#ifndef KDS_SANITIZED  // the sanitizers need files and memory of their own

// An engine tries again what ends with code 75, as TryLater does.
TEST(Sweep, TriesLaterIfNoTaskCanStart) {
  const ScratchDirectory scratch;
  scratch.file("a.xyz", chain(0.2));
  Planned sweep(R"({"inputs": ["a.xyz"], "commands": ["info"]})", scratch.path());
  SweepOptions options;
  options.out = scratch / "out";
  options.quiet = true;
  std::filesystem::create_directories(results_folder(*options.out));
  StopSignals signals;
  rlimit files{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &files), 0);
  const int next = ::dup(0);
  ::close(next);
  const rlimit few{static_cast<rlim_t>(next) + 3, files.rlim_max};  // lock, journal, one file for the output
  ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &few), 0);
  std::string message;
  try {
    static_cast<void>(kds::run_sweep(sweep.plan, sweep.files, options, signals));
  } catch (const TryLater& later) {
    message = later.what();
  }
  ::setrlimit(RLIMIT_NOFILE, &files);
  EXPECT_THAT(message, HasSubstr("no task can start (Too many open files)"));
  EXPECT_EQ(records(scratch, "drop"), 1U);
  EXPECT_EQ(kds::run_sweep(sweep.plan, sweep.files, options, signals).count.done, 1U);
}

// All results of a sweep need not fit in memory.
TEST(Sweep, CollectsInMemoryThatResultsDoNotFill) {
  const auto kilobytes = [](std::size_t count) {
    const ScratchDirectory scratch;
    std::string radii = "1";
    for (std::size_t k = 2; k <= count; ++k) radii += ',' + std::to_string(k);
    const std::string text =
        R"({"inputs": ["a.xyz"], "commands": [{"command": "run", "options": {"radius": [)" + radii + "]}}]}";
    scratch.file("a.xyz", chain(0.2));
    const Planned sweep(text, scratch.path());
    keep_plan(scratch / "out", read_json(text, "s.json"), scratch.path(), sweep.files);
    JournalWriter journal(results_folder(scratch / "out"));
    std::string fields;
    for (int k = 0; k < 100; ++k) fields += fmt::format(R"("field{}":{},)", k, k);
    for (const SweepTask& task : sweep.plan.tasks())
      EXPECT_TRUE(
          journal.add(RecordKind::done, task.name, R"({"seconds":1,"result":{)" + fields + R"("x":1}})"));
    const ProgramRun run = run_program({"sweep", "collect", scratch / "out"});
    EXPECT_EQ(run.code, 0) << run.err;
    return run.peak_kilobytes;
  };
  const long few = kilobytes(100), many = kilobytes(4100);
  EXPECT_LT(many - few, 8000) << few;  // 2 kB a result; its rows alone would take 16
}

#endif

}  // namespace
}  // namespace kds::test::sweep_test
