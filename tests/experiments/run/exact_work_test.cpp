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
#include "tests/experiments/run_program.h"

namespace kds::test::exact_work_test {
namespace {

using testing::HasSubstr;

const std::string kWild = data_file("hostile/deg4-wildmix.txt");

std::uint64_t work_in(const std::string& json) {
  const std::string key = "\"exact_work\": ";
  const std::size_t at = json.find(key);
  return at == std::string::npos ? 0 : std::stoull(json.substr(at + key.size()));
}

TEST(ExactWorkOfRuns, IsTheSameEachTimeAndLimitsTheRun) {
  const std::vector<std::string> arguments{"run", kWild, "--structures", "power", "--quiet", "--json", "-"};
  const ProgramRun free = run_program(arguments);
  ASSERT_EQ(free.code, 0) << free.err;
  const std::uint64_t work = work_in(free.out);
  ASSERT_GT(work, 1000U);
  auto with_limit = arguments;
  with_limit.insert(with_limit.end(), {"--work", std::to_string(work)});
  const ProgramRun same = run_program(with_limit);
  EXPECT_EQ(same.code, 0) << same.err;
  EXPECT_EQ(work_in(same.out), work);
  for (const std::uint64_t limit : {work - 1, work / 2, std::uint64_t{0}}) {
    with_limit.back() = std::to_string(limit);
    const ProgramRun ended = run_program(with_limit);
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
