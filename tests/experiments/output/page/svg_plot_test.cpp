// Plots: the positions of ticks, and the values that a page shows.

#include "experiments/output/page/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "experiments/output/page/gnuplot.h"
#include "tests/experiments/sound_page.h"

namespace kds::svg_plot_test {
namespace {

using test::count_of;
using testing::HasSubstr;
using testing::Not;

void expect_ticks(const std::string& html, const std::vector<std::string>& ticks) {
  for (const std::string& tick : ticks) EXPECT_EQ(count_of(html, ">" + tick + "</text>"), 2U) << tick;
}

TEST(SvgPlot, TicksAreRound) {
  LinePlot plot{"frame", "events", Drawn::line, {{"a", {{0, 0}, {70, 43140}}}}};
  const std::string html = svg_plot(plot);
  expect_ticks(html, {"10,000", "20,000", "30,000", "40,000", "50,000"});
  EXPECT_EQ(count_of(html, ",000</text>"), 10U);
  plot.below_zero = true;
  plot.curves[0].points = {{0, -1}, {70, 1.2}};
  expect_ticks(svg_plot(plot), {"-1", "1"});
}

TEST(SvgPlot, LogarithmicTicksArePowersOfTenWhereThereAreTwo) {
  const std::string powers = svg_plot(PointPlot{"x", "y", {"a"}, {{"", 5, 0.5, 0}, {"", 2000, 0.7, 0}}});
  expect_ticks(powers, {"10", "100", "1,000"});
  EXPECT_EQ(count_of(svg_plot(PointPlot{"x", "y", {"a"}, {{"", 1.5, 40, 0}, {"", 9, 60, 0}}}), ">5</text>"),
            2U);
  expect_ticks(svg_plot(PointPlot{"x", "y", {"a"}, {{"", 1, 1.2, 0}, {"", 90, 3.2, 0}}}),
               {"1.5", "2", "2.5", "3"});
  test::expect_nested(svg_plot(PointPlot{"x", "y", {"a"}, {{"", 1e-12, 1, 0}, {"", 1e12, 1, 0}}}));
}

// gnuplot draws no axis of width 1e-310.
TEST(SvgPlot, ValuesTooCloseForGnuplot) {
  for (const bool below_zero : {false, true}) {
    const std::vector<std::pair<double, double>> points{{1e-310, 0}, {2e-310, 3e-320}, {3e-310, 1e-320}};
    const std::string html = svg_plot(LinePlot{"x", "y", Drawn::line, {{"a", points}}, below_zero});
    EXPECT_EQ(count_of(html, "class=\"hot\""), 3U);
  }
}

// Steps smaller than a unit in the last place would never reach the end of an axis, and rounded ends would
// leave the axis.
TEST(SvgPlot, ValuesThatAreAsGoodAsEqual) {
  const double next = std::nextafter(0.6, 1);
  for (const bool below_zero : {false, true}) {
    const std::string html =
        svg_plot(LinePlot{"x", "y", Drawn::line, {{"a", {{0.6, next}, {next, 0.6}}}}, below_zero});
    EXPECT_EQ(count_of(html, "class=\"hot\""), 2U);
    EXPECT_LE(count_of(html, "<text>"), 40U);
  }
  EXPECT_EQ(count_of(svg_plot(LinePlot{"x", "y", Drawn::line, {{"a", {{1.0 / 3, 1}, {2.0 / 3, 2}}}}}),
                     "class=\"hot\""),
            2U);
}

TEST(SvgPlot, ColoursAreThePagesAndNoIdsAreShared) {
  const std::string html =
      svg_plot(LinePlot{"x", "y", Drawn::staircase, {{"a", {{0, 1}, {1, 2}}}, {"b", {{0, 2}, {1, 1}}}}});
  for (const char* colour : {"var(--s0)", "var(--s1)", "var(--soft)", "var(--line)"})
    EXPECT_THAT(html, HasSubstr(colour));
  for (const char* part : {"rgb(", " id=", "href", "onmouse", "<script", "xmlns"})
    EXPECT_THAT(html, Not(HasSubstr(part)));
}

TEST(SvgPlot, ATimelineHasARowForEachName) {
  const std::string html = svg_plot(
      TimelinePlot{"frame", 0, 100, {{"ALA 1, GLY 5", {{10, 20}, {50, 50}}}, {"ALA 1, LEU 9", {{0, 100}}}}});
  test::expect_nested(html);
  for (const char* part : {"ALA 1, GLY 5", "ALA 1, LEU 9", "frame"}) EXPECT_THAT(html, HasSubstr(part));
  const std::string less =
      svg_plot(TimelinePlot{"frame", 0, 100, {{"ALA 1, GLY 5", {{10, 20}}}, {"ALA 1, LEU 9", {}}}});
  EXPECT_EQ(count_of(html, "Z"), count_of(less, "Z") + 4);  // two more spans, on both pages
  EXPECT_EQ(count_of(html, "<title>"), 0U);
}

TEST(SvgPlot, EachSquareOfAMapHasItsValue) {
  const std::string html = svg_plot(MapPlot{"bead", "share", -0.5, 1.5, 1, {{0, 1, 0.5}, {1, 0, 1}}});
  EXPECT_EQ(count_of(html, "<title>bead 0, 1\nshare: 0.5</title>"), 1U);  // on the wide page
  EXPECT_EQ(count_of(html, "<title>bead 1, 0\nshare: 1</title>"), 1U);
  EXPECT_EQ(count_of(html, "Z"), 4U);  // each on both pages
  EXPECT_EQ(count_of(html, "</path>"), 2U);
}

TEST(SvgPlot, SquaresWithoutTextsAreOnePathOfEachStrength) {
  MapPlot plot{"bead", "share", -0.5, 9.5, 1, {}};
  for (int k = 0; k < 10; ++k) plot.squares.push_back({double(k), 3, k % 2 == 0 ? 0.5 : 1.0});
  const std::string html = svg_plot(plot), narrow = html.substr(html.find("class=\"narrow\""));
  const std::string squares = narrow.substr(narrow.find("class=\"squares\""));
  EXPECT_EQ(count_of(squares.substr(0, squares.find("</g>")), "<path"), 2U);
  EXPECT_EQ(count_of(squares, "Z"), 10U);
}

// 280 pixels for 1000 places: a square of one place would be thinner than a third of a pixel.
TEST(SvgPlot, SquaresOfLargeMapsStayVisibleAndTicksHaveNames) {
  MapPlot plot{"residue", "share", -0.5, 999.5, 1, {{500, 250, 1}}};
  plot.name_of = [](std::size_t place) { return "GLY " + std::to_string(place + 41); };
  const std::string html = svg_plot(plot);
  test::expect_nested(html);
  const std::string narrow = html.substr(html.find("class=\"narrow\""));
  const std::string path = narrow.substr(narrow.find(" d=\"M", narrow.find("class=\"squares\"")) + 5);
  const double from = std::stod(path), to = std::stod(path.substr(path.find('H') + 1));
  EXPECT_NEAR(std::abs(to - from), 2, 0.21);
  EXPECT_EQ(count_of(html, ">GLY 41</text>"), 4U);  // both axes on both pages
}

TEST(SvgPlot, OppositeBarsStandOnBothSides) {
  const std::string html = svg_plot(MirrorPlot{"events", {{{"in", 1200}, {"out", 30}}, {{"turn", 5}}}});
  test::expect_nested(html);
  for (const char* bar : {"in: 1,200", "out: 30", "turn: 5"})
    EXPECT_EQ(count_of(html, ">" + std::string(bar) + "</text>"), 2U) << bar;
  EXPECT_EQ(count_of(html, "text-anchor=\"end\""), 2U);  // only `out`
  test::expect_nested(svg_plot(MirrorPlot{"events", {{{"in", 0}, {"out", 0}}}}));
}

TEST(SvgPlot, HeatShowsItsValuesButNoZeros) {
  const auto text = [](std::size_t c, std::size_t r) {
    return "c" + std::to_string(c) + " r" + std::to_string(r);
  };
  HeatPlot plot{"frame", "bead", "events", {0, 1, 5}, {-0.5, 1.5, 2.5}, {{4, 0}, {1, 2}}, text};
  const std::string html = svg_plot(plot);
  test::expect_nested(html);
  for (const char* square : {"c0 r0\nevents: 4", "c1 r0\nevents: 1", "c1 r1\nevents: 2"})
    EXPECT_EQ(count_of(html, "<title>" + std::string(square) + "</title>"), 1U) << square;
  EXPECT_THAT(html, Not(HasSubstr("c0 r1")));
  plot.values = {{0, 0}, {0, 0}};
  EXPECT_EQ(count_of(svg_plot(plot), "<title>"), 0U);
}

TEST(SvgPlot, BarsHaveTheirNamesAndValues) {
  const std::string html = svg_plot(BarPlot{"events", {{"tip 'edge'", 1200}, {"`date` $b @c", 0}}});
  expect_ticks(html, {"tip 'edge'", "`date` $b @c", "1,200", "0"});
}

TEST(SvgPlot, NamesStandOnNoOtherPoint) {
  const PointPlot apart{"x", "y", {"s"}, {{"first", 1, 1, 0}, {"", 10, 10, 0}}},
      close{"x", "y", {"s"}, {{"first", 1, 1, 0}, {"", 1.1, 1, 0}, {"", 10, 10, 0}}};
  EXPECT_EQ(count_of(svg_plot(apart), ">first</text>"), 1U);  // on wide pages
  EXPECT_EQ(count_of(svg_plot(close), ">first</text>"), 0U);
}

TEST(SvgPlot, LongNamesOfBarsAreShortened) {
  const std::string name(80, 'w');
  const std::string html = svg_plot(BarPlot{"events", {{name, 3}, {"tip", 2}}});
  EXPECT_THAT(html, Not(HasSubstr(name)));
  EXPECT_EQ(count_of(html, "w…</text>"), 2U);
  expect_ticks(html, {"tip"});
}

TEST(SvgPlot, BarsOfSeriesHaveTheirColoursAndAKey) {
  const std::string html =
      svg_plot(BarPlot{"events", {{"enter", 3, 0}, {"", 2, 1}, {"leave", 1, 1}}, {"300 K", "400 K"}});
  test::expect_nested(html);
  EXPECT_THAT(html, HasSubstr("<span class=\"s0\">300 K</span> <span class=\"s1\">400 K</span>"));
  expect_ticks(html, {"enter", "leave", "3", "2", "1"});
  EXPECT_EQ(count_of(html, "var(--s0)"), 2U);
  EXPECT_EQ(count_of(html, "var(--s1)"), 4U);
}

LinePlot points_of(const std::vector<std::string>& names) {
  LinePlot plot{"stride", "events", Drawn::points, {}};
  for (const std::string& name : names) plot.curves.push_back({name, {{1, 2}, {4, 3}}});
  return plot;
}

TEST(SvgPlot, PanelsShareTheirKeyAndColours) {
  const std::string html =
      svg_plot(PanelPlot{{{"<box>", points_of({"a", "b"})}, {"power", points_of({"b"})}}});
  test::expect_nested(html);
  EXPECT_EQ(count_of(html, "class=\"key\""), 1U);
  EXPECT_EQ(count_of(html, "<svg class=\"wide\""), 2U);
  EXPECT_EQ(count_of(html, "<svg class=\"narrow\""), 2U);
  EXPECT_THAT(html, HasSubstr("<h3>&lt;box&gt;</h3>"));
  EXPECT_EQ(count_of(html, "fill=\"var(--s0)\""), 4U);  // two marks of a, in the wide and the narrow plot
  EXPECT_EQ(count_of(html, "fill=\"var(--s1)\""), 8U);  // b has the same colour in both panels
}

TEST(SvgPlot, PanelsWithMoreNamesThanColoursHaveKeysOfTheirOwn) {
  std::vector<std::string> first, second;
  for (char name = 'a'; name < 'i'; ++name) first.emplace_back(1, name);
  for (char name = 'i'; name < 'l'; ++name) second.emplace_back(1, name);
  const std::string html = svg_plot(PanelPlot{{{"x", points_of(first)}, {"y", points_of(second)}}});
  EXPECT_EQ(count_of(html, "class=\"key\""), 2U);
  EXPECT_THAT(html, HasSubstr("<span class=\"s0\">i</span>"));
}

TEST(PageSvg, WhatIsNoDrawingIsAFailure) {
  const DrawingSize size{10, 10, 1, 1, 1, 1};
  EXPECT_THROW(static_cast<void>(page_svg("", size, TextsOf::marks, {}, "")), std::runtime_error);
  EXPECT_THROW(static_cast<void>(page_svg("<svg><defs></defs>", size, TextsOf::squares, {"lost"}, "")),
               std::runtime_error);
  EXPECT_THROW(static_cast<void>(page_svg("<defs></defs>\n<use x='0'/>", size, TextsOf::marks, {}, "")),
               std::runtime_error);
}

TEST(SvgPlot, ValuesAreShownUnderThePointer) {
  LinePlot plot{
      "frame", "events", Drawn::line, {{"wrapped", {{0, 3}, {1, 4}}}, {"power", {{1, 30}, {2, 20}}}}};
  const std::string html = svg_plot(plot);
  EXPECT_THAT(html, HasSubstr("<title>frame 0\nwrapped: 3</title>"));
  EXPECT_THAT(html, HasSubstr("<title>frame 1\nwrapped: 4\npower: 30</title>"));
  EXPECT_EQ(count_of(html, "class=\"curve"), 4U);  // two curves, in the wide and the narrow plot
  EXPECT_EQ(count_of(html, "<span"), 2U);          // the key appears once
  test::expect_nested(html);
}

TEST(SvgPlot, MarksAloneWhereNothingIsKnownBetween) {
  const LinePlot plot{"stride", "events", Drawn::points, {{"wrapped", {{1, 30}, {4, 20}, {32, 10}}}}};
  const std::string html = svg_plot(plot);
  EXPECT_THAT(html, Not(HasSubstr("class=\"curve")));
  EXPECT_EQ(count_of(html, "class=\"mark"), 6U);
  for (const char* tick : {">1</text>", ">4</text>", ">32</text>"}) EXPECT_EQ(count_of(html, tick), 2U);
}

// A curve that is far below another would be a flat line on zero.
TEST(SvgPlot, CurvesOfOtherMagnitudeHavePanelsOfTheirOwn) {
  LinePlot plot{
      "frame", "events", Drawn::staircase, {{"box", {{0, 0}, {1, 2}}}, {"power", {{0, 0}, {1, 21}}}}};
  std::string html = svg_plot(plot);
  test::expect_nested(html);
  EXPECT_EQ(count_of(html, "<svg class=\"wide\""), 2U);
  EXPECT_THAT(html, HasSubstr("<h3>box</h3>"));
  EXPECT_THAT(html, HasSubstr("<h3>power</h3>"));
  EXPECT_THAT(html, Not(HasSubstr("class=\"key\"")));  // the headings tell the curves apart
  expect_ticks(html, {"20"});
  plot.curves.push_back({"sorted", {{0, 0}, {1, 19}}});
  html = svg_plot(plot);
  EXPECT_EQ(count_of(html, "<svg class=\"wide\""), 2U);
  EXPECT_THAT(html, HasSubstr("<h3>power, sorted</h3>"));
  plot.curves = {{"box", {{0, 0}, {1, 2}}}, {"power", {{0, 0}, {1, 20}}}};  // not more than ten times
  EXPECT_EQ(count_of(svg_plot(plot), "<svg class=\"wide\""), 1U);
  plot.curves = {{"none", {{0, 0}, {1, 0}}}, {"power", {{0, 0}, {1, 20}}}};  // zero is no magnitude
  EXPECT_EQ(count_of(svg_plot(plot), "<svg class=\"wide\""), 1U);
}

TEST(SvgPlot, MarksFarApartHaveALogarithmicAxis) {
  LinePlot plot{
      "stride", "events", Drawn::points, {{"box", {{1, 0.5}, {2, 0.7}}}, {"power", {{1, 40}, {2, 50}}}}};
  const std::string html = svg_plot(plot);
  EXPECT_EQ(count_of(html, "<svg class=\"wide\""), 1U);
  expect_ticks(html, {"10"});
  plot.curves.front().points.front().second = 0;  // zero has no logarithm
  EXPECT_EQ(count_of(svg_plot(plot), "<svg class=\"wide\""), 2U);
}

TEST(SvgPlot, ErrorBarsAreCurves) {
  LinePlot plot{"stride", "time", Drawn::points, {{"a", {{1, 2}, {2, 3}}, {{1, 3}, {2, 4.5}}}}};
  std::string html = svg_plot(plot);
  EXPECT_GE(count_of(html, "class=\"curve\""), 2U);
  expect_ticks(html, {"4"});  // the axis is as long as the bars
  PointPlot points{"n", "time", {"a"}, {{"", 1, 2, 0, 1, 3}, {"", 100, 20, 0}}};
  EXPECT_EQ(count_of(svg_plot(points), "class=\"curve\""), 2U);
  PointPlot across{"n", "time", {"a"}, {{"", 1, 2, 0, 0, 0, 0.5, 1000}, {"", 100, 20, 0}}};
  html = svg_plot(across);
  EXPECT_EQ(count_of(html, "class=\"curve\""), 2U);
  expect_ticks(html, {"1,000"});  // the axis is as long as the bars
}

TEST(SvgPlot, NothingToShowIsNoFailure) {
  test::expect_nested(svg_plot(LinePlot{"x", "y", Drawn::line, {}}));
  test::expect_nested(svg_plot(LinePlot{"x", "y", Drawn::points, {{"a", {{0, 0}}}}}));
  test::expect_nested(svg_plot(PointPlot{"x", "y", {"a"}, {}}));
  test::expect_nested(svg_plot(PointPlot{"x", "y", {"a"}, {{"", 1, 0, 0}}}));
  test::expect_nested(svg_plot(BarPlot{"x", {{"a", 0}}}));
  test::expect_nested(svg_plot(MapPlot{"bead", "share", -0.5, 9.5, 1, {}}));
  test::expect_nested(svg_plot(TimelinePlot{"frame", 0, 9, {{"ALA 1, GLY 5", {}}}}));
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
}  // namespace kds::svg_plot_test
