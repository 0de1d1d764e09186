// --threads of kds run, contacts, compare and trade: the results are those of one thread.

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/experiments/run_json.h"
#include "tests/experiments/scratch_directory.h"

namespace kds::test::threads_test {
namespace {

using testing::HasSubstr;
using testing::Not;
using Json = nlohmann::ordered_json;

/// A chain that is long enough in time to be cut.
class Threads : public testing::Test {
 protected:
  void SetUp() override {
    run_line("generate random-chain --beads 20 --frames 2200 --step 0.05 -o OUT/chain.xyz --quiet",
             scratch_.path());
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

TEST_F(Threads, GiveTheEventsOfOneThread) {
  std::vector<std::string> logs;
  std::vector<Json> results;
  for (const std::string threads : {"1", "3"}) {
    const Json json = run_json(
        fmt::format("run OUT/chain.xyz --radius 1 --structures wrapped,power,closest --quiet --threads {0} "
                    "--log OUT/log{0} --events OUT/events{0}.csv",
                    threads),
        scratch_.path());
    const Json& engine = json.at("engine");
    logs.push_back(content_of(scratch_ / ("log" + threads)));
    results.push_back(results_of(json));
    EXPECT_EQ(engine.at("parts") == 1, threads == "1");
    EXPECT_EQ(engine.at("parts_run_again"), 0);
  }
  EXPECT_FALSE(logs[0].empty());
  EXPECT_EQ(logs[0], logs[1]);
  EXPECT_EQ(results[0], results[1]);
  run_line("replay OUT/log3 --quiet", scratch_.path());
}

/// Members of JSON and columns of CSV about the machine and the work of a run, which depend on where it is
/// cut (docs/exactness.md), or on how fast it is.
bool is_of_machine(const std::string& name) {
  static const std::set<std::string> names{
      "command",     "parts",          "parts_run_again", "threads",    "warnings",     "memory",
      "ratio",       "pareto",         "stages",          "exact_work", "certificates", "close_comparisons",
      "recommended", "recommendation", "recommendations"};
  return names.contains(name) || name.find("seconds") != std::string::npos ||
         name.starts_with("responsiveness");
}

void drop_machine(Json& json) {
  if (json.is_object())
    for (auto it = json.begin(); it != json.end();) it = is_of_machine(it.key()) ? json.erase(it) : ++it;
  if (json.is_structured())
    for (Json& member : json) drop_machine(member);
}

/// Returns the files below a folder by name, without what depends on the machine. Leaves out pages, hashes
/// of their contents, and tables with seconds, whose rows are in JSON too.
std::map<std::string, std::string> files_below(const std::filesystem::path& folder) {
  std::map<std::string, std::string> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string name = entry.path().lexically_relative(folder).string();
    if (!entry.is_regular_file() || name.ends_with(".html") || name == "out/.kds-results" ||
        name == "out/compare.csv" || name == "out/trade.csv")
      continue;
    std::string& content = files[name] = content_of(entry.path());
    if (!name.ends_with(".json")) continue;
    Json json = Json::parse(content);
    drop_machine(json);
    content = json.dump(1);
  }
  return files;
}

// Written files have the same bytes on any number of threads.
TEST(ThreadsAndFiles, AreIndependent) {
  const ScratchDirectory scratch;
  const std::string ties = "data/hostile/ties.xyz.gz";  // many contacts last equally long
  const std::string villin = "VILLIN --frames 0:280";
  const std::string all_files =
      " --events OUT/e.csv --log OUT/log --dump OUT/dump --out OUT/out --json OUT/j.json";
  const std::string commands[] = {
      // OUT is the folder of their files
      "run " + ties + " --radius 0.5 --structures sorted,wrapped,contacts --events OUT/e.csv --log OUT/log",
      "run " + villin + " --radius 2 --structures wrapped,boxes,power,contacts,closest" + all_files,
      "contacts " + ties + " --cutoff 1:1.5 --apart 1 --gap 1.5 --strides 1,2 --out OUT/out",
      "contacts " + villin + " --cutoff 5:5.5 --gap 1.5 --out OUT/out",
      "contacts " + villin + " --cutoff 5 --by bead --motion hermite --out OUT/out",
      "compare " + villin + " --structures wrapped,power --strides 1,2 --rounds 1 --out OUT/out",
      "trade " + ties + " --radius 1 --want contacts --rounds 1 --without-exact --out OUT/out",
  };
  int number = 0;
  for (const std::string& line : commands) {
    SCOPED_TRACE(line);
    std::map<std::string, std::string> of_one;
    for (const std::string threads : {"1", "2"}) {
      const std::filesystem::path out = scratch / (std::to_string(number++) + "-" + threads);
      std::filesystem::create_directory(out);
      const ProgramRun done = run_line(line + " --quiet --threads " + threads, out);
      EXPECT_THAT(done.err, Not(HasSubstr("--threads"))) << "too short to be cut";
      auto files = files_below(out);
      std::filesystem::remove_all(out);
      if (threads == "1") {
        of_one = std::move(files);
        EXPECT_FALSE(of_one.empty());
        continue;
      }
      ASSERT_EQ(files.size(), of_one.size());
      for (const auto& [name, content] : files)
        EXPECT_TRUE(content == of_one[name]) << name << ' ' << threads;
    }
  }
}

}  // namespace
}  // namespace kds::test::threads_test
