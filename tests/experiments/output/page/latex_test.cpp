// LaTeX for print: escaped text, captions and tables.

#include "experiments/output/page/latex.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "experiments/output/page/table.h"
#include "experiments/output/text.h"

namespace kds::latex_test {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Latex, SpecialCharactersAreEscaped) {
  EXPECT_EQ(latex_escaped("50% & a_b #1 ${x}"), "50\\% \\& a\\_b \\#1 \\$\\{x\\}");
  EXPECT_EQ(latex_escaped("\\~^"), "\\textbackslash{}\\textasciitilde{}\\textasciicircum{}");
  EXPECT_EQ(latex_escaped("a<b>|"), "a\\textless{}b\\textgreater{}\\textbar{}");
  EXPECT_EQ(latex_escaped("two\nlines\x02"), "two lines");
}

TEST(Latex, PowersAndSignsAreMathematics) {
  EXPECT_EQ(latex_escaped(tick_label(-3e-12)), "-3$\\cdot$10$^{-12}$");
  EXPECT_EQ(latex_escaped("n² ≤ 5 Å"), "n$^{2}$ $\\le$ 5 \\AA{}");
  EXPECT_EQ(latex_escaped("Zürich"), "Zürich");
}

TEST(Latex, CaptionsKeepTheirEmphasis) {
  EXPECT_EQ(latex_of_html("one in <em>stride &amp; 5%</em> is <code>--out</code>, &lt;b&gt;"),
            "one in \\emph{stride \\& 5\\%} is \\texttt{--out}, \\textless{}b\\textgreater{}");
  EXPECT_EQ(latex_of_html("a <span class=\"x\">b</span> < 3"), "a b \\textless{} 3");
}

struct Row {
  std::string name;
  double value = 0;
  std::optional<double> seconds;
};
const Table<Row> table{{
    {"name", "name", [](const Row& r) { return Field(r.name); }},
    {"value", "value, angstrom", [](const Row& r) { return Field(r.value); }, with_decimals(1)},
    {"seconds", "time of a step, seconds", [](const Row& r) { return Field(r.seconds); }, with_decimals(2)},
}};
const std::vector<Row> rows{{"a_1", -0.5, 2}, {"b", 12, std::nullopt}};

TEST(Latex, TablesHaveUnitsSignsAndGaps) {
  EXPECT_EQ(
      table.latex(rows),
      "\\begin{tabular}{@{}lrr@{}}\n\\toprule\n"
      "name & \\shortstack[r]{value,\\\\angstrom} & \\shortstack[r]{time of a\\\\step,\\\\seconds} \\\\\n"
      "\\midrule\na\\_1 & $-$0.5 & 2.00 \\\\\nb & 12.0 & -- \\\\\n\\bottomrule\n\\end{tabular}\n");
}

TEST(Latex, GroupsOfRowsHaveNames) {
  const std::string latex = table.latex(rows, [](const Row& row) { return "case " + row.name; });
  EXPECT_THAT(latex,
              HasSubstr("\\midrule\n\\multicolumn{3}{@{}l@{}}{\\textbf{case a\\_1}} \\\\\n\\quad a\\_1 &"));
  EXPECT_THAT(latex, HasSubstr("\\addlinespace\n\\multicolumn{3}{@{}l@{}}{\\textbf{case b}}"));
}

TEST(Latex, LongTextIsAParagraph) {
  const std::vector<Row> longer{{std::string(60, 'x'), 1, 1}};
  EXPECT_THAT(table.latex(longer), HasSubstr("{@{}p{0.4\\linewidth}rr@{}}"));
  EXPECT_THAT(table.latex(rows), Not(HasSubstr("linewidth")));
}

// In tables of many columns a spread goes below its value, as on pages.
TEST(Latex, SpreadsOfWideTablesHaveTheirOwnLine) {
  const std::vector<HtmlRow> one{{{"x", "0.2 (0.1 to -0.3)"}}};
  EXPECT_THAT(latex_table(std::vector<std::string>(9, "y"), one, "<>"),
              HasSubstr("x & \\shortstack[r]{0.2\\\\{\\scriptsize (0.1 to -0.3)}} & "));
  EXPECT_THAT(latex_table({"a", "b"}, one, "<>"), HasSubstr("x & 0.2 (0.1 to -0.3) "));
}

// Each line of a tabular has as many cells as the tabular has columns.
TEST(Latex, LinesHaveACellForEachColumn) {
  const std::vector<HtmlRow> uneven{{{"one", "2", "3"}}, {{"a&b", "4"}, true}, {{"group"}}};
  const std::string latex = latex_table({"x", "y", "z & w"}, uneven, "<>");
  for (const std::string& line : split(latex, '\n')) {
    if (!line.ends_with("\\\\") || line.find("multicolumn") != std::string::npos) continue;
    std::size_t cells = 1;
    for (std::size_t k = 0; k < line.size(); ++k) cells += line[k] == '&' && (k == 0 || line[k - 1] != '\\');
    EXPECT_EQ(cells, 3U) << line;
  }
  EXPECT_EQ(latex_table({}, {}, "<"), "");
}

}  // namespace
}  // namespace kds::latex_test
