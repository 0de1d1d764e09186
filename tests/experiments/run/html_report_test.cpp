// The page must open without a network and stay a page whatever the files are called.

#include "experiments/run/html_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "experiments/output/svg_plot.h"
#include "tests/experiments/sample_report.h"

namespace kds {
namespace {

using testing::HasSubstr;
using testing::Not;

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t times = 0;
  for (std::size_t place = 0; (place = text.find(word, place)) != std::string::npos; place += word.size())
    ++times;
  return times;
}

// Every tag is closed in order; the page is written as XML would be, but for <meta> and the declaration.
void expect_nested(const std::string& html) {
  std::vector<std::string> open;
  for (std::size_t start = 0; (start = html.find('<', start)) != std::string::npos;) {
    const std::size_t end = html.find_first_of("<>", start + 1);
    ASSERT_TRUE(end != std::string::npos && html[end] == '>') << html.substr(start, 60);
    const std::string tag = html.substr(start + 1, end - start - 1);
    start = end;
    const bool closes = tag.starts_with('/');
    const std::size_t skip = closes ? 1 : 0;
    const std::string name = tag.substr(skip, tag.find_first_of(" \n\t/", 1) - skip);
    if (name == "!DOCTYPE" || name == "meta" || tag.ends_with('/')) continue;
    if (!closes) {
      open.push_back(name);
    } else {
      ASSERT_FALSE(open.empty()) << tag;
      ASSERT_EQ(open.back(), name);
      open.pop_back();
    }
  }
  EXPECT_TRUE(open.empty());
}

// What stands after each mark, up to a quote or bracket.
std::vector<std::string> words_after(const std::string& text, const std::vector<std::string>& marks) {
  std::vector<std::string> words;
  for (const std::string& mark : marks) {
    for (std::size_t place = 0; (place = text.find(mark, place)) != std::string::npos;) {
      place += mark.size();
      words.push_back(text.substr(place, text.find_first_of("\"')", place) - place));
    }
  }
  return words;
}

void expect_own_ids(const std::string& html) {
  std::set<std::string> ids;
  for (const std::string& id : words_after(html, {" id='", " id=\""}))
    EXPECT_TRUE(ids.insert(id).second) << id;
  for (const std::string& id : words_after(html, {"href='#", "href=\"#", "url(#"}))
    EXPECT_TRUE(ids.contains(id)) << id;
}

void expect_no_network(const std::string& html) {
  EXPECT_EQ(count(html, "http://"), count(html, "xmlns=\"http://www.w3.org/2000/svg\"") +
                                        count(html, "xmlns:xlink=\"http://www.w3.org/1999/xlink\""));
  for (const char* word : {"https://", "src=", "@import", "<script", "<link", "url(h"})
    EXPECT_THAT(html, Not(HasSubstr(word)));
}

void expect_sound(const std::string& html) {
  expect_nested(html);
  expect_own_ids(html);
  expect_no_network(html);
}

TEST(HtmlReport, ShowsTableAndBothPlots) {
  const std::string html = html_report(test::sample_report());
  expect_sound(html);
  EXPECT_EQ(count(html, "<svg"), 2U);
  for (const char* text : {"<title>kds run: chain.pdb</title>", "1,234,567", "0000000000abcdef", "wrapped",
                           "power", "events per step", "events so far", "motion linear, kernel filtered"})
    EXPECT_THAT(html, HasSubstr(text));
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
    for (std::size_t step = 0; step < steps; ++step) structure.course.add(1000000, step);
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

TEST(EmbeddableSvg, PrefixesIdsAndTheirReferences) {
  EXPECT_EQ(embeddable_svg("<?xml?>\n<svg><g id=\"a\"/><use xlink:href='#a' filter='url(#b)'/></svg>\n", "p"),
            "<svg><g id=\"p-a\"/><use xlink:href='#p-a' filter='url(#p-b)'/></svg>\n");
  EXPECT_THROW(static_cast<void>(embeddable_svg("no picture", "p")), std::runtime_error);
}

}  // namespace
}  // namespace kds
