// Rows of bars along the chain: values under the pointer, names if they fit, and bins for long chains.

#include "experiments/output/page/svg_plot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

#include "tests/experiments/sound_page.h"

namespace kds::rows_plot_test {
namespace {

using test::count_of;
using testing::HasSubstr;
using testing::Not;

std::string bead(std::size_t column) { return "bead " + std::to_string(column); }

TEST(RowsPlot, EachColumnHasTheValuesOfAllRows) {
  const std::string html =
      svg_plot(RowsPlot{"bead", 3, bead, {{"wrapped", "", {0, 2, 4}}, {"it's <odd>", "", {1, 0, 0.5}}}});
  test::expect_nested(html);
  EXPECT_EQ(count_of(html, "class=\"hot\""), 3U);  // in the wide plot
  EXPECT_EQ(count_of(html, "<title>bead 1\nwrapped: 2\nit&#39;s &lt;odd&gt;: 0</title>"), 1U);
  EXPECT_EQ(count_of(html, "var(--s0)"), 4U);
}

TEST(RowsPlot, NotesStandWhereThereIsRoom) {
  const std::string note(60, 'n'), name(150, 'w');
  const std::string html =
      svg_plot(RowsPlot{"bead", 1, bead, {{"wrapped", note, {1}}, {name, "", {1}}, {"ä" + name, "", {1}}}});
  test::expect_nested(html);
  EXPECT_EQ(count_of(html, ">wrapped: " + note + "</text>"), 1U);
  EXPECT_EQ(count_of(html, ">wrapped</text>"), 1U);  // on narrow pages
  EXPECT_THAT(html, Not(HasSubstr(">" + name + "</text>")));
  EXPECT_EQ(count_of(html, "w…</text>"), 4U);
}

TEST(RowsPlot, OfManyColumnsSomeStandTogether) {
  RowsPlot plot{"bead", 1000, bead, {{"power", "", std::vector<double>(1000, 1)}}};
  plot.rows[0].values[1] = 3;
  const std::string html = svg_plot(plot);
  EXPECT_THAT(html, HasSubstr("<title>bead 0 to bead 2, mean\npower: 1.667</title>"));  // in the wide plot
  EXPECT_THAT(html, HasSubstr("<title>bead 999\npower: 1</title>"));
  EXPECT_LE(count_of(html, "class=\"hot\""), 560U);
}

TEST(RowsPlot, NothingToShowIsNoFailure) {
  test::expect_nested(svg_plot(RowsPlot{"bead", 0, bead, {}}));
  test::expect_nested(svg_plot(RowsPlot{"bead", 2, bead, {{"wrapped", "", {0, 0}}}}));
}

}  // namespace
}  // namespace kds::rows_plot_test
