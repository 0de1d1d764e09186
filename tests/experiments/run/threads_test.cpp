// --threads of kds run, contacts and compare: the results are those of one thread.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "tests/experiments/run_program.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::threads_test {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;
using testing::Not;

/// A chain that is long enough in time to be cut.
class Threads : public testing::Test {
 protected:
  void SetUp() override {
    const ProgramRun made = run_program({"generate", "random-chain", "--beads", "20", "--frames", "2200",
                                         "--step", "0.05", "-o", scratch_ / "chain.xyz", "--quiet"});
    ASSERT_EQ(made.code, 0) << made.err;
  }
  ProgramRun run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin() + 1, scratch_ / "chain.xyz");
    return run_program(std::move(arguments));
  }

  ScratchDirectory scratch_;
};

/// Returns the results of a run that do not depend on the number of threads.
Json results_of(const Json& run) {
  Json results{{"fingerprint", run.at("fingerprint")},
               {"distance", run.at("closest_approach").at("distance")}};
  for (const auto& [name, structure] : run.at("structures").items())
    results[name] = {structure.at("events"), structure.at("rebuilds")};
  return results;
}

/// Returns the events of a log without brackets and hashes.
std::string events_of(const std::string& log) {
  std::string events;
  std::istringstream lines(log);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string step, structure, kind, lower, upper, ids;
    words >> step >> structure >> kind >> lower >> upper;
    std::getline(words, ids);
    if (step != "step" && step != "end") events += step + structure + kind + ids + "\n";
  }
  return events;
}

TEST_F(Threads, GiveTheEventsOfOneThread) {
  std::vector<std::string> logs;
  std::vector<Json> results;
  for (const std::string threads : {"1", "3"}) {
    const ProgramRun done = run({"run", "--radius", "1", "--structures", "wrapped,power,closest", "--threads",
                                 threads, "--log", scratch_ / ("log" + threads), "--events",
                                 scratch_ / ("events" + threads + ".csv"), "--json", "-", "--quiet"});
    ASSERT_EQ(done.code, 0) << done.err;
    logs.push_back(events_of(content_of(scratch_ / ("log" + threads))));
    const Json json = Json::parse(done.out), engine = json.at("engine");
    results.push_back(results_of(json));
    EXPECT_EQ(engine.at("parts") == 1, threads == "1");
    EXPECT_EQ(engine.at("parts_run_again"), 0);
  }
  EXPECT_FALSE(logs[0].empty());
  EXPECT_EQ(logs[0], logs[1]);
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(run_program({"replay", scratch_ / "log3", "--quiet"}).code, 0);
}

TEST_F(Threads, GiveTheContactsOfOneThread) {
  std::vector<std::string> tables;
  for (const std::string threads : {"1", "2"}) {
    const ProgramRun done = run({"contacts", "--radius", "1", "--cutoff", "2.2:2.6", "--gap", "0.5",
                                 "--threads", threads, "--out", scratch_ / ("out" + threads), "--quiet"});
    ASSERT_EQ(done.code, 0) << done.err;
    tables.push_back(content_of(scratch_ / ("out" + threads + "/intervals.csv")) +
                     content_of(scratch_ / ("out" + threads + "/contacts.csv")) +
                     content_of(scratch_ / ("out" + threads + "/frames.csv")));
  }
  EXPECT_EQ(tables[0], tables[1]);
}

TEST_F(Threads, AreOneForRunsThatCannotBeCut) {
  const std::vector<std::string> base{"run",     "--radius", "1",   "--structures",
                                      "wrapped", "--frames", "0:5", "--threads"};
  for (const auto& [options, reason] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"2", "--kernel", "fast"}, "kernel fast"},
           {{"2", "--relax", "0.1"}, "wrapped"},
           {{"2", "--work", "1000000"}, "exact work"}}) {
    std::vector<std::string> arguments = base;
    arguments.insert(arguments.end(), options.begin(), options.end());
    const ProgramRun done = run(arguments);
    EXPECT_EQ(done.code, 0);
    EXPECT_THAT(done.err, HasSubstr("--threads 2: the run is not cut"));
    EXPECT_THAT(done.err, HasSubstr(reason));
  }
  std::vector<std::string> one = base;
  one.insert(one.end(), {"1", "--kernel", "fast"});
  EXPECT_THAT(run(one).err, Not(HasSubstr("--threads")));
  one[base.size()] = "0";
  EXPECT_EQ(run(one).code, 2);
}

// A short run takes fewer threads than asked for, and says how many.
TEST_F(Threads, HintsAtThreadsThatShortRunsDoNotTake) {
  const ProgramRun done = run({"run", "--radius", "1", "--structures", "wrapped", "--frames", "0:2100",
                               "--threads", "64", "--json", "-", "--quiet"});
  ASSERT_EQ(done.code, 0) << done.err;
  const std::string taken = Json::parse(done.out).at("engine").at("threads").dump();
  EXPECT_EQ(taken, "4");
  EXPECT_THAT(done.err, HasSubstr("--threads 64: the run takes " + taken +
                                  ", because 5 threads need at least 2,500 steps and it has 2,099"));
  for (const std::vector<std::string>& command : {std::vector<std::string>{"contacts", "--cutoff", "2"},
                                                  {"compare", "--structures", "wrapped", "--rounds", "1"},
                                                  {"trade", "--want", "contacts", "--rounds", "1"}}) {
    std::vector<std::string> arguments = command;
    arguments.insert(arguments.end(), {"--radius", "1", "--frames", "0:9", "--quiet", "--threads", "2"});
    const ProgramRun few = run(arguments);
    EXPECT_EQ(few.code, 0) << few.err;
    EXPECT_THAT(
        few.err,
        HasSubstr("--threads 2: the run takes 1, because 2 threads need at least 1,000 steps and it has 8"))
        << command.front();
    arguments.resize(arguments.size() - 2);
    EXPECT_THAT(run(arguments).err, Not(HasSubstr("--threads"))) << command.front();
  }
}

}  // namespace
}  // namespace kds::test::threads_test
