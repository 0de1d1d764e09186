#include "experiments/run/run_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/output/text.h"
#include "tests/experiments/sample_report.h"

namespace kds::table_test {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;

TEST(Table, ComparesStructuresFigureByFigure) {
  const std::string table = comparison_table(test::sample_report());
  EXPECT_THAT(table, HasSubstr("input     chain.pdb\n"));
  EXPECT_THAT(table, HasSubstr("36 beads, 4 frames, dimension 3, radius 1.5\n"));
  EXPECT_THAT(table, HasSubstr("motion linear, kernel filtered\n"));
  EXPECT_THAT(table, ContainsRegex("\n +wrapped +power\n"));
  EXPECT_THAT(table, ContainsRegex("\nevents +6 +30\n"));
  EXPECT_THAT(table, ContainsRegex("\n  enter +3 +-\n"));
  EXPECT_THAT(table, ContainsRegex("\n  2-3 +- +17\n"));
  EXPECT_THAT(table, ContainsRegex("\n  wander .internal. +- +5\n"));
  EXPECT_THAT(table, ContainsRegex("\nevents per step +2.000 +10.00\n"));
  EXPECT_THAT(table, ContainsRegex("\ncertificates created +1,234,567 +0\n"));
  EXPECT_THAT(table, ContainsRegex(
                         "\nfailure times settled by\n  double, all coefficients positive +1,000,000 +40\n"));
  EXPECT_THAT(table, ContainsRegex("\n  integers +- +2\n"));
  EXPECT_THAT(table, ContainsRegex("\nbits of the longest integer +54 +-\n"));
  EXPECT_THAT(table, ContainsRegex("\n  kinetic / static +0.250 +-\n"));
  EXPECT_THAT(table, ContainsRegex("\nrebuilds +0 +1\n"));
  EXPECT_TRUE(table.ends_with("\nfingerprint 0000000000abcdef\n"));
}

TEST(Table, NamesFramesByTheirNumberInTheFile) {
  RunReport report = test::sample_report();
  report.first_frame = FrameStamp{0, std::nullopt};
  report.last_frame = FrameStamp{3, std::nullopt};
  EXPECT_THAT(comparison_table(report), HasSubstr("36 beads, 4 frames, dimension 3"));
  report.first_frame = FrameStamp{100, std::nullopt};
  report.last_frame = FrameStamp{130, std::nullopt};
  EXPECT_THAT(comparison_table(report), HasSubstr("36 beads, 4 frames (100 to 130), dimension 3"));
  report.first_frame->picoseconds = 2;
  report.last_frame->picoseconds = 2.6;
  EXPECT_THAT(comparison_table(report), HasSubstr("4 frames (100 to 130, 2 to 2.6 ps), dimension 3"));
}

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

TEST(Table, LeavesOutEmptySettings) {
  RunReport report = test::sample_report();
  report.settings = {{"motion", "linear"}, {"topology", ""}, {"chain", ""}, {"radius", "auto"}};
  EXPECT_THAT(comparison_table(report), HasSubstr("\nsettings  motion linear, radius auto\n"));
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
