// The limit on a run's exact work, and the warnings of a run that needs much of it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "experiments/run/load_scene.h"
#include "experiments/run/run_options.h"
#include "experiments/run/run_scene.h"
#include "tests/experiments/run_json.h"

namespace kds::test::exact_work_test {
namespace {

using testing::HasSubstr;
using Json = nlohmann::ordered_json;

const std::string kWild = data_file("hostile/deg4-wildmix.txt");

TEST(ExactWorkOfRuns, IsTheSameEachTimeAndLimitsTheRun) {
  const std::string line = "run data/hostile/deg4-wildmix.txt --structures power --quiet";
  const auto work_of = [](const Json& run) { return run["engine"]["exact_work"].get<std::uint64_t>(); };
  const std::uint64_t work = work_of(run_json(line));
  ASSERT_GT(work, 1000U);
  EXPECT_EQ(work_of(run_json(line + " --work " + std::to_string(work))), work);
  for (const std::uint64_t limit : {work - 1, work / 2, std::uint64_t{0}}) {
    const ProgramRun ended = run_program(command_words(line + " --json - --work " + std::to_string(limit)));
    EXPECT_EQ(ended.code, 2);
    EXPECT_EQ(ended.out, "");
    EXPECT_EQ(std::count(ended.err.begin(), ended.err.end(), '\n'), 1) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("--work " + std::to_string(limit)));
    EXPECT_THAT(ended.err, HasSubstr("step 0 leads from frame 0 to frame 1"));
    EXPECT_THAT(ended.err, HasSubstr("of beads "));
  }
}

TEST(ExactWorkOfRuns, IsToldOfWhereItIsExtraordinary) {
  const RunOptions options = parse_run_options({kWild, "--structures", "power"});
  const auto warnings_of = [&](std::uint64_t extraordinary) {
    const Scene scene = load_scene(options, [](const std::string&) {});
    const auto run = open_run(options, scene, AuditMode::none);
    std::vector<std::string> warnings;
    watch_exact_work(
        run->simulator(), scene, [&](const std::string& warning) { warnings.push_back(warning); },
        extraordinary);
    run_steps(*run, options, [](std::size_t) {});
    return warnings;
  };
  const std::vector<std::string> warnings = warnings_of(10'000);
  ASSERT_FALSE(warnings.empty());
  EXPECT_LT(warnings.size(), 20U);  // a warning appears only when the total work has doubled
  for (const std::string& warning : warnings) {
    EXPECT_THAT(warning, HasSubstr("step 0 (from frame 0 to frame 1)"));
    EXPECT_THAT(warning, HasSubstr(" of beads "));
    EXPECT_EQ(warning.find('\n'), std::string::npos);
  }
  EXPECT_TRUE(warnings_of(extraordinary_work).empty());
}

}  // namespace
}  // namespace kds::test::exact_work_test
