// Axes and plots: where ticks stand, and what a page shows of values.

#include "experiments/output/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "experiments/output/axis.h"
#include "tests/experiments/sound_page.h"

namespace kds {
namespace {

using test::count_of;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> labels_of(const Axis& axis, std::size_t most) {
  std::vector<std::string> labels;
  for (const Tick& tick : axis.ticks(most)) labels.push_back(tick.label);
  return labels;
}

TEST(Axis, LinearTicksAreRound) {
  EXPECT_THAT(labels_of(Axis(0, 10, false), 5), ElementsAre("0", "2", "4", "6", "8", "10"));
  EXPECT_THAT(labels_of(Axis(-1, 1.2, false), 4), ElementsAre("-1", "0", "1"));
  EXPECT_THAT(labels_of(Axis(0, 43140, false), 5), ElementsAre("0", "10,000", "20,000", "30,000", "40,000"));
  Axis axis(0, 43140, false);
  axis.widen_to_ticks(5);
  EXPECT_THAT(labels_of(axis, 5), ElementsAre("0", "10,000", "20,000", "30,000", "40,000", "50,000"));
  EXPECT_DOUBLE_EQ(axis.share(25000), 0.5);
}

TEST(Axis, LogarithmicTicksArePowersOfTenWhereThereAreTwo) {
  EXPECT_THAT(labels_of(Axis(5, 2000, true), 5), ElementsAre("10", "100", "1,000"));
  EXPECT_THAT(labels_of(Axis(1.5, 9, true), 5), ElementsAre("2", "5"));
  EXPECT_GE(labels_of(Axis(1.1, 1.3, true), 5).size(), 2U);
  EXPECT_LE(labels_of(Axis(1e-12, 1e12, true), 5).size(), 7U);
  EXPECT_DOUBLE_EQ(Axis(1, 100, true).share(10), 0.5);
}

TEST(Axis, OneValueOrNoneHasARangeAroundIt) {
  EXPECT_DOUBLE_EQ(Axis(3, 3, false).share(3), 0.5);
  EXPECT_DOUBLE_EQ(Axis(0, 0, false).share(0), 0.5);
  EXPECT_NEAR(Axis(7, 7, true).share(7), 0.5, 1e-12);
  EXPECT_DOUBLE_EQ(Axis(0, 0, true).share(1), 1);
  const double next = std::nextafter(0.6, 1);  // steps of less than a last place would never arrive
  EXPECT_LE(Axis(0.6, next, false).ticks(5).size(), 7U);
  EXPECT_LE(Axis(0.6, next, true).ticks(5).size(), 7U);
}

TEST(TickLabel, ShowsSizesLegibly) {
  EXPECT_EQ(tick_label(0), "0");
  EXPECT_EQ(tick_label(-3), "-3");
  EXPECT_EQ(tick_label(12000), "12,000");
  EXPECT_EQ(tick_label(-1234), "-1,234");
  EXPECT_EQ(tick_label(0.25), "0.25");
  EXPECT_EQ(tick_label(1e6), "10⁶");
  EXPECT_EQ(tick_label(3e-7), "3·10⁻⁷");
  EXPECT_EQ(tick_label(-2.5e12), "-2.5·10¹²");
  EXPECT_EQ(tick_label(9999999), "10⁷");
}

TEST(SvgPlot, ValuesAreShownUnderThePointer) {
  LinePlot plot{"frame", "events", Drawn::line, {{"wrapped", {{0, 3}, {1, 4}}}, {"power", {{1, 40}}}}};
  const std::string html = svg_plot(plot);
  EXPECT_THAT(html, HasSubstr("<title>frame 0\nwrapped: 3</title>"));
  EXPECT_THAT(html, HasSubstr("<title>frame 1\nwrapped: 4\npower: 40</title>"));
  EXPECT_EQ(count_of(html, "class=\"curve"), 4U);  // two curves, wide and narrow
  EXPECT_EQ(count_of(html, "<span"), 2U);          // the key stands once
  test::expect_nested(html);
}

TEST(SvgPlot, MarksAloneWhereNothingIsKnownBetween) {
  const LinePlot plot{"stride", "events", Drawn::points, {{"wrapped", {{1, 30}, {4, 20}, {32, 10}}}}};
  const std::string html = svg_plot(plot);
  EXPECT_THAT(html, Not(HasSubstr("class=\"curve")));
  EXPECT_EQ(count_of(html, "class=\"mark"), 6U);
  for (const char* tick : {">1</text>", ">4</text>", ">32</text>"}) EXPECT_EQ(count_of(html, tick), 2U);
}

TEST(SvgPlot, NothingToShowIsNoFailure) {
  test::expect_nested(svg_plot(LinePlot{"x", "y", Drawn::line, {}}));
  test::expect_nested(svg_plot(LinePlot{"x", "y", Drawn::points, {{"a", {{0, 0}}}}}));
  test::expect_nested(svg_plot(PointPlot{"x", "y", {"a"}, {}}));
  test::expect_nested(svg_plot(PointPlot{"x", "y", {"a"}, {{"", 1, 0, 0}}}));
  test::expect_nested(svg_plot(BarPlot{"x", {{"a", 0}}}));
  test::expect_nested(svg_plot(MapPlot{"bead", "share", -0.5, 9.5, 1, {}}));
  EXPECT_THAT(svg_plot(LinePlot{"x", "y", Drawn::line, {{"a", {{0, 0}}}}}), Not(HasSubstr("nan")));
}

TEST(SvgPlot, NamesAreEscaped) {
  const std::string html =
      svg_plot(PointPlot{"<x>", "y&y", {"\"s\"", "t"}, {{"a<b", 1, 2, 0}, {"", 3, 0, 1}}});
  test::expect_nested(html);
  EXPECT_THAT(html, Not(HasSubstr("a<b")));
  EXPECT_THAT(html, HasSubstr("&quot;s&quot;"));
}

TEST(SvgPlot, LongCurvesHaveNoMorePlacesThanPixels) {
  LinePlot plot{"x", "y", Drawn::line, {{"a", {}}}};
  for (int x = 0; x < 5000; ++x) plot.curves[0].points.emplace_back(x, x % 7);
  EXPECT_LE(count_of(svg_plot(plot), "class=\"hot\""), 400U);
}

}  // namespace
}  // namespace kds
