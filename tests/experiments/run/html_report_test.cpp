// The page must open without a network and stay a valid page for any file names.

#include "experiments/run/html_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/experiments/sample_report.h"
#include "tests/experiments/sound_page.h"

namespace kds::html_report_test {
namespace {

using test::count_of;
using test::expect_sound;
using testing::HasSubstr;
using testing::Not;

TEST(HtmlReport, ShowsTableAndPlots) {
  const std::string html = html_report(test::sample_report());
  expect_sound(html);
  EXPECT_EQ(count_of(html, "<figure>"), 4U);  // kinds of both structures, events per step, and events so far
  for (const char* text : {"<title>kds run: chain.pdb</title>", "1,234,567", "0000000000abcdef", "wrapped",
                           "power", "events per step", "events so far", "motion linear, kernel filtered"})
    EXPECT_THAT(html, HasSubstr(text));
}

TEST(HtmlReport, BeginsWithWhatWasFound) {
  const std::string html = html_report(test::sample_report());
  EXPECT_THAT(html,
              HasSubstr("<div class=\"found\">\n<p>In 3 motion steps of 36 beads:</p>\n<ul>\n"
                        "<li>The <strong>wrapped</strong> structure changed 6 times (2.000 per step).</li>\n"
                        "<li>The <strong>power</strong> structure changed 30 times (10.00 per step).</li>\n"
                        "</ul>\n</div>"));
}

TEST(HtmlReport, SentencesNameResidues) {
  RunReport report = test::sample_report();
  report.structures[1].distribution.by_bead = {1, 0, 5};
  report.approach = ClosestApproach{{0, 2}, 7, 0.5, {1, 2}};
  EXPECT_THAT(html_report(report), HasSubstr("(10.00 per step), most often at bead 2 (5).</li>"));
  EXPECT_THAT(html_report(report), HasSubstr("<dd>bead 0 and bead 2 come nearest, to 2,"));
  report.bead_names = {"N of ALA 59", "CA of ALA 59", "C of ALA 59"};
  EXPECT_THAT(html_report(report), HasSubstr("most often at bead 2, C of ALA 59 (5).</li>"));
  EXPECT_THAT(html_report(report),
              HasSubstr("<dd>bead 0, N of ALA 59 and bead 2, C of ALA 59 come nearest, to 2,"));
}

TEST(HtmlReport, TitlesOfManyInputsAreShort) {
  RunReport report = test::sample_report();
  report.files = {"dir/a.pdb", "b.pdb"};
  EXPECT_THAT(html_report(report), HasSubstr("<title>kds run: a.pdb, b.pdb</title>"));
  report.files.assign(40, "a_trajectory_of_villin.dcd");
  report.files[0] = "first_trajectory_of_villin.dcd";
  EXPECT_THAT(html_report(report),
              HasSubstr("<title>kds run: first_trajectory_of_villin.dcd and 39 more</title>"));
}

TEST(HtmlReport, OppositeKindsShareARow) {
  RunReport report = test::sample_report();
  report.structures[1].events_by_kind.emplace_back("4-1", 4);  // without its opposite
  report.structures[0].events_by_kind.emplace_back("begin", 0);
  report.structures[0].events_by_kind.emplace_back("end", 0);
  const std::string html = html_report(report);
  for (const char* bar : {"enter: 3", "leave: 2", "pivot: 1", "2-3: 17", "3-2: 13", "4-1: 4"})
    EXPECT_EQ(count_of(html, ">" + std::string(bar) + "</text>"), 2U) << bar;  // wide and narrow
  EXPECT_EQ(count_of(html, ">begin: 0<") + count_of(html, ">end: 0<"), 0U);
  EXPECT_EQ(count_of(html, "with opposite kinds in one row.</figcaption>"), 2U);
}

TEST(HtmlReport, EachStructureHasItsOwnScale) {
  const std::string html = html_report(test::sample_report());
  for (const char* name : {"wrapped", "power"})
    EXPECT_EQ(count_of(html, "<h3>" + std::string(name) + "</h3>"), 2U);  // events per step, and so far
  RunReport one = test::sample_report();
  one.structures.pop_back();
  EXPECT_EQ(count_of(html_report(one), "<h3>"), 0U);
}

TEST(HtmlReport, MapsOfEventsAndContacts) {
  RunReport report = test::sample_report();
  report.beads = 3;
  EXPECT_THAT(html_report(report), Not(HasSubstr("Contact map")));
  EXPECT_THAT(html_report(report), Not(HasSubstr("Over time along the chain")));
  EventDistribution& distribution = report.structures[1].distribution;
  distribution.by_bead = {2, 0, 5};
  distribution.grid.beads_per_block = 2;
  distribution.grid.edges = {{10, {}}, {11, {}}, {14, {}}};
  distribution.grid.counts = {{2, 0}, {0, 5}};
  report.contact_pairs = {{0, 2, 0.5}, {1, 2, 0}};
  report.bead_names = {"N of ALA 59 in chain A", "CA of ALA 59 in chain A", "C of ALA 59 in chain A"};
  const std::string html = html_report(report);
  expect_sound(html);
  for (const std::string text :
       {"ALA 59\nframes 10 to 11\nevents: 2", "C of ALA 59\nframes 11 to 14\nevents: 5",
        "N of ALA 59 and C of ALA 59\noccupancy: 0.5", "CA of ALA 59 and C of ALA 59\noccupancy: 0"})
    EXPECT_EQ(count_of(html, "<title>" + text + "</title>"), 1U) << text;
  EXPECT_THAT(html, Not(HasSubstr("frames 10 to 11\nevents: 0")));

  // Two files may use one chain name.
  report.bead_names.back() = report.bead_names.front();
  const std::string numbered = html_report(report);
  for (const std::string text :
       {"beads 0 to 1\nframes 10 to 11\nevents: 2",
        "bead 0, N of ALA 59 in chain A and bead 2, N of ALA 59 in chain A\noccupancy: 0.5"})
    EXPECT_EQ(count_of(numbered, "<title>" + text + "</title>"), 1U) << text;
  report.bead_names.back() = "N of ALA 59 in chain B";
  EXPECT_THAT(html_report(report), HasSubstr("N of ALA 59 in chain A and N of ALA 59 in chain B\n"));
}

// The time of a single run is one sample: the table shows it, but the findings do not.
TEST(HtmlReport, TimesOfSeveralRoundsHaveTheirSpread) {
  RunReport report = test::sample_report();
  EXPECT_THAT(html_report(report), Not(HasSubstr("Keeping the")));
  report.rounds = 3;
  report.structures[0].of_seconds = {0.5, 0.4, 0.75};
  report.structures[0].of_static_seconds = {2, 1.5, 2.5};
  report.structures[0].of_ratio = {0.25, 0.2, 0.3};
  const std::string html = html_report(report);
  EXPECT_THAT(html, HasSubstr("Keeping the wrapped structure took 0.250 (0.200 to 0.300) times as long"));
  EXPECT_THAT(html, HasSubstr("<td>0.500 <small>(0.400 to 0.750)</small></td>"));
  EXPECT_THAT(html, Not(HasSubstr("Keeping the power")));
}

TEST(HtmlReport, InternalKindsSaySo) {
  const std::string html = html_report(test::sample_report());
  EXPECT_EQ(count_of(html, ">wander (internal)</th>"), 1U);
  EXPECT_EQ(count_of(html, ">wander (internal): 5</text>"), 2U);  // wide and narrow
  EXPECT_THAT(html, Not(HasSubstr("3-2 (internal)")));
}

TEST(HtmlReport, SaysHowItWasMadeAndLinksItsData) {
  RunReport report = test::sample_report();
  report.command_line = "kds run 'a b.pdb'";
  const std::string html = html_report(report, {"summary.json", "events.csv"});
  EXPECT_THAT(html, HasSubstr("<code>kds run &#39;a b.pdb&#39;</code>"));
  EXPECT_THAT(html, HasSubstr("<a href=\"summary.json\">summary.json</a>, <a href=\"events.csv\">"));
}

TEST(HtmlReport, PlacesAndDisplacementsWhereTheyAreKnown) {
  RunReport report = test::sample_report();
  EXPECT_THAT(html_report(report), Not(HasSubstr("Along the chain")));
  report.structures[0].distribution.by_bead = {1, 0, 5};
  for (const double x : {0.0, 1.0, 4.0}) {
    Eigen::Matrix3Xd frame = Eigen::Matrix3Xd::Zero(3, 2);
    frame(0, 1) = x;
    report.displacement.add_frame(frame, {report.displacement.bins().size() + 10, {}});
  }
  EXPECT_EQ(report.displacement.width(), 1U);
  EXPECT_THAT(html_report(report), Not(HasSubstr("the largest value in any of them")));
  ASSERT_EQ(report.displacement.bins().size(), 2U);
  EXPECT_EQ(report.displacement.bins()[1].first_frame.number, 10U);
  EXPECT_EQ(report.displacement.bins()[1].most, 3);
  EXPECT_EQ(report.displacement.bins()[1].mean(), 1.5);
  const std::string html = html_report(report);
  expect_sound(html);
  EXPECT_THAT(html, HasSubstr("Along the chain"));
  EXPECT_THAT(html, HasSubstr("farthest bead: 3"));
  EXPECT_THAT(html, HasSubstr("bead 2\nwrapped: 5"));
  EXPECT_THAT(html, HasSubstr("wrapped: at most 5 events, at bead 2</text>"));
  report.bead_names = {"N of ALA 59", "CA of ALA 59", "C of ALA 59"};
  EXPECT_THAT(html_report(report), HasSubstr("bead 2, C of ALA 59\nwrapped: 5"));
}

// Axes show times if all frames have them in ascending order.
TEST(HtmlReport, AxesShowTimesWhereTheyAreKnown) {
  const auto html_with = [](const std::vector<std::optional<double>>& times) {
    RunReport report = test::sample_report();
    for (StructureReport& structure : report.structures) structure.course = EventCourse();
    for (std::size_t k = 0; k < times.size(); ++k) {
      const FrameStamp stamp{100 + k, times[k]};
      report.displacement.add_frame(Eigen::Matrix3Xd::Constant(3, 2, static_cast<double>(k)), stamp);
      if (k == 0) report.first_frame = stamp;
      report.last_frame = stamp;
      if (k + 1 == times.size()) break;
      for (StructureReport& structure : report.structures) structure.course.add(1, stamp);
    }
    return html_report(report);
  };
  const std::string timed = html_with({2.5, 7.5, 12.5, 17.5});
  expect_sound(timed);
  EXPECT_EQ(count_of(timed, ">time in picoseconds<"), 10U);  // five plots, wide and narrow
  EXPECT_EQ(count_of(timed, ">frame<"), 0U);
  EXPECT_THAT(timed, HasSubstr("17.5"));
  EXPECT_THAT(timed, Not(HasSubstr(">102<")));
  for (const std::vector<std::optional<double>>& times : {std::vector<std::optional<double>>{{}, {}, {}, {}},
                                                          {2.5, {}, 12.5, 17.5},
                                                          {2.5, 7.5, 7.5, 17.5},
                                                          {1e300, 1.1e300, 1.2e300, 1.7e308}}) {
    const std::string numbered = html_with(times);
    EXPECT_EQ(count_of(numbered, ">time in picoseconds<"), 0U);
    EXPECT_EQ(count_of(numbered, ">frame<"), 10U);
    EXPECT_THAT(numbered, HasSubstr("102"));
  }
}

// The farthest displacement in a bin is not labelled as a mean.
TEST(HtmlReport, BinsOfDisplacementsSayWhatTheyAre) {
  RunReport report = test::sample_report();
  report.displacement = Displacements(2);
  for (std::size_t k = 0; k < 5; ++k)
    report.displacement.add_frame(Eigen::Matrix3Xd::Constant(3, 2, static_cast<double>(k * k)), {k, {}});
  ASSERT_EQ(report.displacement.bins().size(), 2U);
  EXPECT_THAT(html_report(report), HasSubstr("for 2 steps: the mean over these steps, and for the farthest "
                                             "bead the largest value in any of them"));
}

TEST(HtmlReport, EscapesNames) {
  RunReport report = test::sample_report();
  report.files = {"<b>&\"quote's\".pdb"};
  report.settings.emplace_back("chain", "</style><script>");
  report.structures[0].name = "it's <odd>";
  report.structures[1].events_by_kind.emplace_back("a<b", 1);
  expect_sound(html_report(report));
}

TEST(HtmlReport, OneStepShowsKindsInsteadOfACourse) {
  RunReport report = test::sample_report();
  for (StructureReport& structure : report.structures)
    structure.course = test::course_of({structure.events_total});
  const std::string html = html_report(report);
  expect_sound(html);
  EXPECT_THAT(html, HasSubstr("Events of the power structure by kind"));
  EXPECT_THAT(html, Not(HasSubstr("events so far")));
}

TEST(HtmlReport, LongRunsStaySmall) {
  RunReport report = test::sample_report();
  constexpr std::size_t steps = 300000;
  for (StructureReport& structure : report.structures) {
    structure.course = EventCourse(bin_width(steps, EventCourse::most_bins));
    for (std::size_t step = 0; step < steps; ++step) structure.course.add(1000000, {step, {}});
  }
  const std::string html = html_report(report);
  EXPECT_LT(html.size(), 500000U);
  EXPECT_THAT(html, HasSubstr("the mean over 500 steps"));
}

TEST(HtmlReport, NoEventsAreNoFailure) {
  RunReport report = test::sample_report();
  for (StructureReport& structure : report.structures) {
    structure.events_total = 0;
    for (auto& [kind, times] : structure.events_by_kind) times = 0;
    structure.course = test::course_of({0, 0, 0});
  }
  expect_sound(html_report(report));
  for (StructureReport& structure : report.structures) structure.course = test::course_of({0});
  expect_sound(html_report(report));
  expect_sound(html_report(RunReport{}));
}

}  // namespace
}  // namespace kds::html_report_test
