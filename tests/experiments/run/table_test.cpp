#include "experiments/run/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/output/text.h"
#include "tests/experiments/sample_report.h"

namespace kds::table_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(Table, ColumnsAreAligned) {
  bool inside = false;
  std::size_t width = 0, rows = 0;
  for (const std::string& line : split(comparison_table(test::sample_report()), '\n')) {
    if (line.ends_with("power")) {
      inside = true;
      width = line.size();
    } else if (line.empty()) {
      inside = false;
    } else if (inside && !line.ends_with(" settled by")) {
      EXPECT_EQ(line.size(), width) << line;
      ++rows;
    }
  }
  EXPECT_GT(rows, 15U);
}

TEST(Table, AStageWithoutALabelKeepsItsName) {
  RunReport report = test::sample_report();
  report.structures[1].stages = {{"newest", 7}};
  EXPECT_THAT(comparison_table(report), ContainsRegex("\n  newest +- +7\n"));
}

TEST(Table, OneStructureOfOddFiguresStillPrints) {
  RunReport report = test::sample_report();
  report.structures.resize(1);
  report.structures[0].course = EventCourse();
  report.structures[0].stages.clear();
  report.radius_max = 2;
  report.files = {"a\nb"};
  const std::string table = comparison_table(report);
  EXPECT_THAT(table, ContainsRegex("events per step +-\n"));
  EXPECT_THAT(table, testing::Not(HasSubstr("settled by")));
  EXPECT_THAT(table, HasSubstr("radii 1.5 to 2"));
  EXPECT_THAT(table, HasSubstr("input     a b\n"));
  EXPECT_FALSE(comparison_table(RunReport{}).empty());
}

}  // namespace
}  // namespace kds::table_test
