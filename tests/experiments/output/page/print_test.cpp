// Files for print: what a page carries for them, and what write_page makes of it.

#include "experiments/output/page/print.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "experiments/output/page/html_page.h"
#include "experiments/output/page/svg_plot.h"
#include "tests/experiments/scratch_directory.h"
#include "tests/experiments/sound_page.h"

namespace kds::print_test {
namespace {

using test::content_of;
using test::count_of;
using test::ScratchDirectory;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

std::set<std::string> names_in(const std::filesystem::path& directory) {
  std::set<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(directory))
    if (const std::string name = file.path().filename().string(); !name.starts_with('.')) names.insert(name);
  return names;
}

void write(const std::filesystem::path& directory, const std::string& page, bool print) {
  AtomicFiles files(directory, "--out", true);
  write_page(files, page, print);
  commit_together({&files});
}

// The series differ by a factor of 100, so there is a panel for each.
std::string small_page() {
  const LinePlot plot{
      "frame", "events <b>", Drawn::line, {{"a_%", {{0, 1}, {1, 2}}}, {"b", {{0, 200}, {1, 9}}}}};
  const MapPlot map{"bead", "share", -0.5, 1.5, 1, {{0, 1, 0.5}, {1, 0, 1}}};
  Page page;
  page.title = "kds run: 50% & more";
  page.found = "<p>Found.</p>\n";
  page.body = html_section("Over time: a/b", html_figure(svg_plot(plot), "Events of <em>a</em> &amp; b.") +
                                                 html_table({"name", "value"}, {{{"x", "1"}}}));
  page.body += html_section("Over time: a/b", html_figure(svg_plot(map), "A map."));
  return html_page(page);
}

TEST(Print, FilesStandBesideThePageThatLinksThem) {
  const ScratchDirectory directory;
  const auto out = directory / "out";
  write(out, small_page(), true);
  const std::set<std::string> expected{"paper-all.tex",
                                       "paper-figure-over-time-a-b-2.pdf",
                                       "paper-figure-over-time-a-b-2.svg",
                                       "paper-figure-over-time-a-b-3.pdf",
                                       "paper-figure-over-time-a-b-3.svg",
                                       "paper-figure-over-time-a-b.pdf",
                                       "paper-figure-over-time-a-b.svg",
                                       "paper-table-over-time-a-b.tex",
                                       "report.html"};
  EXPECT_EQ(names_in(out), expected);
  const std::string page = content_of((out / "report.html").string());
  test::expect_sound(page);
  for (const std::string& name : expected) {
    if (name.starts_with("paper-") && name != "paper-all.tex") {
      EXPECT_THAT(page, HasSubstr("href=\"" + name + "\"")) << name;
    }
  }

  const std::string all = content_of((out / "paper-all.tex").string());
  EXPECT_THAT(all, HasSubstr("\\section*{\\raggedright kds run: 50\\% \\& more}"));
  EXPECT_THAT(all, HasSubstr("\\caption{Events of \\emph{a} \\& b.}"));
  EXPECT_THAT(all, HasSubstr("\\caption{A map.}"));
  EXPECT_EQ(count_of(all, "\\includegraphics{"), 3U);
  EXPECT_EQ(count_of(all, "\\begin{figure}"), 2U);  // both panels are one figure
  EXPECT_EQ(count_of(all, "\\input{paper-table-over-time-a-b}"), 1U);
  EXPECT_EQ(count_of(all, "\\begin{"), count_of(all, "\\end{"));
  EXPECT_THAT(content_of((out / "paper-table-over-time-a-b.tex").string()), StartsWith("\\begin{tabular}"));
}

// A drawing for print stands alone: it has a size, colours of its own and its name, and needs no page.
TEST(Print, DrawingsStandAlone) {
  const ScratchDirectory directory;
  const auto out = directory / "out";
  write(out, small_page(), true);
  const std::string svg = content_of((out / "paper-figure-over-time-a-b.svg").string());
  EXPECT_THAT(svg, HasSubstr("xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_THAT(svg, Not(HasSubstr("var(--")));
  EXPECT_THAT(svg, Not(HasSubstr("hypertext")));
  EXPECT_THAT(svg, HasSubstr("a_%"));
  EXPECT_THAT(svg, HasSubstr("events &lt;b"));
  EXPECT_EQ(count_of(svg, "</svg>"), 1U);
  const std::string map = content_of((out / "paper-figure-over-time-a-b-3.svg").string());
  EXPECT_TRUE(std::regex_search(map, std::regex("rgb\\( *37, *99, *168\\)")))
      << "squares in the first colour";
  for (const char* name : {"paper-figure-over-time-a-b.pdf", "paper-figure-over-time-a-b-3.pdf"}) {
    const std::string pdf = content_of((out / name).string());
    EXPECT_THAT(pdf, StartsWith("%PDF-")) << name;
    EXPECT_TRUE(std::regex_search(pdf.substr(pdf.size() - 8), std::regex("%%EOF\\s*$"))) << name;
  }
}

TEST(Print, WithoutTheOptionThePageCarriesNothingOfIt) {
  const ScratchDirectory directory;
  const auto out = directory / "out";
  write(out, small_page(), true);
  write(out, small_page(), false);  // the files of the earlier result go with it
  EXPECT_EQ(names_in(out), std::set<std::string>{"report.html"});
  const std::string page = content_of((out / "report.html").string());
  test::expect_sound(page);
  for (const char* part : {"paper-", "begin{tabular}", "\x01", "\x02", "c_s0"})
    EXPECT_THAT(page, Not(HasSubstr(part)));
}

TEST(Print, NoTextOfAPageIsTakenForACopy) {
  const ScratchDirectory directory;
  const auto out = directory / "out";
  Page page;
  page.title = "\x01t\x02";
  page.body = html_section("\x01p9\x02", html_table({"\x02"}, {{{"\x01s"}}}));
  write(out, html_page(page), true);
  EXPECT_EQ(names_in(out), (std::set<std::string>{"paper-all.tex", "paper-table-p9.tex", "report.html"}));
}

}  // namespace
}  // namespace kds::print_test
